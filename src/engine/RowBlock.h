// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace allpairs::engine {

/// What is known of sixteen boxes after they were read from rows of six.
struct RowBlockResult {
  bool exact = true;             ///< Their lanes are exactly the boxes.
  std::uint32_t emptyLanes = 0;  ///< A bit for each that is empty.
};

}  // namespace allpairs::engine
