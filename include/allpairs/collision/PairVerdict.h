// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "allpairs/collision/CollisionModel.h"

namespace allpairs::collision {

/// What keeps two models from being a pair: the first rule that does, in the order in which the broad phase asks.
enum class PairRule : std::uint8_t {
  None,           ///< Nothing: they are a pair.
  NoElements,     ///< One of them is null or has no elements.
  OutsideRegion,  ///< One of them lies outside of the region.
  NotSimulated,   ///< Neither of them is simulated.
  OneOwner,       ///< They have one owner, and not both may collide with themselves; or a model may not with itself.
  CommonGroup,    ///< A group has both.
  Refused,        ///< The canCollideWith() of a user's model does not let them collide.
  NoIntersector,  ///< The method has no intersector for their roots.
  Apart,          ///< The intersector says of their roots that they cannot touch: most often, boxes that are apart.
};

/// Whether two models are a pair, and why not.
struct PairVerdict {
  PairRule rule = PairRule::None;

  /// The one at fault, of NoElements and OutsideRegion, at the level of its elements; else null.
  const CollisionModel* model = nullptr;

  [[nodiscard]] bool isPair() const { return rule == PairRule::None; }
};

}  // namespace allpairs::collision
