// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace allpairs::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace allpairs::test
