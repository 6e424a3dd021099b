// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/BoxView.h"

namespace allpairs::scene {

class BoxArray;
struct Remark;

/// Counts boxes of which a minimum is above its maximum and both are finite, as after a mistake: they are empty, and in
/// no pair. A box with an infinite bound is meant as it is.
struct EmptyBoxes {
  std::uint64_t count = 0;
  std::uint64_t first = 0;  ///< The number of the first of them.
  std::size_t axis = 0;     ///< The first axis on which that one is empty.

  /// Counts the box, which has a number, if it is such a one.
  void look(const Box& box, std::uint64_t number) noexcept {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(box.min[i] > box.max[i]) || !std::isfinite(box.min[i]) || !std::isfinite(box.max[i])) continue;
      if (count == 0) {
        first = number;
        axis = i;
      }
      ++count;
      return;
    }
  }

  /// Looks at boxes that are numbered on from `begin`.
  void look(const BoxView& boxes, std::uint64_t begin) noexcept {
    for (std::size_t i = 0; i < boxes.size(); ++i) look(boxes[i], begin + i);
  }
};

/// Why such boxes, of which there are some, are in no pair: what is wrong with the first, and how many others there
/// are.
[[nodiscard]] std::string emptyReason(const EmptyBoxes& boxes);

/// What to warn of in the boxes of a file: that some of them are empty, that a text has none, as one that was not
/// written to its end, and lines that may not be what they were taken for. A .npy file without boxes says so in its shape.
[[nodiscard]] std::vector<Remark> boxWarnings(const BoxArray& boxes, const std::filesystem::path& file);

}  // namespace allpairs::scene
