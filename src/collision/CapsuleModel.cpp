// SPDX-License-Identifier: MIT
#include "allpairs/collision/CapsuleModel.h"

#include <algorithm>

#include "Validate.h"

namespace allpairs::collision {
namespace {

void checkCapsule(const CollisionModel& model, std::size_t index, const Capsule& capsule) {
  if (!isFinite(capsule.begin) || !isFinite(capsule.end)) throwBad(model, "capsule", index, "an end is not finite");
  if (!std::isfinite(capsule.radius) || capsule.radius < 0.0) {
    throwBad(model, "capsule", index, "a radius must be finite and not negative");
  }
}

}  // namespace

CapsuleModel::CapsuleModel(std::string name, std::vector<Capsule> capsules) : SolidModel(std::move(name)) {
  setCapsules(std::move(capsules));
}

void CapsuleModel::setCapsules(std::vector<Capsule> capsules) {
  for (std::size_t i = 0; i < capsules.size(); ++i) checkCapsule(*this, i, capsules[i]);
  if (capsules.size() != m_capsules.size()) setVelocities({});
  m_capsules = std::move(capsules);
  boundsChanged();
}

Box CapsuleModel::boxAt(std::size_t index, const Vec3& offset) const {
  const Capsule& capsule = m_capsules[index];
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double begin = capsule.begin[axis] + offset[axis];
    const double end = capsule.end[axis] + offset[axis];
    box.min[axis] = std::min(begin, end) - capsule.radius;
    box.max[axis] = std::max(begin, end) + capsule.radius;
  }
  return box;
}

}  // namespace allpairs::collision
