// SPDX-License-Identifier: MIT
// Sets of boxes with all that may be said about each, and what the double loop says of their pairs: it shares no code
// with the engine.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "BoxesInMemory.h"
#include "Choices.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"

namespace allpairs::fuzz {

inline constexpr std::size_t kMostBoxes = 300;  // The double loop is quadratic; a hierarchy of three levels fits.

/// A set of boxes with all that may be said about each.
struct Side {
  std::vector<Box> boxes;
  std::optional<BoxesInMemory<float>> float32;
  std::optional<BoxesInMemory<double>> float64;
  BoxView set;
  double margin = 0.0;
  std::vector<double> margins;
  std::vector<std::uint32_t> categories, masks, groups;

  [[nodiscard]] double marginOf(std::size_t i) const { return margins.empty() ? margin : margins[i]; }
};

inline void readMargins(Choices& choices, Side& side) {
  if (choices.flag()) side.margin = choices.distance();
  if (choices.byte() % 4 == 3) {
    for (std::size_t i = 0; i < side.boxes.size(); ++i) side.margins.push_back(choices.distance());
  }
  side.set.setMargin(side.margin);
  if (!side.margins.empty()) side.set.setMargins(side.margins);
}

inline void readFilter(Choices& choices, Side& side) {
  const std::uint8_t parts = choices.byte();
  const std::uint8_t pattern = choices.byte();
  for (std::size_t i = 0; i < side.boxes.size(); ++i) {
    const auto value = static_cast<std::uint32_t>((i * 7 + pattern) * 2654435761U >> 13);
    if ((parts & 1U) != 0) side.categories.push_back(1U << value % 3);
    if ((parts & 2U) != 0) side.masks.push_back(value / 3 % 8);
    if ((parts & 4U) != 0) side.groups.push_back(value / 24 % 4);
  }
}

inline void readSide(Choices& choices, Side& side) {
  while (choices.byte() % 4 != 0) {
    for (const Box& box : choices.boxes(kMostBoxes / 2)) {
      if (side.boxes.size() < kMostBoxes) side.boxes.push_back(box);
    }
  }
  const bool isFloat32 = choices.flag();
  const std::size_t layout = choices.below(BoxesInMemory<float>::kLayouts);
  if (isFloat32) {
    for (Box& box : side.boxes) box = asFloat32(box);
    side.set = side.float32.emplace(side.boxes, layout).view();
  } else {
    side.set = side.float64.emplace(side.boxes, layout).view();
  }
  readMargins(choices, side);
  readFilter(choices, side);
}

inline bool isNothing(const Box& b) { return b.min[0] > b.max[0] || b.min[1] > b.max[1] || b.min[2] > b.max[2]; }

inline bool apart(const Box& a, const Box& b, double d) {
  bool result = isNothing(a) || isNothing(b);
  for (std::size_t k = 0; k < 3; ++k) result = result || a.min[k] > b.max[k] + d || b.min[k] > a.max[k] + d;
  return result;
}

/// What the contract says of one question.
struct Oracle {
  const OverlapOptions& options;
  const Side& first;
  const Side& second;
  std::uint32_t salt = 0;

  [[nodiscard]] bool isInRegion(const Side& side, std::size_t i) const {
    return !options.region || !apart(side.boxes[i], *options.region, options.distance + side.marginOf(i));
  }

  [[nodiscard]] bool passesFilter(std::size_t i, std::size_t j) const {
    const auto at = [](const std::vector<std::uint32_t>& list, std::size_t k, std::uint32_t other) {
      return list.empty() ? other : list[k];
    };
    if ((at(first.categories, i, ~0U) & at(second.masks, j, ~0U)) == 0) return false;
    if ((at(second.categories, j, ~0U) & at(first.masks, i, ~0U)) == 0) return false;
    const std::uint32_t group = at(first.groups, i, 0);
    return group == 0 || group != at(second.groups, j, 0);
  }

  /// All but `accept`.
  [[nodiscard]] bool passes(std::size_t i, std::size_t j) const {
    const double d = options.distance + first.marginOf(i) + second.marginOf(j);
    return !apart(first.boxes[i], second.boxes[j], d) && isInRegion(first, i) && isInRegion(second, j) &&
           passesFilter(i, j);
  }

  [[nodiscard]] bool accepts(std::size_t i, std::size_t j) const {
    return salt == 0 || (i * 31 + j * 17 + salt) % 3 != 0;
  }

  [[nodiscard]] std::vector<Pair> pairs() const {
    std::vector<Pair> result;
    for (std::uint32_t i = 0; i < first.boxes.size(); ++i) {
      for (std::uint32_t j = &first == &second ? i + 1 : 0; j < second.boxes.size(); ++j) {
        if (passes(i, j) && accepts(i, j)) result.push_back({i, j});
      }
    }
    if (options.order == Order::BySecond) {
      std::stable_sort(result.begin(), result.end(), [](Pair a, Pair b) { return a.second < b.second; });
    }
    return result;
  }
};

}  // namespace allpairs::fuzz
