// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "ExactPart.h"

namespace allpairs::exact {

/// A triangle cut by planes: up to a corner more for each cut.
class Polygon {
 public:
  explicit Polygon(const Corners& corners);

  /// Keeps what lies where normal . p <= offset.
  void cut(const Point& normal, double offset);

  /// Keeps what lies in the box.
  void cut(const Box& box);

  [[nodiscard]] std::span<const Point> corners() const { return {m_corners.data(), m_count}; }
  [[nodiscard]] bool empty() const { return m_count == 0; }

  /// The mean of the corners.
  [[nodiscard]] Point middle() const;

 private:
  static constexpr std::size_t kMostCorners = 9;  // a triangle and six cuts

  void append(const Point& point);

  std::array<Point, kMostCorners> m_corners;
  std::size_t m_count = 3;
};

}  // namespace allpairs::exact
