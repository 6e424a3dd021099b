// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ostream>
#include <random>
#include <span>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"

namespace allpairs::test {

/// Boxes of a temporary, for as long as the call that they are an argument of.
template <class Boxes>
std::span<const typename Boxes::value_type> lent(const Boxes& boxes) {
  return boxes;
}

/// n boxes whose centres fill a cube; `size` 1 gives about two pairs a box.
inline std::vector<BoxF> randomBoxes(std::size_t n, unsigned seed, float size = 1.0F) {
  std::mt19937 generator(seed);
  const auto uniform = [&] { return static_cast<float>(generator()) * 0x1p-32F; };
  float side = 1.0F;
  while (side * side * side < static_cast<float>(n)) side += 0.25F;
  std::vector<BoxF> boxes(n);
  for (BoxF& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float centre = side * uniform();
      const float half = size * (0.2F + 0.4F * uniform());
      box.min[axis] = centre - half;
      box.max[axis] = centre + half;
    }
  }
  return boxes;
}

inline Box toDouble(const BoxF& box) {
  Box result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] = static_cast<double>(box.min[axis]);
    result.max[axis] = static_cast<double>(box.max[axis]);
  }
  return result;
}

inline std::vector<Box> toDouble(std::span<const BoxF> boxes) {
  std::vector<Box> result;
  for (const BoxF& box : boxes) result.push_back(toDouble(box));
  return result;
}

/// The boxes with each bound rounded to the nearest float32.
inline std::vector<BoxF> toFloat32(std::span<const Box> boxes) {
  std::vector<BoxF> result;
  for (const Box& box : boxes) {
    BoxF& rounded = result.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rounded.min[axis] = static_cast<float>(box.min[axis]);
      rounded.max[axis] = static_cast<float>(box.max[axis]);
    }
  }
  return result;
}

/// A cube by its minimum and its side.
inline Box cube(double x, double y, double z, double side = 1.0) { return {{x, y, z}, {x + side, y + side, z + side}}; }

/// The order by (second, first).
inline bool isLessBySecond(Pair a, Pair b) { return a.second != b.second ? a.second < b.second : a.first < b.first; }

/// Pairs in the order of the first box, in that of the order.
inline std::vector<Pair> inOrder(std::vector<Pair> pairs, Order order) {
  if (order == Order::BySecond) std::sort(pairs.begin(), pairs.end(), isLessBySecond);
  return pairs;
}

template <class Pairs>
std::vector<Pair> toVector(const Pairs& pairs) {
  return {pairs.begin(), pairs.end()};
}

}  // namespace allpairs::test

namespace allpairs {

// How tests and property tests print what they compare.
template <class T>
std::ostream& operator<<(std::ostream& out, const BasicBox<T>& box) {
  out << std::hexfloat << '[';
  for (const T bound : box.min) out << bound << ' ';
  out << "to";
  for (const T bound : box.max) out << ' ' << bound;
  return out << std::defaultfloat << ']';
}
inline std::ostream& operator<<(std::ostream& out, const Pair& pair) {
  return out << '(' << pair.first << ", " << pair.second << ')';
}
inline void PrintTo(const Pair& pair, std::ostream* out) { *out << pair; }
}  // namespace allpairs
