// SPDX-License-Identifier: MIT
// The bounds of as many boxes as a vector has lanes, from anywhere in the caller's memory.

#if defined(ALLPAIRS_LOAD_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_LOAD_KERNEL_INL_H
#undef ALLPAIRS_LOAD_KERNEL_INL_H
#else
#define ALLPAIRS_LOAD_KERNEL_INL_H
#endif

#include <cstddef>
#include <cstdint>

#include "kernels/Kernels.h"
#include "kernels/LaneTest-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

using DoubleTag = hn::CappedTag<double, kFanOut>;
using DoubleVector = hn::Vec<DoubleTag>;

/// As many boxes as a vector has lanes, from rows of six that follow each other.
HWY_INLINE void loadRows(const float* rows, FloatVector* bound) {
  const FloatTag d;
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t k = 0; k < 6; ++k) bound[k] = hn::LoadU(d, rows + k);
#else
  // Three values make a corner; corners alternate between minimum and maximum.
  FloatVector first[3];
  FloatVector last[3];
  hn::LoadInterleaved3(d, rows, first[0], first[1], first[2]);
  hn::LoadInterleaved3(d, rows + 3 * hn::Lanes(d), last[0], last[1], last[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    bound[axis] = hn::ConcatEven(d, last[axis], first[axis]);
    bound[axis + 3] = hn::ConcatOdd(d, last[axis], first[axis]);
  }
#endif
}

#if HWY_TARGET == HWY_SCALAR

/// One box from anywhere in memory.
HWY_INLINE void loadBoxes(const BoxPlaces<float>& places, std::size_t at, FloatVector* bound) {
  for (std::size_t k = 0; k < 6; ++k) bound[k] = hn::LoadU(FloatTag(), places.bound[k] + places.offset[at]);
}

#else

/// Three values, or four, that follow each other of every fourth box: those of box 4k are in block k of 128 bits.
template <std::size_t kValues, class D>
HWY_INLINE hn::Vec<D> everyFourth(D d, const float* values, const std::int32_t* offsets) {
  const hn::Half<D> half;
  if constexpr (hn::MaxLanes(D()) > 4) {
    return hn::Combine(d, everyFourth<kValues>(half, values, offsets + hn::MaxLanes(D()) / 2),
                       everyFourth<kValues>(half, values, offsets));
  } else if constexpr (kValues == 4) {
    return hn::LoadU(d, values + offsets[0]);
  } else {
    const hn::Half<decltype(half)> one;
    return hn::Combine(d, hn::ZeroExtendVector(half, hn::LoadU(one, values + offsets[0] + 2)),
                       hn::LoadU(half, values + offsets[0]));
  }
}

/// Two vectors of a value each from four of two values each.
HWY_INLINE void zip(FloatVector first, FloatVector second, FloatVector& lower, FloatVector& upper) {
  const FloatTag d;
  const hn::Repartition<double, FloatTag> pairs;
  lower = hn::BitCast(d, hn::InterleaveLower(pairs, hn::BitCast(pairs, first), hn::BitCast(pairs, second)));
  upper = hn::BitCast(d, hn::InterleaveUpper(pairs, hn::BitCast(pairs, first), hn::BitCast(pairs, second)));
}

/// The values 0 and 1, or 2 and 3, of four vectors of every fourth box.
HWY_INLINE void zipLower(const FloatVector* from, FloatVector& first, FloatVector& second) {
  const FloatTag d;
  zip(hn::InterleaveLower(d, from[0], from[1]), hn::InterleaveLower(d, from[2], from[3]), first, second);
}
HWY_INLINE void zipUpper(const FloatVector* from, FloatVector& first, FloatVector& second) {
  const FloatTag d;
  zip(hn::InterleaveUpper(d, from[0], from[1]), hn::InterleaveUpper(d, from[2], from[3]), first, second);
}

/// As many boxes as a vector has lanes, from corners anywhere in memory.
///
/// Corners are loaded and transposed, which takes half the time of gathering each bound. Of a row of six the second
/// load begins one value before the maximum, so that both are of four values.
template <std::size_t kValues>
HWY_INLINE void loadCorners(const BoxPlaces<float>& places, std::size_t at, FloatVector* bound) {
  const FloatTag d;
  const float* const second = places.bound[3] - (kValues - 3);
  FloatVector min[4];
  FloatVector max[4];
  for (std::size_t j = 0; j < 4; ++j) {
    min[j] = everyFourth<kValues>(d, places.bound[0], &places.offset[at + j]);
    max[j] = everyFourth<kValues>(d, second, &places.offset[at + j]);
  }
  FloatVector rest;
  zipLower(min, bound[0], bound[1]);
  zipUpper(min, bound[2], rest);
  if constexpr (kValues == 4) {
    zipLower(max, rest, bound[3]);
    zipUpper(max, bound[4], bound[5]);
  } else {
    zipLower(max, bound[3], bound[4]);
    zipUpper(max, bound[5], rest);
  }
}

/// Whether three values of a box follow each other.
template <class T>
HWY_INLINE bool isCorner(const T* const* axis) {
  return axis[1] == axis[0] + 1 && axis[2] == axis[0] + 2;
}

/// As many boxes as a vector has lanes, from anywhere in memory.
HWY_INLINE void loadBoxes(const BoxPlaces<float>& places, std::size_t at, FloatVector* bound) {
  const auto& from = places.bound;
  if (!isCorner(from.data()) || !isCorner(from.data() + 3)) {
    const FloatTag d;
    const auto offsets = hn::LoadU(hn::RebindToSigned<FloatTag>(), &places.offset[at]);
    for (std::size_t k = 0; k < 6; ++k) bound[k] = hn::GatherIndex(d, from[k], offsets);
  } else if (from[3] == from[0] + 3) {
    loadCorners<4>(places, at, bound);
  } else {
    loadCorners<3>(places, at, bound);
  }
}

#endif

#if HWY_TARGET == HWY_SCALAR

/// One box from anywhere in memory.
HWY_INLINE void loadBoxes(const BoxPlaces<double>& places, std::size_t at, DoubleVector* bound) {
  for (std::size_t k = 0; k < 6; ++k) bound[k] = hn::LoadU(DoubleTag(), places.bound[k] + places.offset[at]);
}

#else

/// Two values that follow each other, of every second box: those of box 2k are in block k of 128 bits.
template <class D>
HWY_INLINE hn::Vec<D> everySecond(D d, const double* values, const std::int32_t* offsets) {
  if constexpr (hn::MaxLanes(D()) > 2) {
    const hn::Half<D> half;
    return hn::Combine(d, everySecond(half, values, offsets + hn::MaxLanes(D()) / 2),
                       everySecond(half, values, offsets));
  } else {
    return hn::LoadU(d, values + offsets[0]);
  }
}

/// Two values that follow each other, of as many boxes as a vector has lanes.
HWY_INLINE void loadTwo(const double* values, const std::int32_t* offsets, DoubleVector& first, DoubleVector& second) {
  const DoubleTag d;
  const auto even = everySecond(d, values, offsets);
  const auto odd = everySecond(d, values, offsets + 1);
  first = hn::InterleaveLower(d, even, odd);
  second = hn::InterleaveUpper(d, even, odd);
}

/// As many boxes as a vector has lanes, from anywhere in memory. Rows and corners are loaded two values at a time and
/// transposed, which takes less than gathering each bound, on AMD's processors a third of it.
HWY_INLINE void loadBoxes(const BoxPlaces<double>& places, std::size_t at, DoubleVector* bound) {
  const auto& from = places.bound;
  const std::int32_t* const offsets = &places.offset[at];
  if (!isCorner(from.data()) || !isCorner(from.data() + 3)) {
    const hn::Rebind<std::int32_t, DoubleTag> places32;
    const auto places64 = hn::PromoteTo(hn::RebindToSigned<DoubleTag>(), hn::LoadU(places32, offsets));
    for (std::size_t k = 0; k < 6; ++k) bound[k] = hn::GatherIndex(DoubleTag(), from[k], places64);
  } else if (from[3] == from[0] + 3) {
    for (std::size_t k = 0; k < 6; k += 2) loadTwo(from[k], offsets, bound[k], bound[k + 1]);
  } else {
    for (std::size_t k = 0; k < 6; k += 3) {
      loadTwo(from[k], offsets, bound[k], bound[k + 1]);
      loadTwo(from[k + 1], offsets, bound[k + 1], bound[k + 2]);
    }
  }
}

#endif

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_LOAD_KERNEL_INL_H
