// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "Ranks.h"
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

  void add(std::uint64_t first, std::uint64_t second);

  /// Sends what was added since the last time, and receives as much from the others; collective.
  void send();

  /// The pairs that came to this rank, by (first, second). It keeps none.
  [[nodiscard]] std::vector<IdPair> takeInOrder();

 private:
  const Ranks& m_ranks;
  bool m_areIdsShort = true;
  std::vector<std::uint64_t> m_ends;
  std::vector<std::vector<std::uint64_t>> m_outgoing;  ///< By rank.
  std::vector<std::vector<std::uint64_t>> m_received;  ///< As they came, a part each time.
};

}  // namespace allpairs::mpi
