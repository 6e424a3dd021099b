// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "allpairs/bullet/CountingPairCache.h"

namespace allpairs {

/// Bullet's hashed pair cache, whose pairs can be put in the order of the m_uniqueId of their proxies, ascending, that
/// of the first proxy before that of the second. A pair keeps its collision algorithm and so its contacts.
///
/// Cost:    order() a pass over the pairs if any was added or removed since the last call, and a sort of those that are
///          not in their place; about 72 bytes of scratch memory per pair, which are kept.
/// Threads: one call at a time, as in Bullet's caches.
/// Memory:  if order() throws std::bad_alloc, the cache is as before.
class OrderedPairCache : public CountingPairCache {
 public:
  using btHashedOverlappingPairCache::processAllOverlappingPairs;

  /// The narrow phase calls this. The pairs are in order, so that btDispatcherInfo::m_deterministicOverlappingPairs has
  /// no need to sort them.
  void processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher,
                                  const btDispatcherInfo& /*info*/) override {
    order();
    processAllOverlappingPairs(callback, dispatcher);
  }

  /// Unlike Bullet's, which sorts in descending order, and drops the contacts.
  void sortOverlappingPairs(btDispatcher* /*dispatcher*/) override { order(); }

  void order() {
    if (m_ordered == changes()) return;
    readKeys();
    if (!m_misplaced.empty()) {
      mergeMisplaced();
      permute();
    }
    m_ordered = changes();
  }

 private:
  struct Place {
    std::uint64_t key;
    int index;  ///< In the array of pairs.

    friend bool operator<(const Place& a, const Place& b) { return a.key < b.key; }
  };

  static std::uint64_t keyOf(const btBroadphasePair& pair) {
    const auto first = static_cast<std::uint32_t>(pair.m_pProxy0->m_uniqueId);
    const auto second = static_cast<std::uint32_t>(pair.m_pProxy1->m_uniqueId);
    return std::uint64_t{first} << 32U | second;
  }

  /// Most pairs are in order already. Of two neighbours that are not, either may be in the wrong place: both are
  /// misplaced, so that these are at most twice as many as need be.
  void readKeys() {
    m_placed.clear();
    m_misplaced.clear();
    const btBroadphasePairArray& pairs = getOverlappingPairArray();
    for (int i = 0; i < pairs.size(); ++i) {
      const Place place{keyOf(pairs[i]), i};
      if (m_placed.empty() || m_placed.back() < place) {
        m_placed.push_back(place);
      } else {
        m_misplaced.push_back(m_placed.back());
        m_misplaced.push_back(place);
        m_placed.pop_back();
      }
    }
  }

  void mergeMisplaced() {
    std::sort(m_misplaced.begin(), m_misplaced.end());
    m_merged.resize(m_placed.size() + m_misplaced.size());
    std::merge(m_placed.begin(), m_placed.end(), m_misplaced.begin(), m_misplaced.end(), m_merged.begin());
    m_newIndex.resize(m_merged.size());
    for (std::size_t i = 0; i < m_merged.size(); ++i) {
      m_newIndex[static_cast<std::size_t>(m_merged[i].index)] = static_cast<int>(i);
    }
  }

  [[nodiscard]] int renamed(int index) const {
    return index == BT_NULL_PAIR ? BT_NULL_PAIR : m_newIndex[static_cast<std::size_t>(index)];
  }

  /// The lists of the hash table keep their pairs, which have other indices.
  void permute() {
    btBroadphasePairArray& pairs = getOverlappingPairArray();
    m_pairs.assign(&pairs[0], &pairs[0] + pairs.size());
    m_links.assign(&m_next[0], &m_next[0] + pairs.size());
    for (int i = 0; i < pairs.size(); ++i) {
      const auto from = static_cast<std::size_t>(m_merged[static_cast<std::size_t>(i)].index);
      pairs[i] = m_pairs[from];
      m_next[i] = renamed(m_links[from]);
    }
    for (int i = 0; i < m_hashTable.size(); ++i) m_hashTable[i] = renamed(m_hashTable[i]);
  }

  std::uint64_t m_ordered = 0;  // changes() at the last order()
  std::vector<Place> m_placed;  // the scratch memory of order(), kept
  std::vector<Place> m_misplaced;
  std::vector<Place> m_merged;
  std::vector<int> m_newIndex;
  std::vector<btBroadphasePair> m_pairs;
  std::vector<int> m_links;
};

}  // namespace allpairs
