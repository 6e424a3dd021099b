// SPDX-License-Identifier: MIT
#pragma once

namespace allpairs::collision {

/// How two collision elements are tested: distances, and which intersector knows which types.
class Intersection {
 public:
  virtual ~Intersection() = default;
};

}  // namespace allpairs::collision
