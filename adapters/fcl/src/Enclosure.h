// SPDX-License-Identifier: MIT
#pragma once

#include "ExactPart.h"

namespace allpairs::exact {

/// Whether all points of `inner` that are worth asking lie in `outer`, or no further than the tolerance outside of it:
/// the corners and middles of triangles. Triangles of the two that cross are for the caller to look for.
[[nodiscard]] bool isWithin(const ExactPart& outer, const ExactPart& inner, double tolerance);

/// Whether two parts have the same surface, whatever triangles it is made of: the corners and middles of the triangles
/// of each are no further than the tolerance from the other.
[[nodiscard]] bool areSame(const ExactPart& first, const ExactPart& second, double tolerance);

/// Whether one box, widened by a length, holds another.
[[nodiscard]] bool holds(const Box& outer, const Box& inner, double slack);

}  // namespace allpairs::exact
