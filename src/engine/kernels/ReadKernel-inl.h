// SPDX-License-Identifier: MIT
// Sixteen boxes from the caller's memory to a block of lanes, and the bounds and the keys along the curve of such
// blocks.

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
#include <limits>
#include <span>

#include "kernels/CurveGrid.h"
#include "kernels/Kernels.h"
#include "kernels/LaneTest-inl.h"
#include "kernels/LoadKernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

using HalfFloatTag = hn::Rebind<float, DoubleTag>;

/// Keeps values within the finite ones; `same` stays true if that changed nothing.
HWY_INLINE FloatVector finite(FloatVector value, bool& same) {
  const FloatTag d;
  const auto inside = hn::Max(hn::Set(d, -kLaneMax), hn::Min(value, hn::Set(d, kLaneMax)));
  same = same && hn::AllTrue(d, hn::Eq(inside, value));
  return inside;
}

/// Keeps the bounds of boxes within the finite ones. Which boxes are empty is told before that: a bound at infinity may
/// be inverted with the largest finite number, which is then its own.
HWY_INLINE void storeFinite(const FloatVector (&bound)[6], LaneBlock& block, std::size_t at, BlockRead& result) {
  const FloatTag d;
  const auto inverted = [&](std::size_t axis) HWY_ATTR { return hn::Gt(bound[axis], bound[axis + 3]); };
  result.emptyLanes |= bitsOf(d, hn::Or(hn::Or(inverted(0), inverted(1)), inverted(2))) << at;
  for (std::size_t k = 0; k < 6; ++k) hn::StoreU(finite(bound[k], result.exact), d, &block.bound[k][at]);
}

/// Sixteen boxes from rows that follow each other.
BlockRead readRun32(const float* rows, LaneBlock& block) {
  BlockRead result;
  for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(FloatTag())) {
    FloatVector bound[6];
    loadRows(rows + 6 * i, bound);
    storeFinite(bound, block, i, result);
  }
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

/// float64 rounded down to float32, the lowest for a NaN, or to the nearest, which is for no NaN, and kept within the
/// finite ones; `same` stays true if that changed nothing.
template <bool kToNearest>
HWY_INLINE hn::Vec<HalfFloatTag> rounded(hn::Vec<DoubleTag> value, bool& same) {
  const DoubleTag d;
  const auto most = hn::Set(d, static_cast<double>(kLaneMax));
  const auto least = hn::Neg(most);
  const auto above = kToNearest ? hn::Max(value, least) : hn::IfThenElse(hn::Gt(value, least), value, least);
  const auto inside = hn::Min(above, most);
  const auto result = kToNearest ? hn::DemoteTo(HalfFloatTag(), inside) : demoteDown(inside);
  same = same && hn::AllTrue(d, hn::Eq(hn::PromoteTo(d, result), value));
  return result;
}

BlockRead readFloat32(const BoxPlaces<float>& places, LaneBlock& block) {
  BlockRead result;
  for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(FloatTag())) {
    FloatVector bound[6];
    loadBoxes(places, i, bound);
    storeFinite(bound, block, i, result);
  }
  return result;
}

/// A minimum, or a negated maximum, widened by half a distance and a margin, and by a slack that is larger than what
/// all roundings of the exact expression, max + ((distance + margin) + margin), can add up to. Infinity stays what it
/// is, unless it is taken from itself: that is a NaN.
HWY_INLINE DoubleVector widened(DoubleVector bound, DoubleVector halfDistance, DoubleVector margin) {
  const DoubleTag d;
  const auto sum = hn::Add(halfDistance, margin);
  // The sum of a distance and two margins is infinite if it overflows, to which one of them has to be large.
  const auto half = hn::IfThenElse(hn::Lt(sum, hn::Set(d, 0x1p1022)), sum, hn::Inf(d));
  const auto magnitude = hn::Add(hn::Abs(halfDistance), hn::Abs(margin));
  const auto units = hn::Set(d, 0x1p-48);  // Sixteen units in the last place of a double.
  const auto finite = hn::Min(hn::Add(hn::Abs(bound), magnitude), hn::Set(d, std::numeric_limits<double>::max()));
  return hn::Sub(hn::Sub(bound, half), hn::Mul(units, finite));
}

/// Sixteen boxes whose bounds are read as doubles: load(i, bound) reads those of the boxes from i on.
///
/// Emptiness is tested before anything is added: rounded outward, an empty box may no longer be empty. A negative
/// margin may invert a box, which can still overlap a larger one; with its bounds swapped it is no smaller.
template <bool kWidens, class Load>
HWY_INLINE BlockRead readOutward(const Load& load, const Widening& widening, LaneBlock& block) {
  const DoubleTag d;
  const HalfFloatTag df;
  BlockRead result{.exact = !kWidens};
  for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(d)) {
    const auto half = hn::Set(d, widening.half);
    const auto margin = widening.margins != nullptr ? hn::LoadU(d, widening.margins + i) : hn::Zero(d);
    DoubleVector bound[6];
    load(i, bound);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto from = hn::Set(d, widening.origin[axis]);
      auto min = bound[axis];
      auto max = hn::Neg(bound[axis + 3]);
      result.emptyLanes |= bitsOf(d, hn::Gt(min, hn::Neg(max))) << i;
      if constexpr (kWidens) {
        min = widened(min, half, margin);
        max = widened(max, half, margin);
      }
      auto low = rounded<false>(hn::Sub(min, from), result.exact);
      auto high = hn::Neg(rounded<false>(hn::Add(max, from), result.exact));
      if constexpr (kWidens) {
        const auto swapped = hn::Min(low, high);
        high = hn::Max(low, high);
        low = swapped;
      }
      hn::StoreU(low, df, &block.bound[axis][i]);
      hn::StoreU(high, df, &block.bound[axis + 3][i]);
    }
  }
  return result;
}

/// The same of bounds that are not widened, rounded to the nearest float32. Minima and maxima are rounded alike, so
/// that the order of any two is kept whatever the direction is in which threads round, if all do alike.
template <class Load>
HWY_INLINE BlockRead readNearest(const Load& load, const std::array<double, 3>& origin, LaneBlock& block) {
  const DoubleTag d;
  BlockRead result;
  for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(d)) {
    DoubleVector bound[6];
    load(i, bound);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.emptyLanes |= bitsOf(d, hn::Gt(bound[axis], bound[axis + 3])) << i;
    }
    for (std::size_t k = 0; k < 6; ++k) {
      const auto lanes = rounded<true>(hn::Sub(bound[k], hn::Set(d, origin[k % 3])), result.exact);
      hn::StoreU(lanes, HalfFloatTag(), &block.bound[k][i]);
    }
  }
  return result;
}

template <class Load>
HWY_INLINE BlockRead readDoubles(const Load& load, const Widening& widening, LaneBlock& block) {
  if (widening.widens) return readOutward<true>(load, widening, block);
  return widening.toNearest ? readNearest(load, widening.origin, block) : readOutward<false>(load, widening, block);
}

BlockRead readWide32(const BoxPlaces<float>& places, const Widening& widening, LaneBlock& block) {
  LaneBlock bounds;
  for (std::size_t i = 0; i < kFanOut; i += hn::Lanes(FloatTag())) {
    FloatVector bound[6];
    loadBoxes(places, i, bound);
    for (std::size_t k = 0; k < 6; ++k) hn::Store(bound[k], FloatTag(), &bounds.bound[k][i]);
  }
  const auto load = [&bounds](std::size_t i, DoubleVector* bound) HWY_ATTR {
    for (std::size_t k = 0; k < 6; ++k) {
      bound[k] = hn::PromoteTo(DoubleTag(), hn::LoadU(HalfFloatTag(), &bounds.bound[k][i]));
    }
  };
  return readDoubles(load, widening, block);
}

BlockRead readWide64(const BoxPlaces<double>& places, const Widening& widening, LaneBlock& block) {
  const auto load = [&places](std::size_t i, DoubleVector* bound) HWY_ATTR { loadBoxes(places, i, bound); };
  return readDoubles(load, widening, block);
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

/// The cell of the centres along an axis.
HWY_INLINE hn::Vec<IdTag> cells(const LaneBlock& block, std::size_t lane, std::size_t axis, const CurveGrid& grid) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  const auto lastCell = hn::Set(d, static_cast<float>((1U << grid.bitsPerAxis) - 1));
  // Half of each bound first: their sum may be too large for a float32.
  const auto half = hn::Set(d, 0.5F);
  const auto centre = hn::Add(hn::Mul(half, hn::Load(d, &block.bound[axis][lane])),
                              hn::Mul(half, hn::Load(d, &block.bound[axis + 3][lane])));
  const auto position = hn::Mul(hn::Sub(centre, hn::Set(d, grid.origin[axis])), hn::Set(d, grid.scale));
  // A NaN, of an infinite distance times a scale of 0, fails the comparison and goes to cell 0.
  const auto inside = hn::IfThenElseZero(hn::Gt(position, hn::Zero(d)), position);
  return hn::BitCast(IdTag(), hn::ConvertTo(di, hn::Min(inside, lastCell)));
}

/// The bits of a number below 2^10, each moved to three times its place.
HWY_INLINE hn::Vec<IdTag> spreadBits(hn::Vec<IdTag> x) {
  const IdTag d;
  x = hn::And(hn::Or(x, hn::ShiftLeft<16>(x)), hn::Set(d, 0x030000FFU));
  x = hn::And(hn::Or(x, hn::ShiftLeft<8>(x)), hn::Set(d, 0x0300F00FU));
  x = hn::And(hn::Or(x, hn::ShiftLeft<4>(x)), hn::Set(d, 0x030C30C3U));
  return hn::And(hn::Or(x, hn::ShiftLeft<2>(x)), hn::Set(d, 0x09249249U));
}

/// One axis of a step of the curve: the cell is mirrored where the axis' bit is set, else turned with the first axis.
HWY_INLINE void turnAxis(hn::Vec<IdTag>& first, hn::Vec<IdTag>& axis, hn::Vec<IdTag> bit, hn::Vec<IdTag> below) {
  const auto isSet = hn::TestBit(axis, bit);
  const auto swapped = hn::IfThenZeroElse(isSet, hn::And(hn::Xor(first, axis), below));
  first = hn::Xor(first, hn::IfThenElse(isSet, below, swapped));
  axis = hn::Xor(axis, swapped);
}

/// Converts cells to positions along Hilbert's curve.
///
/// Reference: J. Skilling, "Programming the Hilbert curve", AIP Conference Proceedings 707, 2004.
struct Turn {
  hn::Vec<IdTag> x, y, z;

  HWY_INLINE Turn(const LaneBlock& block, std::size_t lane, const CurveGrid& grid)
      : x(cells(block, lane, grid.axes[0], grid)),
        y(cells(block, lane, grid.axes[1], grid)),
        z(cells(block, lane, grid.axes[2], grid)) {}

  /// The step of one bit; steps go from the highest bit down to the second.
  HWY_INLINE void step(hn::Vec<IdTag> bit, hn::Vec<IdTag> below) {
    x = hn::Xor(x, hn::IfThenElseZero(hn::TestBit(x, bit), below));
    turnAxis(x, y, bit, below);
    turnAxis(x, z, bit, below);
  }

  /// The key; call it after all steps.
  [[nodiscard]] HWY_INLINE hn::Vec<IdTag> key() const {
    const auto gray = hn::Xor(y, x);
    const auto last = hn::Xor(z, gray);
    auto parity = hn::ShiftRight<1>(last);
    parity = hn::Xor(parity, hn::ShiftRight<1>(parity));
    parity = hn::Xor(parity, hn::ShiftRight<2>(parity));
    parity = hn::Xor(parity, hn::ShiftRight<4>(parity));
    parity = hn::Xor(parity, hn::ShiftRight<8>(parity));
    const auto xy =
        hn::Or(hn::ShiftLeft<2>(spreadBits(hn::Xor(x, parity))), hn::ShiftLeft<1>(spreadBits(hn::Xor(gray, parity))));
    return hn::Or(xy, spreadBits(hn::Xor(last, parity)));
  }
};

HWY_INLINE FloatVector extents(const LaneBlock& block, std::size_t lane, std::size_t axis) {
  const FloatTag d;
  return hn::Sub(hn::Load(d, &block.bound[axis + 3][lane]), hn::Load(d, &block.bound[axis][lane]));
}

/// The keys of kBlocks blocks at once: a step depends on the previous one of the same block, not on other blocks.
template <std::size_t kBlocks>
HWY_INLINE void writeKeys(const LaneBlock* blocks, std::size_t lane, const CurveGrid& grid, std::uint32_t* keys) {
  static_assert(kBlocks == 1 || kBlocks == 2);
  const IdTag d;
  Turn first(blocks[0], lane, grid);
  Turn second = first;
  if constexpr (kBlocks == 2) second = Turn(blocks[1], lane, grid);
  for (std::uint32_t bit = 1U << (grid.bitsPerAxis - 1); bit > 1; bit >>= 1) {
    const auto q = hn::Set(d, bit);
    const auto below = hn::Set(d, bit - 1);
    first.step(q, below);
    if constexpr (kBlocks == 2) second.step(q, below);
  }
  hn::StoreU(first.key(), d, keys + lane);
  if constexpr (kBlocks == 2) hn::StoreU(second.key(), d, keys + kFanOut + lane);
}

/// Adds their class to the keys of large boxes.
HWY_INLINE void classify(const LaneBlock& block, const CurveGrid& grid, std::uint32_t* keys) {
  const FloatTag d;
  auto longest = hn::Zero(d);
  for (std::size_t lane = 0; lane < kFanOut; lane += hn::Lanes(d)) {
    const auto xy = hn::Max(extents(block, lane, 0), extents(block, lane, 1));
    longest = hn::Max(longest, hn::Max(xy, extents(block, lane, 2)));
  }
  if (hn::AllFalse(d, hn::Gt(longest, hn::Set(d, grid.largeExtent)))) return;
  for (std::size_t lane = 0; lane < kFanOut; ++lane) {
    const LaneBox box = block.get(lane);
    if (longestSide(box) > grid.largeExtent) keys[lane] |= grid.classOf(box) << grid.classShift();
  }
}

void curveKeys(std::span<const LaneBlock> blocks, const CurveGrid& grid, std::uint32_t* keys) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  std::size_t b = 0;
  for (; grid.isLine && b < blocks.size(); ++b) {
    for (std::size_t lane = 0; lane < kFanOut; lane += lanes) {
      hn::StoreU(cells(blocks[b], lane, grid.axes[2], grid), IdTag(), keys + b * kFanOut + lane);
    }
  }
  for (; b + 2 <= blocks.size(); b += 2) {
    for (std::size_t lane = 0; lane < kFanOut; lane += lanes) writeKeys<2>(&blocks[b], lane, grid, keys + b * kFanOut);
  }
  for (; b < blocks.size(); ++b) {
    for (std::size_t lane = 0; lane < kFanOut; lane += lanes) writeKeys<1>(&blocks[b], lane, grid, keys + b * kFanOut);
  }
  for (b = 0; b < blocks.size(); ++b) classify(blocks[b], grid, keys + b * kFanOut);
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_READ_KERNEL_INL_H
