// SPDX-License-Identifier: MIT
#pragma once

#include "allpairs/OverlapOptions.h"

namespace allpairs::test {

inline constexpr Strategy kStrategies[] = {Strategy::Automatic, Strategy::Exhaustive, Strategy::Bvh};

}  // namespace allpairs::test
