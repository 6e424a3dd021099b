// SPDX-License-Identifier: MIT
#include "order/PairRows.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace allpairs::engine {
namespace {

void writeHalfRows(std::span<const Pair> pairs, const NeighborsMemory& place) noexcept {
  std::size_t row = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    for (; row <= pairs[i].first; ++row) place.offsets[row] = i;
    place.indices[i] = pairs[i].second;
  }
  std::fill(place.offsets.begin() + static_cast<std::ptrdiff_t>(row), place.offsets.end(), pairs.size());
}

/// In the order of the pairs a box comes second to all that are less before it comes first to those that are greater: what is
/// appended to its row ascends.
void writeFullRows(std::span<const Pair> pairs, const NeighborsMemory& place) noexcept {
  const std::span<std::uint64_t> offsets = place.offsets;
  std::fill(offsets.begin(), offsets.end(), 0);
  // Only sums of what stands before stay between a row's offset and the next but one: the latter counts.
  const auto count = [&](std::size_t row) {
    if (row + 2 < offsets.size()) ++offsets[row + 2];
  };
  for (const Pair pair : pairs) {
    count(pair.first);
    count(pair.second);
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  for (const Pair pair : pairs) {
    place.indices[offsets[pair.first + std::size_t{1}]++] = pair.second;
    place.indices[offsets[pair.second + std::size_t{1}]++] = pair.first;
  }
}

}  // namespace

void writeRows(std::span<const Pair> pairs, NeighborRows kind, const NeighborsMemory& place) noexcept {
  kind == NeighborRows::Full ? writeFullRows(pairs, place) : writeHalfRows(pairs, place);
}

}  // namespace allpairs::engine
