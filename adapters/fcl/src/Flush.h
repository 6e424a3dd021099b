// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "Deepest.h"
#include "ExactPart.h"

namespace allpairs::exact {

/// A place where triangles of two parts lie on each other, and the direction across them.
struct FlushPlace {
  Point point = Point::Zero();
  Point normal = Point::Zero();  ///< Length 1.
};

/// What lies on either side of such places: where one surface lies on the other, none of its points tells whether the
/// volumes share anything.
struct FlushSides {
  Deepest common;           ///< Of the points that both hold, the one deepest in both; `surface` is the nearer one's.
  bool isOfSecond = false;  ///< Whether that is the second's surface.
  bool isFirstOut = false;  ///< The first holds a point that lies outside of the second, by more than the tolerance.
  bool isSecondOut = false;
};

/// Looks halfway from each place to the next surface of either part, on both sides; of many, from some that lie far apart
/// or face different ways. Both parts enclose a volume.
[[nodiscard]] FlushSides lookBesideFlush(const ExactPart& first, const ExactPart& second,
                                         const std::vector<FlushPlace>& places, double tolerance);

}  // namespace allpairs::exact
