// SPDX-License-Identifier: MIT
// Space cut at random, each cell searched by itself: together the cells have the pairs of the double loop, each once.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "allpairs/partition/Cell.h"
#include "allpairs/partition/Partition.h"
#include "support/AnyBoxes.h"
#include "support/Boxes.h"
#include "support/Oracle.h"

namespace allpairs::partition {
namespace {

using test::distance;
using test::scene;

/// A tree of cuts anywhere, at coordinates that boxes have too.
Partition anyPartition() {
  const auto places = *rc::gen::resize(12, rc::gen::container<std::vector<double>>(test::coordinate()));
  std::vector<Cut> cuts;
  std::vector<std::int32_t*> open;
  cuts.reserve(places.size());
  std::int32_t cells = 0;
  for (const double at : places) {
    if (std::isinf(at)) continue;
    const auto axis = static_cast<std::uint32_t>(*rc::gen::inRange(0, 3));
    if (!open.empty()) {
      const auto chosen = *rc::gen::inRange<std::size_t>(0, open.size());
      *open[chosen] = static_cast<std::int32_t>(cuts.size());
      open.erase(open.begin() + static_cast<std::ptrdiff_t>(chosen));
    }
    Cut& cut = cuts.emplace_back(Cut{at, axis});
    open.push_back(&cut.low);
    open.push_back(&cut.high);
  }
  for (std::int32_t* side : open) *side = ~cells++;
  return Partition::fromCuts(cuts);
}

/// Numbers that are not dense; in order where margins differ, and now and then otherwise.
std::vector<std::uint64_t> someIds(const std::vector<double>& margins) {
  std::vector<std::uint64_t> ids(margins.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = (std::uint64_t{1} << 40) + (i * 37) % 1009;
  const bool doDiffer = std::adjacent_find(margins.begin(), margins.end(), std::not_equal_to()) != margins.end();
  if (doDiffer || *rc::gen::inRange(0, 2) == 0) std::sort(ids.begin(), ids.end());
  return ids;
}

struct CellBoxes {
  std::vector<Box> boxes{};
  std::vector<std::uint64_t> ids{};
  std::vector<double> margins{};
};

double greatest(const std::vector<double>& margins) {
  return margins.empty() ? 0.0 : *std::max_element(margins.begin(), margins.end());
}

/// Those of all boxes that go to a cell.
CellBoxes boxesOf(const Partition& partition, std::uint32_t cell, const CellBoxes& all, double d) {
  const auto& [boxes, ids, margins] = all;
  const double maxMargin = greatest(margins);
  CellBoxes result;
  std::vector<std::uint32_t> cells;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box reach = reachOf(boxes[i], margins[i], d, maxMargin);
    partition.cellsOf(reach, cells);
    const bool isIn = std::find(cells.begin(), cells.end(), cell) != cells.end();
    RC_ASSERT(isIn == touches(partition.cell(cell), reach));
    if (!isIn) continue;
    result.boxes.push_back(boxes[i]);
    result.ids.push_back(ids[i]);
    result.margins.push_back(margins[i]);
  }
  return result;
}

std::vector<double> someMargins(std::size_t count) {
  if (*rc::gen::inRange(0, 2) == 0) return std::vector<double>(count, 0.0);
  return *rc::gen::container<std::vector<double>>(count, distance());
}

RC_GTEST_PROP(CellProperty, TheCellsOfAnyCutsHaveTheOraclesPairsOnce, ()) {
  const auto boxes = *scene();
  const std::vector<double> margins = someMargins(boxes.size());
  const double d = *distance();
  const Partition partition = anyPartition();
  const std::vector<std::uint64_t> ids = someIds(margins);
  std::vector<IdPair> expected;
  for (const Pair pair : test::oracle(boxes, d, margins)) {
    const auto [low, high] = std::pair(ids[pair.first], ids[pair.second]);
    expected.push_back({std::min(low, high), std::max(low, high)});
  }
  std::sort(expected.begin(), expected.end());
  std::vector<IdPair> found;
  for (std::uint32_t cell = 0; cell < partition.size(); ++cell) {
    const CellBoxes own = boxesOf(partition, cell, {boxes, ids, margins}, d);
    BoxView view(own.boxes);
    view.setMargins(own.margins);
    const auto pairs = overlapsInCell(view, own.ids, partition.cell(cell), {.distance = d});
    RC_ASSERT(std::is_sorted(pairs.begin(), pairs.end()));
    RC_ASSERT(countOverlapsInCell(view, partition.cell(cell), {.distance = d}) == pairs.size());
    found.insert(found.end(), pairs.begin(), pairs.end());
  }
  std::sort(found.begin(), found.end());
  RC_ASSERT(found == expected);
}

RC_GTEST_PROP(CellProperty, TheCellsHaveThePairsOfTwoSetsOnce, ()) {
  const auto first = *scene();
  const auto second = *scene();
  const std::vector<double> firstMargins(first.size(), 0.0);
  const std::vector<double> secondMargins(second.size(), 0.0);
  const double d = *distance();
  const Partition partition = anyPartition();
  const std::vector<std::uint64_t> firstIds = someIds(firstMargins);
  const std::vector<std::uint64_t> secondIds = someIds(secondMargins);
  std::vector<IdPair> expected;
  for (const Pair pair : test::oracleBetween(first, second, d)) {
    expected.push_back({firstIds[pair.first], secondIds[pair.second]});
  }
  std::sort(expected.begin(), expected.end());
  std::vector<IdPair> found;
  for (std::uint32_t cell = 0; cell < partition.size(); ++cell) {
    const CellBoxes a = boxesOf(partition, cell, {first, firstIds, firstMargins}, d);
    const CellBoxes b = boxesOf(partition, cell, {second, secondIds, secondMargins}, d);
    const auto pairs = overlapsInCell(a.boxes, a.ids, b.boxes, b.ids, partition.cell(cell), {.distance = d});
    RC_ASSERT(std::is_sorted(pairs.begin(), pairs.end()));
    RC_ASSERT(countOverlapsInCell(a.boxes, b.boxes, partition.cell(cell), {.distance = d}) == pairs.size());
    found.insert(found.end(), pairs.begin(), pairs.end());
  }
  std::sort(found.begin(), found.end());
  RC_ASSERT(found == expected);
}

RC_GTEST_PROP(CellProperty, EveryPointIsInOneCell, ()) {
  const Partition partition = anyPartition();
  const auto point = *rc::gen::container<Point>(test::coordinate());
  std::vector<std::uint32_t> holding;
  for (std::uint32_t cell = 0; cell < partition.size(); ++cell) {
    if (partition.cell(cell).holds(point)) holding.push_back(cell);
  }
  RC_ASSERT(holding == std::vector<std::uint32_t>{partition.cellOf(point)});
}

}  // namespace
}  // namespace allpairs::partition
