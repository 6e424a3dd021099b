// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "CurveOrder.h"
#include "LaneReader.h"
#include "Memory.h"
#include "allpairs/Executor.h"

namespace allpairs::engine {

/// Makes the blocks of boxes that lie along a curve more compact: runs of the curve are cut in four along their longest
/// axis, each part by as many boxes as the next, and those again, down to blocks of sixteen.
///
/// A join then tests about half as many boxes as along the curve itself. An order that is used once isn't worth the
/// trouble; one that is kept is (docs/decisions/0007).
/// Reference: the cuts are those of S. Leutenegger, M. Lopez, J. Edgington, "STR: a simple and efficient algorithm for
///            R-tree packing", ICDE 1997, with the axis chosen anew for each.
class TightOrder {
 public:
  /// Orders the boxes anew within runs; keys stay sorted between the runs only.
  void tighten(std::span<KeyedBox> boxes, const LaneReader& reader, Executor& executor);

 private:
  struct Point {
    std::array<float, 3> centre;  ///< Half of it, so that no difference overflows.
    std::uint32_t id;
  };

  /// Orders the points, by way of as much spare memory.
  static void cut(std::span<Point> points, Point* spare);
  static void sortAlong(std::span<Point> points, Point* spare);

  Buffer<Point> m_points;
  Buffer<Point> m_spare;
};

}  // namespace allpairs::engine
