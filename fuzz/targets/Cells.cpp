// SPDX-License-Identifier: MIT
// Space cut into cells in any way: each pair of the double loop is found in exactly one of them.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "../Choices.h"
#include "../Sides.h"
#include "allpairs/partition/Cell.h"
#include "allpairs/partition/Partition.h"

namespace allpairs::fuzz {
namespace {

using partition::Cut;
using partition::IdPair;
using partition::Partition;

/// Cuts at any finite numbers: a cell is cut in two, again and again.
Partition cutAnywhere(Choices& choices) {
  std::vector<Cut> cuts;
  const std::size_t count = choices.below(12);
  for (std::size_t i = 0; i < count; ++i) {
    const auto cell = static_cast<std::int32_t>(choices.below(i + 1));
    const auto place = static_cast<std::int32_t>(i);
    for (Cut& cut : cuts) {
      if (cut.low == ~cell) cut.low = place;
      if (cut.high == ~cell) cut.high = place;
    }
    cuts.push_back({choices.finite(), static_cast<std::uint32_t>(choices.below(3)), ~cell, ~(place + 1)});
  }
  return Partition::fromCuts(cuts);
}

/// Some boxes of a side, each with its number.
struct Part {
  Side side;
  std::vector<std::uint64_t> ids;
};

Part partOf(const Side& side, const Partition& cells, std::size_t cell, double distance, double maxMargin) {
  Part part;
  std::vector<std::uint32_t> touched;
  for (std::size_t i = 0; i < side.boxes.size(); ++i) {
    const Box reach = partition::reachOf(side.boxes[i], side.marginOf(i), distance, maxMargin);
    cells.cellsOf(reach, touched);
    const bool isHere = std::find(touched.begin(), touched.end(), cell) != touched.end();
    require(isHere == partition::touches(cells.cell(cell), reach), "cellsOf() and touches() agree");
    if (!isHere) continue;
    part.side.boxes.push_back(side.boxes[i]);
    part.side.margins.push_back(side.marginOf(i));
    part.ids.push_back(3 * std::uint64_t{i} + (std::uint64_t{1} << 40));
  }
  part.side.set = part.side.boxes;
  part.side.set.setMargins(part.side.margins);
  return part;
}

void runCells(Bytes bytes) {
  Choices choices(bytes);
  Side first, second;
  readSide(choices, first);
  const bool isOne = choices.flag();
  if (!isOne) readSide(choices, second);
  const OverlapOptions options{.distance = choices.distance()};
  const Side& other = isOne ? first : second;
  for (Side* side : {&first, &second}) side->categories = side->masks = side->groups = {};
  const Partition cells =
      choices.flag() ? cutAnywhere(choices) : Partition(first.set, 1 + choices.below(20), options.distance);
  std::vector<IdPair> found;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const Part a = partOf(first, cells, cell, options.distance, partition::greatestMargin(other.set));
    const Part b = isOne ? Part() : partOf(second, cells, cell, options.distance, partition::greatestMargin(first.set));
    const std::vector<IdPair> pairs =
        isOne ? overlapsInCell(a.side.set, a.ids, cells.cell(cell), options)
              : overlapsInCell(a.side.set, a.ids, b.side.set, b.ids, cells.cell(cell), options);
    require(std::is_sorted(pairs.begin(), pairs.end()), "the pairs of a cell are in order");
    found.insert(found.end(), pairs.begin(), pairs.end());
  }
  std::sort(found.begin(), found.end());
  std::vector<IdPair> expected;
  for (const Pair pair : Oracle{options, first, other}.pairs()) {
    constexpr std::uint64_t kOffset = std::uint64_t{1} << 40;
    expected.push_back({3 * std::uint64_t{pair.first} + kOffset, 3 * std::uint64_t{pair.second} + kOffset});
  }
  require(found == expected, "the cells have each pair of the double loop once");
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(cells, allpairs::fuzz::runCells)
