// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "memory/Memory.h"

namespace allpairs::engine {

/// The order in which the queries of a batch are answered: those that are near each other in space one after the other,
/// so that they find in the cache what they read.
class QueryOrder {
 public:
  explicit QueryOrder(std::pmr::memory_resource* memory) : m_keys(memory), m_spare(memory) {}

  /// Orders the queries by the points at which they begin. Points at infinity are anywhere.
  void sort(std::span<const std::array<float, 3>> points);

  [[nodiscard]] std::size_t operator[](std::size_t i) const noexcept { return static_cast<std::uint32_t>(m_keys[i]); }

 private:
  Buffer<std::uint64_t> m_keys;
  Buffer<std::uint64_t> m_spare;
};

}  // namespace allpairs::engine
