// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "ExactPart.h"

namespace allpairs::exact {

/// The middle of where two triangles meet, or nothing where rounding leaves no point that both have.
[[nodiscard]] std::optional<Point> meetingPoint(const Corners& a, const Corners& b);

}  // namespace allpairs::exact
