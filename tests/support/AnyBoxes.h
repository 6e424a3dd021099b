// SPDX-License-Identifier: MIT
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "allpairs/Box.h"
#include "support/Numbers.h"

namespace allpairs::test {

/// Coordinates that make boxes touch, coincide, vanish and overflow: few values, chosen to meet each other.
inline rc::Gen<double> coordinate() {
  return rc::gen::weightedOneOf<double>(
      {{6, rc::gen::map(rc::gen::inRange(-8, 9), [](int i) { return 0.5 * i; })},
       {3, rc::gen::map(rc::gen::inRange(-8, 9), [](int i) { return 0.1 * i; })},
       {2, rc::gen::map(rc::gen::inRange(-50, 51), [](int i) { return 1.0 + i * 0x1p-52; })},
       {1, rc::gen::element(0.0, -0.0, 1e-320, -5e-324, 1e-45, 1e30, -1e30, 3.4e38, 3.5e38, 1e300, -1e300)},
       {1, rc::gen::element(kInfinity, -kInfinity)}});
}

inline rc::Gen<Box> anyBox() {
  return rc::gen::map(rc::gen::container<std::array<double, 6>>(coordinate()), [](const std::array<double, 6>& c) {
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = std::min(c[axis], c[axis + 3]);
      box.max[axis] = std::max(c[axis], c[axis + 3]);
    }
    return box;
  });
}

/// Now and then a box that is turned over on an axis, and so empty unless it is flat there.
inline rc::Gen<Box> maybeInverted() {
  return rc::gen::map(rc::gen::pair(anyBox(), rc::gen::inRange(0, 24)), [](std::pair<Box, int> drawn) {
    if (drawn.second < 3) {
      const auto axis = static_cast<std::size_t>(drawn.second);
      std::swap(drawn.first.min[axis], drawn.first.max[axis]);
    }
    return drawn.first;
  });
}

/// Boxes at the end of the numbers: where float32 ends and where float64 does, and beyond, often turned over.
inline rc::Gen<Box> extremeBox() {
  const auto bound = rc::gen::element(-kInfinity, -kMost, -kMostOfFloat, 0.0, kMostOfFloat, kMost, kInfinity);
  return rc::gen::map(rc::gen::container<std::array<double, 6>>(bound), [](const std::array<double, 6>& c) {
    return Box{{c[0], c[1], std::min(c[2], c[5])}, {c[3], c[4], std::max(c[2], c[5])}};
  });
}

inline rc::Gen<std::vector<Box>> scene() {
  return rc::gen::scale(2.0, rc::gen::container<std::vector<Box>>(maybeInverted()));
}

inline rc::Gen<double> distance() {
  return rc::gen::weightedOneOf<double>({{4, rc::gen::just(0.0)},
                                         {4, rc::gen::map(rc::gen::inRange(-10, 20), [](int i) { return 0.1 * i; })},
                                         {1, rc::gen::element(1e-320, 0x1p-52, -0x1p-53, 1e30, 1e300, kInfinity)}});
}

}  // namespace allpairs::test
