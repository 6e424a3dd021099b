// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "ExactPart.h"
#include "allpairs/collision/CollisionModel.h"

namespace allpairs::exact {

/// The shape of a collision model: all of its parts together.
struct ExactBody {
  std::vector<std::unique_ptr<ExactPart>> parts;
  std::vector<Box> boxes;  ///< Of the parts, radii included.
  Box box = kEmptyBox;     ///< Around all parts, radii not included.
  bool isKnown = true;     ///< Whether the type of the model is one whose shape is known.
  double extent = 0.0;     ///< The greatest, of the box around all parts.
  double reach = 0.0;      ///< The greatest coordinate, whatever its sign.
};

/// Makes the shape of a model, as it stands now.
[[nodiscard]] ExactBody makeBody(const collision::CollisionModel& model);

}  // namespace allpairs::exact
