// SPDX-License-Identifier: MIT
#include "Nearest.h"

#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "PointTriangle.h"

namespace allpairs::exact {
namespace {

/// No less than this lies between a point and what a node of a hierarchy holds, but for rounding.
double limitOf(const ::fcl::OBBd& box, const Point& point) {
  const Point local = box.axis.transpose() * (point - box.To);
  return (local.cwiseAbs() - box.extent).cwiseMax(0.0).norm();
}

/// Looks for the triangle that is nearest to a point, the nearer part of a node first.
class PointSearch {
 public:
  PointSearch(const ExactPart& part, const Point& point)
      : m_part(part), m_point(point), m_scaled(point * kHierarchyScale) {}

  Nearest take() {
    m_nearest.distance = std::numeric_limits<double>::infinity();
    m_nearest.onSecond = m_point;
    open(0);
    while (!m_open.empty()) {
      const Node node = m_open.back();
      m_open.pop_back();
      if (node.limit < m_nearest.distance) look(node.number);
    }
    return m_nearest;
  }

 private:
  struct Node {
    double limit = 0.0;
    int number = 0;
  };

  void look(int number) {
    const auto& node = m_part.hierarchy().getBV(number);
    if (node.isLeaf()) return measure(node.primitiveId());
    open(node.leftChild());
    open(node.rightChild());
    const std::size_t last = m_open.size() - 1;
    if (m_open[last - 1].limit < m_open[last].limit) std::swap(m_open[last - 1], m_open[last]);
  }

  void open(int number) {
    constexpr double kSlack = 1.0 - 1e-12;  // a box may be too small by its rounding
    const double limit = limitOf(m_part.hierarchy().getBV(number).bv.obb, m_scaled);
    m_open.push_back({limit / kHierarchyScale * kSlack, number});
  }

  void measure(int triangle) {
    const Point onTriangle = nearestPoint(m_part.triangles()[static_cast<std::size_t>(triangle)], m_point);
    const double distance = (onTriangle - m_point).norm();
    if (distance >= m_nearest.distance) return;
    m_nearest.distance = distance;
    m_nearest.onFirst = onTriangle;
    m_nearest.triangle = triangle;
  }

  const ExactPart& m_part;
  Point m_point;
  Point m_scaled;
  std::vector<Node> m_open;
  Nearest m_nearest;
};

}  // namespace

Nearest nearest(const ExactPart& first, const ExactPart& second) {
  const ::fcl::Transform3d here = ::fcl::Transform3d::Identity();
  const ::fcl::DistanceRequestd request(true);
  ::fcl::DistanceResultd result;
  const double distance = ::fcl::distance(&first.hierarchy(), here, &second.hierarchy(), here, request, result);
  return {.distance = std::max(0.0, distance) / kHierarchyScale,
          .onFirst = result.nearest_points[0] / kHierarchyScale,
          .onSecond = result.nearest_points[1] / kHierarchyScale,
          .triangle = std::ptrdiff_t{result.b1}};
}

Nearest nearest(const ExactPart& part, const Point& point) { return PointSearch(part, point).take(); }

}  // namespace allpairs::exact
