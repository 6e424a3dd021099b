// SPDX-License-Identifier: MIT
#pragma once

#include "ExactPart.h"
#include "Nearest.h"

namespace allpairs::exact {

/// Where the cores of two parts meet, at least one of which is thick (a ball or a capsule), no direction lies between
/// their nearest points: a unit vector that parts the first from the second, the same for the same parts. The point
/// where they meet, moved against it by the first's radius and along it by the second's, lies on both surfaces.
[[nodiscard]] Point normalWhereCoresMeet(const ExactPart& first, const ExactPart& second, const Point& at,
                                         double tolerance);

/// The middle of the circle in which the surface of a thick part meets that of another: a point of both. The circle is
/// that of two balls, or of a ball and a plane, whatever the parts look like elsewhere.
[[nodiscard]] Point contactOfThick(const ExactPart& first, const ExactPart& second, const Nearest& cores,
                                   double tolerance);

}  // namespace allpairs::exact
