// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "allpairs/join/Join.h"

namespace allpairs::app {

/// What a join costs on this machine: seconds = perRecord (boxes + copies) + perPair pairs. Reading and writing files
/// is part of both.
struct JoinCost {
  double perRecord = 0.0;
  double perPair = 0.0;

  [[nodiscard]] double secondsFor(const join::JoinSummary& plan) const;
};

/// Measures it in some seconds, by joins of generated boxes in a folder within `place`, which is gone afterwards. The
/// more boxes the plan has, the more are joined.
[[nodiscard]] JoinCost measureJoinCost(const std::filesystem::path& place, const join::JoinSummary& plan,
                                       join::JoinOptions options);

}  // namespace allpairs::app
