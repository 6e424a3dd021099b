// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "allpairs/collision/CollisionModel.h"

namespace allpairs::collision {

/// One element of one level of a collision model: a triangle, a sphere, or the box of a root.
struct CollisionElement {
  CollisionModel* model = nullptr;
  std::size_t index = 0;

  [[nodiscard]] Box box() const { return model->elementBox(index); }
  [[nodiscard]] NormalCone cone() const { return model->elementCone(index); }

  friend bool operator==(const CollisionElement& a, const CollisionElement& b) {
    return a.model == b.model && a.index == b.index;
  }
  friend bool operator!=(const CollisionElement& a, const CollisionElement& b) { return !(a == b); }
};

}  // namespace allpairs::collision
