// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "sofa/mesh/Math.h"

namespace allpairs::scene::sofa {

/// A map of space that keeps straight lines.
struct AffineMap {
  Mat3 linear;
  Vec3 offset{};

  [[nodiscard]] Vec3 operator()(const Vec3& p) const { return linear * p + offset; }
};

/// First scaled, then turned, then moved.
[[nodiscard]] inline AffineMap affine(const Quat& rotation, const Vec3& scale, const Vec3& translation) {
  return {{rotate(rotation, {scale[0], 0, 0}), rotate(rotation, {0, scale[1], 0}), rotate(rotation, {0, 0, scale[2]})},
          translation};
}

[[nodiscard]] inline AffineMap compose(const AffineMap& after, const AffineMap& before) {
  return {{after.linear * before.linear.x, after.linear * before.linear.y, after.linear * before.linear.z},
          after(before.offset)};
}

/// How the points of a sparse grid were moved that a data holds.
struct GridMotion {
  AffineMap map{};
  bool areUnknown = false;  ///< The points themselves are not known, only how they were moved.
};

/// The degrees of freedom of a state component at the start of the simulation.
struct State {
  enum class Kind { Points, Rigid, Other };

  Kind kind = Kind::Points;
  std::vector<Vec3> positions;
  std::vector<Quat> orientations;  ///< As many as positions if rigid, else none.
  std::vector<Vec3> rest;          ///< The rest positions.
  /// Set while the positions are the points of a topology, moved by this.
  std::optional<AffineMap> fromTopology;
  /// That topology is a sparse grid: how it is moved is known, where its points are isn't.
  bool pointsUnknown = false;

  void resize(std::size_t count) {
    positions.resize(count);
    if (kind == Kind::Rigid) orientations.resize(count);
  }
};

}  // namespace allpairs::scene::sofa
