// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "allpairs/collision/SolidModel.h"

namespace allpairs::collision {

/// A model made of axis-aligned boxes. Its root box is their union; the contact distance does not enlarge them.
///
/// Geometry:  closed boxes; min > max on an axis means empty; infinite bounds are allowed.
/// Bad input: a NaN throws InvalidBox.
class BoxModel : public SolidModel {
 public:
  BoxModel(std::string name, std::vector<Box> boxes);
  BoxModel(std::string name, const Box& box);

  [[nodiscard]] const std::vector<Box>& boxes() const { return m_boxes; }

  /// Replaces the boxes. Another number of them removes the velocities.
  void setBoxes(std::vector<Box> boxes);
  void setBox(std::size_t index, const Box& box);

  [[nodiscard]] std::size_t getSize() const override { return m_boxes.size(); }
  [[nodiscard]] std::string_view typeName() const override { return "BoxModel"; }

 protected:
  [[nodiscard]] Box boxAt(std::size_t index, const Vec3& offset) const override;

 private:
  std::vector<Box> m_boxes;
};

}  // namespace allpairs::collision
