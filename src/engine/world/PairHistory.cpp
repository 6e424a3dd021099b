// SPDX-License-Identifier: MIT
#include "world/PairHistory.h"

#include <algorithm>

namespace allpairs::engine {
namespace {

/// Rows up to this length are searched one by one.
constexpr std::size_t kShortRow = 16;

/// How many pairs ahead the memory of a row is asked for.
constexpr std::size_t kPrefetchDistance = 16;

}  // namespace

void PairHistory::begin(std::size_t idBound, std::size_t finders) {
  m_idBound = idBound;
  m_rowBegin.resize(std::max(m_rowBegin.size(), idBound + 1), m_result.pairs.size());
  m_seen.require(m_result.pairs.size() + 1);
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
    const Pair ahead = found[std::min(i + kPrefetchDistance, found.size() - 1)];
    __builtin_prefetch(m_result.pairs.data() + m_rowBegin[ahead.first]);
    const std::size_t place = find(found[i]);
    if (place == kNowhere) {
      fresh.pairs[fresh.size++] = found[i];
    } else {
      m_seen[place] = 1;
    }
  }
}

void PairHistory::gatherFresh(Executor& executor) {
  std::size_t size = 0;
  for (const Fresh& fresh : m_fresh) size += fresh.size;
  m_began.require(size + 1);
  Pair* to = m_began.data();
  for (const Fresh& fresh : m_fresh) to = std::copy_n(fresh.pairs.data(), fresh.size, to);
  m_result.began = {m_began.data(), size};
  PairSort::Task task;
  task.firsts = m_idBound;
  task.seconds = m_idBound;
  m_sort.sort({m_began.data(), size}, task, executor);
}

/// Merges what persists with what began: stretches of the one between entries of the other.
void PairHistory::mergeFresh() {
  shiftRows();
  const std::span<const Pair> persisted = m_result.persisted;
  const std::size_t size = persisted.size() + m_result.began.size();
  m_pairs.require(size + 1);
  Pair* to = m_pairs.data();
  std::size_t next = 0;
  for (const Pair& pair : m_result.began) {
    std::size_t stop = next;
    while (stop < persisted.size() && persisted[stop] < pair) ++stop;
    to = std::copy(persisted.begin() + static_cast<std::ptrdiff_t>(next),
                   persisted.begin() + static_cast<std::ptrdiff_t>(stop), to);
    *to++ = pair;
    next = stop;
  }
  std::copy(persisted.begin() + static_cast<std::ptrdiff_t>(next), persisted.end(), to);
  m_result.pairs = {m_pairs.data(), size};
}

/// Moves the beginnings of the rows by what began and ended before them.
void PairHistory::shiftRows() {
  if (m_result.began.empty() && m_result.ended.empty()) return;
  const Pair* began = m_result.began.data();
  const Pair* ended = m_result.ended.data();
  const Pair* const beganEnd = began + m_result.began.size();
  const Pair* const endedEnd = ended + m_result.ended.size();
  std::size_t shift = 0;  // Modulo 2^64: may be below 0 in between.
  for (std::size_t row = 0; row < m_rowBegin.size(); ++row) {
    m_rowBegin[row] += shift;
    for (; began != beganEnd && began->first == row; ++began) ++shift;
    for (; ended != endedEnd && ended->first == row; ++ended) --shift;
  }
}

}  // namespace allpairs::engine
