// SPDX-License-Identifier: MIT
// Hits among boxes of float64 as the nearest float32, tested in double one by one. Rounding to the nearest keeps the
// order of two bounds or makes them equal, so that every pair is a hit, and a hit may be of boxes that are apart.

#if defined(ALLPAIRS_NEAREST_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_NEAREST_KERNEL_INL_H
#undef ALLPAIRS_NEAREST_KERNEL_INL_H
#else
#define ALLPAIRS_NEAREST_KERNEL_INL_H
#endif

#include <bit>
#include <cstddef>
#include <cstdint>

#include "kernels/LaneTest-inl.h"
#include "kernels/Lanes.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// Boxes of float64 in rows of six or three, of one set or two, tested one pair at a time.
class RowsTest {
 public:
  HWY_INLINE RowsTest(const BoxRun<double>& first, const BoxRun<double>& second) : m_first(first), m_second(second) {}

  [[nodiscard]] HWY_INLINE bool areHit(Pair pair) const {
    const double* const min = m_first.min + m_first.stride * pair.first;
    const double* const max = m_first.max + m_first.stride * pair.first;
    const double* const otherMin = m_second.min + m_second.stride * pair.second;
    const double* const otherMax = m_second.max + m_second.stride * pair.second;
    const hn::CappedTag<double, 4> d;
    // A vector has a value more than a corner, which after the last box may lie outside the caller's memory.
#if HWY_MEM_OPS_MIGHT_FAULT
    const bool isLast = pair.first + std::size_t{1} == m_first.size || pair.second + std::size_t{1} == m_second.size;
    if (hn::MaxLanes(d) < 4 || HWY_UNLIKELY(isLast)) return engine::areHit(min, max, otherMin, otherMax);
    const auto corner = [&](const double* values) HWY_ATTR { return hn::LoadU(d, values); };
#else
    if (hn::MaxLanes(d) < 4) return engine::areHit(min, max, otherMin, otherMax);
    const auto corner = [&](const double* values) HWY_ATTR { return hn::MaskedLoad(hn::FirstN(d, 3), d, values); };
#endif
    const auto from = hn::Max(corner(min), corner(otherMin));
    const auto to = hn::Min(corner(max), corner(otherMax));
    return (allBitsOf(d, hn::Le(from, to)) & 7U) == 7U;
  }

  /// Moves the pairs that are hits to the front; returns their number.
  [[nodiscard]] HWY_INLINE std::size_t select(Pair* pairs, std::size_t count) const {
    std::size_t size = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Pair pair = pairs[i];
      pairs[size] = pair;
      size += static_cast<std::size_t>(areHit(pair));
    }
    return size;
  }

  /// Of the boxes of a word of one set, as bits, those that a box hits.
  [[nodiscard]] HWY_NOINLINE std::uint64_t hitsOf(std::uint64_t bits, std::uint32_t box,
                                                  std::uint32_t firstOfWord) const {
    std::uint64_t hits = bits;
    for (; bits != 0; bits &= bits - 1) {
      const std::uint32_t other = firstOfWord + static_cast<std::uint32_t>(std::countr_zero(bits));
      if (!areHit({box, other})) hits ^= bits & (~bits + 1);
    }
    return hits;
  }

 private:
  BoxRun<double> m_first;
  BoxRun<double> m_second;
};

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_NEAREST_KERNEL_INL_H
