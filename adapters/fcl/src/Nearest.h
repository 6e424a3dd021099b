// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "ExactPart.h"

namespace allpairs::exact {

/// Where two parts, or a part and a point, are nearest to each other, radii not included.
struct Nearest {
  double distance = 0.0;
  Point onFirst = Point::Zero();
  Point onSecond = Point::Zero();
  std::ptrdiff_t triangle = -1;  ///< The first's, below 0 where that is not told.
};

[[nodiscard]] Nearest nearest(const ExactPart& first, const ExactPart& second);
[[nodiscard]] Nearest nearest(const ExactPart& part, const Point& point);

/// How far two boxes are apart.
[[nodiscard]] double boxGap(const Box& first, const Box& second);

}  // namespace allpairs::exact
