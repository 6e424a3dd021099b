// SPDX-License-Identifier: MIT
#include "allpairs/collision/SolidModel.h"

#include "Validate.h"

namespace allpairs::collision {

void SolidModel::setVelocities(std::vector<Vec3> velocities) {
  if (!velocities.empty()) checkLength(*this, "velocities", velocities.size(), getSize());
  checkFinite(*this, "velocity", velocities);
  m_velocities = std::move(velocities);
  boundsChanged();
}

Box SolidModel::elementSweptBox(std::size_t index, double dt) const {
  const Box start = elementBox(index);
  if (index >= m_velocities.size() || isEmpty(start)) return start;  // however far it moves, and however that rounds
  const Vec3& v = m_velocities[index];
  return allpairs::merge(start, boxAt(index, {dt * v[0], dt * v[1], dt * v[2]}));
}

}  // namespace allpairs::collision
