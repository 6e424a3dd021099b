// SPDX-License-Identifier: MIT
#include "ExactPart.h"

#include <algorithm>
#include <new>
#include <string>
#include <utility>

#include "allpairs/Error.h"

namespace allpairs::exact {
namespace {

/// An edge of a triangle, by its points in ascending order, and which way the triangle passes it: 1 or -1.
struct Passage {
  std::array<collision::Vec3, 2> points{};
  int direction = 0;
};

/// Corners are the same point if their coordinates are the same: many formats repeat a vertex for each triangle.
void addEdges(const Corners& triangle, std::vector<Passage>& edges) {
  for (std::size_t i = 0; i < 3; ++i) {
    const collision::Vec3 from = toVec3(triangle[i]);
    const collision::Vec3 to = toVec3(triangle[(i + 1) % 3]);
    edges.push_back(from < to ? Passage{{from, to}, 1} : Passage{{to, from}, -1});
  }
}

/// What edges say that lie sorted by their points.
Volume volumeOf(const std::vector<Passage>& edges) {
  bool isBalanced = !edges.empty();
  bool isEven = !edges.empty();
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    int balance = 0;
    for (; end < edges.size() && edges[end].points == edges[begin].points; ++end) balance += edges[end].direction;
    isBalanced = isBalanced && balance == 0;
    isEven = isEven && (end - begin) % 2 == 0;
  }
  if (isBalanced) return Volume::Winding;
  return isEven ? Volume::Parity : Volume::None;
}

bool isTriangle(const Corners& corners) {
  return corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
}

/// Segments and points, and triangles without an area between others, close nothing and open nothing.
Volume volumeOf(const std::vector<Corners>& triangles) {
  std::vector<Passage> edges;
  for (const Corners& corners : triangles) {
    if (isTriangle(corners)) addEdges(corners, edges);
  }
  std::sort(edges.begin(), edges.end(), [](const Passage& a, const Passage& b) { return a.points < b.points; });
  return volumeOf(edges);
}

Box boxOf(const Corners& corners) {
  Box box = kEmptyBox;
  for (const Point& corner : corners) include(box, corner);
  return box;
}

void build(Hierarchy& hierarchy, const std::vector<Corners>& triangles) {
  const int count = static_cast<int>(triangles.size());
  int problem = hierarchy.beginModel(count, 3 * count);
  for (const Corners& corners : triangles) {
    if (problem != ::fcl::BVH_OK) break;
    problem =
        hierarchy.addTriangle(corners[0] * kHierarchyScale, corners[1] * kHierarchyScale, corners[2] * kHierarchyScale);
  }
  if (problem == ::fcl::BVH_OK) problem = hierarchy.endModel();
  if (problem == ::fcl::BVH_ERR_MODEL_OUT_OF_MEMORY) throw std::bad_alloc();
  if (problem != ::fcl::BVH_OK) throw Error("FCL can't build a hierarchy: its error " + std::to_string(problem));
}

}  // namespace

void include(Box& box, const Point& point) {
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    box.min[a] = std::min(box.min[a], point[axis]);
    box.max[a] = std::max(box.max[a], point[axis]);
  }
}

ExactPart::ExactPart(std::vector<Corners> triangles, double radius)
    : m_triangles(std::move(triangles)),
      m_radius(radius),
      m_volume(volumeOf(m_triangles)),
      m_hasArea(std::any_of(m_triangles.begin(), m_triangles.end(), isTriangle)) {
  build(m_hierarchy, m_triangles);
  m_boxes.reserve(m_triangles.size());
  for (const Corners& corners : m_triangles) {
    m_boxes.push_back(boxOf(corners));
    m_box = merge(m_box, m_boxes.back());
  }
}

}  // namespace allpairs::exact
