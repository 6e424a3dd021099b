// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/collision/Vec3.h"

namespace allpairs::collision {

/// A cone that contains the normals of a patch of surface; half-angle 2 pi means that they are unknown.
///
/// A patch whose normals all lie within less than a quarter turn of one axis is too flat to touch itself.
struct NormalCone {
  Vec3 axis{0.0, 0.0, 0.0};
  double halfAngle = 2.0 * 3.141592653589793;

  /// The cone of a single direction.
  ///
  /// Bad input: the null vector has no direction, and gives the cone of unknown normals.
  [[nodiscard]] static NormalCone of(const Vec3& normal);

  /// The cone of a direction that turns during a step: around the one at the start, as wide as the angle between the
  /// two.
  [[nodiscard]] static NormalCone ofTurning(const Vec3& start, const Vec3& end);

  /// Widens this cone so that it contains the other as well.
  ///
  /// Geometry: with a the larger half-angle, if a <= pi/2 the axis is the normalised sum of the two and the half-angle
  ///           acos(axis1 . axis2) / 2 + a; otherwise the normals become unknown. The order of merging matters.
  void merge(const NormalCone& other);
};

}  // namespace allpairs::collision
