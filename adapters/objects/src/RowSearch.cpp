// SPDX-License-Identifier: MIT
#include "allpairs/objects/RowSearch.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>

namespace allpairs {
namespace {

/// While at most one box in this many changes, a step of the world is cheaper than a full search: measured with 10,000
/// boxes that have 1 to 19 pairs each, where they break even at 13 to 3 %.
constexpr std::size_t kShareOfChanged = 32;

/// Up to so many rows, comparing each with each is faster than a search for pairs.
constexpr std::size_t kFewForPairs = 20;

/// Two searches of which each row of one and each of the other make so many pairs at most are compared by scans.
constexpr std::size_t kFewForScans = 4096;

/// Queries scan all rows until they have compared so many for each row that a world would have to hear of: then that
/// costs about what they have cost. Measured with 200 to 1,000 rows that have all moved.
constexpr std::size_t kScansPerChange = 32;

WorldOptions worldOptions(Executor* executor) {
  WorldOptions options;
  options.executor = executor;
  return options;
}

OverlapOptions searchOptions(Executor* executor, bool isOrdered) {
  OverlapOptions options;
  options.executor = executor;
  options.order = isOrdered ? Order::ByFirst : Order::Unordered;
  return options;
}

/// Two numbers that are compared at once, which every 64-bit processor can: pairs are many, and lie anywhere.
using Two [[gnu::vector_size(16)]] = double;

/// Numbers that follow each other, wherever they are.
Two load(const double* numbers) {
  Two vector;
  std::memcpy(&vector, numbers, sizeof(vector));
  return vector;
}

/// Whether rows overlap that do so when they are rounded.
bool overlap(const double* a, const double* b) {
  const auto xy = (load(a) <= load(b + 3)) & (load(b) <= load(a + 3));
  const auto z = Two{a[2], b[2]} <= Two{b[5], a[5]};
  const auto both = xy & z;
  return (both[0] & both[1]) != 0;
}

/// Rows of float32 are what they are when rounded.
bool overlap(const float* /*a*/, const float* /*b*/) { return true; }

/// Copies the pairs that overlap by their rows.
void selectExact(std::span<const Pair> pairs, std::span<const double> rows, std::vector<Pair>& results) {
  results.resize(pairs.size());
  std::size_t kept = 0;
  for (const Pair pair : pairs) {
    results[kept] = pair;
    kept += overlap(&rows[std::size_t{6} * pair.first], &rows[std::size_t{6} * pair.second]) ? 1U : 0U;
  }
  results.resize(kept);
}

}  // namespace

template <class T>
RowSearch<T>::RowSearch(Executor* executor, bool isOrdered)
    : m_executor(executor), m_search(searchOptions(executor, isOrdered)), m_world(worldOptions(executor)) {}

template <class T>
void RowSearch<T>::clear() {
  m_world = World(worldOptions(m_executor));
  m_isPending.clear();
  m_pending = 0;
  m_changes = 0;
  m_isCalm = false;
  m_wantsPairs = false;
  m_hasPairs = false;
  m_hasWorld = false;
  m_scanned = 0;
  m_rounded.clear();
  m_changedBegin = kNoBox;
  m_changedEnd = 0;
  m_isRounded = true;
}

/// What was made for the rows as they were is out of date.
template <class T>
void RowSearch<T>::beginChange() {
  m_wantsPairs = m_hasPairs;
  m_hasPairs = false;
  m_hasWorld = false;
  m_scanned = 0;
}

template <class T>
const RoundedBoxes& RowSearch<T>::rounded(Span<const T> rows) const {
  if (m_isRounded.load(std::memory_order_acquire)) return m_rounded;
  const std::lock_guard lock(m_making);
  round(rows);
  return m_rounded;
}

/// Brings m_rounded up to date, under the lock.
template <class T>
void RowSearch<T>::round(Span<const T> rows) const {
  if (m_isRounded.load(std::memory_order_relaxed)) return;
  m_rounded.reserve(m_changedEnd);
  for (BoxId i = m_changedBegin; i < m_changedEnd; ++i) m_rounded.set(i, &rows[std::size_t{6} * i]);
  m_changedBegin = kNoBox;
  m_changedEnd = 0;
  m_isRounded.store(true, std::memory_order_release);
}

template <class T>
Span<const Pair> RowSearch<T>::pairs(Span<const T> rows) const {
  if (m_hasPairs.load(std::memory_order_acquire)) return m_pairs;
  const std::lock_guard lock(m_making);
  if (!m_hasPairs.load(std::memory_order_relaxed)) find(rows);
  return m_pairs;
}

template <class T>
const World& RowSearch<T>::world(Span<const T> rows) const {
  if (m_hasWorld.load(std::memory_order_acquire)) return m_world;
  const std::lock_guard lock(m_making);
  if (m_hasWorld.load(std::memory_order_relaxed)) return m_world;
  bringIn(rows);
  // Afterwards others query the world, which must not make a step then.
  if (m_wantsPairs && !m_hasPairs.load(std::memory_order_relaxed) && isCalmAgain(rows)) step(rows);
  m_hasWorld.store(true, std::memory_order_release);
  return m_world;
}

template <class T>
const World* RowSearch<T>::worldForMany(Span<const T> rows) const {
  if (m_hasWorld.load(std::memory_order_acquire)) return &m_world;
  const std::size_t scanned = m_scanned.load(std::memory_order_relaxed);
  if (scanned > kScansPerChange * m_pending.load(std::memory_order_relaxed)) return &world(rows);
  m_scanned.store(scanned + rows.size() / 6, std::memory_order_relaxed);  // about
  return nullptr;
}

template <class T>
bool RowSearch<T>::isFasterByScans(Span<const T> rows, std::size_t others) const {
  return !m_hasWorld.load(std::memory_order_acquire) && rows.size() / 6 * others <= kFewForScans;
}

/// Few have changed, now as before: the world has to catch up with all that changed in between, which one quiet step is
/// no reason for.
template <class T>
bool RowSearch<T>::isCalmAgain(Span<const T> rows) const {
  return m_isCalm && m_changes * kShareOfChanged <= rows.size() / 6;
}

template <class T>
void RowSearch<T>::find(Span<const T> rows) const {
  if (rows.size() <= 6 * kFewForPairs) {
    m_pairs = scanAll(rows);
  } else if (isCalmAgain(rows) && !m_hasWorld.load(std::memory_order_relaxed)) {
    bringIn(rows);
    return step(rows);
  } else {
    m_pairs = searchAll(rows);
  }
  m_isCalm = m_changes * kShareOfChanged <= rows.size() / 6;
  m_changes = 0;
  m_hasPairs.store(true, std::memory_order_release);
}

template <class T>
void RowSearch<T>::step(Span<const T> rows) const {
  m_pairs = m_world.step().pairs;
  m_isCalm = m_changes * kShareOfChanged <= rows.size() / 6;
  m_changes = 0;
  m_hasPairs.store(true, std::memory_order_release);
}

template <class T>
Span<const Pair> RowSearch<T>::searchAll(Span<const T> rows) const {
  if constexpr (std::is_same_v<T, float>) {
    return m_search.find(BoxView::fromRows(rows));
  } else {
    m_roundedRows.resize(rows.size());
    std::transform(rows.begin(), rows.end(), m_roundedRows.begin(), [](T bound) { return static_cast<float>(bound); });
    selectExact(m_search.find(BoxView::fromRows(Span<const float>(m_roundedRows))), rows, m_exact);
    return m_exact;
  }
}

template <class T>
Span<const Pair> RowSearch<T>::scanAll(Span<const T> rows) const {
  round(rows);
  m_exact.clear();
  for (BoxId i = 0; std::size_t{6} * i < rows.size(); ++i) {
    const T* const row = &rows[std::size_t{6} * i];
    if (row[0] > row[3]) continue;  // empty
    std::uint64_t found = m_rounded.mayOverlap(0, RoundedBoxes::rounded(row)) >> i >> 1U;
    for (; found != 0; found &= found - 1) {
      const BoxId other = i + 1 + static_cast<BoxId>(std::countr_zero(found));
      const T* const second = &rows[std::size_t{6} * other];
      if (second[0] <= second[3] && overlap(row, second)) m_exact.push_back({i, other});
    }
  }
  return m_exact;
}

template <class T>
void RowSearch<T>::bringIn(Span<const T> rows) const {
  const std::size_t known = m_world.idBound();
  m_ids.clear();
  m_moved.clear();
  const auto end = m_isPending.begin() + static_cast<std::ptrdiff_t>(std::min(known, m_isPending.size()));
  for (auto at = std::find(m_isPending.begin(), end, 1); at != end; at = std::find(at + 1, end, 1)) {
    m_ids.push_back(static_cast<BoxId>(at - m_isPending.begin()));
    const std::span<const T> row = rows.subspan(std::size_t{6} * m_ids.back(), 6);
    m_moved.insert(m_moved.end(), row.begin(), row.end());
  }
  m_world.move(m_ids, BoxView::fromRows(std::span<const T>(m_moved)));
  const BoxView fresh = BoxView::fromRows(rows.subspan(6 * known));
  m_ids.resize(fresh.size());
  m_world.add(fresh, {}, m_ids);  // none has ever been removed, so that they are the next ones
  std::fill(m_isPending.begin(), m_isPending.end(), std::uint8_t{0});
  m_pending = 0;
}

template class RowSearch<float>;
template class RowSearch<double>;

}  // namespace allpairs
