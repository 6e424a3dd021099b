// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>
#ifdef __cpp_impl_three_way_comparison
#include <compare>
#endif

#include "allpairs/Box.h"
#include "allpairs/BoxView.h"
#include "allpairs/Filter.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Span.h"

namespace allpairs::partition {

using Point = std::array<double, 3>;

/// Two boxes by the caller's 64-bit ids.
struct IdPair {
  std::uint64_t first = 0;
  std::uint64_t second = 0;

#ifdef __cpp_impl_three_way_comparison
  friend constexpr auto operator<=>(const IdPair&, const IdPair&) = default;
#else
  friend constexpr bool operator==(const IdPair& a, const IdPair& b) {
    return a.first == b.first && a.second == b.second;
  }
  friend constexpr bool operator!=(const IdPair& a, const IdPair& b) { return !(a == b); }
  friend constexpr bool operator<(const IdPair& a, const IdPair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }
  friend constexpr bool operator>(const IdPair& a, const IdPair& b) { return b < a; }
  friend constexpr bool operator<=(const IdPair& a, const IdPair& b) { return !(b < a); }
  friend constexpr bool operator>=(const IdPair& a, const IdPair& b) { return !(a < b); }
#endif
};

/// A part of space: the points p with min[a] <= p[a] < max[a] on each axis. A max of infinity includes infinity, so
/// that cells which tile space hold every point once; a min that is not below its max holds none, at infinity too. The
/// default is all of space.
struct Cell {
  Point min{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};
  Point max{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};

  [[nodiscard]] constexpr bool holds(const Point& point) const noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool isBelow = point[axis] < max[axis] || max[axis] == std::numeric_limits<double>::infinity();
      if (!(min[axis] <= point[axis]) || !isBelow || min[axis] >= max[axis]) return false;
    }
    return true;
  }

  friend bool operator==(const Cell& a, const Cell& b) { return a.min == b.min && a.max == b.max; }
  friend bool operator!=(const Cell& a, const Cell& b) { return !(a == b); }
};

/// The point by which a pair belongs to a cell: on each axis the greater of the two minima. Of cells that tile space
/// exactly one holds it.
[[nodiscard]] constexpr Point pairPoint(const Box& a, const Box& b) noexcept {
  Point point{};
  for (std::size_t axis = 0; axis < 3; ++axis) point[axis] = a.min[axis] < b.min[axis] ? b.min[axis] : a.min[axis];
  return point;
}

/// Where the points of all pairs of a box lie: from its minimum to its maximum widened by the greatest distance at
/// which it can be in a pair. A box goes to each cell that this touches.
///
/// `maxMargin` is the greatest margin of any box that it may be paired with. Only sums that the test of a pair makes
/// itself are made, or greater ones, and rounding is monotonic: no pair is lost.
[[nodiscard]] inline Box reachOf(const Box& box, double margin = 0.0, double distance = 0.0,
                                 double maxMargin = 0.0) noexcept {
  if (isEmpty(box)) return kEmptyBox;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double asFirst = (distance + margin) + maxMargin;
  const double asSecond = (distance + maxMargin) + margin;
  double widening = asFirst < asSecond ? asSecond : asFirst;
  // A NaN is the sum of infinities, of which a lesser margin than the greatest may make any number.
  if (asFirst != asFirst || asSecond != asSecond) widening = kInfinity;
  Box reach = box;
  for (double& max : reach.max) {
    // To infinity also from -infinity, where the sum would be NaN.
    const double widened = widening == kInfinity ? widening : max + widening;
    if (max < widened) max = widened;
  }
  return reach;
}

/// Whether a reach has points in the cell. An empty box touches none.
[[nodiscard]] bool touches(const Cell& cell, const Box& reach) noexcept;

/// Searches the boxes of one cell after the other, and keeps its working memory in between.
///
/// A pair belongs to the cell that holds its pairPoint(). Cells that tile space, each searched with the boxes whose
/// reach touches it, give every pair exactly once, however space is cut.
///
/// Options:   order and maxPairs are those of the pairs of a cell, distance and filter as in OverlapSearch; `first` and
///            `second` of a filter, and the numbers that `accept` receives, are indices into the given boxes.
/// Bad input: as OverlapSearch; a cell with a NaN throws InvalidArgument; one with min >= max on an axis has no pairs.
///            A call by the search's own filter, visitor, stop or task throws InvalidArgument.
/// Threads:   one search at a time per object.
class CellSearch {
 public:
  explicit CellSearch(OverlapOptions options = {});
  ~CellSearch();
  CellSearch(CellSearch&&) noexcept;
  CellSearch& operator=(CellSearch&&) noexcept;

  /// Another filter for the searches that follow.
  void setFilter(Filter filter);

  /// Passes the pairs that belong to the cell to the visitor, by index into the given boxes, in batches and in bounded
  /// memory: at most as many at once as OverlapSearch::stream() passes.
  void stream(const BoxView& boxes, const Cell& cell, PairVisitor visitor);
  void stream(const BoxView& first, const BoxView& second, const Cell& cell, PairVisitor visitor);

  /// The pairs that belong to the cell, all at once, in the order of the options. Valid until the next search.
  ///
  /// Cost: memory for the pairs of the given boxes, those of other cells too, but never for more than maxPairs.
  [[nodiscard]] Span<const Pair> find(const BoxView& boxes, const Cell& cell);
  [[nodiscard]] Span<const Pair> find(const BoxView& first, const BoxView& second, const Cell& cell);

 private:
  struct State;
  State& state();
  std::unique_ptr<State> m_state;  ///< Null in an object that has been moved from, which is used as a new one.
};

/// The pairs among the boxes of a set that belong to the cell, by the boxes' ids: first < second.
///
/// `boxes` are those whose reach touches the cell; more do no harm.
/// Bad input: as overlaps(); ids of another number than boxes, or one id of two boxes that are a pair, throw
///            InvalidArgument. So do ids that do not ascend, of boxes whose margins differ: those of a pair are added
///            up in that order.
[[nodiscard]] std::vector<IdPair> overlapsInCell(const BoxView& boxes, Span<const std::uint64_t> ids, const Cell& cell,
                                                 const OverlapOptions& options = {});

/// The pairs of a box of `first` and a box of `second` that belong to the cell.
[[nodiscard]] std::vector<IdPair> overlapsInCell(const BoxView& first, Span<const std::uint64_t> firstIds,
                                                 const BoxView& second, Span<const std::uint64_t> secondIds,
                                                 const Cell& cell, const OverlapOptions& options = {});

/// The number of pairs of overlapsInCell(), of boxes in the order of their ids.
[[nodiscard]] std::uint64_t countOverlapsInCell(const BoxView& boxes, const Cell& cell,
                                                const OverlapOptions& options = {});
[[nodiscard]] std::uint64_t countOverlapsInCell(const BoxView& first, const BoxView& second, const Cell& cell,
                                                const OverlapOptions& options = {});

}  // namespace allpairs::partition
