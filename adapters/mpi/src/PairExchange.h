// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "Ranks.h"
#include "allpairs/Pair.h"
#include "allpairs/partition/Cell.h"

namespace allpairs::mpi {

using partition::IdPair;

/// Pairs on their way from the rank that finds them to the rank of their first box, which puts them in order.
class PairExchange {
 public:
  explicit PairExchange(const Ranks& ranks) : m_ranks(ranks) {}

  /// Before the first pair: the number behind the last first box of each rank, and whether all ids are below 2^32, so
  /// that a pair travels as one word instead of two.
  void start(std::span<const std::uint64_t> ends, bool areIdsShort);

  /// Pairs of indices whose first ids ascend: any other order is right too, but each descent begins a run, of which
  /// takeInOrder() looks at all together.
  template <class FirstId, class SecondId>
  void add(std::span<const Pair> pairs, const FirstId& firstId, const SecondId& secondId) {
    for (auto begin = pairs.begin(); begin != pairs.end();) {
      turnTo(firstId(begin->first));
      const auto isElsewhere = [&](Pair pair) { return !goesToTheSame(firstId(pair.first)); };
      const auto end = std::find_if(begin, pairs.end(), isElsewhere);
      append({begin, end}, firstId, secondId);
      begin = end;
    }
  }

  /// Sends what was added since the last time, and receives as much from the others; collective.
  void send();

  /// The pairs that came to this rank, by (first, second). It keeps none.
  [[nodiscard]] std::vector<IdPair> takeInOrder();

 private:
  /// Makes the rank of a first box the one that pairs go to.
  void turnTo(std::uint64_t first);

  [[nodiscard]] bool goesToTheSame(std::uint64_t first) const noexcept { return m_begin <= first && first < m_end; }

  template <class FirstId, class SecondId>
  void append(std::span<const Pair> pairs, const FirstId& firstId, const SecondId& secondId) {
    std::vector<std::uint64_t>& words = m_outgoing[m_to];
    const std::size_t before = words.size();
    words.resize(before + pairs.size() * (m_areIdsShort ? 1 : 2));
    std::uint64_t* to = words.data() + before;
    if (m_areIdsShort) {
      for (const Pair pair : pairs) *to++ = firstId(pair.first) << 32 | secondId(pair.second);
      return;
    }
    for (const Pair pair : pairs) {
      *to++ = firstId(pair.first);
      *to++ = secondId(pair.second);
    }
  }

  const Ranks& m_ranks;
  bool m_areIdsShort = true;
  std::vector<std::uint64_t> m_ends;
  std::size_t m_to = 0;  ///< The rank that the last pair goes to, and the first boxes that it has.
  std::uint64_t m_begin = 0;
  std::uint64_t m_end = 0;
  std::vector<std::vector<std::uint64_t>> m_outgoing;  ///< By rank.
  std::vector<std::vector<std::uint64_t>> m_received;  ///< As they came, a part each time.
};

}  // namespace allpairs::mpi
