// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

/// What of Coal's interface its adapter and the tests use, for machines without Coal. Its managers are double loops.
namespace coal {

using CoalScalar = double;

struct Vec3s {
  Vec3s() = default;
  Vec3s(double x, double y, double z) : numbers{x, y, z} {}
  double& operator[](int axis) { return numbers[static_cast<std::size_t>(axis)]; }
  const double& operator[](int axis) const { return numbers[static_cast<std::size_t>(axis)]; }
  friend bool operator==(const Vec3s& a, const Vec3s& b) { return a.numbers == b.numbers; }

  std::array<double, 3> numbers{};
};

class AABB {
 public:
  AABB() {
    for (int axis = 0; axis < 3; ++axis) {
      min_[axis] = std::numeric_limits<double>::max();
      max_[axis] = -std::numeric_limits<double>::max();
    }
  }

  [[nodiscard]] bool overlap(const AABB& other) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (min_[axis] > other.max_[axis] || other.min_[axis] > max_[axis]) return false;
    }
    return true;
  }

  [[nodiscard]] double distance(const AABB& other) const {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double gap = std::max({0.0, min_[axis] - other.max_[axis], other.min_[axis] - max_[axis]});
      square += gap * gap;
    }
    return std::sqrt(square);
  }

  Vec3s min_;
  Vec3s max_;
};

class CollisionGeometry {};

class CollisionObject {
 public:
  explicit CollisionObject(std::shared_ptr<CollisionGeometry> shape) : m_shape(std::move(shape)) {}

  [[nodiscard]] const AABB& getAABB() const { return m_bounds; }
  AABB& getAABB() { return m_bounds; }

 private:
  std::shared_ptr<CollisionGeometry> m_shape;
  AABB m_bounds;
};

}  // namespace coal
