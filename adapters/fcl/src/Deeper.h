// SPDX-License-Identifier: MIT
#pragma once

#include "Deepest.h"

namespace allpairs::exact {

/// Looks for a point of `inner` that lies deeper within `outer` than a known one, wherever that is. If one does so by
/// more than a hundredth, it is found, as deep as the deepest but for a hundredth; unless that takes too many measures:
/// then it is the deepest of those measured. Both parts are solid, or the inner one a surface.
[[nodiscard]] Deepest deeperWithin(const ExactPart& outer, const ExactPart& inner, double known);

}  // namespace allpairs::exact
