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

/// Whether no bound of box i lies beyond the box.
template <class T>
HWY_INLINE bool mayTouch(const BoxRun<T>& run, std::size_t i, const std::array<T, 6>& box) {
  const T* const min = run.min + i * run.stride;
  const T* const max = run.max + i * run.stride;
  bool inside = true;
  for (std::size_t axis = 0; axis < 3; ++axis) inside &= (min[axis] <= box[axis + 3]) & (max[axis] >= box[axis]);
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

/// A bit at every so many places.
template <std::size_t kStep>
inline constexpr std::uint64_t kEvery = [] {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 64; i += kStep) bits |= std::uint64_t{1} << i;
  return bits;
}();

/// Writes the numbers of boxes whose bits are set, one at every kStep places; returns where they end.
template <std::size_t kStep>
HWY_INLINE std::uint32_t* writeNumbers(std::uint64_t bits, std::size_t first, std::uint32_t* numbers) {
  for (bits &= kEvery<kStep>; bits != 0; bits &= bits - 1) {
    *numbers++ = static_cast<std::uint32_t>(first + static_cast<std::size_t>(std::countr_zero(bits)) / kStep);
  }
  return numbers;
}

/// Those of whole vectors; `end` is the box that follows the last one.
template <class T>
HWY_INLINE std::uint32_t* touchingWhole(const BoxRun<T>& run, const std::array<T, 6>& box, std::uint32_t* numbers,
                                        std::size_t& end) {
  using Limits = CornerLimits<T>;
  const std::size_t lanes = hn::Lanes(typename Limits::Tag());
  if (run.stride == 6) {
    const Limits both(box, Limits::Corners::Both);
    for (; end + lanes / 2 <= run.size; end += lanes / 2) {
      const std::uint64_t bits = both.within(run.min + 6 * end);
      numbers = writeNumbers<6>(bits & bits >> 3, end, numbers);
    }
    return numbers;
  }
  const Limits lower(box, Limits::Corners::Min);
  const Limits upper(box, Limits::Corners::Max);
  for (; end + lanes <= run.size; end += lanes) {
    numbers = writeNumbers<3>(lower.within(run.min + 3 * end) & upper.within(run.max + 3 * end), end, numbers);
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
    last += mayTouch(run, i, box) ? 1 : 0;
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
