// SPDX-License-Identifier: MIT
#include "worlds/SharedSearcher.h"

#include <algorithm>
#include <cstddef>

namespace allpairs::engine {
namespace {

std::size_t worldOf(const Worlds& worlds, std::size_t box) {
  if (worlds.offsets().empty()) return box / worlds.eachSize();
  const auto next = std::upper_bound(worlds.offsets().begin(), worlds.offsets().end(), box);
  return static_cast<std::size_t>(next - worlds.offsets().begin()) - 1;
}

/// The values of all boxes, where those of one world are given for all.
std::span<const std::uint32_t> valuesOfAll(std::span<const std::uint32_t> values, const Worlds& worlds,
                                           const char* name, std::pmr::vector<std::uint32_t>& all) {
  if (!isForOneWorld(values, worlds, name)) return values;
  all.clear();
  for (std::size_t world = 0; world < worlds.size(); ++world) all.insert(all.end(), values.begin(), values.end());
  return all;
}

/// Before the first pair of those that takeByWorld() takes.
void startByWorld(const Worlds& worlds, std::pmr::vector<std::uint64_t>& begin) {
  begin.reserve(worlds.size() + 2);
  begin.assign(2, 0);
}

/// Calls take(pair) for each of some pairs, in the order of the boxes of all worlds, with its box numbered within its
/// world. In `begin` is where the pairs of each world begin so far, and where those of the last one end.
template <class Take>
void takeByWorld(std::span<const Pair> pairs, const Worlds& worlds, std::pmr::vector<std::uint64_t>& begin,
                 const Take& take) {
  std::size_t world = begin.size() - 2;
  std::uint64_t size = begin.back();
  for (const Pair pair : pairs) {
    for (; pair.first >= worlds.begin(world + 1); ++world) {
      begin.back() = size;
      begin.push_back(size);
    }
    take(Pair{static_cast<std::uint32_t>(pair.first - worlds.begin(world)), pair.second});
    ++size;
  }
  begin.back() = size;
}

}  // namespace

OverlapOptions SharedSearcher::optionsForAll(const Worlds& worlds, const OverlapOptions& options) {
  OverlapOptions all = options;
  if (all.order <= Order::Unordered) all.order = Order::ByFirst;  // Another is none, and refused.
  FilterBits& bits = all.filter.first;
  bits.categories = valuesOfAll(bits.categories, worlds, "categories", m_categories);
  bits.masks = valuesOfAll(bits.masks, worlds, "masks", m_masks);
  bits.groups = valuesOfAll(bits.groups, worlds, "groups", m_groups);
  if (options.filter.accept) {
    all.filter.accept = [&worlds, &options](std::uint32_t box, std::uint32_t second) {
      const std::size_t first = worlds.begin(worldOf(worlds, box));
      return options.filter.accept(static_cast<std::uint32_t>(box - first), second);
    };
  }
  return all;
}

WorldPairsView SharedSearcher::find(const Worlds& worlds, const BoxView& shared, const OverlapOptions& options) {
  const std::span<const Pair> found = m_search.find({worlds.boxes(), shared}, optionsForAll(worlds, options));
  m_pairs.require(found.size());
  Pair* to = m_pairs.data();
  startByWorld(worlds, m_begin);
  takeByWorld(found, worlds, m_begin, [&](Pair pair) { *to++ = pair; });
  m_begin.resize(worlds.size() + 1, m_begin.back());
  if (options.order == Order::BySecond) {
    const auto isBefore = [](Pair a, Pair b) { return keyOf(a, Order::BySecond) < keyOf(b, Order::BySecond); };
    for (std::size_t world = 0; world < worlds.size(); ++world) {
      std::sort(m_pairs.data() + m_begin[world], m_pairs.data() + m_begin[world + 1], isBefore);
    }
  }
  return {{m_pairs.data(), found.size()}, m_begin};
}

std::span<const std::uint64_t> SharedSearcher::count(const Worlds& worlds, const BoxView& shared,
                                                     const OverlapOptions& options) {
  startByWorld(worlds, m_begin);
  const auto add = [&](std::span<const Pair> pairs) { takeByWorld(pairs, worlds, m_begin, [](Pair) {}); };
  m_search.stream({worlds.boxes(), shared}, optionsForAll(worlds, options), add, kBatchSize);
  m_begin.resize(worlds.size() + 1, m_begin.back());
  return m_begin;
}

}  // namespace allpairs::engine
