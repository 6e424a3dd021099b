// SPDX-License-Identifier: MIT
#include "Bindings.h"

PYBIND11_MODULE(_files, module) {
  module.doc() = "What reads files for the package allpairs; a build without readers of scenes has it not.";
  allpairs::python::bindErrors(module);
  pybind11::module_::import("allpairs._core");  // has the types of arguments and results
  allpairs::python::bindScene(module);
  allpairs::python::bindJoin(module);
  allpairs::python::refusePickling(module);
}
