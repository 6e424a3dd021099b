// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"
#include "allpairs/World.h"

namespace allpairs {

/// The overlapping pairs of boxes that lie in rows of six and change between searches, in whichever of two ways is the
/// faster: a world that knows the pairs of before, while few boxes change, else a search of all.
///
/// Geometry:  boxes are closed, in the precision of T. An empty box overlaps nothing; it has all minima at the greatest
///            finite number, all maxima at the least.
/// Bad input: a NaN throws InvalidBox.
/// Threads:   one call at a time per object; parallel inside when there is an executor.
template <class T>
class RowSearch {
 public:
  /// Pairs come ordered by (first, second) if that is asked for, else in an order that is the same each time.
  explicit RowSearch(Executor* executor, bool isOrdered);

  /// Removes all boxes.
  void clear();

  /// Marks a row as new or changed; for an unmarked row, its previous contents may be used.
  void note(BoxId row) {
    if (m_isPending.size() <= row) m_isPending.resize(std::size_t{row} + 1, 0);
    m_isPending[row] = 1;
    m_isBehind = true;
    ++m_changes;
  }

  /// All pairs, in which the first is the smaller number; valid until the next call of this after a change.
  [[nodiscard]] std::span<const Pair> pairs(std::span<const T> rows);

  /// The same boxes as a world, for queries; the numbers of rows are its ids.
  [[nodiscard]] World& world(std::span<const T> rows);

 private:
  [[nodiscard]] std::span<const Pair> searchAll(std::span<const T> rows);
  void bringIn(std::span<const T> rows);

  Executor* m_executor;
  OverlapSearch m_search;
  World m_world;

  std::vector<std::uint8_t> m_isPending;  ///< By row: whether the world hasn't heard of it as it is now.
  std::size_t m_changes = 0;              ///< How many there were since the last search.
  bool m_isCalm = false;                  ///< Whether there were few before that.
  bool m_isBehind = false;                ///< Whether the world may have something to hear.

  std::vector<float> m_rounded;
  std::vector<BoxId> m_ids;
  std::vector<T> m_moved;
  std::vector<Pair> m_exact;
  std::span<const Pair> m_pairs;
};

extern template class RowSearch<float>;
extern template class RowSearch<double>;

}  // namespace allpairs
