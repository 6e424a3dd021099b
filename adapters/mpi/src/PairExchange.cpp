// SPDX-License-Identifier: MIT
#include "PairExchange.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>

namespace allpairs::mpi {
namespace {

constexpr std::uint64_t kLeastRows = 4096;  // first boxes whose pairs are put in order together: they stay in the cache
constexpr std::uint64_t kMostRows = std::uint64_t{1} << 20;
constexpr std::uint64_t kPairsOfRun = 8;  // in a group, or looking at all runs takes longer than at their pairs
constexpr std::ptrdiff_t kShortRow = 16;  // partners of a box that are put in order by insertion

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

void orderRow(IdPair* begin, IdPair* end) {
  if (end - begin > kShortRow) {
    std::sort(begin, end, [](const IdPair& a, const IdPair& b) { return a.second < b.second; });
    return;
  }
  for (IdPair* next = begin; next != end; ++next) {
    const IdPair pair = *next;
    IdPair* place = next;
    for (; place != begin && pair.second < place[-1].second; --place) *place = place[-1];
    *place = pair;
  }
}

/// Puts pairs in order that came in runs, each of which ascends.
template <class Travelling>
class Orderer {
 public:
  Orderer(std::span<const std::vector<std::uint64_t>> parts, std::uint64_t firstId, std::uint64_t rows)
      : m_firstId(firstId), m_rows(rows) {
    for (const std::vector<std::uint64_t>& part : parts) addRuns(part);
    const std::uint64_t groups = std::max<std::uint64_t>(m_size / (kPairsOfRun * (m_runs.size() + 1)), 1);
    m_places.resize(std::clamp(rows / groups + 1, kLeastRows, kMostRows));
  }

  std::vector<IdPair> inOrder() {
    std::vector<IdPair> ordered;
    ordered.reserve(m_size);
    for (std::uint64_t row = 0; row < m_rows; row += m_places.size()) orderGroup(m_firstId + row, ordered);
    return ordered;
  }

 private:
  struct Run {
    const std::uint64_t* next;  ///< What is not in order yet.
    const std::uint64_t* end;
    const std::uint64_t* groupEnd;
  };

  void addRuns(const std::vector<std::uint64_t>& words) {
    m_size += words.size() / Travelling::kWords;
    const std::uint64_t* begin = words.data();
    const std::uint64_t* const end = begin + words.size();
    std::uint64_t last = 0;
    for (const std::uint64_t* at = begin; at != end; at += Travelling::kWords) {
      const std::uint64_t first = Travelling::from(at).first();
      if (first < last) {
        m_runs.push_back({begin, at, begin});
        begin = at;
      }
      last = first;
    }
    if (begin != end) m_runs.push_back({begin, end, begin});
  }

  /// Appends the pairs of the first boxes of a group.
  void orderGroup(std::uint64_t begin, std::vector<IdPair>& ordered) {
    std::fill(m_places.begin(), m_places.end(), std::size_t{0});
    const std::size_t before = ordered.size();
    ordered.resize(before + countRows(begin));
    IdPair* const group = ordered.data() + before;
    std::exclusive_scan(m_places.begin(), m_places.end(), m_places.begin(), std::size_t{0});
    for (Run& run : m_runs) {
      for (; run.next != run.groupEnd; run.next += Travelling::kWords) {
        const Travelling pair = Travelling::from(run.next);
        group[m_places[pair.first() - begin]++] = {pair.first(), pair.second()};
      }
    }
    IdPair* row = group;
    for (const std::size_t end : m_places) {
      orderRow(row, group + end);
      row = group + end;
    }
  }

  /// Counts the pairs of each first box of a group, and finds where they end in each run.
  std::size_t countRows(std::uint64_t begin) {
    std::size_t count = 0;
    for (Run& run : m_runs) {
      run.groupEnd = run.next;
      for (; run.groupEnd != run.end; run.groupEnd += Travelling::kWords) {
        const std::uint64_t row = Travelling::from(run.groupEnd).first() - begin;
        if (row >= m_places.size()) break;
        ++m_places[row];
      }
      count += static_cast<std::size_t>(run.groupEnd - run.next) / Travelling::kWords;
    }
    return count;
  }

  std::uint64_t m_firstId;
  std::uint64_t m_rows;
  std::size_t m_size = 0;
  std::vector<Run> m_runs;
  std::vector<std::size_t> m_places;  ///< Where the next pair of each first box of a group goes.
};

}  // namespace

void PairExchange::start(std::span<const std::uint64_t> ends, bool areIdsShort) {
  m_ends.assign(ends.begin(), ends.end());
  m_areIdsShort = areIdsShort;
  m_outgoing.resize(ends.size());
  m_begin = 0;
  m_end = 0;
}

void PairExchange::turnTo(std::uint64_t first) {
  if (goesToTheSame(first)) return;
  m_to = static_cast<std::size_t>(std::upper_bound(m_ends.begin(), m_ends.end(), first) - m_ends.begin());
  m_begin = m_to == 0 ? 0 : m_ends[m_to - 1];
  m_end = m_ends[m_to];
}

void PairExchange::send() {
  m_ranks.onAll([this] { m_received.emplace_back(); });
  m_ranks.exchange(m_outgoing, m_received.back());
  for (auto& words : m_outgoing) {
    freeIfLarge(words, words.size());
    words.clear();
  }
}

std::vector<IdPair> PairExchange::takeInOrder() {
  const auto rank = static_cast<std::size_t>(m_ranks.rank());
  const std::uint64_t firstId = rank == 0 ? 0 : m_ends[rank - 1];
  const std::uint64_t rows = m_ends[rank] - firstId;
  m_outgoing.clear();
  m_outgoing.shrink_to_fit();
  const std::vector<std::vector<std::uint64_t>> parts = std::exchange(m_received, {});
  return m_areIdsShort ? Orderer<ShortPair>(parts, firstId, rows).inOrder()
                       : Orderer<LongPair>(parts, firstId, rows).inOrder();
}

}  // namespace allpairs::mpi
