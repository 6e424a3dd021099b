// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace allpairs::collision {

/// Whether two ascending lists have a member in common.
[[nodiscard]] inline bool haveCommonMember(const std::vector<int>& a, const std::vector<int>& b) {
  auto i = a.begin();
  auto j = b.begin();
  while (i != a.end() && j != b.end()) {
    if (*i == *j) return true;
    if (*i < *j) {
      ++i;
    } else {
      ++j;
    }
  }
  return false;
}

}  // namespace allpairs::collision
