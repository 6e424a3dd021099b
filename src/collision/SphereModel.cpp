// SPDX-License-Identifier: MIT
#include "allpairs/collision/SphereModel.h"

#include "Validate.h"

namespace allpairs::collision {

SphereModel::SphereModel(std::string name, std::vector<Vec3> centres, std::vector<double> radii, double radius)
    : SolidModel(std::move(name)), m_centres(std::move(centres)), m_radii(std::move(radii)) {
  checkFinite(*this, "sphere", m_centres);
  if (m_radii.size() > m_centres.size()) checkLength(*this, "radii", m_radii.size(), m_centres.size());
  m_radii.resize(m_centres.size(), radius);
  for (std::size_t i = 0; i < m_radii.size(); ++i) {
    if (!std::isfinite(m_radii[i]) || m_radii[i] < 0.0) {
      throwBad(*this, "sphere", i, "a radius must be finite and not negative");
    }
  }
}

void SphereModel::setCentres(std::vector<Vec3> centres) {
  checkLength(*this, "centres", centres.size(), m_centres.size());
  checkFinite(*this, "sphere", centres);
  m_centres = std::move(centres);
  boundsChanged();
}

Box SphereModel::boxAt(std::size_t index, const Vec3& offset) const {
  const double reach = m_radii[index] + getContactDistance();
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double centre = m_centres[index][axis] + offset[axis];
    box.min[axis] = centre - reach;
    box.max[axis] = centre + reach;
  }
  return box;
}

}  // namespace allpairs::collision
