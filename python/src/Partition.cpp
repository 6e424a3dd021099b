// SPDX-License-Identifier: MIT
#include "allpairs/partition/Partition.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "Arguments.h"
#include "Bindings.h"
#include "Bounds.h"
#include "Boxes.h"
#include "BufferProtocol.h"
#include "IdPairArray.h"
#include "Interrupts.h"
#include "NumberArray.h"
#include "Options.h"
#include "allpairs/Error.h"
#include "allpairs/StopFlag.h"
#include "allpairs/partition/Cell.h"

namespace allpairs::python {
namespace py = pybind11;
namespace {

using partition::Cell;
using partition::Cut;
using partition::IdPair;
using partition::Partition;

Cell cellOf(const Bounds& bounds) {
  const Box box = boxOf(bounds);
  return {box.min, box.max};
}

py::buffer_info idsOf(const py::buffer& ids) {
  py::buffer_info held = ids.request();
  if (held.ndim != 1 || held.itemsize != 8) throw InvalidArgument("ids of another kind than the module takes");
  return held;
}

std::unique_ptr<IdPairArray> overlapsInCell(const Boxes& boxes, const py::buffer& ids, const Bounds& cell,
                                            Options& options) {
  const py::buffer_info held = idsOf(ids);
  return arrayOf(options.run(boxes.set().size(), [&](const OverlapOptions& settings) {
    return partition::overlapsInCell(boxes.set(), valuesOf<std::uint64_t>(held), cellOf(cell), settings);
  }));
}

/// Boxes and their ids.
using Identified = std::pair<const Boxes*, py::buffer>;

std::unique_ptr<IdPairArray> overlapsBetweenInCell(const Identified& first, const Identified& second,
                                                   const Bounds& cell, Options& options) {
  const py::buffer_info firstIds = idsOf(first.second);
  const py::buffer_info secondIds = idsOf(second.second);
  const BoxView& a = first.first->set();
  const BoxView& b = second.first->set();
  return arrayOf(options.run(a.size() + b.size(), [&](const OverlapOptions& settings) {
    return partition::overlapsInCell(a, valuesOf<std::uint64_t>(firstIds), b, valuesOf<std::uint64_t>(secondIds),
                                     cellOf(cell), settings);
  }));
}

std::uint64_t countInCell(const Boxes& boxes, const Bounds& cell, Options& options) {
  return options.run(boxes.set().size(), [&](const OverlapOptions& settings) {
    return partition::countOverlapsInCell(boxes.set(), cellOf(cell), settings);
  });
}

std::uint64_t countBetweenInCell(const Boxes& first, const Boxes& second, const Bounds& cell, Options& options) {
  return options.run(first.set().size() + second.set().size(), [&](const OverlapOptions& settings) {
    return partition::countOverlapsInCell(first.set(), second.set(), cellOf(cell), settings);
  });
}

std::unique_ptr<RealArray> cellsOf(const Partition& partition) {
  std::vector<double> numbers;
  for (const Cell& cell : partition.cells()) append(numbers, cell);
  return arrayOf(std::move(numbers), 6);
}

/// Rows of at, axis, low and high: small integers are exact in float64.
std::unique_ptr<RealArray> cutsOf(const Partition& partition) {
  std::vector<double> numbers;
  for (const Cut& cut : partition.cuts()) {
    numbers.insert(numbers.end(), {cut.at, static_cast<double>(cut.axis), static_cast<double>(cut.low),
                                   static_cast<double>(cut.high)});
  }
  return arrayOf(std::move(numbers), 4);
}

Partition fromCuts(const std::vector<std::array<double, 4>>& rows) {
  std::vector<Cut> cuts;
  for (const auto& row : rows) {
    const auto isNumber = [](double value) { return std::abs(value) <= 2147483647.0 && value == std::trunc(value); };
    if (!std::all_of(row.begin() + 1, row.end(), isNumber) || row[1] < 0.0) {
      throw InvalidArgument("cuts that are those of no partition");
    }
    cuts.push_back({row[0], static_cast<std::uint32_t>(row[1]), static_cast<std::int32_t>(row[2]),
                    static_cast<std::int32_t>(row[3])});
  }
  return Partition::fromCuts(cuts);
}

/// Rows of a box and a cell that it goes to.
std::unique_ptr<OffsetArray> cellsOfBoxes(const Partition& partition, const Boxes& boxes, double distance,
                                          double maxMargin) {
  const BoxView& set = boxes.set();
  return stoppably(set.size(), Runs::Alone, [&](const StopFlag& stop) {
    std::vector<std::uint64_t> rows;
    const double greatest = std::max(maxMargin, partition::greatestMargin(set));
    std::vector<std::uint32_t> ordered;
    const auto reach = [&](std::size_t i) { return partition::reachOf(set[i], set.margin(i), distance, greatest); };
    partition.visitCells(set.size(), reach, [&](std::size_t i, Span<const std::uint32_t> cells) {
      checkStop(&stop);
      ordered.assign(cells.begin(), cells.end());
      std::sort(ordered.begin(), ordered.end());
      for (const std::uint32_t cell : ordered) rows.insert(rows.end(), {i, cell});
    });
    return arrayOf(std::move(rows), 2);
  });
}

}  // namespace

void bindPartition(py::module_& module) {
  const py::class_<IdPairArray> pairs(module, "IdPairArray", tableProtocol<IdPairArray>());
  py::class_<Partition>(module, "Partition")
      .def(py::init([](const Boxes& sample, std::size_t cells, double distance) {
        return stoppably(sample.set().size(), Runs::Alone,
                         [&](const StopFlag& stop) { return Partition(sample.set(), cells, distance, &stop); });
      }))
      .def_static("from_cuts", &fromCuts)
      .def("cuts", &cutsOf)
      .def("cells", &cellsOf)
      .def("cells_of", &cellsOfBoxes)
      .def("__len__", &Partition::size);
  module.def("overlaps_in_cell", &overlapsInCell);
  module.def("overlaps_between_in_cell", &overlapsBetweenInCell);
  module.def("count_in_cell", &countInCell);
  module.def("count_between_in_cell", &countBetweenInCell);
}

}  // namespace allpairs::python
