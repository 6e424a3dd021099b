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

/// Measures it in some seconds, by joins of generated boxes in a folder within the work folder of a join, or beside it
/// if it is not there; that is gone afterwards. The more boxes the plan has, the more are joined.
///
/// Bad input: a work folder that a join could not use throws FileError, which names it.
[[nodiscard]] JoinCost measureJoinCost(const std::filesystem::path& work, const join::JoinSummary& plan,
                                       join::JoinOptions options);

}  // namespace allpairs::app
