// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "allpairs/collision/CollisionModel.h"

namespace allpairs::collision {

/// Base of the models whose elements are whole bodies, each with one velocity: boxes, spheres, capsules.
class SolidModel : public CollisionModel {
 public:
  /// One velocity per element, for continuous methods; an empty vector means that nothing moves. Velocities stay until
  /// the number of elements changes.
  ///
  /// Bad input: a wrong length or a number that is not finite throws InvalidArgument.
  void setVelocities(std::vector<Vec3> velocities);
  [[nodiscard]] const std::vector<Vec3>& velocities() const { return m_velocities; }

  [[nodiscard]] Box elementBox(std::size_t index) const override { return boxAt(index, {0.0, 0.0, 0.0}); }
  [[nodiscard]] Box elementSweptBox(std::size_t index, double dt) const override;

 protected:
  using CollisionModel::CollisionModel;

  /// The box of an element moved by `offset`.
  [[nodiscard]] virtual Box boxAt(std::size_t index, const Vec3& offset) const = 0;

 private:
  std::vector<Vec3> m_velocities;
};

}  // namespace allpairs::collision
