// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>

#include "Peer.h"
#include "allpairs/OverlapOptions.h"

namespace allpairs::bench {

using MakeSearch = std::function<std::unique_ptr<Search>()>;

/// One-shot: boxes checked, an OverlapSearch of its own, nothing kept from before.
[[nodiscard]] MakeSearch freshSearches(const OverlapOptions& options);

/// The function that most users call, overlaps(): one-shot, and a vector of pairs that is the caller's.
[[nodiscard]] MakeSearch vectorSearches(const OverlapOptions& options);

/// Boxes checked, but one OverlapSearch for all searches, which has kept its memory from the search before.
[[nodiscard]] MakeSearch warmSearches(const OverlapOptions& options);

/// Counts only, and so gives no pairs.
[[nodiscard]] MakeSearch countingSearches(const OverlapOptions& options);

}  // namespace allpairs::bench
