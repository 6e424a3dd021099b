// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"
#include "allpairs/Span.h"
#include "allpairs/World.h"
#include "allpairs/objects/RoundedBoxes.h"

namespace allpairs {

/// Searches of boxes that lie in rows of six and change between searches. What a search needs is made when it is asked
/// for: of few rows or a few times the rows are scanned, else a world is brought up to date.
///
/// Geometry:  boxes are closed, in the precision of T. An empty box overlaps nothing; it has all minima at the greatest
///            finite number, all maxima at the least.
/// Bad input: a NaN throws InvalidBox.
/// Threads:   const members may be called concurrently while no other member runs, with the same rows; all others one
///            at a time. Parallel inside when there is an executor.
template <class T>
class RowSearch {
 public:
  /// Pairs come ordered by (first, second) if that is asked for, else in an order that is the same each time.
  explicit RowSearch(Executor* executor, bool isOrdered);

  /// Removes all boxes.
  void clear();

  /// Makes room for so many rows: note() of these needs no memory.
  void reserve(std::size_t rows) {
    if (m_isPending.size() < rows) m_isPending.resize(rows, 0);
    m_rounded.reserve(rows);
  }

  /// Marks a row as new or changed; for an unmarked row, its previous contents may be used.
  void note(BoxId row) {
    constexpr auto kRelaxed = std::memory_order_relaxed;
    if (m_hasPairs.load(kRelaxed) || m_hasWorld.load(kRelaxed) || m_scanned.load(kRelaxed) != 0) beginChange();
    if (m_isPending.size() <= row) m_isPending.resize(std::size_t{row} + 1, 0);
    if (m_isPending[row] == 0) m_pending.store(m_pending.load(kRelaxed) + 1, kRelaxed);
    m_isPending[row] = 1;
    ++m_changes;
    m_isRounded.store(false, kRelaxed);
    m_changedBegin = std::min(m_changedBegin, row);
    m_changedEnd = std::max(m_changedEnd, row + 1);
  }

  /// All pairs, in which the first is the smaller number; valid until the next note() or clear().
  [[nodiscard]] Span<const Pair> pairs(Span<const T> rows) const;

  /// The same boxes as a world, for queries; the numbers of rows are its ids.
  [[nodiscard]] const World& world(Span<const T> rows) const;

  /// The same for one query, or null where a scan of all rows is the faster: few of them, or few queries since many
  /// have changed.
  [[nodiscard]] const World* worldForQuery(Span<const T> rows) const {
    return rows.size() <= 6 * kFewForQueries ? nullptr : worldForMany(rows);
  }

  /// All rows that have been noted, to be compared with a box; those behind them are empty.
  [[nodiscard]] const RoundedBoxes& rounded(Span<const T> rows) const;

  /// Whether a comparison of each row with each of another search is faster than their worlds.
  [[nodiscard]] bool isFasterByScans(Span<const T> rows, std::size_t others) const;

 private:
  /// Up to so many rows, a scan of all is always as fast as a query of a world: measured with boxes that overlap 1 or 2
  /// of 100 to 400 others.
  static constexpr std::size_t kFewForQueries = 128;

  [[nodiscard]] const World* worldForMany(Span<const T> rows) const;
  void beginChange();
  void round(Span<const T> rows) const;
  void find(Span<const T> rows) const;
  void step(Span<const T> rows) const;
  [[nodiscard]] Span<const Pair> searchAll(Span<const T> rows) const;
  [[nodiscard]] Span<const Pair> scanAll(Span<const T> rows) const;
  void bringIn(Span<const T> rows) const;
  [[nodiscard]] bool isCalmAgain(Span<const T> rows) const;

  Executor* m_executor;

  // Const members make what they need under the lock, once after each change, and publish it by the three marks.
  mutable std::mutex m_making;
  mutable std::atomic<bool> m_hasPairs = false;    ///< m_pairs are those of the rows as they are.
  mutable std::atomic<bool> m_hasWorld = false;    ///< The world has heard of all rows as they are.
  mutable std::atomic<bool> m_isRounded = true;    ///< m_rounded are the rows as they are.
  mutable std::atomic<std::size_t> m_scanned = 0;  ///< Rows that queries have compared since the last change.

  mutable OverlapSearch m_search;
  mutable World m_world;
  mutable std::vector<std::uint8_t> m_isPending;   ///< By row: whether the world hasn't heard of it as it is now.
  mutable std::atomic<std::size_t> m_pending = 0;  ///< How many of them there are.
  mutable std::size_t m_changes = 0;               ///< How many there were since the last search for pairs.
  mutable bool m_isCalm = false;                   ///< Whether there were few before that.
  bool m_wantsPairs = false;                       ///< Whether anybody asked for pairs before the last change.

  mutable RoundedBoxes m_rounded;
  mutable BoxId m_changedBegin = kNoBox;  ///< No row outside of these differs from m_rounded.
  mutable BoxId m_changedEnd = 0;
  mutable std::vector<float> m_roundedRows;
  mutable std::vector<BoxId> m_ids;
  mutable std::vector<T> m_moved;
  mutable std::vector<Pair> m_exact;
  mutable Span<const Pair> m_pairs;
};

extern template class RowSearch<float>;
extern template class RowSearch<double>;

}  // namespace allpairs
