// SPDX-License-Identifier: MIT
#include "allpairs/collision/OrientedBoxModel.h"

#include <algorithm>

#include "Validate.h"

namespace allpairs::collision {
namespace {

void checkOrientedBox(const CollisionModel& model, std::size_t index, const OrientedBox& box) {
  const bool finite = isFinite(box.centre) && isFinite(box.axes[0]) && isFinite(box.axes[1]) && isFinite(box.axes[2]) &&
                      isFinite(box.halfExtents);
  if (!finite) throwBad(model, "oriented box", index, "a number is not finite");
  if (box.halfExtents[0] < 0.0 || box.halfExtents[1] < 0.0 || box.halfExtents[2] < 0.0) {
    throwBad(model, "oriented box", index, "a half extent is negative");
  }
}

/// Corner 0 to 7; bit a of the number says on which side along axis a.
Vec3 cornerOf(const OrientedBox& box, unsigned corner) {
  Vec3 point = box.centre;
  for (std::size_t a = 0; a < 3; ++a) {
    const double along = ((corner >> a) & 1U) != 0 ? box.halfExtents[a] : -box.halfExtents[a];
    for (std::size_t axis = 0; axis < 3; ++axis) point[axis] += along * box.axes[a][axis];
  }
  return point;
}

}  // namespace

OrientedBox OrientedBox::turned(const Vec3& centre, const std::array<double, 4>& quaternion, const Vec3& halfExtents) {
  const auto [x, y, z, w] = quaternion;
  return {centre,
          {Vec3{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)},
           Vec3{2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)},
           Vec3{2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)}},
          halfExtents};
}

OrientedBoxModel::OrientedBoxModel(std::string name, std::vector<OrientedBox> boxes) : SolidModel(std::move(name)) {
  setBoxes(std::move(boxes));
}

void OrientedBoxModel::setBoxes(std::vector<OrientedBox> boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) checkOrientedBox(*this, i, boxes[i]);
  if (boxes.size() != m_boxes.size()) setVelocities({});
  m_boxes = std::move(boxes);
  boundsChanged();
}

Box OrientedBoxModel::boxAt(std::size_t index, const Vec3& offset) const {
  Box box = kEmptyBox;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 point = cornerOf(m_boxes[index], corner);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(box.min[axis], point[axis] + offset[axis] - getContactDistance());
      box.max[axis] = std::max(box.max[axis], point[axis] + offset[axis] + getContactDistance());
    }
  }
  return box;
}

}  // namespace allpairs::collision
