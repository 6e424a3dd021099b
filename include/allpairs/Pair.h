// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>

namespace allpairs {

/// Two boxes by index. Within one set first < second; between two sets, first is of the first set.
struct Pair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;

  friend constexpr auto operator<=>(const Pair&, const Pair&) = default;
};

}  // namespace allpairs
