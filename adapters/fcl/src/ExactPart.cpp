// SPDX-License-Identifier: MIT
#include "ExactPart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "Inside.h"
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

/// A triangle as the least of its corners and the two others in ascending order, and which way it faces.
struct Facing {
  std::array<collision::Vec3, 3> points{};
  int way = 0;
  std::uint32_t triangle = 0;
};

Facing facingOf(const Corners& corners, std::uint32_t triangle) {
  std::array<collision::Vec3, 3> points{toVec3(corners[0]), toVec3(corners[1]), toVec3(corners[2])};
  std::rotate(points.begin(), std::min_element(points.begin(), points.end()), points.end());
  const bool isTurned = points[2] < points[1];
  if (isTurned) std::swap(points[1], points[2]);
  return {points, isTurned ? -1 : 1, triangle};
}

std::vector<Corners> chosen(const std::vector<Corners>& triangles, const std::vector<std::uint32_t>& numbers) {
  std::vector<Corners> result;
  for (const std::uint32_t number : numbers) result.push_back(triangles[number]);
  return result;
}

/// Puts one of each two triangles that are the same but for the way they face apart.
Shell split(const std::vector<Corners>& triangles, const std::vector<std::uint32_t>& numbers) {
  std::vector<Facing> facings;
  for (const std::uint32_t number : numbers) facings.push_back(facingOf(triangles[number], number));
  std::sort(facings.begin(), facings.end(), [](const Facing& a, const Facing& b) { return a.points < b.points; });
  Shell shell;
  std::vector<std::uint32_t> ways[2];
  for (std::size_t begin = 0, end = 0; begin < facings.size(); begin = end) {
    for (std::vector<std::uint32_t>& way : ways) way.clear();
    for (; end < facings.size() && facings[end].points == facings[begin].points; ++end) {
      ways[facings[end].way > 0 ? 1 : 0].push_back(facings[end].triangle);
    }
    const std::size_t both = std::min(ways[0].size(), ways[1].size());
    shell.twoSided.insert(shell.twoSided.end(), ways[0].begin(), ways[0].begin() + static_cast<std::ptrdiff_t>(both));
    for (const std::vector<std::uint32_t>& way : ways) {
      shell.triangles.insert(shell.triangles.end(), way.begin() + static_cast<std::ptrdiff_t>(both), way.end());
    }
  }
  return shell;
}

/// Some programs write each triangle for either side: then one of the two is the mesh, and the way it faces means
/// nothing.
Shell shellOf(const std::vector<Corners>& triangles) {
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (isTriangle(triangles[i])) all.push_back(i);
  }
  const Volume volume = volumeOf(triangles);
  if (volume != Volume::Winding) return {.volume = volume, .triangles = std::move(all), .twoSided = {}};
  Shell shell = split(triangles, all);
  shell.volume = Volume::Winding;
  const bool isClosed = volumeOf(chosen(triangles, shell.twoSided)) != Volume::None;
  if (shell.triangles.empty()) {
    std::sort(shell.twoSided.begin(), shell.twoSided.end());
    return {.volume = isClosed ? Volume::Parity : Volume::None, .triangles = std::move(shell.twoSided), .twoSided = {}};
  }
  std::sort(shell.triangles.begin(), shell.triangles.end());
  std::sort(shell.twoSided.begin(), shell.twoSided.end());
  if (!isClosed) shell.twoSided.clear();  // fins, and walls between solids of one part
  return shell;
}

/// Whether what faces one way takes away what faces the other.
bool isWithoutVolume(const std::vector<Corners>& triangles, const Box& box) {
  const Point origin = toPoint(box.min);
  double sum = 0.0;
  double area = 0.0;
  for (const Corners& corners : triangles) {
    const Point normal = normalOf(corners);
    sum += normal.dot(corners[0] - origin);
    area += normal.norm();
  }
  return std::abs(sum) <= 1e-9 * area * (toPoint(box.max) - origin).norm();
}

/// Points close to triangles, on either side.
std::vector<Point> besideTriangles(const std::vector<Corners>& triangles) {
  constexpr std::size_t kMost = 16;
  constexpr double kOff = 1e-6;  // of the size of a triangle: within a thin plate too
  std::vector<Point> points;
  const std::size_t stride = triangles.size() / kMost + 1;
  for (std::size_t i = 0; i < triangles.size(); i += stride) {
    const auto& [a, b, c] = triangles[i];
    const Point normal = normalOf(triangles[i]);
    const double length = normal.norm();
    if (length == 0.0) continue;
    for (const double side : {-kOff, kOff}) points.push_back((a + b + c) / 3.0 + side / std::sqrt(length) * normal);
  }
  return points;
}

Box boxOf(const Corners& corners) {
  Box box = kEmptyBox;
  for (const Point& corner : corners) include(box, corner);
  return box;
}

void build(Hierarchy& hierarchy, const std::vector<Corners>& triangles) {
  constexpr std::size_t kMostTriangles = std::numeric_limits<int>::max() / 3;  // FCL counts corners in an int
  if (triangles.size() > kMostTriangles) {
    throw InvalidArgument("an exact test of a model of " + std::to_string(triangles.size()) + " triangles: at most " +
                          std::to_string(kMostTriangles) + " are possible");
  }
  const int count = static_cast<int>(triangles.size());
  int problem = hierarchy.beginModel(count, 3 * count);
  for (const Corners& corners : triangles) {
    if (problem == ::fcl::BVH_OK) problem = hierarchy.addTriangle(corners[0], corners[1], corners[2]);
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

Box common(const Box& a, const Box& b) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::max(a.min[axis], b.min[axis]);
    box.max[axis] = std::min(a.max[axis], b.max[axis]);
  }
  return box;
}

ExactPart::ExactPart(std::vector<Corners> triangles, double radius)
    : m_triangles(std::move(triangles)),
      m_radius(radius),
      m_shell(shellOf(m_triangles)),
      m_hasArea(std::any_of(m_triangles.begin(), m_triangles.end(), isTriangle)) {
  build(m_hierarchy, m_triangles);
  m_boxes.reserve(m_triangles.size());
  for (const Corners& corners : m_triangles) {
    m_boxes.push_back(boxOf(corners));
    m_box = merge(m_box, m_boxes.back());
  }
  findNodeBoxes();
  if (m_shell.volume == Volume::Winding && isWithoutVolume(m_triangles, m_box)) lookAtBothSides();
}

/// The children of a node have greater numbers.
void ExactPart::findNodeBoxes() {
  m_nodeBoxes.assign(static_cast<std::size_t>(m_hierarchy.getNumBVs()), kEmptyBox);
  for (int i = m_hierarchy.getNumBVs(); i-- > 0;) {
    const auto& node = m_hierarchy.getBV(i);
    m_nodeBoxes[static_cast<std::size_t>(i)] = node.isLeaf()
                                                   ? m_boxes[static_cast<std::size_t>(node.primitiveId())]
                                                   : merge(nodeBox(node.leftChild()), nodeBox(node.rightChild()));
  }
}

/// What is drawn for either side with other triangles is a surface, of which nobody can tell the inside; a part and its
/// mirror image have an inside, and no volume in sum either.
void ExactPart::lookAtBothSides() {
  const std::vector<Point> points = besideTriangles(m_triangles);
  if (4 * pointsInside(*this, points).size() <= points.size()) m_shell.volume = Volume::None;
}

}  // namespace allpairs::exact
