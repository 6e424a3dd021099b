// SPDX-License-Identifier: MIT
#include "world/PairHistory.h"

#include <algorithm>

namespace allpairs::engine {
namespace {

/// Rows up to this length are searched one by one.
constexpr std::size_t kShortRow = 16;

/// How many pairs ahead the memory of a row is asked for.
constexpr std::size_t kPrefetchPairs = 16;

/// Compares as the pair does.
std::uint64_t keyOf(Pair pair) { return (std::uint64_t{pair.first} << 32U) | pair.second; }

}  // namespace

void PairHistory::begin(std::size_t idBound, std::size_t finders) {
  m_idBound = idBound;
  m_rowBegin.resize(std::max(m_rowBegin.size(), idBound + 1), m_result.pairs.size());
  makeRoom(m_seen, m_result.pairs.size());
  std::fill_n(m_seen.data(), m_result.pairs.size(), std::uint8_t{0});
  if (m_fresh.size() < finders) m_fresh.resize(finders);
  for (Fresh& fresh : m_fresh) fresh.size = 0;
}

std::size_t PairHistory::find(Pair pair) const noexcept {
  const Pair* const pairs = m_result.pairs.data();
  std::size_t begin = m_rowBegin[pair.first];
  const std::size_t end = m_rowBegin[pair.first + 1];
  if (end - begin > kShortRow) {
    begin = static_cast<std::size_t>(std::lower_bound(pairs + begin, pairs + end, pair) - pairs);
    return begin < end && pairs[begin] == pair ? begin : kNowhere;
  }
  for (; begin < end; ++begin) {
    if (pairs[begin].second == pair.second) return begin;
  }
  return kNowhere;
}

void PairHistory::take(std::span<const Pair> found, std::size_t finder) {
  Fresh& fresh = m_fresh[finder];
  fresh.pairs.grow(fresh.size + found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Pair ahead = found[std::min(i + kPrefetchPairs, found.size() - 1)];
    __builtin_prefetch(m_result.pairs.data() + m_rowBegin[ahead.first]);
    const std::size_t place = find(found[i]);
    if (place == kNowhere) {
      fresh.pairs[fresh.size++] = found[i];
    } else {
      m_seen[place] = 1;
    }
  }
}

void PairHistory::gatherFresh(const Kernels& kernels, Executor& executor) {
  std::size_t size = 0;
  for (const Fresh& fresh : m_fresh) size += fresh.size;
  makeRoom(m_began, size);
  Pair* to = m_began.data();
  for (const Fresh& fresh : m_fresh) to = std::copy_n(fresh.pairs.data(), fresh.size, to);
  m_result.began = {m_began.data(), size};
  PairSort::Task task;
  task.firsts = m_idBound;
  task.seconds = m_idBound;
  task.kernels = &kernels;
  // The old pairs have been split up: their memory is where the sort moves pairs to and fro.
  task.spare = {m_pairs.data(), m_pairs.capacity()};
  m_sort.sort({m_began.data(), size}, task, executor);
}

/// Merges what persists with what began.
void PairHistory::mergeFresh() {
  shiftRows();
  const std::span<const Pair> persisted = m_result.persisted;
  const std::size_t size = persisted.size() + m_result.began.size();
  makeRoom(m_pairs, size);
  Pair* to = m_pairs.data();
  const Pair* next = persisted.data();
  const Pair* const end = next + persisted.size();
  for (const Pair& pair : m_result.began) {
    // Stretches are short: copied one by one they cost less than a call would.
    while (next != end && keyOf(*next) < keyOf(pair)) *to++ = *next++;
    *to++ = pair;
  }
  std::copy(next, end, to);
  m_result.pairs = {m_pairs.data(), size};
}

/// Moves the beginnings of the rows by what began and ended before them.
void PairHistory::shiftRows() {
  const std::size_t rows = m_rowBegin.size();
  const std::span<const Pair> began = m_result.began;
  const std::span<const Pair> ended = m_result.ended;
  std::size_t b = 0;
  std::size_t e = 0;
  std::size_t row = 0;
  std::size_t shift = 0;  // Modulo 2^64: may be below 0 in between.
  while (b < began.size() || e < ended.size()) {
    const std::size_t stop =
        std::min<std::size_t>(b < began.size() ? began[b].first : rows, e < ended.size() ? ended[e].first : rows);
    for (; row <= stop; ++row) m_rowBegin[row] += shift;
    for (; b < began.size() && began[b].first == stop; ++b) ++shift;
    for (; e < ended.size() && ended[e].first == stop; ++e) --shift;
  }
  for (; row < rows; ++row) m_rowBegin[row] += shift;
}

}  // namespace allpairs::engine
