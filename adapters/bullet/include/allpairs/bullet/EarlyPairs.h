// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "allpairs/Pair.h"

namespace allpairs::internal {

/// Pairs that are added between two steps. Where proxies come and go, the same one may be added any number of times:
/// there is room for no more than twice those that differ, or for those and what was asked for at once.
class EarlyPairs {
 public:
  /// Makes room for so many more: add() of these needs no memory.
  void reserve(std::size_t more) {
    if (m_pairs.size() + more <= m_pairs.capacity()) return;
    sort();
    m_pairs.reserve(m_pairs.size() + std::max(more, m_pairs.size()));
  }

  void add(const Pair& pair) { m_pairs.push_back(pair); }

  /// Leaves each pair once, in ascending order.
  void sort() {
    std::sort(m_pairs.begin(), m_pairs.end());
    m_pairs.erase(std::unique(m_pairs.begin(), m_pairs.end()), m_pairs.end());
  }

  void clear() { m_pairs.clear(); }

  [[nodiscard]] const std::vector<Pair>& pairs() const { return m_pairs; }
  [[nodiscard]] std::size_t capacity() const { return m_pairs.capacity(); }

 private:
  std::vector<Pair> m_pairs;
};

}  // namespace allpairs::internal
