// SPDX-License-Identifier: MIT
// Sixteen boxes from rows of six in the caller's memory to a block of lanes, and the bounds of such blocks.

#if defined(ALLPAIRS_READ_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_READ_KERNEL_INL_H
#undef ALLPAIRS_READ_KERNEL_INL_H
#else
#define ALLPAIRS_READ_KERNEL_INL_H
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernels/Kernels.h"
#include "kernels/LaneTest-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

using DoubleTag = hn::CappedTag<double, kFanOut>;
using HalfFloatTag = hn::Rebind<float, DoubleTag>;

/// Keeps values within the finite ones; `same` stays true if that changed nothing.
HWY_INLINE FloatVector finite(FloatVector value, bool& same) {
  const FloatTag d;
  const auto inside = hn::Max(hn::Set(d, -kLaneMax), hn::Min(value, hn::Set(d, kLaneMax)));
  same = same && hn::AllTrue(d, hn::Eq(inside, value));
  return inside;
}

/// Which of sixteen boxes are empty, as bits.
HWY_INLINE std::uint32_t emptyLanes(const LaneBlock& block) {
  const FloatTag d;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(d)) {
    const auto inverted = [&](std::size_t axis) HWY_ATTR {
      return hn::Gt(hn::Load(d, &block.bound[axis][i]), hn::Load(d, &block.bound[axis + 3][i]));
    };
    bits |= bitsOf(d, hn::Or(hn::Or(inverted(0), inverted(1)), inverted(2))) << i;
  }
  return bits;
}

#if HWY_TARGET == HWY_SCALAR

/// One box from its row of six.
HWY_INLINE bool readRows(const float* rows, LaneBlock& block, std::size_t at) {
  const FloatTag d;
  bool same = true;
  for (std::size_t row = 0; row < 6; ++row)
    hn::StoreU(finite(hn::LoadU(d, rows + row), same), d, &block.bound[row][at]);
  return same;
}

#else

/// As many boxes as a vector has lanes, from rows of six that follow each other; returns whether they are finite.
HWY_INLINE bool readRows(const float* rows, LaneBlock& block, std::size_t at) {
  const FloatTag d;
  // Three values make a corner; corners alternate between minimum and maximum.
  FloatVector corners[2][3];
  for (std::size_t half = 0; half < 2; ++half) {
    hn::LoadInterleaved3(d, rows + 3 * hn::Lanes(d) * half, corners[half][0], corners[half][1], corners[half][2]);
  }
  bool same = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto min = hn::ConcatEven(d, corners[1][axis], corners[0][axis]);
    const auto max = hn::ConcatOdd(d, corners[1][axis], corners[0][axis]);
    hn::Store(finite(min, same), d, &block.bound[axis][at]);
    hn::Store(finite(max, same), d, &block.bound[axis + 3][at]);
  }
  return same;
}

#endif

#if HWY_TARGET == HWY_SCALAR

/// One box from its row, anywhere in memory.
HWY_INLINE bool readScattered(const float* rows, const std::int32_t* offsets, LaneBlock& block, std::size_t at) {
  return readRows(rows + offsets[0], block, at);
}

#else

/// Four values that follow each other of every fourth box: those of box 4k are in block k of 128 bits.
template <class D>
HWY_INLINE hn::Vec<D> everyFourth(D d, const float* values, const std::int32_t* offsets) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::LoadU(d, values + offsets[0]);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, everyFourth(half, values, offsets + hn::MaxLanes(D()) / 2),
                       everyFourth(half, values, offsets));
  }
}

/// Two vectors of a value each from four of two values each.
HWY_INLINE void zip(FloatVector first, FloatVector second, FloatVector& lower, FloatVector& upper) {
  const FloatTag d;
  const hn::Repartition<double, FloatTag> pairs;
  lower = hn::BitCast(d, hn::InterleaveLower(pairs, hn::BitCast(pairs, first), hn::BitCast(pairs, second)));
  upper = hn::BitCast(d, hn::InterleaveUpper(pairs, hn::BitCast(pairs, first), hn::BitCast(pairs, second)));
}

/// As many boxes as a vector has lanes, from rows anywhere in memory; returns whether they are finite.
///
/// Rows are loaded and transposed, which takes half the time of gathering each bound.
HWY_INLINE bool readScattered(const float* rows, const std::int32_t* offsets, LaneBlock& block, std::size_t at) {
  const FloatTag d;
  FloatVector first[4];
  FloatVector last[4];
  for (std::size_t j = 0; j < 4; ++j) {
    first[j] = everyFourth(d, rows, offsets + j);
    last[j] = everyFourth(d, rows + 2, offsets + j);
  }
  FloatVector bound[6];
  zip(hn::InterleaveLower(d, first[0], first[1]), hn::InterleaveLower(d, first[2], first[3]), bound[0], bound[1]);
  zip(hn::InterleaveUpper(d, first[0], first[1]), hn::InterleaveUpper(d, first[2], first[3]), bound[2], bound[3]);
  zip(hn::InterleaveUpper(d, last[0], last[1]), hn::InterleaveUpper(d, last[2], last[3]), bound[4], bound[5]);
  bool same = true;
  for (std::size_t row = 0; row < 6; ++row) hn::Store(finite(bound[row], same), d, &block.bound[row][at]);
  return same;
}

#endif

/// Sixteen boxes from rows that follow each other.
BlockRead readRun32(const float* rows, LaneBlock& block) {
  BlockRead result;
  for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(FloatTag())) result.exact &= readRows(rows + 6 * i, block, i);
  result.emptyLanes = emptyLanes(block);
  return result;
}

#if HWY_TARGET <= HWY_AVX3

/// The greatest float32 that are not above: an instruction that AVX-512 has.
HWY_INLINE hn::Vec<HalfFloatTag> demoteDown(hn::Vec<DoubleTag> value) {
  return hn::Vec<HalfFloatTag>{_mm512_cvt_roundpd_ps(value.raw, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC)};
}

#else

/// The next float32 below where `further` says so. Zero never has to go down: see roundDown().
HWY_INLINE hn::Vec<HalfFloatTag> stepDown(hn::Vec<HalfFloatTag> value, hn::Mask<HalfFloatTag> further) {
  const HalfFloatTag d;
  const hn::RebindToSigned<HalfFloatTag> di;
  const auto bits = hn::BitCast(di, value);
  // -1 for a positive number, +1 for a negative one.
  const auto step = hn::Or(hn::Not(hn::ShiftRight<31>(bits)), hn::Set(di, 1));
  const auto moved = hn::BitCast(d, hn::Add(bits, step));
  return hn::IfThenElse(further, moved, value);
}

/// The greatest float32 that are not above.
HWY_INLINE hn::Vec<HalfFloatTag> demoteDown(hn::Vec<DoubleTag> value) {
  const DoubleTag d;
  const HalfFloatTag df;
  const auto nearest = hn::DemoteTo(df, value);
  const auto above = hn::Gt(hn::PromoteTo(d, nearest), value);
  const auto further = hn::Gt(hn::DemoteTo(df, hn::IfThenElseZero(above, hn::Set(d, 1.0))), hn::Zero(df));
  return stepDown(nearest, further);
}

#endif

/// float64 rounded down to float32 and kept within the finite ones; `same` stays true if that changed nothing.
HWY_INLINE hn::Vec<HalfFloatTag> lower(hn::Vec<DoubleTag> value, bool& same) {
  const DoubleTag d;
  const auto most = hn::Set(d, static_cast<double>(kLaneMax));
  const auto down = demoteDown(hn::Max(hn::Neg(most), hn::Min(value, most)));
  same = same && hn::AllTrue(d, hn::Eq(hn::PromoteTo(d, down), value));
  return down;
}

BlockRead readFloat32(const float* rows, const std::int32_t* offsets, LaneBlock& block) {
  bool exact = true;
  for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(FloatTag())) exact &= readScattered(rows, offsets + i, block, i);
  return {exact, emptyLanes(block)};
}

/// Emptiness is tested in double: rounded outward, an empty box may no longer be empty.
BlockRead readFloat64(const double* rows, const std::int32_t* offsets, const std::array<double, 3>& origin,
                      LaneBlock& block) {
  const DoubleTag d;
  const HalfFloatTag df;
  const hn::Rebind<std::int32_t, DoubleTag> di;
  BlockRead result;
  for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(d)) {
    const auto offset = hn::PromoteTo(hn::RebindToSigned<DoubleTag>(), hn::LoadU(di, offsets + i));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto from = hn::Set(d, origin[axis]);
      const auto min = hn::GatherIndex(d, rows + axis, offset);
      const auto max = hn::GatherIndex(d, rows + axis + 3, offset);
      result.emptyLanes |= bitsOf(d, hn::Gt(min, max)) << i;
      hn::StoreU(lower(hn::Sub(min, from), result.exact), df, &block.bound[axis][i]);
      hn::StoreU(hn::Neg(lower(hn::Sub(from, max), result.exact)), df, &block.bound[axis + 3][i]);
    }
  }
  return result;
}

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

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_READ_KERNEL_INL_H
