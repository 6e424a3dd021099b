// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace allpairs::generate {

/// Numbers that are a function of (seed, box, draw) and of nothing else, so that scenes are the same everywhere; the
/// distributions of the standard library differ from one implementation to the next.
///
/// Reference: the mixing function of SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators,
///            OOPSLA 2014), used on a counter.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t box) noexcept : m_state(mix(mix(seed + kStep) ^ (box * kStep + kStep))) {}

  /// 64 random bits.
  std::uint64_t bits() noexcept { return mix(m_state += kStep); }

  /// From [0, 1), a multiple of 2^-53.
  double unit() noexcept { return static_cast<double>(bits() >> 11U) * 0x1.0p-53; }

  /// From [low, high).
  double between(double low, double high) noexcept { return low + (high - low) * unit(); }

  /// From {0, ..., count - 1}.
  std::size_t below(std::size_t count) noexcept {
    return static_cast<std::size_t>(unit() * static_cast<double>(count));
  }

  /// Bell-shaped about 0 with standard deviation 1: the sum of twelve draws, never beyond 6. No logarithm or sine of
  /// the platform's takes part.
  double bell() noexcept {
    double sum = -6.0;
    for (int draw = 0; draw < 12; ++draw) sum += unit();
    return sum;
  }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15U;

  static std::uint64_t mix(std::uint64_t z) noexcept {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }

  std::uint64_t m_state;
};

}  // namespace allpairs::generate
