// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace allpairs::join {

/// A box on disk: its number in 64 bits, six numbers, and what boxes of any set have beside them: a margin in float64,
/// and a group, categories and a mask in 32 bits each.
struct RecordType {
  bool isFloat64 = false;
  bool hasMargins = false;
  bool hasGroups = false;
  bool hasCategories = false;
  bool hasMasks = false;

  [[nodiscard]] std::size_t labels() const noexcept {
    return (hasGroups ? 1U : 0U) + (hasCategories ? 1U : 0U) + (hasMasks ? 1U : 0U);
  }
  [[nodiscard]] std::size_t marginSize() const noexcept { return hasMargins ? sizeof(double) : 0; }

  /// What a search takes of each box beside its bounds.
  [[nodiscard]] std::size_t valuesSize() const noexcept { return marginSize() + labels() * sizeof(std::uint32_t); }

  [[nodiscard]] std::size_t boundsSize() const noexcept { return 6 * (isFloat64 ? sizeof(double) : sizeof(float)); }
  [[nodiscard]] std::size_t words() const noexcept {
    return (sizeof(std::uint64_t) + boundsSize() + marginSize()) / sizeof(std::uint64_t) + (labels() + 1) / 2;
  }
  [[nodiscard]] std::size_t size() const noexcept { return words() * sizeof(std::uint64_t); }
};

}  // namespace allpairs::join
