// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

namespace allpairs::python {

/// The parts of the modules _core and _files.
void bindErrors(pybind11::module_& module);
void bindArguments(pybind11::module_& module);
void bindPartition(pybind11::module_& module);
void bindSearch(pybind11::module_& module);
void bindElements(pybind11::module_& module);
void bindJoin(pybind11::module_& module);
void bindScene(pybind11::module_& module);
void bindWorld(pybind11::module_& module);
void bindWorlds(pybind11::module_& module);

}  // namespace allpairs::python
