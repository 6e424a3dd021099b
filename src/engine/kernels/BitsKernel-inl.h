// SPDX-License-Identifier: MIT
// Pairs of a box with others that are bits of a word.

#if defined(ALLPAIRS_BITS_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_BITS_KERNEL_INL_H
#undef ALLPAIRS_BITS_KERNEL_INL_H
#else
#define ALLPAIRS_BITS_KERNEL_INL_H
#endif

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "allpairs/Pair.h"
#include "kernels/LaneTest-inl.h"
#include "kernels/Lanes.h"
#include "kernels/WorldsRun.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// So many bits, from the lowest on; fewer than a word has.
HWY_INLINE std::uint64_t lowBits(std::size_t count) { return ~(~std::uint64_t{0} << count); }

/// The position of the lowest bit; any number if there is none.
HWY_INLINE std::uint32_t lowestBit(std::uint64_t bits) {
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86_64
  return static_cast<std::uint32_t>(_tzcnt_u64(bits));
#else
  return static_cast<std::uint32_t>(std::countr_zero(bits | std::uint64_t{1} << 63));  // spares a test for no bits
#endif
}

/// Writes a box's pairs with the lowest so many bits of a word, and clears these. A function, not a lambda: GCC does
/// not inline a lambda that is called several times.
template <bool kBoxSecond, std::size_t kCount>
HWY_INLINE void writeLowest(std::uint64_t& bits, std::uint32_t box, std::uint32_t firstOfWord, Pair* to) {
  if constexpr (kCount != 0) {
    const std::uint32_t other = firstOfWord + lowestBit(bits);
    // Without the fences, which cost no instruction, compilers combine both into one number, or several pairs into a
    // vector, and either takes longer.
    to->first = kBoxSecond ? other : box;
    std::atomic_signal_fence(std::memory_order_acq_rel);
    to->second = kBoxSecond ? box : other;
    std::atomic_signal_fence(std::memory_order_acq_rel);
    bits &= bits - 1;
    writeLowest<kBoxSecond, kCount - 1>(bits, box, firstOfWord, to + 1);
  }
}

/// Writes the pairs of a box with those of a word: the first few without asking whether there are as many, which would
/// be mispredicted too often. Returns how many there are.
template <bool kBoxSecond, std::size_t kUnasked>
HWY_INLINE std::size_t writeBits(std::uint64_t bits, std::uint32_t box, std::uint32_t firstOfWord, Pair* pairs) {
  // Of the others: where there are many, a tenth of the time of all (few_benchmark).
  constexpr std::size_t kAtOnce = 4;
  static_assert(std::max(kUnasked, kAtOnce) <= kVectorSlack);
  const auto count = static_cast<std::size_t>(std::popcount(bits));
  writeLowest<kBoxSecond, kUnasked>(bits, box, firstOfWord, pairs);
  for (std::size_t i = kUnasked; i < count; i += kAtOnce) {
    writeLowest<kBoxSecond, kAtOnce>(bits, box, firstOfWord, pairs + i);
  }
  return count;
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_BITS_KERNEL_INL_H
