// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/math/bv/OBBRSS.h>

#include <array>
#include <cstdint>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/collision/Vec3.h"

namespace allpairs::exact {

using Point = ::fcl::Vector3d;
using Corners = std::array<Point, 3>;
using Hierarchy = ::fcl::BVHModel<::fcl::OBBRSSd>;

[[nodiscard]] inline Point toPoint(const collision::Vec3& v) { return {v[0], v[1], v[2]}; }
[[nodiscard]] inline collision::Vec3 toVec3(const Point& p) { return {p[0], p[1], p[2]}; }

/// An order of points, by x, then y, then z.
[[nodiscard]] inline bool isBefore(const Point& a, const Point& b) { return toVec3(a) < toVec3(b); }

/// Points to where the corners turn counterclockwise, as long as twice the area.
[[nodiscard]] inline Point normalOf(const Corners& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

/// The box widened to hold a point.
void include(Box& box, const Point& point);

/// What two boxes share.
[[nodiscard]] Box common(const Box& a, const Box& b);

/// How the triangles of a part tell inside from outside.
enum class Volume : std::uint8_t {
  None,     ///< They don't close.
  Winding,  ///< Each edge is passed as often one way as the other: what they wind around is inside.
  Parity,   ///< Each edge is shared by an even number: a ray from inside leaves through an odd number of triangles.
};

/// The triangles, by their numbers in ascending order, that a ray from inside leaves through.
struct Shell {
  Volume volume = Volume::None;
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> twoSided;  ///< Besides those of a winding: a surface that closes, whichever way it faces.
};

/// Triangles, segments (two corners the same) or points (all three) thickened by a radius, ready for FCL.
///
/// A ball is a thick point and a capsule a thick segment, so that one kind of query serves all shapes.
class ExactPart {
 public:
  ExactPart(std::vector<Corners> triangles, double radius);

  [[nodiscard]] const std::vector<Corners>& triangles() const { return m_triangles; }
  [[nodiscard]] const std::vector<Box>& triangleBoxes() const { return m_boxes; }
  [[nodiscard]] const Hierarchy& hierarchy() const { return m_hierarchy; }
  /// Around the triangles of a node of the hierarchy.
  [[nodiscard]] const Box& nodeBox(int node) const { return m_nodeBoxes[static_cast<std::size_t>(node)]; }
  [[nodiscard]] double radius() const { return m_radius; }
  [[nodiscard]] Volume volume() const { return m_shell.volume; }
  [[nodiscard]] const Shell& shell() const { return m_shell; }

  /// Whether it has triangles, and not only segments and points.
  [[nodiscard]] bool hasArea() const { return m_hasArea; }

  /// Whether it is a surface that may look closed and is not: nobody can tell what lies in it.
  [[nodiscard]] bool isOpen() const { return m_hasArea && m_radius == 0.0 && volume() == Volume::None; }

  /// Holds the triangles, radius not included.
  [[nodiscard]] const Box& box() const { return m_box; }

 private:
  void findNodeBoxes();
  void lookAtBothSides();

  std::vector<Corners> m_triangles;
  std::vector<Box> m_boxes;
  Hierarchy m_hierarchy;
  std::vector<Box> m_nodeBoxes;
  double m_radius;
  Shell m_shell;
  bool m_hasArea;
  Box m_box = kEmptyBox;
};

}  // namespace allpairs::exact
