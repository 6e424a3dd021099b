// SPDX-License-Identifier: MIT
#include "allpairs/collision/BoxModel.h"

#include "Validate.h"

namespace allpairs::collision {
namespace {

void checkBox(const CollisionModel& model, std::size_t index, const Box& box) {
  if (hasNan(box)) {
    throw InvalidBox(index, model.describe() + ", box " + std::to_string(index) + ": a bound is not a number (NaN)");
  }
}

}  // namespace

BoxModel::BoxModel(std::string name, std::vector<Box> boxes) : SolidModel(std::move(name)) {
  setBoxes(std::move(boxes));
}

BoxModel::BoxModel(std::string name, const Box& box) : BoxModel(std::move(name), std::vector<Box>{box}) {}

void BoxModel::setBoxes(std::vector<Box> boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) checkBox(*this, i, boxes[i]);
  if (boxes.size() != m_boxes.size()) setVelocities({});
  m_boxes = std::move(boxes);
  boundsChanged();
}

void BoxModel::setBox(std::size_t index, const Box& box) {
  if (index >= m_boxes.size()) throwBad(*this, "box", index, "the model has no box of this number");
  checkBox(*this, index, box);
  m_boxes[index] = box;
  boundsChanged();
}

Box BoxModel::boxAt(std::size_t index, const Vec3& offset) const {
  Box box = m_boxes[index];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] += offset[axis];
    box.max[axis] += offset[axis];
  }
  return box;
}

}  // namespace allpairs::collision
