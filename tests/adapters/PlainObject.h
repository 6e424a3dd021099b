// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>

namespace allpairs::test {

/// As hosts have them, whose corners are Eigen's.
struct Corner {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  const double& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  friend bool operator==(const Corner&, const Corner&) = default;
};

struct Bounds {
  static constexpr double kMost = std::numeric_limits<double>::max();

  Corner min_{kMost, kMost, kMost};
  Corner max_{-kMost, -kMost, -kMost};

  [[nodiscard]] bool overlap(const Bounds& other) const { return distance(other) == 0.0; }
  [[nodiscard]] double distance(const Bounds& other) const {
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (min_[axis] > other.max_[axis]) square += (min_[axis] - other.max_[axis]) * (min_[axis] - other.max_[axis]);
      if (other.min_[axis] > max_[axis]) square += (other.min_[axis] - max_[axis]) * (other.min_[axis] - max_[axis]);
    }
    return std::sqrt(square);
  }
};

/// An object as ObjectBroadPhase takes it, of no host.
struct Object {
  Bounds bounds;
  [[nodiscard]] const Bounds& getAABB() const { return bounds; }
};

}  // namespace allpairs::test
