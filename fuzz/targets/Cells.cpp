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

  [[nodiscard]] FilterBits filter() const { return {side.categories, side.masks, side.groups}; }
};

constexpr std::uint64_t kOffset = std::uint64_t{1} << 40;  // ids need 64 bits

std::uint64_t idOf(std::size_t box) { return 3 * std::uint64_t{box} + kOffset; }

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
    if (!side.categories.empty()) part.side.categories.push_back(side.categories[i]);
    if (!side.masks.empty()) part.side.masks.push_back(side.masks[i]);
    if (!side.groups.empty()) part.side.groups.push_back(side.groups[i]);
    part.ids.push_back(idOf(i));
  }
  part.side.set = part.side.boxes;
  part.side.set.setMargins(part.side.margins);
  return part;
}

/// What is asked of all cells.
struct CellsQuestion {
  const Side& first;
  const Side& second;  ///< The first again, of one set.
  OverlapOptions options;

  [[nodiscard]] bool isOne() const { return &first == &second; }
};

/// The pairs of a cell, by id; streaming, finding and counting agree.
std::vector<IdPair> pairsOfCell(const CellsQuestion& question, const Partition& cells, std::size_t number) {
  const double distance = question.options.distance;
  const Part a = partOf(question.first, cells, number, distance, partition::greatestMargin(question.second.set));
  const Part b = partOf(question.second, cells, number, distance, partition::greatestMargin(question.first.set));
  const partition::Cell cell = cells.cell(number);
  OverlapOptions options = question.options;
  options.filter.first = a.filter();
  if (!question.isOne()) options.filter.second = b.filter();
  partition::CellSearch search(options);
  std::vector<Pair> streamed;
  const auto visit = [&streamed](Span<const Pair> pairs) {
    streamed.insert(streamed.end(), pairs.begin(), pairs.end());
  };
  question.isOne() ? search.stream(a.side.set, cell, visit) : search.stream(a.side.set, b.side.set, cell, visit);
  std::sort(streamed.begin(), streamed.end());
  const auto found = question.isOne() ? search.find(a.side.set, cell) : search.find(a.side.set, b.side.set, cell);
  require(std::ranges::equal(streamed, found), "streaming a cell gives the pairs that are found");
  const std::uint64_t count = question.isOne() ? partition::countOverlapsInCell(a.side.set, cell, options)
                                               : partition::countOverlapsInCell(a.side.set, b.side.set, cell, options);
  require(count == found.size(), "as many pairs of a cell are counted as are found");
  std::vector<IdPair> pairs = question.isOne() ? overlapsInCell(a.side.set, a.ids, cell, options)
                                               : overlapsInCell(a.side.set, a.ids, b.side.set, b.ids, cell, options);
  require(std::ranges::equal(pairs, found, {}, {},
                             [&](Pair p) {
                               return IdPair{a.ids[p.first], (question.isOne() ? a : b).ids[p.second]};
                             }),
          "the pairs of a cell are in order, with and without ids");
  return pairs;
}

/// All boxes at once and each alone go to the same cells, of which each is then asked for as many.
void compareCells(const Partition& cells, const Side& side, double distance, double maxMargin) {
  std::vector<std::uint64_t> expected(cells.size());
  std::vector<std::uint32_t> alone;
  std::size_t next = 0;
  const auto reachOf = [&](std::size_t i) {
    return partition::reachOf(side.boxes[i], side.marginOf(i), distance, maxMargin);
  };
  cells.visitCells(side.boxes.size(), reachOf, [&](std::size_t i, Span<const std::uint32_t> touched) {
    require(i == next++, "boxes are visited in order");
    cells.cellsOf(reachOf(i), alone);
    require(std::ranges::is_permutation(touched, alone), "a box is visited with the cells that it touches");
    for (const std::uint32_t cell : touched) ++expected[cell];
  });
  require(next == side.boxes.size(), "all boxes are visited");
  const double most = std::max(maxMargin, partition::greatestMargin(side.set));
  if (most == maxMargin) {
    require(partition::boxesPerCell(cells, side.set, distance, maxMargin) == expected, "each cell has as many boxes");
  }
}

void runCells(Bytes bytes) {
  Choices choices(bytes);
  Side first, second;
  readSide(choices, first);
  const bool isOne = choices.flag();
  if (!isOne) readSide(choices, second);
  const Side& other = isOne ? first : second;
  CellsQuestion question{first, other, {.distance = choices.distance()}};
  Partition cells =
      choices.flag() ? cutAnywhere(choices) : Partition(first.set, 1 + choices.below(20), question.options.distance);
  for (std::size_t again = choices.below(4); again > 0; --again) {
    static_cast<void>(
        cells.cutAgain(choices.below(cells.size()), first.set, 2 + choices.below(4), question.options.distance));
  }
  compareCells(cells, first, question.options.distance, partition::greatestMargin(other.set));
  std::vector<IdPair> found;
  for (std::size_t cell = 0; cell < cells.size(); ++cell) {
    const std::vector<IdPair> pairs = pairsOfCell(question, cells, cell);
    found.insert(found.end(), pairs.begin(), pairs.end());
  }
  std::sort(found.begin(), found.end());
  std::vector<IdPair> expected;
  for (const Pair pair : Oracle{question.options, first, other}.pairs()) {
    expected.push_back({idOf(pair.first), idOf(pair.second)});
  }
  require(found == expected, "the cells have each pair of the double loop once");
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(cells, allpairs::fuzz::runCells)
