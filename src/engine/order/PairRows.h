// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "allpairs/Neighbors.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// Writes pairs that are ordered by (first, second) as rows, in memory for exactly these.
void writeRows(std::span<const Pair> pairs, NeighborRows kind, const NeighborsMemory& place) noexcept;

}  // namespace allpairs::engine
