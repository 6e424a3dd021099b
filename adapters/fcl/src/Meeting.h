// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ExactPart.h"

namespace allpairs::exact {

/// Two parts, looked at closely.
struct Meeting {
  bool surfacesMeet = false;    ///< They are no further apart than the tolerance.
  bool isDeep = false;          ///< One reaches into the other by more than the tolerance.
  bool isCrossed = false;       ///< The surfaces pass through each other, whether they are closed or not.
  bool isFirstWithin = false;   ///< It reaches into the second, and no part of it out of the second.
  bool isSecondWithin = false;  ///< The same of the second.
  bool hasVolume = false;       ///< One of them is thick or encloses a volume, so that depth is defined.
  double distance = 0.0;        ///< Between the surfaces, 0 where they meet or one is within the other.
  double depth = 0.0;
  Point onFirst = Point::Zero();
  Point onSecond = Point::Zero();
  Point normal = Point::Zero();  ///< Unit; the way that parts the first from the second.
  std::uint64_t contactCount = 0;
  std::vector<Point> contactPoints;                ///< All of them.
  std::vector<std::array<Point, 2>> contactLines;  ///< Where triangles cross, all of them.
};

/// Surfaces that are no further apart meet, and those that reach deeper overlap; and what sticks out of a part, or is
/// missing from it, by no more than `same` is as good as within, or there.
struct Tolerances {
  double meeting = 0.0;
  double same = 0.0;
};

/// Looks closely at two parts.
[[nodiscard]] Meeting meet(const ExactPart& first, const ExactPart& second, const Tolerances& tolerances);

/// No less than this lies between two parts.
[[nodiscard]] double boxDistance(const ExactPart& first, const ExactPart& second);

}  // namespace allpairs::exact
