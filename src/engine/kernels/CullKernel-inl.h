// SPDX-License-Identifier: MIT
// Boxes as they lie in the caller's memory against one box: which of them may touch it, and whether any value is a NaN.

#if defined(ALLPAIRS_CULL_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_CULL_KERNEL_INL_H
#undef ALLPAIRS_CULL_KERNEL_INL_H
#else
#define ALLPAIRS_CULL_KERNEL_INL_H
#endif

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/Kernels.h"
#include "kernels/LaneTest-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// Whether no bound of box i lies beyond the box, and box i is not empty.
template <class T>
HWY_INLINE bool touches(const BoxRun<T>& run, std::size_t i, const std::array<T, 6>& box) {
  const T* const min = run.min + i * run.stride;
  const T* const max = run.max + i * run.stride;
  bool inside = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    inside &= (min[axis] <= box[axis + 3]) & (max[axis] >= box[axis]) & (min[axis] <= max[axis]);
  }
  return inside;
}

#if HWY_TARGET != HWY_SCALAR

/// What three vectors of bounds are compared with: corners follow each other in them, minima, maxima, or both in turns.
/// Maxima are negated, so that one comparison serves both.
template <class T>
struct CornerLimits {
  using Tag = hn::CappedTag<T, kFanOut>;
  enum class Corners : std::uint8_t { Min, Max, Both };

  hn::Vec<Tag> sign[3];
  hn::Vec<Tag> limit[3];

  HWY_INLINE CornerLimits(const std::array<T, 6>& box, Corners corners) {
    const Tag d;
    std::array<T, 3 * kFanOut> signs;
    std::array<T, 3 * kFanOut> limits;
    for (std::size_t i = 0; i < 3 * hn::Lanes(d); ++i) {
      const bool isMax = corners == Corners::Both ? i / 3 % 2 == 1 : corners == Corners::Max;
      signs[i] = isMax ? T{-0.0} : T{0.0};
      limits[i] = isMax ? -box[i % 3] : box[i % 3 + 3];
    }
    for (std::size_t k = 0; k < 3; ++k) sign[k] = hn::LoadU(d, &signs[k * hn::Lanes(d)]);
    for (std::size_t k = 0; k < 3; ++k) limit[k] = hn::LoadU(d, &limits[k * hn::Lanes(d)]);
  }

  /// A bit for each corner that is within the limits, at the place of its first value.
  [[nodiscard]] HWY_INLINE std::uint64_t within(const T* values) const {
    const Tag d;
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto value = hn::Xor(hn::LoadU(d, values + k * hn::Lanes(d)), sign[k]);
      bits |= std::uint64_t{allBitsOf(d, hn::Le(value, limit[k]))} << (k * hn::Lanes(d));
    }
    return bits & bits >> 1 & bits >> 2;
  }
};

/// A bit for each three values that are not above those at the same places of another corner, at the place of the first.
template <class T>
HWY_INLINE std::uint64_t areBelow(const T* min, const T* max) {
  const hn::CappedTag<T, kFanOut> d;
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < 3 * hn::Lanes(d); k += hn::Lanes(d)) {
    bits |= std::uint64_t{allBitsOf(d, hn::Le(hn::LoadU(d, min + k), hn::LoadU(d, max + k)))} << k;
  }
  return bits & bits >> 1 & bits >> 2;
}

/// A bit for each of so many boxes, one at every so many places.
template <std::size_t kStep>
HWY_INLINE std::uint64_t bitsOfAll(std::size_t boxes) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < boxes; ++i) bits |= std::uint64_t{1} << (i * kStep);
  return bits;
}

/// Writes the numbers of boxes whose bits are set, those of `all` or some of them, one at every kStep places; returns where they
/// end.
template <std::size_t kStep>
HWY_INLINE std::uint32_t* writeNumbers(std::uint64_t bits, std::uint64_t all, std::size_t first,
                                       std::uint32_t* numbers) {
  if (bits == all) {
    const IdTag d;
    const auto count = static_cast<std::size_t>(std::popcount(all));
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) hn::StoreU(numbersFrom(first + i), d, numbers + i);
    return numbers + count;
  }
  for (; bits != 0; bits &= bits - 1) {
    *numbers++ = static_cast<std::uint32_t>(first + static_cast<std::size_t>(std::countr_zero(bits)) / kStep);
  }
  return numbers;
}

/// Those of whole vectors, which other boxes follow where three values more are read; `end` is the box that follows the last one.
template <class T>
HWY_INLINE std::uint32_t* touchingWhole(const BoxRun<T>& run, const std::array<T, 6>& box, std::uint32_t* numbers,
                                        std::size_t& end) {
  using Limits = CornerLimits<T>;
  const std::size_t lanes = hn::Lanes(typename Limits::Tag());
  if (run.stride == 6) {
    const Limits both(box, Limits::Corners::Both);
    const std::uint64_t all = bitsOfAll<6>(lanes / 2);
    for (; end + lanes / 2 < run.size; end += lanes / 2) {
      const T* const values = run.min + 6 * end;
      const std::uint64_t corners = both.within(values);
      const std::uint64_t bits = corners & corners >> 3 & all;
      if (bits != 0) numbers = writeNumbers<6>(bits & areBelow(values, values + 3), all, end, numbers);
    }
    return numbers;
  }
  const Limits lower(box, Limits::Corners::Min);
  const Limits upper(box, Limits::Corners::Max);
  const std::uint64_t all = bitsOfAll<3>(lanes);
  for (; end + lanes <= run.size; end += lanes) {
    const T* const min = run.min + 3 * end;
    const T* const max = run.max + 3 * end;
    const std::uint64_t bits = lower.within(min) & upper.within(max) & all;
    if (bits != 0) numbers = writeNumbers<3>(bits & areBelow(min, max), all, end, numbers);
  }
  return numbers;
}

#endif

template <class T>
std::size_t touchingBoxes(const BoxRun<T>& run, const std::array<T, 6>& box, std::uint32_t* numbers) {
  std::uint32_t* last = numbers;
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  last = touchingWhole(run, box, last, i);
#endif
  for (; i < run.size; ++i) {
    *last = static_cast<std::uint32_t>(i);
    last += touches(run, i, box) ? 1 : 0;
  }
  return static_cast<std::size_t>(last - numbers);
}

template <class T>
bool anyNan(const T* values, std::size_t size) {
  const hn::CappedTag<T, kFanOut> d;
  const std::size_t lanes = hn::Lanes(d);
  // Two vectors at once: their flags are collected without waiting for each other.
  auto first = hn::IsNaN(hn::Zero(d));
  auto second = first;
  std::size_t i = 0;
  for (; i + 2 * lanes <= size; i += 2 * lanes) {
    first = hn::Or(first, hn::IsNaN(hn::LoadU(d, values + i)));
    second = hn::Or(second, hn::IsNaN(hn::LoadU(d, values + i + lanes)));
  }
  bool found = !hn::AllFalse(d, hn::Or(first, second));
  for (; i < size; ++i) found |= values[i] != values[i];
  return found;
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_CULL_KERNEL_INL_H
