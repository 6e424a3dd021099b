// SPDX-License-Identifier: MIT
#include "allpairs/collision/MeshModel.h"

#include <algorithm>

#include "Validate.h"

namespace allpairs::collision {
namespace {

void include(Box& box, const Vec3& point, double margin) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min(box.min[axis], point[axis] - margin);
    box.max[axis] = std::max(box.max[axis], point[axis] + margin);
  }
}

}  // namespace

MeshModel::MeshModel(std::string name, std::vector<Vec3> positions)
    : CollisionModel(std::move(name)), m_positions(std::move(positions)) {
  if (m_positions.size() > UINT32_MAX) throw InvalidArgument(describe() + ": more points than 32 bits can number");
  checkFinite(*this, "point", m_positions);
}

void MeshModel::setPositions(std::vector<Vec3> positions) {
  checkLength(*this, "positions", positions.size(), m_positions.size());
  checkFinite(*this, "point", positions);
  m_positions = std::move(positions);
  boundsChanged();
}

void MeshModel::setVelocities(std::vector<Vec3> velocities) {
  if (!velocities.empty()) checkLength(*this, "velocities", velocities.size(), m_positions.size());
  checkFinite(*this, "velocity", velocities);
  m_velocities = std::move(velocities);
  boundsChanged();
}

Vec3 MeshModel::positionAt(std::uint32_t vertex, double dt) const {
  Vec3 point = m_positions[vertex];
  if (m_velocities.empty()) return point;
  for (std::size_t axis = 0; axis < 3; ++axis) point[axis] += dt * m_velocities[vertex][axis];
  return point;
}

Box MeshModel::elementBox(std::size_t index) const {
  std::uint32_t storage = 0;
  Box box = kEmptyBox;
  for (const std::uint32_t vertex : verticesOf(index, storage)) include(box, m_positions[vertex], margin());
  return box;
}

Box MeshModel::elementSweptBox(std::size_t index, double dt) const {
  std::uint32_t storage = 0;
  Box end = kEmptyBox;
  for (const std::uint32_t vertex : verticesOf(index, storage)) include(end, positionAt(vertex, dt), margin());
  return allpairs::merge(elementBox(index), end);
}

void MeshModel::checkVertices(Span<const std::uint32_t> vertices, std::size_t element) const {
  for (const std::uint32_t vertex : vertices) {
    if (vertex >= m_positions.size()) {
      throwBad(*this, "element", element,
               "point " + std::to_string(vertex) + " is not one of the " + std::to_string(m_positions.size()));
    }
  }
}

}  // namespace allpairs::collision
