// SPDX-License-Identifier: MIT
#include "Bindings.h"

PYBIND11_MODULE(_core, module) {
  module.doc() = "What the package allpairs is made of; its own interface is the package's.";
  module.attr("version") = ALLPAIRS_VERSION;
  allpairs::python::bindErrors(module);
  allpairs::python::bindArguments(module);
  allpairs::python::bindSearch(module);
  allpairs::python::bindElements(module);
  allpairs::python::bindWorld(module);
  allpairs::python::bindWorlds(module);
  allpairs::python::bindPartition(module);
  allpairs::python::refusePickling(module);
}
