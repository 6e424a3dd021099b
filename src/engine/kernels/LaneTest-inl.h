// SPDX-License-Identifier: MIT
// The test of one box against a vector of boxes. Included once for each instruction set: see Kernels.cpp.

#if defined(ALLPAIRS_LANE_TEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_LANE_TEST_INL_H
#undef ALLPAIRS_LANE_TEST_INL_H
#else
#define ALLPAIRS_LANE_TEST_INL_H
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "hwy/highway.h"
#include "kernels/Lanes.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

namespace hn = hwy::HWY_NAMESPACE;

// Blocks of 16 lanes bound the width, so that a block is a whole number of vectors everywhere.
using FloatTag = hn::CappedTag<float, kFanOut>;
using IdTag = hn::CappedTag<std::uint32_t, kFanOut>;
using FloatVector = hn::Vec<FloatTag>;
using FloatMask = hn::Mask<FloatTag>;

/// One box in all lanes.
struct Query {
  FloatVector minX, minY, minZ, maxX, maxY, maxZ;
};

HWY_INLINE Query broadcast(const LaneBox& box) {
  const FloatTag d;
  return {hn::Set(d, box.bound[0]), hn::Set(d, box.bound[1]), hn::Set(d, box.bound[2]),
          hn::Set(d, box.bound[3]), hn::Set(d, box.bound[4]), hn::Set(d, box.bound[5])};
}

/// The lanes that overlap the query on an axis. Both sides are boxes that are not empty, or lanes that never overlap.
///
/// Minima and maxima run on more ports of a processor than comparisons into a mask, so a mix of both is fastest: a
/// conjunction of two comparisons under a mask on the first axis, max(min, min) <= min(max, max) on the others.
HWY_INLINE FloatMask meets(FloatVector queryMin, FloatVector queryMax, FloatVector min, FloatVector max) {
#if HWY_TARGET <= HWY_AVX3
  return FloatMask{_mm512_mask_cmp_ps_mask(hn::Le(queryMin, max).raw, min.raw, queryMax.raw, _CMP_LE_OQ)};
#else
  return hn::Le(hn::Max(queryMin, min), hn::Min(queryMax, max));
#endif
}

/// The lanes that overlap on this axis too.
HWY_INLINE FloatMask meetsAlso(FloatMask also, FloatVector queryMin, FloatVector queryMax, FloatVector min,
                               FloatVector max) {
  const FloatVector from = hn::Max(queryMin, min);
  const FloatVector to = hn::Min(queryMax, max);
#if HWY_TARGET <= HWY_AVX3
  // A masked comparison: the conjunction is free.
  return FloatMask{_mm512_mask_cmp_ps_mask(also.raw, from.raw, to.raw, _CMP_LE_OQ)};
#else
  return hn::And(also, hn::Le(from, to));
#endif
}

/// A vector of each of six rows, at its own pointer plus `i`: what the tests below take as bound(k).
template <class Rows>
HWY_INLINE auto vectorsAt(const Rows& rows, std::size_t i) {
  return [&rows, i](std::size_t k) HWY_ATTR { return hn::LoadU(FloatTag(), &rows[k][i]); };
}

/// The lanes that overlap the query.
template <class BoundOf>
HWY_INLINE FloatMask overlapping(const Query& q, const BoundOf& bound) {
  const FloatMask x = meets(q.minX, q.maxX, bound(0), bound(3));
  const FloatMask xy = meetsAlso(x, q.minY, q.maxY, bound(1), bound(4));
  return meetsAlso(xy, q.minZ, q.maxZ, bound(2), bound(5));
}
template <class Rows>
HWY_INLINE FloatMask overlapping(const Query& q, const Rows& rows, std::size_t i) {
  return overlapping(q, vectorsAt(rows, i));
}

/// The lanes of a mask in which one value is below another.
HWY_INLINE FloatMask belowAlso(FloatMask also, FloatVector value, FloatVector other) {
#if HWY_TARGET <= HWY_AVX3
  return FloatMask{_mm512_mask_cmp_ps_mask(also.raw, value.raw, other.raw, _CMP_LT_OQ)};
#else
  return hn::And(also, hn::Lt(value, other));
#endif
}

/// Of lanes that are the nearest float32 to bounds, those whose bounds overlap the query's for certain: a bound is
/// below another if its lane is.
template <class BoundOf>
HWY_INLINE FloatMask strictlyOverlapping(const Query& q, const BoundOf& bound) {
  FloatMask mask = belowAlso(hn::Lt(q.minX, bound(3)), bound(0), q.maxX);
  mask = belowAlso(belowAlso(mask, q.minY, bound(4)), bound(1), q.maxY);
  return belowAlso(belowAlso(mask, q.minZ, bound(5)), bound(2), q.maxZ);
}

/// The query with each bound moved inward by more than the rounding of both sides: what it overlaps is certain.
///
/// A lane is within one unit in the last place of the bound that it was rounded from, in whatever direction. If a
/// minimum, increased by eight units of its own, does not exceed a maximum, then the bounds that they were rounded from
/// do not either: if both are of similar magnitude, a unit of one is at most two of the other; else they are far apart.
/// Lanes that were widened may differ by more, because a sum may cancel: by less than `most`. Where that is 0 no lane
/// was rounded, and none is moved.
HWY_INLINE Query inward(const Query& q, const std::array<float, 3>& most) {
  const FloatTag d;
  const auto slack = [&](FloatVector value, float add) HWY_ATTR {
    return hn::MulAdd(hn::Abs(value), hn::Set(d, add == 0.0F ? 0.0F : kQuerySlack), hn::Set(d, add));
  };
  return {hn::Add(q.minX, slack(q.minX, most[0])), hn::Add(q.minY, slack(q.minY, most[1])),
          hn::Add(q.minZ, slack(q.minZ, most[2])), hn::Sub(q.maxX, slack(q.maxX, most[0])),
          hn::Sub(q.maxY, slack(q.maxY, most[1])), hn::Sub(q.maxZ, slack(q.maxZ, most[2]))};
}

/// The lanes that overlap the query whatever the rounding was.
template <class BoundOf>
HWY_INLINE FloatMask overlappingForCertain(const Query& q, const LaneSlack& slack, const BoundOf& bound) {
  return slack.areNearest ? strictlyOverlapping(q, bound) : overlapping(inward(q, slack.most), bound);
}

/// The lanes of a mask as bits.
template <class D, class M>
HWY_INLINE std::uint32_t allBitsOf(D d, M mask) {
#if HWY_TARGET <= HWY_AVX3
  static_cast<void>(d);
  return mask.raw;
#else
  std::array<std::uint8_t, 8> bytes{};
  hn::StoreMaskBits(d, mask, bytes.data());
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8U;
#endif
}

/// The same where most often there are none.
template <class D, class M>
HWY_INLINE std::uint32_t bitsOf(D d, M mask) {
  return hn::AllFalse(d, mask) ? 0 : allBitsOf(d, mask);
}

/// The lanes whose bits are set, first; what follows them is unspecified.
///
/// Not hn::Compress for vectors of 4 and 8 lanes: GCC 12 copies its table to the stack for each call, which took AVX2
/// half of the time of a search (docs/decisions/0024).
template <class D>
HWY_INLINE hn::Vec<D> lanesOfBits(D d, hn::Vec<D> values, std::uint64_t bits) {
  if constexpr (hn::MaxLanes(D()) == 8) {
    const hn::Rebind<std::uint8_t, D> bytes;
    const hn::RebindToUnsigned<D> lanes;
    const auto order = hn::PromoteTo(lanes, hn::LoadU(bytes, kLaneSelections<8, 1>[bits].data()));
    return hn::TableLookupLanes(values, hn::IndicesFromVec(d, order));
  } else if constexpr (hn::MaxLanes(D()) == 4) {
    const hn::Repartition<std::uint8_t, D> bytes;
    const auto order = hn::Load(bytes, kLaneSelections<4, 4>[bits].data());
    return hn::BitCast(d, hn::TableLookupBytes(hn::BitCast(bytes, values), order));
  } else {
    const std::array<std::uint8_t, 8> bytes{static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
    return hn::Compress(values, hn::LoadMaskBits(d, bytes.data()));
  }
}

/// The lanes that the mask selects, first; what follows them is unspecified.
template <class D, class M>
HWY_INLINE hn::Vec<D> selectedLanes(D d, hn::Vec<D> values, M mask) {
  if constexpr (hn::MaxLanes(D()) == 8 || hn::MaxLanes(D()) == 4) return lanesOfBits(d, values, allBitsOf(d, mask));
  return hn::Compress(values, mask);
}

/// Stores the lanes that the mask selects, in a whole vector; returns how many they are.
template <class D, class M>
HWY_INLINE std::size_t storeSelected(D d, hn::Vec<D> values, M mask, hn::TFromD<D>* to) {
  hn::StoreU(selectedLanes(d, values, mask), d, to);
  return hn::CountTrue(d, mask);
}

/// What numbersFrom() adds to.
alignas(64) inline constexpr std::array<std::uint32_t, kFanOut> kLaneNumbers{0, 1, 2,  3,  4,  5,  6,  7,
                                                                             8, 9, 10, 11, 12, 13, 14, 15};

/// first, first + 1, and so on. Not hn::Iota, which GCC turns into a store of each number and a load that waits for
/// all.
HWY_INLINE hn::Vec<IdTag> numbersFrom(std::size_t first) {
  const IdTag d;
  return hn::Add(hn::Load(d, kLaneNumbers.data()), hn::Set(d, static_cast<std::uint32_t>(first)));
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_LANE_TEST_INL_H
