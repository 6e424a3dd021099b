// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace allpairs::collision {

/// A point, a direction or an extent: x, y, z.
using Vec3 = std::array<double, 3>;

}  // namespace allpairs::collision
