// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace allpairs::test {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kMost = std::numeric_limits<double>::max();
inline constexpr double kMostOfFloat = static_cast<double>(std::numeric_limits<float>::max());
inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// The nearest number that float32 has. It is stored, since GCC 12 leaves out the conversion of neighbouring numbers to
/// float32 and back.
inline double asFloat32(double value) {
  const volatile float stored = static_cast<float>(value);
  return static_cast<double>(stored);
}

}  // namespace allpairs::test
