// SPDX-License-Identifier: MIT
// Many worlds in one call, against the double loop in each of them.
#include "allpairs/Worlds.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "../BackwardExecutor.h"
#include "../Choices.h"
#include "../Sides.h"
#include "allpairs/Error.h"

namespace allpairs::fuzz {
namespace {

/// The boxes [begin, end) of a side as one of its own.
Side part(const Side& side, std::size_t begin, std::size_t end) {
  const auto of = [&](const auto& values) {
    if (values.empty()) return values;
    return std::decay_t<decltype(values)>(values.begin() + static_cast<std::ptrdiff_t>(begin),
                                          values.begin() + static_cast<std::ptrdiff_t>(end));
  };
  Side some;
  some.boxes = of(side.boxes);
  some.margin = side.margin;
  some.margins = of(side.margins);
  some.categories = of(side.categories);
  some.masks = of(side.masks);
  some.groups = of(side.groups);
  return some;
}

std::vector<std::uint64_t> readOffsets(Choices& choices, std::size_t boxes) {
  std::vector<std::uint64_t> begin{0};
  const std::size_t style = choices.below(3);
  while (begin.back() < boxes) {
    const std::size_t size = style == 0 ? choices.below(boxes + 1) : style == 1 ? choices.below(24) : 1;
    begin.push_back(std::min<std::uint64_t>(begin.back() + size, boxes));
    if (choices.done()) begin.push_back(boxes);
  }
  return begin;
}

/// The pairs of each world, one after the other, and where they begin.
WorldPairs expectedOf(const Side& all, const std::vector<std::uint64_t>& begin, const Side* shared,
                      const OverlapOptions& options) {
  WorldPairs expected{.pairs = {}, .begin = {0}};
  for (std::size_t world = 0; world + 1 < begin.size(); ++world) {
    const Side own = part(all, begin[world], begin[world + 1]);
    const std::vector<Pair> pairs = Oracle{options, own, shared != nullptr ? *shared : own}.pairs();
    expected.pairs.insert(expected.pairs.end(), pairs.begin(), pairs.end());
    expected.begin.push_back(expected.pairs.size());
  }
  return expected;
}

bool isAmong(const std::vector<Pair>& pairs, Pair pair) {
  return std::any_of(pairs.begin(), pairs.end(), [pair](Pair other) {
    return other == pair || (other.first == pair.second && other.second == pair.first);
  });
}

std::uint32_t smallNumber(Choices& choices, std::size_t n) { return static_cast<std::uint32_t>(choices.below(n)); }

/// Finding, counting and listing, by the object and by the functions.
void requireInEachWorld(const Worlds& worlds, const OverlapOptions& options, const WorldPairs& expected) {
  const auto requireSame = [&](Span<const Pair> found, Span<const std::uint64_t> begin, std::string_view property) {
    require(std::ranges::equal(begin, expected.begin) && found.size() == expected.pairs.size(), property);
    std::vector<Pair> pairs(found.begin(), found.end());
    for (std::size_t world = 0; options.order == Order::Unordered && world < worlds.size(); ++world) {
      std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(begin[world]),
                pairs.begin() + static_cast<std::ptrdiff_t>(begin[world + 1]));
    }
    require(pairs == expected.pairs, property);
  };
  WorldsSearch search(options);
  const WorldPairsView found = search.find(worlds);
  requireSame(found.pairs, found.begin, "each of worlds of equal size has the pairs of the double loop");
  const Span<const std::uint64_t> counted = search.count(worlds);
  const std::vector<std::uint64_t> begin(counted.begin(), counted.end());
  require(begin == expected.begin, "count() says where the pairs of worlds of equal size begin");
  std::vector<Pair> listed(expected.pairs.size());
  search.list(worlds, begin, listed);
  requireSame(listed, begin, "list() writes the pairs of each world");
  const WorldPairs once = overlapsInWorlds(worlds, options);
  requireSame(once.pairs, once.begin, "overlapsInWorlds() gives the pairs of each world");
}

/// Worlds of equal size: pairs ignored in each of them, filters of one world, and any order and strategy.
void compareEqualWorlds(Choices& choices, const Side& given, OverlapOptions options) {
  const std::size_t count = 1 + choices.below(12);
  const std::size_t size = given.boxes.size() / count;
  if (size == 0) return;
  Side all = part(given, 0, size * count);
  all.set = all.boxes;
  all.set.setMargin(all.margin);
  if (!all.margins.empty()) all.set.setMargins(all.margins);
  Side one = part(given, 0, size);
  const bool isOfOne = choices.flag();
  const Side& filtered = isOfOne ? one : all;
  options.filter.first = {filtered.categories, filtered.masks, filtered.groups};
  options.filter.second = {};
  options.order = std::array{Order::ByFirst, Order::BySecond, Order::Unordered}.at(choices.below(3));
  options.strategy = static_cast<Strategy>(choices.below(3));
  options.maxPairs = std::numeric_limits<std::uint64_t>::max();
  std::vector<Pair> ignored(choices.below(8));
  for (Pair& pair : ignored) pair = {smallNumber(choices, size), smallNumber(choices, size)};

  WorldPairs expected{.pairs = {}, .begin = {0}};
  for (std::size_t world = 0; world < count; ++world) {
    Side own = part(all, world * size, (world + 1) * size);
    if (isOfOne) own.categories = one.categories, own.masks = one.masks, own.groups = one.groups;
    for (const Pair pair : Oracle{options, own, own}.pairs()) {
      if (!isAmong(ignored, pair)) expected.pairs.push_back(pair);
    }
    expected.begin.push_back(expected.pairs.size());
  }
  Worlds worlds = Worlds::ofEqualSize(all.set, count);
  worlds.setIgnoredPairs(ignored);
  requireInEachWorld(worlds, options, expected);
}

void runWorlds(Bytes bytes) {
  Choices choices(bytes);
  Side all, shared;
  readSide(choices, all);
  const bool hasShared = choices.byte() % 4 == 3;
  if (hasShared) readSide(choices, shared);
  const std::vector<std::uint64_t> begin = readOffsets(choices, all.boxes.size());
  BackwardExecutor executor;
  OverlapOptions options{.order = choices.flag() ? Order::ByFirst : Order::BySecond, .distance = choices.distance()};
  options.instructionSet = instructionSets()[choices.below(instructionSets().size())];
  if (choices.flag()) options.executor = &executor;
  const WorldPairs expected = expectedOf(all, begin, hasShared ? &shared : nullptr, options);
  options.filter.first = {all.categories, all.masks, all.groups};
  if (hasShared) options.filter.second = {shared.categories, shared.masks, shared.groups};
  if (choices.flag()) options.maxPairs = choices.below(1000);
  const bool isTooMany = expected.pairs.size() > options.maxPairs;
  const Worlds worlds(all.set, begin);
  WorldsSearch search(options);
  try {
    const WorldPairsView found = hasShared ? search.find(worlds, shared.set) : search.find(worlds);
    require(std::equal(found.pairs.begin(), found.pairs.end(), expected.pairs.begin(), expected.pairs.end()) &&
                std::equal(found.begin.begin(), found.begin.end(), expected.begin.begin(), expected.begin.end()),
            "each world has the pairs of the double loop");
    const auto counted = hasShared ? search.count(worlds, shared.set) : search.count(worlds);
    require(std::equal(counted.begin(), counted.end(), expected.begin.begin(), expected.begin.end()),
            "count() says where the pairs of each world begin");
    require(!isTooMany, "more pairs than maxPairs are an error");
  } catch (const LimitExceeded&) {
    require(isTooMany, "no error without more pairs than maxPairs");
  }
  compareEqualWorlds(choices, all, options);
}

}  // namespace
}  // namespace allpairs::fuzz

ALLPAIRS_FUZZ_TARGET(worlds, allpairs::fuzz::runWorlds)
