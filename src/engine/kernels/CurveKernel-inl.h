// SPDX-License-Identifier: MIT
// Keys along the curve, a block of boxes at a time.

#if defined(ALLPAIRS_CURVE_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_CURVE_KERNEL_INL_H
#undef ALLPAIRS_CURVE_KERNEL_INL_H
#else
#define ALLPAIRS_CURVE_KERNEL_INL_H
#endif

#include <span>

#include "kernels/CurveGrid.h"
#include "kernels/LaneTest-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

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
    const float extent =
        HWY_MAX(box.bound[3] - box.bound[0], HWY_MAX(box.bound[4] - box.bound[1], box.bound[5] - box.bound[2]));
    if (extent > grid.largeExtent) keys[lane] |= grid.classOf(box) << grid.classShift();
  }
}

void curveKeys(std::span<const LaneBlock> blocks, const CurveGrid& grid, std::uint32_t* keys) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  std::size_t b = 0;
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

#endif  // ALLPAIRS_CURVE_KERNEL_INL_H
