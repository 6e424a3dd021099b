// SPDX-License-Identifier: MIT
#include "allpairs/collision/TriangleModel.h"

namespace allpairs::collision {
namespace {

Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace

TriangleModel::TriangleModel(std::string name, std::vector<Vec3> positions, std::vector<Triangle> triangles,
                             const std::vector<Quad>& quads)
    : MeshModel(std::move(name), std::move(positions)), m_triangles(std::move(triangles)) {
  m_triangles.reserve(m_triangles.size() + 2 * quads.size());
  for (const Quad& quad : quads) {
    m_triangles.push_back({quad[0], quad[1], quad[2]});
    m_triangles.push_back({quad[0], quad[2], quad[3]});
  }
  for (std::size_t i = 0; i < m_triangles.size(); ++i) checkVertices(m_triangles[i], i);
}

void TriangleModel::setUseCurvature(bool useCurvature) {
  m_useCurvature = useCurvature;
  boundsChanged();
}

Span<const std::uint32_t> TriangleModel::verticesOf(std::size_t index, std::uint32_t& /*storage*/) const {
  return m_triangles[index];
}

Vec3 TriangleModel::normalAt(std::size_t index, double dt) const {
  const Triangle& triangle = m_triangles[index];
  const Vec3 origin = positionAt(triangle[0], dt);
  return cross(minus(positionAt(triangle[1], dt), origin), minus(positionAt(triangle[2], dt), origin));
}

NormalCone TriangleModel::elementCone(std::size_t index) const {
  return m_useCurvature ? NormalCone::of(normalAt(index, 0.0)) : NormalCone{};
}

NormalCone TriangleModel::elementSweptCone(std::size_t index, double dt) const {
  return m_useCurvature ? NormalCone::ofTurning(normalAt(index, 0.0), normalAt(index, dt)) : NormalCone{};
}

}  // namespace allpairs::collision
