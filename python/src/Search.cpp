// SPDX-License-Identifier: MIT
#include "allpairs/Overlaps.h"

#include <pybind11/stl.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "Batches.h"
#include "Bindings.h"
#include "Bounds.h"
#include "Boxes.h"
#include "BufferProtocol.h"
#include "NumberArray.h"
#include "Options.h"
#include "PairArray.h"
#include "allpairs/Neighbors.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

/// From so many boxes on Python gets the pairs in the memory of the search: a vector of many pairs would be touched,
/// and filled with zeros, for the first time. Of fewer boxes, the memory of one call is there for the next
/// (docs/decisions/0015).
constexpr std::size_t kManyBoxes = std::size_t{1} << 14;

template <class... Sets>
std::unique_ptr<PairArray> pairsOf(const OverlapOptions& settings, const Sets&... sets) {
  if ((sets.size() + ...) < kManyBoxes) return toPython(overlaps(sets..., settings));
  OverlapSearch search(settings);
  const std::span<const Pair> pairs = search.find(sets...);
  search.setOptions({});  // what the settings refer to is gone before the pairs are
  search.shrink();
  return std::make_unique<PairArray>(std::move(search), pairs);
}

std::unique_ptr<PairArray> findPairs(const Boxes& boxes, Options& options) {
  const BoxView& set = boxes.set();
  return options.run(set.size(), [&](const OverlapOptions& settings) { return pairsOf(settings, set); });
}

std::unique_ptr<PairArray> findPairsBetween(const Boxes& first, const Boxes& second, Options& options) {
  return options.run(first.set().size() + second.set().size(),
                     [&](const OverlapOptions& settings) { return pairsOf(settings, first.set(), second.set()); });
}

py::tuple toTuple(Neighbors found) {
  return py::make_tuple(arrayOf(std::move(found.offsets)), arrayOf(std::move(found.indices)));
}

py::tuple findNeighbors(const Boxes& boxes, NeighborRows rows, Options& options) {
  const BoxView& set = boxes.set();
  return toTuple(
      options.run(set.size(), [&](const OverlapOptions& settings) { return neighbors(set, rows, settings); }));
}

py::tuple findNeighborsBetween(const Boxes& first, const Boxes& second, Options& options) {
  return toTuple(options.run(first.set().size() + second.set().size(), [&](const OverlapOptions& settings) {
    return neighbors(first.set(), second.set(), settings);
  }));
}

std::uint64_t countPairs(const Boxes& boxes, Options& options) {
  const BoxView& set = boxes.set();
  return options.run(set.size(), [&](const OverlapOptions& settings) { return countOverlaps(set, settings); });
}

std::uint64_t countPairsBetween(const Boxes& first, const Boxes& second, Options& options) {
  return options.run(first.set().size() + second.set().size(), [&](const OverlapOptions& settings) {
    return countOverlaps(first.set(), second.set(), settings);
  });
}

void bindOptions(py::module_& module) {
  py::enum_<Side>(module, "Side").value("FIRST", Side::First).value("SECOND", Side::Second);
  py::enum_<Order>(module, "Order")
      .value("first", Order::ByFirst)
      .value("second", Order::BySecond)
      .value("unordered", Order::Unordered);
  py::enum_<Strategy>(module, "Strategy")
      .value("auto", Strategy::Automatic)
      .value("exhaustive", Strategy::Exhaustive)
      .value("bvh", Strategy::Bvh);
  py::enum_<NeighborRows>(module, "NeighborRows").value("full", NeighborRows::Full).value("half", NeighborRows::Half);
  py::class_<Options, std::shared_ptr<Options>>(module, "Options")
      .def(py::init<>())
      .def_readwrite("threads", &Options::threads)
      .def("set_distance", [](Options& self, double distance) { self.engine.distance = distance; })
      .def("set_order", [](Options& self, Order order) { self.engine.order = order; })
      .def("set_strategy", [](Options& self, Strategy strategy) { self.engine.strategy = strategy; })
      .def("set_max_pairs", [](Options& self, std::uint64_t count) { self.engine.maxPairs = count; })
      .def("set_region", [](Options& self, const Bounds& region) { self.engine.region = boxOf(region); })
      .def("set_groups", &Options::setGroups)
      .def("set_categories", &Options::setCategories)
      .def("set_masks", &Options::setMasks)
      .def("set_ignored", &Options::setIgnored);
}

}  // namespace

void bindArguments(py::module_& module) {
  py::class_<Boxes, std::shared_ptr<Boxes>>(module, "Boxes")
      .def(py::init<const py::buffer&, const py::buffer&, std::string>())
      .def("__len__", [](const Boxes& self) { return self.set().size(); })
      .def("set_margin", &Boxes::setMargin)
      .def("set_margins", &Boxes::setMargins);
  const py::class_<PairArray> pairs(module, "PairArray", tableProtocol<PairArray>());
  bindOptions(module);
}

void bindSearch(py::module_& module) {
  py::class_<Batches>(module, "Batches")
      .def(py::init<std::shared_ptr<Boxes>, std::shared_ptr<Boxes>, std::shared_ptr<Options>, std::size_t>())
      .def("next", &Batches::next)
      .def("close", &Batches::close);
  module.def("overlaps", &findPairs);
  module.def("overlaps_between", &findPairsBetween);
  module.def("neighbors", &findNeighbors);
  module.def("neighbors_between", &findNeighborsBetween);
  module.def("count", &countPairs);
  module.def("count_between", &countPairsBetween);
  module.def("instruction_sets", [] {
    py::tuple names(instructionSets().size());
    std::size_t i = 0;
    for (const std::string_view name : instructionSets()) names[i++] = py::str(name.data(), name.size());
    return names;
  });
}

}  // namespace allpairs::python
