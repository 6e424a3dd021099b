// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ExactPart.h"

namespace allpairs::exact {

/// Faces that are flat in float32 are as flat as that.
inline constexpr double kSameAngle = 1e-6;

/// The directions in which two surfaces go on from a line that both have.
class Around {
 public:
  enum class Surface { First, Second };

  /// `along` has length 1; triangles that reach no further from the line than the tolerance do not go on.
  Around(const Point& middle, const Point& along, double tolerance);

  /// Adds a triangle that holds the line, on either side of which it may lie.
  void add(const Corners& corners, Surface surface);

  /// Whether one surface goes on between two ways of the other, and again between the two others: then they cross.
  [[nodiscard]] bool takeTurns();

 private:
  struct Way {
    double angle = 0.0;
    Surface surface = Surface::First;
  };

  [[nodiscard]] Point offLine(const Point& point) const;
  [[nodiscard]] bool isShared(const Way& way) const;
  void addWay(const Point& direction, Surface surface);

  Point m_middle;
  Point m_along;
  Point m_u;
  Point m_v;
  double m_tolerance;
  std::vector<Way> m_ways;
};

}  // namespace allpairs::exact
