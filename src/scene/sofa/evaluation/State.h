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
