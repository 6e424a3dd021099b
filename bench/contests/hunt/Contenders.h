// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "SetPeer.h"

namespace allpairs::bench {

/// The call that most users make: overlaps(), pairs in order, in a vector of the caller's.
template <class T>
[[nodiscard]] std::unique_ptr<SetSearch<T>> orderedOverlaps();

/// find() of an object that is kept from search to search, and with it its memory; pairs in no order.
template <class T>
[[nodiscard]] std::unique_ptr<SetSearch<T>> keptUnorderedFind();

}  // namespace allpairs::bench
