// SPDX-License-Identifier: MIT
// Queries against the sixteen boxes of a block: which of them they may hit, and the earliest time.

#if defined(ALLPAIRS_QUERY_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_QUERY_KERNEL_INL_H
#undef ALLPAIRS_QUERY_KERNEL_INL_H
#else
#define ALLPAIRS_QUERY_KERNEL_INL_H
#endif

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels/LaneTest-inl.h"
#include "kernels/ReadKernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// The bits of all lanes of a block, from maskOf(first lane of a vector).
template <class MaskOf>
HWY_INLINE std::uint32_t bitsOfBlock(const MaskOf& maskOf) {
  const FloatTag d;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(d)) bits |= bitsOf(d, maskOf(i)) << i;
  return bits;
}

/// Which lanes overlap a box.
std::uint32_t touchingLanes(const LaneBlock& block, const LaneBox& box) {
  const Query query = broadcast(box);
  return bitsOfBlock([&](std::size_t i) HWY_ATTR { return overlapping(query, block.bound, i); });
}

/// No branch depends on what is found: which of a few visits finds something is not to be predicted.
std::size_t touchingPlaces(const BlockVisits& visits, std::uint32_t* HWY_RESTRICT boxOf,
                           std::uint32_t* HWY_RESTRICT places) {
  const IdTag d;
  std::size_t size = 0;
  for (std::size_t visit = 0; visit < visits.size; ++visit) {
    const std::size_t block = visits.blockOf[visit];
    const Query query = broadcast(visits.boxes[visits.boxOf[visit]]);
    const auto box = hn::Set(d, visits.boxOf[visit]);
    for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(d)) {
      const auto touching = hn::RebindMask(d, overlapping(query, visits.blocks[block].bound, i));
      hn::StoreU(box, d, boxOf + size);
      size += storeSelected(d, numbersFrom(block * kFanOut + i), touching, places + size);
    }
  }
  return size;
}

/// What MarkedCells::cellOf() gives, of a vector of bounds.
HWY_INLINE hn::Vec<hn::RebindToSigned<FloatTag>> cellsOf(FloatVector bounds, const MarkedCells& cells,
                                                         std::size_t axis) {
  const FloatTag d;
  const auto cell = hn::Mul(hn::Sub(bounds, hn::Set(d, cells.origin[axis])), hn::Set(d, cells.scale));
  const auto last = hn::Set(d, static_cast<float>(cells.count[axis] - 1));
  return hn::ConvertTo(hn::RebindToSigned<FloatTag>(), hn::Min(hn::Max(cell, hn::Zero(d)), last));
}

/// Which lanes have a first cell that is marked, or more than two cells on an axis.
std::uint32_t markedLanes(const LaneBlock& block, const MarkedCells& cells) {
  return bitsOfBlock([&](std::size_t i) HWY_ATTR {
    const FloatTag d;
    const IdTag du;
    const hn::RebindToSigned<FloatTag> di;
    auto number = hn::Zero(di);
    auto further = hn::Zero(di);
    for (std::size_t axis = 3; axis-- > 0;) {
      if (cells.count[axis] == 1) continue;
      const auto first = cellsOf(hn::LoadU(d, &block.bound[axis][i]), cells, axis);
      const auto last = cellsOf(hn::LoadU(d, &block.bound[axis + 3][i]), cells, axis);
      further = hn::Max(further, hn::Sub(last, first));
      number = hn::Add(hn::Mul(number, hn::Set(di, cells.count[axis])), first);
    }
    const auto marks = hn::GatherIndex(du, cells.marks, hn::ShiftRight<5>(number));
    const auto bit = hn::Shl(hn::Set(du, 1U), hn::BitCast(du, hn::And(number, hn::Set(di, 31))));
    const auto isMarked = hn::Ne(hn::And(marks, bit), hn::Zero(du));
    return hn::RebindMask(d, hn::Or(isMarked, hn::RebindMask(du, hn::Gt(further, hn::Set(di, 1)))));
  });
}

/// Clips the times at which a query enters boxes and leaves them to those of one axis, from how far it is from where it
/// meets and leaves them there, by the inverse of its speed. Overflow and NaN are resolved conservatively, so that no
/// hit is lost.
HWY_INLINE void clip(FloatVector near, FloatVector far, FloatVector inverse, FloatVector& enter, FloatVector& leave) {
  const FloatTag d;
  const auto most = hn::Set(d, kLaneMax);
  const auto least = hn::Set(d, -kLaneMax);
  const auto slack = hn::Set(d, kQuerySlack);
  const auto tiny = hn::Set(d, kQueryTiny);
  const auto in = hn::Min(hn::Mul(hn::Min(near, most), inverse), most);
  const auto out = hn::Max(hn::Mul(hn::Max(far, least), inverse), least);
  const auto from = hn::Sub(hn::Sub(in, hn::Mul(hn::Abs(in), slack)), tiny);
  const auto to = hn::Add(hn::Add(out, hn::Mul(hn::Abs(out), slack)), tiny);
  enter = hn::IfThenElse(hn::Gt(from, enter), from, enter);
  leave = hn::IfThenElse(hn::Lt(to, leave), to, leave);
}

/// Which lanes a swept box may hit up to `limit`, and a lower bound of the time.
std::uint32_t meetingLanes(const LaneBlock& block, const SweepLanes& sweep, float limit, float* times) {
  return bitsOfBlock([&](std::size_t i) HWY_ATTR {
    const FloatTag d;
    auto enter = hn::Zero(d);
    auto leave = hn::Set(d, limit);
    // A lane that holds no box has a minimum of infinity, which no box has.
    auto possible = hn::Lt(hn::Load(d, &block.bound[0][i]), hn::Set(d, kNever));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (sweep.axis[axis] == SweepLanes::Axis::Unbounded) continue;
      auto min = hn::Load(d, &block.bound[axis][i]);
      auto max = hn::Load(d, &block.bound[axis + 3][i]);
      // The largest float32 stands for infinity as well.
      min = hn::IfThenElse(hn::Le(min, hn::Set(d, -kLaneMax)), hn::Set(d, -kNever), min);
      max = hn::IfThenElse(hn::Ge(max, hn::Set(d, kLaneMax)), hn::Set(d, kNever), max);
      const auto queryMin = hn::Set(d, sweep.min[axis]);
      const auto queryMax = hn::Set(d, sweep.max[axis]);
      if (sweep.axis[axis] == SweepLanes::Axis::Rests) {
        possible = hn::And(possible, hn::And(hn::Le(min, queryMax), hn::Le(queryMin, max)));
        continue;
      }
      const bool forward = sweep.axis[axis] == SweepLanes::Axis::Forward;
      const auto near = forward ? hn::Sub(min, queryMax) : hn::Sub(queryMin, max);
      const auto far = forward ? hn::Sub(max, queryMin) : hn::Sub(queryMax, min);
      clip(near, far, hn::Set(d, sweep.inverse[axis]), enter, leave);
    }
    hn::StoreU(enter, d, times + i);
    return hn::AndNot(hn::Gt(enter, leave), possible);
  });
}

/// Which lanes may be as near to a box as the square root of `limit`, and lower bounds of their squared distances.
std::uint32_t nearLanes(const LaneBlock& block, const LaneBox& box, float limit, float* squares) {
  return bitsOfBlock([&](std::size_t i) HWY_ATTR {
    const FloatTag d;
    auto sum = hn::Zero(d);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto ahead = hn::Sub(hn::Load(d, &block.bound[axis][i]), hn::Set(d, box.bound[axis + 3]));
      const auto behind = hn::Sub(hn::Set(d, box.bound[axis]), hn::Load(d, &block.bound[axis + 3][i]));
      const auto apart = hn::Max(hn::Max(ahead, behind), hn::Zero(d));
      sum = hn::Add(sum, hn::Mul(apart, apart));
    }
    sum = hn::Min(sum, hn::Set(d, kLaneMax));
    const auto least = hn::Sub(hn::Sub(sum, hn::Mul(sum, hn::Set(d, kQuerySlack))), hn::Set(d, kQueryTiny));
    const auto nonnegative = hn::Max(least, hn::Zero(d));
    hn::StoreU(nonnegative, d, squares + i);
    const auto isBox = hn::Lt(hn::Load(d, &block.bound[0][i]), hn::Set(d, kNever));
    return hn::And(isBox, hn::Le(nonnegative, hn::Set(d, limit)));
  });
}

/// The cheapest of some lanes, the first of several.
std::size_t cheapestLane(std::uint32_t lanes, const float* costs) {
  const FloatTag d;
  const IdTag du;
  const auto isAmong = [&](std::size_t i) HWY_ATTR {
    const auto bit = hn::Shl(hn::Set(du, 1U), numbersFrom(i));
    return hn::RebindMask(d, hn::Ne(hn::And(bit, hn::Set(du, lanes)), hn::Zero(du)));
  };
  const auto costsOf = [&](std::size_t i)
                           HWY_ATTR { return hn::IfThenElse(isAmong(i), hn::LoadU(d, costs + i), hn::Set(d, kNever)); };
  auto least = costsOf(0);
  for (std::size_t i = hn::Lanes(d); i < kFanOut; i += hn::Lanes(d)) least = hn::Min(least, costsOf(i));
  const auto everywhere = hn::MinOfLanes(d, least);
  const std::uint32_t cheapest = bitsOfBlock([&](std::size_t i) HWY_ATTR { return hn::Eq(costsOf(i), everywhere); });
  return hwy::Num0BitsBelowLS1Bit_Nonzero32(cheapest & lanes);
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_QUERY_KERNEL_INL_H
