// SPDX-License-Identifier: MIT
#include "allpairs/join/Join.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "Bindings.h"
#include "Bounds.h"
#include "Executors.h"
#include "Interrupts.h"
#include "allpairs/scene/BoxValues.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

/// The fields of the package's JoinSummary, in its order.
py::tuple joinFiles(const std::vector<std::filesystem::path>& inputs,
                    const std::optional<std::filesystem::path>& output, join::JoinOptions& options,
                    std::size_t threads) {
  const join::JoinSummary summary = stoppably(kLong, Runs::OnThreads, [&](const StopFlag& stop) {
    options.stop = &stop;
    const std::unique_ptr<Executor> executor = executorOf(threads);
    options.executor = executor.get();
    return output ? join::joinFiles(inputs, *output, options) : join::countFiles(inputs, options);
  });
  return py::make_tuple(summary.pairs, summary.boxes, summary.cells, summary.copies, summary.wideBoxes,
                        summary.boxBytes, summary.pairBytes, summary.resumedCells, summary.secondBoxes,
                        summary.empty[0].count + summary.empty[1].count);
}

}  // namespace

void bindJoin(py::module_& module) {
  py::class_<scene::BoxValueFiles>(module, "BoxValueFiles")
      .def(py::init<>())
      .def_readwrite("margin", &scene::BoxValueFiles::margins)
      .def_readwrite("group", &scene::BoxValueFiles::groups)
      .def_readwrite("category", &scene::BoxValueFiles::categories)
      .def_readwrite("mask", &scene::BoxValueFiles::masks);
  py::class_<join::JoinOptions>(module, "JoinOptions")
      .def(py::init<>())
      .def("set_region", [](join::JoinOptions& options, const Bounds& region) { options.region = boxOf(region); })
      .def_readwrite("values", &join::JoinOptions::values)
      .def_readwrite("second_values", &join::JoinOptions::secondValues)
      .def_readwrite("distance", &join::JoinOptions::distance)
      .def_readwrite("memory", &join::JoinOptions::memory)
      .def_readwrite("work", &join::JoinOptions::work)
      .def_readwrite("resume", &join::JoinOptions::resume)
      .def_readwrite("second", &join::JoinOptions::second);
  module.def("join_files", &joinFiles);
}

}  // namespace allpairs::python
