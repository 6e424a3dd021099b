// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "allpairs/Neighbors.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// Where rows of partners are put: memory for one offset more than there are rows, and for the indices in all of them.
struct RowsPlace {
  std::span<std::uint64_t> offsets;
  std::span<std::uint32_t> indices;
};

/// Writes pairs that are ordered by (first, second) as rows.
void writeRows(std::span<const Pair> pairs, NeighborRows kind, const RowsPlace& place) noexcept;

}  // namespace allpairs::engine
