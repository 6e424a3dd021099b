// SPDX-License-Identifier: MIT
// Keys along the curve, a block of boxes at a time.

#if defined(ALLPAIRS_CURVE_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_CURVE_KERNEL_INL_H
#undef ALLPAIRS_CURVE_KERNEL_INL_H
#else
#define ALLPAIRS_CURVE_KERNEL_INL_H
#endif

#include "CurveGrid.h"
#include "LaneTest-inl.h"

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

/// The place of a cell along Hilbert's curve, still as three numbers whose bits are to be interleaved.
///
/// Reference: J. Skilling, "Programming the Hilbert curve", AIP Conference Proceedings 707, 2004.
HWY_INLINE void turnCells(hn::Vec<IdTag>& x, hn::Vec<IdTag>& y, hn::Vec<IdTag>& z, unsigned bits) {
  const IdTag d;
  for (std::uint32_t bit = 1U << (bits - 1); bit > 1; bit >>= 1) {
    const auto q = hn::Set(d, bit);
    const auto below = hn::Set(d, bit - 1);
    x = hn::Xor(x, hn::IfThenElseZero(hn::TestBit(x, q), below));
    turnAxis(x, y, q, below);
    turnAxis(x, z, q, below);
  }
  y = hn::Xor(y, x);
  z = hn::Xor(z, y);
  auto parity = hn::ShiftRight<1>(z);
  parity = hn::Xor(parity, hn::ShiftRight<1>(parity));
  parity = hn::Xor(parity, hn::ShiftRight<2>(parity));
  parity = hn::Xor(parity, hn::ShiftRight<4>(parity));
  parity = hn::Xor(parity, hn::ShiftRight<8>(parity));
  x = hn::Xor(x, parity);
  y = hn::Xor(y, parity);
  z = hn::Xor(z, parity);
}

HWY_INLINE FloatVector extents(const LaneBlock& block, std::size_t lane, std::size_t axis) {
  const FloatTag d;
  return hn::Sub(hn::Load(d, &block.bound[axis + 3][lane]), hn::Load(d, &block.bound[axis][lane]));
}

void curveKeys(const LaneBlock& block, const CurveGrid& grid, std::uint32_t* keys) {
  const FloatTag d;
  const IdTag di;
  bool anyLarge = false;
  for (std::size_t lane = 0; lane < kFanOut; lane += hn::Lanes(d)) {
    auto x = cells(block, lane, grid.axes[0], grid);
    auto y = cells(block, lane, grid.axes[1], grid);
    auto z = cells(block, lane, grid.axes[2], grid);
    turnCells(x, y, z, grid.bitsPerAxis);
    const auto xy = hn::Or(hn::ShiftLeft<2>(spreadBits(x)), hn::ShiftLeft<1>(spreadBits(y)));
    hn::StoreU(hn::Or(xy, spreadBits(z)), di, keys + lane);
    const auto longest = hn::Max(extents(block, lane, 0), hn::Max(extents(block, lane, 1), extents(block, lane, 2)));
    anyLarge = anyLarge || !hn::AllFalse(d, hn::Gt(longest, hn::Set(d, grid.largeExtent)));
  }
  if (!anyLarge) return;
  for (std::size_t lane = 0; lane < kFanOut; ++lane) {
    const LaneBox box = block.get(lane);
    const float longest =
        HWY_MAX(box.bound[3] - box.bound[0], HWY_MAX(box.bound[4] - box.bound[1], box.bound[5] - box.bound[2]));
    if (longest > grid.largeExtent) keys[lane] |= grid.classOf(box) << grid.classShift();
  }
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_CURVE_KERNEL_INL_H
