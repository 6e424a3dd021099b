// SPDX-License-Identifier: MIT
#include <allpairs/Overlaps.h>
#include <allpairs/World.h>
#include <allpairs/Worlds.h>

#include <cstdlib>
#include <vector>

#include "DoubleLoop.h"

static_assert(__cplusplus == 201703L, "what is linked asks for another standard");

namespace {

Pairs plain(allpairs::Span<const allpairs::Pair> found) {
  Pairs pairs;
  for (const auto& [first, second] : found) pairs.emplace_back(first, second);
  return pairs;
}

std::vector<allpairs::BoxF> boxesOf(const std::vector<Row>& rows) {
  std::vector<allpairs::BoxF> boxes;
  for (const Row& row : rows) boxes.push_back({{row[0], row[1], row[2]}, {row[3], row[4], row[5]}});
  return boxes;
}

bool isSearchRight() {
  const std::vector<allpairs::BoxF> boxes = boxesOf(someRows(1000, 1));
  const Pairs expected = byDoubleLoop(someRows(1000, 1));
  allpairs::OverlapSearch search;
  Pairs streamed;
  search.stream(boxes, [&](allpairs::Span<const allpairs::Pair> batch) {
    for (const allpairs::Pair& pair : batch) streamed.emplace_back(pair.first, pair.second);
  });
  Pairs ofRows;
  const allpairs::Neighbors rows = allpairs::neighbors(boxes, allpairs::NeighborRows::Half);
  for (std::size_t first = 0; first < rows.size(); ++first) {
    for (const std::uint32_t second : rows[first]) ofRows.emplace_back(first, second);
  }
  const std::vector<std::uint64_t> begin{0, boxes.size()};
  const allpairs::WorldPairs ofWorlds = allpairs::overlapsInWorlds(allpairs::Worlds(boxes, begin));
  return expected.size() > 1000 && plain(search.find(boxes)) == expected && streamed == expected &&
         plain(allpairs::overlaps(boxes)) == expected && ofRows == expected && plain(ofWorlds.pairs) == expected;
}

bool isWorldRight() {
  allpairs::World world;
  const std::vector<allpairs::BoxF> added = boxesOf(someRows(500, 1));
  const std::vector<allpairs::BoxId> ids = world.add(added);
  bool isRight = plain(world.step().pairs) == byDoubleLoop(someRows(500, 1));
  for (std::uint32_t step = 2; step < 6; ++step) {
    const std::vector<allpairs::BoxF> boxes = boxesOf(someRows(500, step));
    world.move(ids, boxes);
    isRight = isRight && plain(world.step().pairs) == byDoubleLoop(someRows(500, step));
  }
  return isRight && world.findFirst(allpairs::Ray{{-1, 8, 8}, {1, 0, 0}, 100}).id != allpairs::kNoBox;
}

bool isFilterRight() {
  const std::vector<allpairs::BoxF> boxes = boxesOf(someRows(100, 1));
  const std::vector<std::uint32_t> groups(boxes.size(), 1);
  allpairs::OverlapOptions options;
  options.filter.first.groups = groups;
  if (allpairs::countOverlaps(boxes, options) != 0) return false;
  options.filter = {};
  options.filter.accept = [](std::uint32_t first, std::uint32_t) { return first != 0; };
  for (const allpairs::Pair& pair : allpairs::overlaps(boxes, options)) {
    if (pair.first == 0) return false;
  }
  return true;
}

}  // namespace

int main() { return isSearchRight() && isWorldRight() && isFilterRight() ? EXIT_SUCCESS : EXIT_FAILURE; }
