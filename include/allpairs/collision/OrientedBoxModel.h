// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "allpairs/collision/SolidModel.h"

namespace allpairs::collision {

/// A box with axes of its own: the points centre + a axes[0] + b axes[1] + c axes[2] with |a|, |b|, |c| up to the half
/// extents.
struct OrientedBox {
  static constexpr double kDefaultHalfExtent = 1.0;

  Vec3 centre{};
  std::array<Vec3, 3> axes{Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}};
  Vec3 halfExtents{kDefaultHalfExtent, kDefaultHalfExtent, kDefaultHalfExtent};

  /// The box whose axes are those of the world rotated by a unit quaternion x, y, z, w.
  [[nodiscard]] static OrientedBox turned(const Vec3& centre, const std::array<double, 4>& quaternion,
                                          const Vec3& halfExtents = {kDefaultHalfExtent, kDefaultHalfExtent,
                                                                     kDefaultHalfExtent});
};

/// Oriented boxes. The axis-aligned box of each bounds its 8 corners, enlarged by the contact distance.
///
/// Bad input: a number that is not finite, or a negative half extent, throws InvalidArgument.
class OrientedBoxModel : public SolidModel {
 public:
  OrientedBoxModel(std::string name, std::vector<OrientedBox> boxes);

  [[nodiscard]] const std::vector<OrientedBox>& boxes() const { return m_boxes; }

  /// Replaces the boxes. Another number of them removes the velocities.
  void setBoxes(std::vector<OrientedBox> boxes);

  [[nodiscard]] std::size_t getSize() const override { return m_boxes.size(); }
  [[nodiscard]] std::string_view typeName() const override { return "TOBBModel"; }

 protected:
  [[nodiscard]] Box boxAt(std::size_t index, const Vec3& offset) const override;

 private:
  std::vector<OrientedBox> m_boxes;
};

}  // namespace allpairs::collision
