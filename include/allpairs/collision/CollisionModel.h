// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "allpairs/Box.h"

namespace allpairs::collision {

/// A body, or part of one, that may collide: a chain of levels from a root (one box) down to the elements.
///
/// A model of the user's own derives from this and says how many elements it has and what box each of them fills.
class CollisionModel {
 public:
  CollisionModel() = default;
  CollisionModel(const CollisionModel&) = delete;
  CollisionModel& operator=(const CollisionModel&) = delete;
  CollisionModel(CollisionModel&&) = delete;
  CollisionModel& operator=(CollisionModel&&) = delete;
  virtual ~CollisionModel() = default;

  [[nodiscard]] virtual std::size_t getSize() const = 0;
  [[nodiscard]] bool empty() const { return getSize() == 0; }
};

}  // namespace allpairs::collision

namespace allpairs {
/// The seed writes `core::CollisionModel`.
namespace core = collision;
}  // namespace allpairs
