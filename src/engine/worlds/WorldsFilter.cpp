// SPDX-License-Identifier: MIT
#include "worlds/WorldsFilter.h"

#include <algorithm>
#include <string>

#include "allpairs/Error.h"
#include "input/Options.h"
#include "kernels/WorldsRun.h"
#include "search/PairTest.h"

namespace allpairs::engine {
namespace {

using Values = std::span<const std::uint32_t>;

/// Those of one world.
Values part(Values values, const Worlds& worlds, std::size_t world) {
  if (values.size() != worlds.boxes().size()) return values;
  return values.subspan(worlds.begin(world), worlds.begin(world + 1) - worlds.begin(world));
}

bool areForOneWorld(const FilterBits& bits, const Worlds& worlds) {
  const bool categories = isForOneWorld(bits.categories, worlds, "categories");
  const bool masks = isForOneWorld(bits.masks, worlds, "masks");
  const bool groups = isForOneWorld(bits.groups, worlds, "groups");
  return (bits.categories.empty() || categories) && (bits.masks.empty() || masks) && (bits.groups.empty() || groups);
}

}  // namespace

bool isForOneWorld(std::span<const std::uint32_t> values, const Worlds& worlds, const char* name) {
  const std::size_t boxes = worlds.boxes().size();
  if (worlds.hasEqualSizes() && worlds.size() > 1 && values.size() == worlds.eachSize()) return true;
  if (values.empty() || values.size() == boxes) return false;
  const std::string sizes = worlds.hasEqualSizes() ? " worlds of " + std::to_string(worlds.eachSize()) + " boxes"
                                                   : " worlds with " + std::to_string(boxes) + " boxes altogether";
  throw InvalidArgument("the filter has " + std::to_string(values.size()) + ' ' + name + " for " +
                        std::to_string(worlds.size()) + sizes +
                        (worlds.hasEqualSizes() ? "" : ", which are not of equal size"));
}

void WorldsFilter::prepare(const Worlds& worlds, const OverlapOptions& options, std::size_t mostBoxes) {
  m_worlds = &worlds;
  m_options = &options;
  m_allowed.clear();
  m_ignored.clear();
  checkSettings(options);
  checkOneSet(options.filter);
  const FilterBits& bits = options.filter.first;
  const bool isForAll = areForOneWorld(bits, worlds);
  for (const Pair pair : worlds.ignoredPairs()) {
    m_ignored.push_back({std::min(pair.first, pair.second), std::max(pair.first, pair.second)});
  }
  std::sort(m_ignored.begin(), m_ignored.end());
  const bool usesBits = worlds.hasEqualSizes() && worlds.size() > 1 && worlds.eachSize() <= mostBoxes;
  m_selectsBits = !isEmpty(bits) && !(usesBits && isForAll);
  m_selectsIgnored = !m_ignored.empty() && !usesBits;
  if (usesBits && (!m_ignored.empty() || (isForAll && !isEmpty(bits)))) allowSome(isForAll ? bits : FilterBits());
}

void WorldsFilter::allowSome(const FilterBits& bits) {
  const std::size_t size = m_worlds->eachSize();
  const WorldPlaces places = WorldPlaces::of(size);
  const PairPredicate none;
  const TestedBoxes tested = TestedBoxes::of(m_worlds->boxes(), bits);
  const PairTest test(tested, tested, 0.0, none);
  m_allowed.assign(size * places.words, 0);
  const auto wordOf = [&](std::size_t row, std::size_t other) -> std::uint64_t& {
    return m_allowed[row * places.words + (places.first + other) / kWordBoxes];
  };
  const auto bitOf = [&](std::size_t other) { return std::uint64_t{1} << ((places.first + other) % kWordBoxes); };
  for (std::uint32_t i = 0; i < size; ++i) {
    for (std::uint32_t j = 0; j < size; ++j) {
      if (i != j && (!test.needed() || test.keeps({std::min(i, j), std::max(i, j)}))) wordOf(i, j) |= bitOf(j);
    }
  }
  for (const Pair pair : m_ignored) {
    wordOf(pair.first, pair.second) &= ~bitOf(pair.second);
    wordOf(pair.second, pair.first) &= ~bitOf(pair.first);
  }
}

std::size_t WorldsFilter::select(std::size_t world, std::span<Pair> pairs) const {
  std::size_t kept = pairs.size();
  if (m_selectsIgnored) {
    const auto end = std::remove_if(pairs.begin(), pairs.end(), [this](Pair pair) { return isIgnored(pair); });
    kept = static_cast<std::size_t>(end - pairs.begin());
  }
  const TestedBoxes tested = TestedBoxes::of(m_worlds->boxes(), m_selectsBits ? bitsOf(world) : FilterBits());
  const PairTest test(tested, tested, 0.0, m_options->filter.accept);
  return test.select(pairs.first(kept));
}

FilterBits WorldsFilter::bitsOf(std::size_t world) const noexcept {
  const FilterBits& bits = m_options->filter.first;
  return {part(bits.categories, *m_worlds, world), part(bits.masks, *m_worlds, world),
          part(bits.groups, *m_worlds, world)};
}

bool WorldsFilter::isIgnored(Pair pair) const noexcept {
  return std::binary_search(m_ignored.begin(), m_ignored.end(), pair);
}

}  // namespace allpairs::engine
