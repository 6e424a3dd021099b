// SPDX-License-Identifier: MIT
#include "PairExchange.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

namespace allpairs::mpi {
namespace {

constexpr unsigned kGroupBits = 12;  // of first boxes whose pairs are put in order together: they stay in the cache
constexpr std::size_t kGroupRows = std::size_t{1} << kGroupBits;

/// A pair as it travels, in one word.
struct ShortPair {
  static constexpr std::size_t kWords = 1;
  std::uint64_t word;

  static ShortPair from(const std::uint64_t* words) { return {words[0]}; }
  [[nodiscard]] std::uint64_t first() const { return word >> 32; }
  [[nodiscard]] std::uint64_t second() const { return word & 0xFFFFFFFFU; }
};

/// A pair as it travels, in two words.
struct LongPair {
  static constexpr std::size_t kWords = 2;
  std::array<std::uint64_t, 2> words;

  static LongPair from(const std::uint64_t* words) { return {{words[0], words[1]}}; }
  [[nodiscard]] std::uint64_t first() const { return words[0]; }
  [[nodiscard]] std::uint64_t second() const { return words[1]; }
};

/// Puts pairs in order that came in parts, which it frees.
template <class Travelling>
class Orderer {
 public:
  Orderer(std::vector<std::vector<std::uint64_t>>& parts, std::uint64_t firstId, std::uint64_t rows)
      : m_firstId(firstId), m_groups((rows >> kGroupBits) + 2) {
    for (const std::vector<std::uint64_t>& part : parts) {
      forEach(part, [this](const Travelling& pair) { ++m_groups[groupOf(pair) + 1]; });
    }
    std::partial_sum(m_groups.begin(), m_groups.end(), m_groups.begin());
    m_pairs = std::make_unique_for_overwrite<Travelling[]>(m_groups.back());
    std::vector<std::size_t> next(m_groups.begin(), m_groups.end() - 1);
    for (std::vector<std::uint64_t>& part : parts) {
      forEach(part, [&](const Travelling& pair) { m_pairs[next[groupOf(pair)]++] = pair; });
      part = {};
    }
  }

  std::vector<IdPair> inOrder() {
    std::vector<IdPair> ordered;
    ordered.reserve(m_groups.back());
    for (std::size_t group = 0; group + 1 < m_groups.size(); ++group) {
      const std::span<const Travelling> pairs = orderGroup(group);
      for (const Travelling& pair : pairs) ordered.push_back({pair.first(), pair.second()});
    }
    return ordered;
  }

 private:
  template <class Use>
  static void forEach(const std::vector<std::uint64_t>& words, const Use& use) {
    for (std::size_t at = 0; at < words.size(); at += Travelling::kWords) use(Travelling::from(&words[at]));
  }

  [[nodiscard]] std::size_t groupOf(const Travelling& pair) const { return (pair.first() - m_firstId) >> kGroupBits; }

  std::span<const Travelling> orderGroup(std::size_t group) {
    const std::span<const Travelling> pairs(m_pairs.get() + m_groups[group], m_groups[group + 1] - m_groups[group]);
    const std::uint64_t firstOfGroup = m_firstId + (std::uint64_t{group} << kGroupBits);
    m_ends.fill(0);
    for (const Travelling& pair : pairs) ++m_ends[pair.first() - firstOfGroup];
    std::exclusive_scan(m_ends.begin(), m_ends.end(), m_ends.begin(), std::size_t{0});
    m_ordered.resize(pairs.size());
    for (const Travelling& pair : pairs) m_ordered[m_ends[pair.first() - firstOfGroup]++] = pair;
    const auto isLess = [](const Travelling& a, const Travelling& b) { return a.second() < b.second(); };
    std::size_t begin = 0;
    for (const std::size_t end : m_ends) {
      std::sort(m_ordered.data() + begin, m_ordered.data() + end, isLess);
      begin = end;
    }
    return m_ordered;
  }

  std::uint64_t m_firstId;
  std::vector<std::size_t> m_groups;  ///< Where the pairs of each begin, and the end.
  std::unique_ptr<Travelling[]> m_pairs;
  std::array<std::size_t, kGroupRows> m_ends{};  ///< Of each row of a group.
  std::vector<Travelling> m_ordered;             ///< Pairs of a group.
};

}  // namespace

void PairExchange::start(std::span<const std::uint64_t> ends, bool areIdsShort) {
  m_ends.assign(ends.begin(), ends.end());
  m_areIdsShort = areIdsShort;
  m_outgoing.resize(ends.size());
}

void PairExchange::add(std::uint64_t first, std::uint64_t second) {
  const auto rank = std::upper_bound(m_ends.begin(), m_ends.end(), first) - m_ends.begin();
  std::vector<std::uint64_t>& words = m_outgoing[static_cast<std::size_t>(rank)];
  if (m_areIdsShort) {
    words.push_back(first << 32 | second);
  } else {
    words.insert(words.end(), {first, second});
  }
}

void PairExchange::send() {
  m_ranks.onAll([this] { m_received.emplace_back(); });
  m_received.back() = m_ranks.exchange(m_outgoing);
  for (auto& pairs : m_outgoing) pairs.clear();
}

std::vector<IdPair> PairExchange::takeInOrder() {
  const auto rank = static_cast<std::size_t>(m_ranks.rank());
  const std::uint64_t firstId = rank == 0 ? 0 : m_ends[rank - 1];
  const std::uint64_t rows = m_ends[rank] - firstId;
  std::vector<std::vector<std::uint64_t>> parts = std::move(m_received);
  m_received.clear();
  return m_areIdsShort ? Orderer<ShortPair>(parts, firstId, rows).inOrder()
                       : Orderer<LongPair>(parts, firstId, rows).inOrder();
}

}  // namespace allpairs::mpi
