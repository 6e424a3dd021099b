// SPDX-License-Identifier: MIT
// Boxes as they lie in the caller's memory against one box: which of them touch it, the pairs of some such boxes, and
// whether any value is a NaN.

#if defined(ALLPAIRS_CULL_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_CULL_KERNEL_INL_H
#undef ALLPAIRS_CULL_KERNEL_INL_H
#else
#define ALLPAIRS_CULL_KERNEL_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/BitsKernel-inl.h"
#include "kernels/Kernels.h"
#include "kernels/LaneTest-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

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

/// A bit for each three values that are not above those at the same places of another corner, at the place of the
/// first.
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

/// The first kCount bits of those at every kStep places, next to each other.
template <std::size_t kStep, std::size_t kCount>
HWY_INLINE std::uint64_t closeUp(std::uint64_t bits) {
#if HWY_TARGET <= HWY_AVX3 && defined(__x86_64__)
  return _pext_u64(bits, bitsOfAll<kStep>(kCount));
#else
  std::uint64_t closed = 0;
  for (std::size_t i = 0; i < kCount; ++i) closed |= bits >> (i * (kStep - 1)) & std::uint64_t{1} << i;
  return closed;
#endif
}

/// The bits of whole vectors, which other boxes follow where three values more are read; returns the box that follows
/// the last one.
template <class T>
HWY_INLINE std::size_t touchWhole(const BoxRun<T>& run, const std::array<T, 6>& box, std::uint64_t* words) {
  using Limits = CornerLimits<T>;
  constexpr std::size_t kLanes = hn::MaxLanes(typename Limits::Tag());
  std::size_t i = 0;
  if (run.stride == 6) {
    const Limits both(box, Limits::Corners::Both);
    for (; i + kLanes / 2 < run.size; i += kLanes / 2) {
      const T* const values = run.min + 6 * i;
      const std::uint64_t corners = both.within(values);
      const std::uint64_t bits = corners & corners >> 3 & bitsOfAll<6>(kLanes / 2);
      if (bits == 0) continue;
      words[i / kWordBoxes] |= closeUp<6, kLanes / 2>(bits & areBelow(values, values + 3)) << (i % kWordBoxes);
    }
    return i;
  }
  const Limits lower(box, Limits::Corners::Min);
  const Limits upper(box, Limits::Corners::Max);
  for (; i + kLanes <= run.size; i += kLanes) {
    const T* const min = run.min + 3 * i;
    const T* const max = run.max + 3 * i;
    const std::uint64_t bits = lower.within(min) & upper.within(max) & bitsOfAll<3>(kLanes);
    if (bits != 0) words[i / kWordBoxes] |= closeUp<3, kLanes>(bits & areBelow(min, max)) << (i % kWordBoxes);
  }
  return i;
}

#endif

template <class T>
void touchBoxes(const BoxRun<T>& run, const std::array<T, 6>& box, std::uint64_t* words) {
  std::fill_n(words, (run.size + kWordBoxes - 1) / kWordBoxes, std::uint64_t{0});
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  i = touchWhole(run, box, words);
#endif
  const BoxRun<T> one{box.data(), box.data() + 3, 6, 1};
  for (; i < run.size; ++i) words[i / kWordBoxes] |= std::uint64_t{areHit(run, i, one, 0)} << (i % kWordBoxes);
}

/// With more pairs in a word they are selected by vectors, which takes the same time for any number (few_benchmark).
constexpr int kManyBits = 8;

/// Writes a vector of pairs, of which `ids` come first, or second.
template <bool kIdsSecond>
HWY_INLINE void storePairs(hn::Vec<IdTag> ids, hn::Vec<IdTag> others, Pair* pairs) {
  const IdTag d;
  auto* const to = reinterpret_cast<std::uint32_t*>(pairs);
  if (kIdsSecond) {
    hn::StoreInterleaved2(others, ids, d, to);
  } else {
    hn::StoreInterleaved2(ids, others, d, to);
  }
}

/// Writes the pairs of a row with a word of which many bits are set; returns how many there are.
template <bool kRowSecond>
HWY_INLINE std::size_t writeManyBits(std::uint64_t bits, std::uint32_t row, std::uint32_t firstOfWord, Pair* pairs) {
  const IdTag d;
  const auto rows = hn::Set(d, row);
  std::size_t size = 0;
  for (std::size_t i = 0; i < kWordBoxes; i += hn::Lanes(d), bits >>= hn::Lanes(d)) {
    const std::uint64_t some = bits & lowBits(hn::Lanes(d));
    storePairs<kRowSecond>(rows, lanesOfBits(d, numbersFrom(firstOfWord + i), some), pairs + size);
    size += static_cast<std::size_t>(std::popcount(some));
  }
  return size;
}

/// Pairs of boxes with a single one, most of which have no more than two in a word.
template <bool kOneSecond>
HWY_INLINE std::size_t writeTouchingOne(const TouchedBoxes& touched, Pair* pairs) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < touched.size; i += kWordBoxes) {
    const std::uint64_t bits = touched.words[0][i / kWordBoxes];
    const std::uint32_t first = touched.first + static_cast<std::uint32_t>(i);
    size += std::popcount(bits) > kManyBits ? writeManyBits<kOneSecond>(bits, touched.firstOther, first, pairs + size)
                                            : writeBits<kOneSecond, 2>(bits, touched.firstOther, first, pairs + size);
  }
  return size;
}

/// The lowest bits, as many as there is room for, each at so many times its place.
template <std::size_t kStep>
HWY_INLINE std::uint64_t spreadOut(std::uint64_t bits) {
  static_assert(kStep == 4 || kStep == 8);
  if (kStep == 4) {
    bits = (bits | bits << 24) & 0x000000FF000000FFU;
    bits = (bits | bits << 12) & 0x000F000F000F000FU;
    bits = (bits | bits << 6) & 0x0303030303030303U;
    return (bits | bits << 3) & 0x1111111111111111U;
  }
  bits = (bits | bits << 28) & 0x0000000F0000000FU;
  bits = (bits | bits << 14) & 0x0003000300030003U;
  return (bits | bits << 7) & 0x0101010101010101U;
}

/// Pairs of some boxes, from `first` on, with others: a bit for each, those of a box next to each other, of kStep
/// others.
template <std::size_t kStep, bool kOthersSecond>
HWY_INLINE std::size_t writeTouchingWord(std::uint64_t bits, std::uint32_t first, std::uint32_t firstOther,
                                         Pair* pairs) {
  const IdTag d;
  std::size_t size = 0;
  for (std::size_t i = 0; bits != 0; i += hn::Lanes(d), bits >>= hn::Lanes(d)) {
    const std::uint64_t some = bits & lowBits(hn::Lanes(d));
    const auto places = numbersFrom(i);
    const auto boxes = hn::Add(hn::ShiftRight<std::countr_zero(kStep)>(places), hn::Set(d, first));
    const auto others = hn::Add(hn::And(places, hn::Set(d, kStep - 1)), hn::Set(d, firstOther));
    storePairs<kOthersSecond>(lanesOfBits(d, others, some), lanesOfBits(d, boxes, some), pairs + size);
    size += static_cast<std::size_t>(std::popcount(some));
  }
  return size;
}

template <std::size_t kStep, bool kOthersSecond>
HWY_INLINE std::size_t writeTouchingSome(const TouchedBoxes& touched, Pair* pairs) {
  std::size_t size = 0;
  for (std::size_t word = 0; word * kWordBoxes < touched.size; ++word) {
    std::uint64_t any = 0;
    for (std::size_t k = 0; k < touched.others; ++k) any |= touched.words[k][word];
    if (any == 0) continue;
    for (std::size_t i = 0; i < kWordBoxes; i += kWordBoxes / kStep) {
      std::uint64_t bits = 0;
      for (std::size_t k = 0; k < touched.others; ++k) {
        bits |= spreadOut<kStep>(touched.words[k][word] >> i & lowBits(kWordBoxes / kStep)) << k;
      }
      const std::uint32_t first = touched.first + static_cast<std::uint32_t>(word * kWordBoxes + i);
      size += writeTouchingWord<kStep, kOthersSecond>(bits, first, touched.firstOther, pairs + size);
    }
  }
  return size;
}

template <bool kOthersSecond>
HWY_INLINE std::size_t writeTouching(const TouchedBoxes& touched, Pair* pairs) {
  static_assert(kMostOthers == 8);
  if (touched.others == 1) return writeTouchingOne<kOthersSecond>(touched, pairs);
  return touched.others <= 4 ? writeTouchingSome<4, kOthersSecond>(touched, pairs)
                             : writeTouchingSome<8, kOthersSecond>(touched, pairs);
}

std::size_t writeTouching(const TouchedBoxes& touched, bool othersSecond, Pair* pairs) {
  return othersSecond ? writeTouching<true>(touched, pairs) : writeTouching<false>(touched, pairs);
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
