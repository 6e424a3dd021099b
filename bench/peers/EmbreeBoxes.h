// SPDX-License-Identifier: MIT
#pragma once

#include <embree3/rtcore.h>

namespace allpairs::bench {

/// Gives Embree the bounds of a box, from its row of six numbers.
inline void writeBounds(const float* row, RTCBounds& to) {
  to.lower_x = row[0];
  to.lower_y = row[1];
  to.lower_z = row[2];
  to.upper_x = row[3];
  to.upper_y = row[4];
  to.upper_z = row[5];
}

}  // namespace allpairs::bench
