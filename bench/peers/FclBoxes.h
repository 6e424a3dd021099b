// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/narrowphase/collision_object.h>

#include <cstdint>

namespace allpairs::bench {

/// A collision object that is nothing but its box: no geometry, which the broad phase never asks for.
class BoxObject final : public fcl::CollisionObjectd {
 public:
  template <class T>
  BoxObject(const T* row, std::uint32_t number) : fcl::CollisionObjectd(nullptr), m_number(number) {
    set(row);
  }

  template <class T>
  void set(const T* row) {
    for (int axis = 0; axis < 3; ++axis) {
      aabb.min_[axis] = static_cast<double>(row[axis]);
      aabb.max_[axis] = static_cast<double>(row[axis + 3]);
    }
  }

  [[nodiscard]] std::uint32_t number() const { return m_number; }

 private:
  std::uint32_t m_number;
};

}  // namespace allpairs::bench
