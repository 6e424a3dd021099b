// SPDX-License-Identifier: MIT
#include "detect/Exact.h"

namespace allpairs::app {

double ExactCounts::falseShare() const {
  const std::uint64_t examined = apart + inContact();
  return examined == 0 ? 0.0 : static_cast<double>(apart) / static_cast<double>(examined);
}

ExactCounts countStates(std::span<const ExactPair> pairs) {
  ExactCounts counts;
  for (const ExactPair& pair : pairs) {
    counts.apart += pair.state == ExactState::Apart ? 1U : 0U;
    counts.touching += pair.state == ExactState::Touching ? 1U : 0U;
    counts.overlapping += pair.state == ExactState::Overlapping ? 1U : 0U;
    counts.contained += pair.state == ExactState::Contained ? 1U : 0U;
    counts.notExamined += pair.state == ExactState::NotExamined ? 1U : 0U;
  }
  return counts;
}

const char* stateName(ExactState state) {
  switch (state) {
    case ExactState::Apart:
      return "apart";
    case ExactState::Touching:
      return "touching";
    case ExactState::Overlapping:
      return "overlapping";
    case ExactState::Contained:
      return "contained";
    case ExactState::NotExamined:
      break;
  }
  return "not-examined";
}

std::vector<Pair> withoutFalse(std::span<const Pair> candidates, const ExactReport& report) {
  std::vector<Pair> kept;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (report.pairs[i].state != ExactState::Apart) kept.push_back(candidates[i]);
  }
  return kept;
}

}  // namespace allpairs::app
