// SPDX-License-Identifier: MIT
// Bounds of blocks, and pairs from hits.

#if defined(ALLPAIRS_BLOCK_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_BLOCK_KERNELS_INL_H
#undef ALLPAIRS_BLOCK_KERNELS_INL_H
#else
#define ALLPAIRS_BLOCK_KERNELS_INL_H
#endif

#include "LaneTest-inl.h"
#include "allpairs/Pair.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

HWY_INLINE float leastOf(const std::array<float, kFanOut>& row) {
  const FloatTag d;
  FloatVector least = hn::Load(d, row.data());
  for (std::size_t i = hn::Lanes(d); i < kFanOut; i += hn::Lanes(d)) least = hn::Min(least, hn::Load(d, &row[i]));
  return hn::GetLane(hn::MinOfLanes(d, least));
}

HWY_INLINE float greatestOf(const std::array<float, kFanOut>& row) {
  const FloatTag d;
  FloatVector greatest = hn::Load(d, row.data());
  for (std::size_t i = hn::Lanes(d); i < kFanOut; i += hn::Lanes(d)) greatest = hn::Max(greatest, hn::Load(d, &row[i]));
  return hn::GetLane(hn::MaxOfLanes(d, greatest));
}

void boundBlocks(const LaneBlock* blocks, std::size_t begin, std::size_t end, LaneBlock* parents) {
  for (std::size_t b = begin; b < end; ++b) {
    LaneBlock& parent = parents[b / kFanOut];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      parent.bound[axis][b % kFanOut] = leastOf(blocks[b].bound[axis]);
      parent.bound[axis + 3][b % kFanOut] = greatestOf(blocks[b].bound[axis + 3]);
    }
  }
}

/// Pairs are written a vector at a time, up to Hits::kSlack pairs past the end.
void writePairs(const Hits& hits, PairSide side, Pair* pairs) {
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  const IdTag d;
  auto* to = reinterpret_cast<std::uint32_t*>(pairs);
  for (std::size_t i = 0; i < hits.size; i += hn::Lanes(d)) {
    const auto row = hn::LoadU(d, hits.row + i);
    const auto partner = hn::LoadU(d, hits.partner + i);
    switch (side) {
      case PairSide::RowFirst:
        hn::StoreInterleaved2(row, partner, d, to + 2 * i);
        break;
      case PairSide::RowSecond:
        hn::StoreInterleaved2(partner, row, d, to + 2 * i);
        break;
      case PairSide::SmallerFirst:
        hn::StoreInterleaved2(hn::Min(row, partner), hn::Max(row, partner), d, to + 2 * i);
        break;
    }
  }
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_BLOCK_KERNELS_INL_H
