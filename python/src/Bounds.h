// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "allpairs/Box.h"

namespace allpairs::python {

/// A box as Python has it: minx miny minz maxx maxy maxz.
using Bounds = std::array<double, 6>;

[[nodiscard]] inline Box boxOf(const Bounds& bounds) {
  return {{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}};
}

/// Appends the bounds of a box, or of a cell.
template <class AnyBox>
void append(std::vector<double>& numbers, const AnyBox& box) {
  numbers.insert(numbers.end(), box.min.begin(), box.min.end());
  numbers.insert(numbers.end(), box.max.begin(), box.max.end());
}

}  // namespace allpairs::python
