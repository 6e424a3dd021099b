// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/collision/CollisionModel.h"

namespace allpairs::collision {

[[nodiscard]] inline bool isFinite(const Vec3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// Throws InvalidArgument: "model 'name', what index: problem".
[[noreturn]] inline void throwBad(const CollisionModel& model, std::string_view what, std::size_t index,
                                  std::string_view problem) {
  throw InvalidArgument(model.describe() + ", " + std::string(what) + " " + std::to_string(index) + ": " +
                        std::string(problem));
}

inline void checkFinite(const CollisionModel& model, std::string_view what, const std::vector<Vec3>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!isFinite(values[i])) throwBad(model, what, i, "not a finite number");
  }
}

inline void checkLength(const CollisionModel& model, std::string_view what, std::size_t size, std::size_t expected) {
  if (size != expected) {
    throw InvalidArgument(model.describe() + ": " + std::to_string(size) + " " + std::string(what) + " instead of " +
                          std::to_string(expected));
  }
}

}  // namespace allpairs::collision
