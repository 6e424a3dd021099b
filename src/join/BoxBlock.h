// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "RecordType.h"
#include "allpairs/Box.h"
#include "allpairs/BoxView.h"
#include "allpairs/Filter.h"

namespace allpairs::join {

/// Some boxes of a set that follow one another.
struct BoxBlock {
  std::size_t set = 0;
  std::uint64_t begin = 0;   ///< The number of the first of them in its set.
  std::uint64_t before = 0;  ///< Boxes of all sets that were read before.
  BoxView boxes{};           ///< With their margins.
  FilterBits bits{};

  [[nodiscard]] std::uint32_t group(std::size_t i) const { return bits.groups.empty() ? 0 : bits.groups[i]; }
  [[nodiscard]] std::uint32_t categories(std::size_t i) const { return allOr(bits.categories, i); }
  [[nodiscard]] std::uint32_t mask(std::size_t i) const { return allOr(bits.masks, i); }

 private:
  static std::uint32_t allOr(Span<const std::uint32_t> values, std::size_t i) {
    return values.empty() ? std::numeric_limits<std::uint32_t>::max() : values[i];
  }
};

/// Boxes that were picked from blocks, in memory of their own.
struct BoxSample {
  RecordType type{};
  std::vector<Box> boxes{};
  std::vector<double> margins{};
  std::vector<std::uint32_t> groups{};
  std::vector<std::uint32_t> categories{};
  std::vector<std::uint32_t> masks{};

  void add(const BoxBlock& block, std::size_t i) {
    boxes.push_back(block.boxes[i]);
    if (type.hasMargins) margins.push_back(block.boxes.margin(i));
    if (type.hasGroups) groups.push_back(block.group(i));
    if (type.hasCategories) categories.push_back(block.categories(i));
    if (type.hasMasks) masks.push_back(block.mask(i));
  }

  [[nodiscard]] BoxView view() const {
    BoxView view(boxes);
    view.setMargins(margins);
    return view;
  }
  [[nodiscard]] FilterBits bits() const { return {.categories = categories, .masks = masks, .groups = groups}; }
  [[nodiscard]] BoxBlock block() const { return {.boxes = view(), .bits = bits()}; }
};

}  // namespace allpairs::join
