// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "allpairs/Worlds.h"
#include "support/Boxes.h"

namespace allpairs::test {

template <class T, class From>
BasicBox<T> boxAs(const BasicBox<From>& box) {
  BasicBox<T> result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.min[axis] = static_cast<T>(box.min[axis]);
    result.max[axis] = static_cast<T>(box.max[axis]);
  }
  return result;
}

/// Worlds of given sizes, with empty, infinite and touching boxes among them.
template <class T>
struct WorldsScene {
  std::vector<BasicBox<T>> boxes;
  std::vector<std::uint64_t> begin{0};

  explicit WorldsScene(const std::vector<std::size_t>& sizes, unsigned seed = 1, float boxSize = 1.0F) {
    for (std::size_t k = 0; k < sizes.size(); ++k) add(sizes[k], seed + static_cast<unsigned>(k), boxSize);
  }

  void add(std::size_t size, unsigned seed, float boxSize) {
    const std::size_t first = boxes.size();
    for (const BoxF& box : randomBoxes(size, seed, boxSize)) {
      Box precise = toDouble(box);
      for (double& bound : precise.min) bound /= 3.0;
      for (double& bound : precise.max) bound /= 3.0;
      boxes.push_back(boxAs<T>(precise));
    }
    const T infinity = std::numeric_limits<T>::infinity();
    for (std::size_t i = first; i < boxes.size(); ++i) {
      if (i % 13 == 3) std::swap(boxes[i].min[i % 3], boxes[i].max[i % 3]);
      if (i % 17 == 5) boxes[i].min[i % 3] = -infinity;
      if (i % 19 == 5) boxes[i].max[i % 3] = infinity;
      if (i % 11 == 6 && i > first) boxes[i].min[0] = boxes[i - 1].max[0];
      if (i % 101 == 50) boxes[i].min[1] = boxes[i].max[1] = infinity;
    }
    begin.push_back(boxes.size());
  }

  [[nodiscard]] Worlds worlds() const { return {BoxView(boxes), begin}; }
  [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
  [[nodiscard]] std::vector<Box> world(std::size_t k) const {
    std::vector<Box> result;
    for (std::uint64_t i = begin[k]; i < begin[k + 1]; ++i) result.push_back(boxAs<double>(boxes[i]));
    return result;
  }
};

}  // namespace allpairs::test
