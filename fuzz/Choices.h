// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "Target.h"
#include "allpairs/Box.h"

namespace allpairs::fuzz {

/// Decisions read from the input, one after the other; all zero once the input is used up.
class Choices {
 public:
  explicit Choices(Bytes bytes) : m_bytes(bytes) {}

  [[nodiscard]] bool done() const { return m_next >= m_bytes.size(); }

  std::uint8_t byte() { return done() ? std::uint8_t{0} : m_bytes[m_next++]; }

  /// One of 0 to n - 1.
  std::size_t below(std::size_t n) {
    std::size_t value = byte();
    for (std::size_t range = 256; range < n; range *= 256) value = value * 256 + byte();
    return value % n;
  }

  bool flag() { return (byte() & 1U) != 0; }

  template <class T>
  T raw() {
    std::array<std::uint8_t, sizeof(T)> bytes{};
    for (std::uint8_t& b : bytes) b = byte();
    T value{};
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
  }

  /// A number, seldom a NaN: mostly few values that meet each other, so that boxes touch, coincide and vanish.
  double anyNumber() {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr std::array kSpecial{0.0,    -0.0,    1e-320, -5e-324, 1e-45,   1e30,     -1e30,     3.4e38,
                                  3.5e38, -3.5e38, 1e300,  -1e300,  1.7e308, -1.7e308, kInfinity, -kInfinity};
    const std::uint8_t kind = byte();
    const int step = kind % 32 - 16;
    if (kind < 128) return 0.5 * step;
    if (kind < 192) return 0.1 * step;
    if (kind < 224) return 1.0 + step * 0x1p-52;
    if (kind < 240) return kSpecial[kind % kSpecial.size()];
    return kind < 248 ? static_cast<double>(raw<float>()) : raw<double>();
  }

  /// The same, never a NaN.
  double number() {
    const double value = anyNumber();
    return std::isnan(value) ? 0.0 : value;
  }

  /// The same, never infinite.
  double finite() {
    const double value = number();
    return std::isfinite(value) ? value : 0.0;
  }

  /// What a distance or a margin may be: any number but -infinity.
  double distance() {
    const double value = flag() ? number() : 0.0;
    return value == -std::numeric_limits<double>::infinity() ? 0.0 : value;
  }

  /// Any box without a NaN, now and then an empty one.
  Box box() {
    const bool mayBeEmpty = byte() >= 240;
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = number();
      box.max[axis] = number();
      if (!mayBeEmpty && box.min[axis] > box.max[axis]) std::swap(box.min[axis], box.max[axis]);
    }
    return box;
  }

  /// One to eight boxes, each read from the input, or up to `most` drawn at random from a seed in it.
  std::vector<Box> boxes(std::size_t most) {
    if (flag()) return randomBoxes(1 + below(most));
    std::vector<Box> boxes(1 + below(8));
    for (Box& each : boxes) each = box();
    return boxes;
  }

 private:
  /// Boxes of about the same size that fill a cube; a few pairs each, or all with all.
  std::vector<Box> randomBoxes(std::size_t count) {
    std::mt19937 random(raw<std::uint16_t>());
    const std::uint8_t style = byte();
    const bool onGrid = (style & 1U) != 0;
    const double side = std::cbrt(static_cast<double>(count)) * std::array{1.0, 0.1, 4.0, 1e6}[style / 2 % 4];
    std::vector<Box> boxes(count);
    for (Box& each : boxes) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = side * static_cast<double>(random()) * 0x1p-32;
        const double high = low + 1.5 * static_cast<double>(random()) * 0x1p-32;
        each.min[axis] = onGrid ? std::floor(low) : low;
        each.max[axis] = onGrid ? std::ceil(high) : high;
      }
    }
    return boxes;
  }

  Bytes m_bytes;
  std::size_t m_next = 0;
};

/// A number as float32 holds it. GCC 12 at -O2 drops the rounding where it turns two of them into one vector; hence the
/// volatile.
inline double asFloat32(double value) {
  const volatile float rounded = static_cast<float>(value);
  return static_cast<double>(rounded);
}

inline Box asFloat32(Box box) {
  for (double& bound : box.min) bound = asFloat32(bound);
  for (double& bound : box.max) bound = asFloat32(bound);
  return box;
}

}  // namespace allpairs::fuzz
