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

bool isLessBySecond(Pair a, Pair b) { return a.second != b.second ? a.second < b.second : a.first < b.first; }

/// Numbers boxes within their world, of pairs in the order of the boxes of all.
class PairsByWorld {
 public:
  PairsByWorld(const Worlds& worlds, std::span<std::uint64_t> begin) : m_worlds(worlds), m_begin(begin) {
    m_begin[0] = 0;
  }

  /// Calls take(pair) for each.
  template <class Take>
  void add(std::span<const Pair> pairs, const Take& take) {
    for (const Pair pair : pairs) {
      while (pair.first >= m_worlds.begin(m_world + 1)) m_begin[++m_world] = m_size;
      take(Pair{static_cast<std::uint32_t>(pair.first - m_worlds.begin(m_world)), pair.second});
      ++m_size;
    }
  }

  void finish() {
    while (m_world < m_worlds.size()) m_begin[++m_world] = m_size;
  }

 private:
  const Worlds& m_worlds;
  std::span<std::uint64_t> m_begin;
  std::size_t m_world = 0;
  std::uint64_t m_size = 0;
};

}  // namespace

OverlapOptions SharedSearcher::optionsForAll(const Worlds& worlds, const OverlapOptions& options) {
  OverlapOptions all = options;
  all.order = Order::ByFirst;
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
  const std::span<const Pair> found = m_search.find({worlds.boxes(), shared, false}, optionsForAll(worlds, options));
  m_begin.resize(worlds.size() + 1);
  m_pairs.require(found.size());
  PairsByWorld byWorld(worlds, m_begin);
  Pair* to = m_pairs.data();
  byWorld.add(found, [&](Pair pair) { *to++ = pair; });
  byWorld.finish();
  if (options.order == Order::BySecond) {
    for (std::size_t world = 0; world < worlds.size(); ++world) {
      std::sort(m_pairs.data() + m_begin[world], m_pairs.data() + m_begin[world + 1], isLessBySecond);
    }
  }
  return {{m_pairs.data(), found.size()}, m_begin};
}

std::span<const std::uint64_t> SharedSearcher::count(const Worlds& worlds, const BoxView& shared,
                                                     const OverlapOptions& options) {
  m_begin.resize(worlds.size() + 1);
  PairsByWorld byWorld(worlds, m_begin);
  const auto add = [&](std::span<const Pair> pairs) { byWorld.add(pairs, [](Pair) {}); };
  m_search.stream({worlds.boxes(), shared, false}, optionsForAll(worlds, options), {add, kBatchSize, options.maxPairs});
  byWorld.finish();
  return m_begin;
}

}  // namespace allpairs::engine
