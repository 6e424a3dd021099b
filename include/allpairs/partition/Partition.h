// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/BoxView.h"
#include "allpairs/Span.h"
#include "allpairs/StopFlag.h"
#include "allpairs/partition/Cell.h"

namespace allpairs::partition {

/// One cut of a partition: points below `at` on the axis are on its low side, all others on its high side. A side is
/// another cut, by index, or a cell: the complement (~) of its number.
struct Cut {
  double at = 0.0;
  std::uint32_t axis = 0;
  std::int32_t low = 0;
  std::int32_t high = 0;

  friend bool operator==(const Cut& a, const Cut& b) {
    return a.at == b.at && a.axis == b.axis && a.low == b.low && a.high == b.high;
  }
  friend bool operator!=(const Cut& a, const Cut& b) { return !(a == b); }
};

/// A cell that is to be cut again, into about so many parts.
struct CellToCut {
  std::size_t number = 0;
  std::size_t parts = 2;
};

/// Cells that tile space, made by cutting it in two again and again where a sample of boxes says so.
///
/// Threads: const use from any number of threads.
class Partition {
 public:
  /// One cell: all of space.
  Partition() = default;

  /// About `cells` cells of about as many boxes each. Each cut is at a minimum of a box, on the axis on which the
  /// fewest boxes lie on both sides; what no cut divides stays one cell.
  ///
  /// The sample stands for all boxes: some hundred for each cell suffice. Its margins count.
  /// Bad input: a distance that is NaN or -infinity throws InvalidArgument.
  /// Cost: O(s log(cells)) for a sample of s boxes. If `stop` is given, it throws Stopped soon after this is set.
  Partition(const BoxView& sample, std::size_t cells, double distance = 0.0, const StopFlag* stop = nullptr);

  /// The partition that has these cuts.
  ///
  /// Bad input: cuts that are no tree, or a cut that is not at a number, throw InvalidArgument.
  [[nodiscard]] static Partition fromCuts(Span<const Cut> cuts);

  [[nodiscard]] Span<const Cut> cuts() const noexcept { return m_cuts; }

  /// The number of cells, at least 1.
  [[nodiscard]] std::size_t size() const noexcept { return m_cuts.size() + 1; }

  /// The bounds of a cell; what cellsOf() says agrees with them.
  ///
  /// Bad input: a number that no cell has throws InvalidArgument.
  /// Cost: O(cells).
  [[nodiscard]] Cell cell(std::size_t number) const;

  /// The bounds of all cells, by number.
  ///
  /// Cost: O(cells).
  [[nodiscard]] std::vector<Cell> cells() const;

  /// Whether a box that goes to so many cells is better kept apart than copied to each: more than 16, and more than a
  /// fourth of all.
  [[nodiscard]] bool isWide(std::size_t reached) const noexcept { return reached > 16 && reached > size() / 4; }

  /// The cell that holds a point.
  [[nodiscard]] std::uint32_t cellOf(const Point& point) const noexcept;

  /// Replaces `cells` by the numbers of all cells that a reach (see reachOf()) touches; none if it is empty.
  void cellsOf(const Box& reach, std::vector<std::uint32_t>& cells) const;

  /// Calls `visit(i, cells)` for each of so many boxes, in order, with the numbers of all cells that `reachOf(i)`
  /// touches, as a span. Of boxes that are mostly in one cell each, it takes a quarter of cellsOf().
  template <class ReachOf, class Visit>
  void visitCells(std::size_t boxes, const ReachOf& reachOf, const Visit& visit) const {
    std::vector<Box> reaches;
    std::vector<std::uint32_t> sole;
    std::vector<std::uint32_t> several;
    for (std::size_t begin = 0; begin < boxes; begin += kTogether) {
      const std::size_t end = boxes - begin < kTogether ? boxes : begin + kTogether;
      reaches.clear();
      for (std::size_t i = begin; i < end; ++i) reaches.push_back(reachOf(i));
      findSoleCells(reaches, sole);
      for (std::size_t i = begin; i < end; ++i) {
        if (sole[i - begin] != kNoSoleCell) {
          visit(i, Span<const std::uint32_t>(&sole[i - begin], 1));
        } else {
          cellsOf(reaches[i - begin], several);
          visit(i, Span<const std::uint32_t>(several));
        }
      }
    }
  }

  /// Cuts one cell again, into about `parts`; the new cells are numbered after all others. Returns whether a cut
  /// divides the boxes of the sample that touch it.
  bool cutAgain(std::size_t number, const BoxView& sample, std::size_t parts, double distance = 0.0);

  /// The same of several cells. Returns whether any is cut.
  ///
  /// Bad input: a number that no cell has, or that is given twice, throws InvalidArgument.
  /// Cost: O(s log(cells)) for a sample of s boxes that are in few cells, however many are cut.
  bool cutAgain(Span<const CellToCut> given, const BoxView& sample, double distance = 0.0);

 private:
  class Cutter;

  static constexpr std::size_t kTogether = 2048;  // reaches, which the cache of a core holds
  static constexpr std::uint32_t kNoSoleCell = std::numeric_limits<std::uint32_t>::max();

  void findSoleCells(const std::vector<Box>& reaches, std::vector<std::uint32_t>& cells) const;
  void addCells(std::int32_t side, const Box& reach, std::vector<std::uint32_t>& cells) const;

  std::vector<Cut> m_cuts;
};

/// How many boxes of a cell a search on several ranks would like: they stay in the cache of a core.
inline constexpr std::size_t kBoxesPerCell = std::size_t{1} << 18;

/// Into how many cells a search on several ranks cuts space: at least 8 for each rank, so that work can be dealt out
/// evenly; as many as cells of `boxesPerCell` boxes take, but no more than 32 for each rank, since one rank makes the
/// cuts; and in any case so many that none has much more than 16 times `boxesPerCell`: a rank holds one at a time.
[[nodiscard]] std::size_t cellsOnRanks(std::uint64_t boxes, std::size_t ranks,
                                       std::size_t boxesPerCell = kBoxesPerCell) noexcept;

/// A cell of no more boxes is no burden to a rank, though nothing divides it.
inline constexpr std::uint64_t kLeastCrowded = std::uint64_t{1} << 16;

/// The most boxes of a cell that a search on several ranks leaves to one of them: its share of all. Those of a cell
/// with more are sent to all ranks, as wide boxes are.
[[nodiscard]] std::uint64_t mostInCellOnRanks(std::uint64_t boxes, std::size_t ranks,
                                              std::uint64_t least = kLeastCrowded) noexcept;

/// The greatest margin of a box; -infinity if there is none.
[[nodiscard]] double greatestMargin(const BoxView& boxes) noexcept;

/// How many of the boxes go to each cell: the copies that a partition makes are the sum less their number.
///
/// `maxMargin` is the greatest margin of any box that they may be paired with. The boxes' own are taken for some of
/// these, so that of one of two sets, whose boxes are not paired with each other, more may be counted than have to go
/// there.
[[nodiscard]] std::vector<std::uint64_t> boxesPerCell(const Partition& partition, const BoxView& boxes,
                                                      double distance = 0.0, double maxMargin = 0.0);

}  // namespace allpairs::partition
