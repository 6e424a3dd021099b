// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "sofa/graph/Values.h"
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
  /// They are the points of a sparse grid, and where those are isn't known; how they are moved is while fromTopology
  /// is set.
  bool pointsUnknown = false;
  /// A mapping writes it once all states are placed, or one that its position links to.
  bool isWrittenAgain = false;

  /// How many numbers an entry has: a point's, and of a frame those of its turn too.
  [[nodiscard]] std::size_t width() const { return kind == Kind::Rigid ? 7 : 3; }

  /// Takes the entries of numbers of that width for its positions and turns.
  void setPositions(const Numbers& numbers) {
    resize(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto* v = numbers.values.data() + i * numbers.width;
      positions[i] = {v[0], v[1], v[2]};
      if (kind == Kind::Rigid) orientations[i] = {v[3], v[4], v[5], v[6]};
    }
  }

  /// Takes points that are known for its positions; frames that it did not have are not turned.
  void setPoints(std::vector<Vec3> points) {
    resize(points.size());
    positions = std::move(points);
    pointsUnknown = false;
  }

  /// Makes room for points that come from elsewhere than a topology, all of them known.
  void setCount(std::size_t count) {
    resize(count);
    fromTopology.reset();
    pointsUnknown = false;
  }

  void resize(std::size_t count) {
    positions.resize(count);
    if (kind == Kind::Rigid) orientations.resize(count);
  }
};

}  // namespace allpairs::scene::sofa
