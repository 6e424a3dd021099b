// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

namespace allpairs::generate {

// Roots and sines from the four operations alone, which IEEE 754 defines to the last bit; those of the platforms'
// mathematical libraries do not agree with each other.

/// The cube root of a positive number, by Newton's method.
[[nodiscard]] inline double cubeRoot(double value) noexcept {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  const int third = exponent / 3;
  const double scaled = std::ldexp(mantissa, exponent - 3 * third);
  double root = 1.0;
  constexpr int kSteps = 8;  // From 1 to a number in (0.5, 1.6) at full precision.
  for (int step = 0; step < kSteps; ++step) root = (2.0 * root + scaled / (root * root)) / 3.0;
  return std::ldexp(root, third);
}

/// The cosine and sine of `turns` full turns.
[[nodiscard]] inline std::array<double, 2> cosineAndSine(double turns) noexcept {
  constexpr double kTurn = 6.283185307179586;
  constexpr int kHalvings = 5;  // The angle is below 0.2, where five terms of the series give every bit.
  const double x = (turns - std::floor(turns)) * kTurn / 32.0;
  const double x2 = x * x;
  double cosine = 1.0 - x2 / 2.0 * (1.0 - x2 / 12.0 * (1.0 - x2 / 30.0 * (1.0 - x2 / 56.0 * (1.0 - x2 / 90.0))));
  double sine = x * (1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0 * (1.0 - x2 / 72.0 * (1.0 - x2 / 110.0)))));
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double doubled = 2.0 * sine * cosine;
    cosine = cosine * cosine - sine * sine;
    sine = doubled;
  }
  return {cosine, sine};
}

}  // namespace allpairs::generate
