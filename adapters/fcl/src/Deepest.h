// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ExactPart.h"

namespace allpairs::exact {

/// The deepest point found of one part within another, and the nearest point of the other's surface.
struct Deepest {
  bool found = false;  ///< Whether any point lies within.
  double depth = 0.0;  ///< From point to surface, radii not included.
  Point point = Point::Zero();
  Point surface = Point::Zero();
};

/// A triangle of each of two parts that meet.
struct TrianglePair {
  std::size_t first = 0;
  std::size_t second = 0;
};

/// Looks for the deepest point of `inner` within `outer`, among the corners and middles of the parts of inner's
/// triangles that lie in outer's box, and in the boxes of the triangles of outer that they meet, and halfway between
/// those that cross one of them. Exact where a vertex or a flat face is deepest; elsewhere others may be deeper.
[[nodiscard]] Deepest deepestWithin(const ExactPart& outer, const ExactPart& inner,
                                    const std::vector<TrianglePair>& innerAndOuter);

}  // namespace allpairs::exact
