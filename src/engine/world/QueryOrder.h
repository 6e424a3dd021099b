// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "memory/Memory.h"

namespace allpairs::engine {

/// The order in which the queries of a batch are answered: queries that are near each other in space are consecutive,
/// for cache locality.
class QueryOrder {
 public:
  explicit QueryOrder(std::pmr::memory_resource* memory) : m_keys(memory), m_spare(memory) {}

  /// Orders the queries by their starting points. The position of points at infinity is unspecified.
  void sort(std::span<const std::array<float, 3>> points);

  [[nodiscard]] std::size_t operator[](std::size_t i) const noexcept { return static_cast<std::uint32_t>(m_keys[i]); }

 private:
  Buffer<std::uint64_t> m_keys;
  Buffer<std::uint64_t> m_spare;
};

}  // namespace allpairs::engine
