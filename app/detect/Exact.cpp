// SPDX-License-Identifier: MIT
#include "detect/Exact.h"

namespace allpairs::app {

std::vector<Pair> withoutFalse(std::span<const Pair> candidates, const ExactReport& report) {
  std::vector<Pair> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (report.pairs[i].state != ExactState::Apart) kept.push_back(candidates[i]);
  }
  return kept;
}

}  // namespace allpairs::app
