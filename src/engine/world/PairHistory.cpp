// SPDX-License-Identifier: MIT
#include "world/PairHistory.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

#include "input/Parts.h"
#include "kernels/Lanes.h"
#include "memory/Platform.h"
#include "search/CallExecutor.h"

namespace allpairs::engine {
namespace {

/// Rows up to this length, as most are, are searched one by one and not by halves (moving_benchmark --scene
/// one-percent).
constexpr std::size_t kShortRow = 16;

/// Where the comparison of two ordered lists is: what is left of them, and where the next pairs go.
struct Comparison {
  const Pair* old;
  const Pair* oldEnd;
  const Pair* now;
  const Pair* nowEnd;
  Pair* persisted;
  Pair* began;
  Pair* ended;

  /// Passes the next pair of the old list, of the new one, or of both. No branch depends on which.
  void pass(bool isKept, bool isNeeded) noexcept {
    const auto olds = static_cast<std::ptrdiff_t>(isKept);
    const auto news = static_cast<std::ptrdiff_t>(isNeeded);
    *persisted = *now;
    *began = *now;
    *ended = *old;
    persisted += olds & news;
    began += 1 - olds;
    ended += 1 - news;
    old += olds;
    now += news;
  }
};

/// Whether the next pairs of both lists are the same.
bool areSame(const Pair* a, const Pair* b) noexcept {
  std::uint64_t difference = 0;
  for (std::size_t i = 0; i < kLinePairs; ++i)
    difference |= std::bit_cast<std::uint64_t>(a[i]) ^ std::bit_cast<std::uint64_t>(b[i]);
  return difference == 0;
}

/// Some steps without branches: the keys that follow are read before it is known which of them come next, and chosen by
/// arithmetic.
template <Order order>
void compareFew(Comparison& at) noexcept {
  std::uint64_t oldKey = keyOf(*at.old, order);
  std::uint64_t nowKey = keyOf(*at.now, order);
  for (std::size_t i = 0; i < kLinePairs; ++i) {
    const std::uint64_t nextOld = keyOf(at.old[1], order);
    const std::uint64_t nextNow = keyOf(at.now[1], order);
    const bool isKept = oldKey <= nowKey;
    const bool isNeeded = nowKey <= oldKey;
    at.pass(isKept, isNeeded);
    oldKey ^= (oldKey ^ nextOld) & (std::uint64_t{0} - std::uint64_t{isKept});
    nowKey ^= (nowKey ^ nextNow) & (std::uint64_t{0} - std::uint64_t{isNeeded});
  }
}

/// Compares up to a part of the lists, a cache line of pairs at once (moving_benchmark).
template <Order order>
Comparison comparePart(Comparison at) noexcept {
  for (std::size_t i = 0; i < kPartSize && at.old != at.oldEnd && at.now != at.nowEnd; i += kLinePairs) {
    if (std::min(at.oldEnd - at.old, at.nowEnd - at.now) <= std::ptrdiff_t{kLinePairs}) {
      const std::uint64_t oldKey = keyOf(*at.old, order);
      const std::uint64_t nowKey = keyOf(*at.now, order);
      at.pass(oldKey <= nowKey, nowKey <= oldKey);
    } else if (areSame(at.old, at.now)) {
      at.persisted = std::copy_n(at.now, kLinePairs, at.persisted);
      at.old += kLinePairs;
      at.now += kLinePairs;
    } else {
      compareFew<order>(at);
    }
  }
  return at;
}

}  // namespace

void PairHistory::begin(std::size_t idBound, std::size_t workers, bool looksForAll) {
  m_looksForAll = looksForAll;
  dropChanges();
  m_rowsAreCurrent = m_rowsAreCurrent && idBound == m_idBound;
  m_idBound = idBound;
  while (m_fresh.size() < workers) m_fresh.emplace_back(m_memory);
  for (Fresh& fresh : m_fresh) {
    fresh.size = 0;
    fresh.isInOrder = true;
  }
  const PairOrder order(idBound, idBound, m_options->order, workers);
  m_usesBuckets = looksForAll && !m_comeInOrder && order.packs();
  if (m_usesBuckets) m_sort.start(order, workers, *m_kernels);
  if (looksForAll) return;
  if (!m_rowsAreCurrent) findRows();
  m_seen.requireAmply(m_result.pairs.size() + 1);
  std::fill_n(m_seen.data(), m_result.pairs.size(), std::uint8_t{0});
}

void PairHistory::shrink() noexcept {
  PairHistory rest(m_memory, *m_options, *m_kernels);
  rest.m_pairs = std::move(m_pairs);
  rest.m_began = std::move(m_began);
  rest.m_persisted = std::move(m_persisted);
  rest.m_ended = std::move(m_ended);
  rest.m_result = m_result;
  *this = std::move(rest);
}

/// The index of the first old pair of each box: each pair says where the next row begins, and rows without pairs begin
/// where those before them end.
void PairHistory::findRows() {
  const std::span<const Pair> pairs = m_result.pairs;
  m_rowBegin.assign(std::max(m_rowBegin.size(), m_idBound + 1), 0);
  for (std::size_t i = 0; i < pairs.size(); ++i) m_rowBegin[rowOf(pairs[i]) + 1] = i + 1;
  for (std::size_t row = 1; row < m_rowBegin.size(); ++row)
    m_rowBegin[row] = std::max(m_rowBegin[row], m_rowBegin[row - 1]);
  m_rowsAreCurrent = true;
}

std::size_t PairHistory::find(Pair pair) const noexcept {
  const Pair* const pairs = m_result.pairs.data();
  const BoxId row = rowOf(pair);
  std::size_t begin = m_rowBegin[row];
  const std::size_t end = m_rowBegin[row + 1];
  if (end - begin > kShortRow) {
    const auto isBefore = [this](Pair a, Pair b) { return keyOf(a) < keyOf(b); };
    begin = static_cast<std::size_t>(std::lower_bound(pairs + begin, pairs + end, pair, isBefore) - pairs);
    return begin < end && pairs[begin] == pair ? begin : m_result.pairs.size();
  }
  for (; begin < end; ++begin) {
    if (pairs[begin] == pair) return begin;
  }
  return m_result.pairs.size();
}

void PairHistory::gather(std::span<const Pair> found, Fresh& fresh, bool areInOrder) {
  fresh.pairs.grow(fresh.size + found.size(), [this] { checkStop(m_options->stop); });
  if (found.empty()) return;
  assert(!areInOrder ||
         std::is_sorted(found.begin(), found.end(), [this](Pair a, Pair b) { return keyOf(a) < keyOf(b); }));
  fresh.isInOrder &= areInOrder && (fresh.size == 0 || keyOf(fresh.pairs[fresh.size - 1]) < keyOf(found[0]));
  std::copy(found.begin(), found.end(), fresh.pairs.data() + fresh.size);
  fresh.size += found.size();
}

void PairHistory::tickOff(std::span<const Pair> found, Fresh& fresh) {
  fresh.pairs.grow(fresh.size + found.size(), [this] { checkStop(m_options->stop); });
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Pair ahead = found[std::min(i + kPrefetchDistance, found.size() - 1)];
    prefetchLine(m_result.pairs.data() + m_rowBegin[rowOf(ahead)]);
    const std::size_t place = find(found[i]);
    if (place == m_result.pairs.size()) {
      fresh.pairs[fresh.size++] = found[i];
    } else {
      m_seen[place] = 1;
    }
  }
}

std::size_t PairHistory::freshSize() const noexcept {
  std::size_t size = 0;
  for (const Fresh& fresh : m_fresh) size += fresh.size;
  return size;
}

/// Sorts the new pairs, with memory that may be overwritten.
void PairHistory::sortFresh(Buffer<Pair>& to, std::span<Pair> spare, Executor& executor) {
  Pair* end = to.data();
  for (const Fresh& fresh : m_fresh) {
    runInParts(fresh.size, kPartSize, executor, [&](std::size_t first, std::size_t last) {
      std::copy(fresh.pairs.data() + first, fresh.pairs.data() + last, end + first);
    });
    end += fresh.size;
  }
  m_sort.sortList({to.data(), end}, {m_idBound, m_idBound, m_options->order}, spare, executor);
}

/// Allocates everything that the end of a step needs before it changes anything.
void PairHistory::makeRoomForChanges() {
  const std::size_t old = m_result.pairs.size();
  const std::size_t fresh = freshSize();
  m_began.requireAmply(fresh + 1);
  m_persisted.requireAmply(std::max(old, fresh) + 1);
  m_ended.requireAmply(old + 1);
  m_pairs.grow(old + fresh + 1);
  m_result.pairs = {m_pairs.data(), old};
  dropChanges();  // What persists are these: what follows may throw.
}

/// Whether one worker has found all pairs, in order; then they are the next ones.
bool PairHistory::takeOrdered() noexcept {
  const auto isUsed = [](const Fresh& fresh) { return fresh.size != 0; };
  const auto used = std::find_if(m_fresh.begin(), m_fresh.end(), isUsed);
  if (used == m_fresh.end() || std::any_of(used + 1, m_fresh.end(), isUsed)) return false;
  if (!used->isInOrder) return false;
  std::swap(m_next, used->pairs);
  return true;
}

void PairHistory::finishAll(Executor& executor, JoinRunner& memory) {
  const std::size_t size = m_usesBuckets ? m_sort.finish() : freshSize();
  m_persisted.requireAmply(size + 1);
  m_began.requireAmply(size + 1);
  m_ended.requireAmply(m_result.pairs.size() + 1);
  if (!m_usesBuckets && size != 0) m_comeInOrder = takeOrdered();
  if (!m_comeInOrder) m_next.requireAmply(size + 1);
  if (m_usesBuckets) {
    m_sort.sort({m_next.data(), size}, executor, memory);
  } else if (!m_comeInOrder) {
    sortFresh(m_next, {m_persisted.data(), m_persisted.capacity()}, executor);
  }
  compare({m_next.data(), size});
  std::swap(m_pairs, m_next);
  m_result.pairs = {m_pairs.data(), size};
  m_rowsAreCurrent = false;
}

/// Copies pairs part by part, and looks at the flag before each; returns where they end.
Pair* PairHistory::copyAll(std::span<const Pair> pairs, Pair* to) const {
  for (; !pairs.empty(); pairs = pairs.subspan(std::min(pairs.size(), kPartSize))) {
    checkStop(m_options->stop);
    to = std::copy_n(pairs.begin(), std::min(pairs.size(), kPartSize), to);
  }
  return to;
}

/// Compares two ordered lists: pairs in both persist, pairs in only one began or ended.
void PairHistory::compare(std::span<const Pair> now) {
  const std::span<const Pair> old = m_result.pairs;
  const bool isByFirst = m_options->order == Order::ByFirst;
  Comparison at{old.data(),         old.data() + old.size(), now.data(),    now.data() + now.size(),
                m_persisted.data(), m_began.data(),          m_ended.data()};
  while (at.old != at.oldEnd && at.now != at.nowEnd) {
    checkStop(m_options->stop);
    at = isByFirst ? comparePart<Order::ByFirst>(at) : comparePart<Order::BySecond>(at);
  }
  at.ended = copyAll({at.old, at.oldEnd}, at.ended);
  at.began = copyAll({at.now, at.nowEnd}, at.began);
  m_result.persisted = {m_persisted.data(), at.persisted};
  m_result.began = {m_began.data(), at.began};
  m_result.ended = {m_ended.data(), at.ended};
}

/// Merges the pairs that persist with those that began.
void PairHistory::mergeFresh() noexcept {
  shiftRows();
  const std::span<const Pair> persisted = m_result.persisted;
  const std::size_t size = persisted.size() + m_result.began.size();
  Pair* to = m_pairs.data();
  const Pair* next = persisted.data();
  const Pair* const end = next + persisted.size();
  for (const Pair& pair : m_result.began) {
    for (; static_cast<std::size_t>(end - next) >= kLinePairs && keyOf(next[kLinePairs - 1]) < keyOf(pair);
         next += kLinePairs)
      to = std::copy_n(next, kLinePairs, to);
    while (next != end && keyOf(*next) < keyOf(pair)) *to++ = *next++;
    *to++ = pair;
  }
  std::copy(next, end, to);
  m_result.pairs = {m_pairs.data(), size};
}

/// Shifts the beginnings of the rows by the number of pairs that began and ended before them.
void PairHistory::shiftRows() noexcept {
  const std::size_t rows = m_rowBegin.size();
  const std::span<const Pair> began = m_result.began;
  const std::span<const Pair> ended = m_result.ended;
  std::size_t b = 0;
  std::size_t e = 0;
  std::size_t row = 0;
  std::size_t shift = 0;  // Modulo 2^64: may be below 0 in between.
  while (b < began.size() || e < ended.size()) {
    const std::size_t stop =
        std::min<std::size_t>(b < began.size() ? rowOf(began[b]) : rows, e < ended.size() ? rowOf(ended[e]) : rows);
    for (; row <= stop; ++row) m_rowBegin[row] += shift;
    for (; b < began.size() && rowOf(began[b]) == stop; ++b) ++shift;
    for (; e < ended.size() && rowOf(ended[e]) == stop; ++e) --shift;
  }
  for (; row < rows; ++row) m_rowBegin[row] += shift;
}

}  // namespace allpairs::engine
