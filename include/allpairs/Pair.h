// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#ifdef __cpp_impl_three_way_comparison
#include <compare>
#endif

namespace allpairs {

/// Two boxes by index. Within one set first < second; between two sets, first is of the first set.
struct Pair {
  std::uint32_t first = 0;
  std::uint32_t second = 0;

#ifdef __cpp_impl_three_way_comparison
  friend constexpr auto operator<=>(const Pair&, const Pair&) = default;
#else
  friend constexpr bool operator==(const Pair& a, const Pair& b) { return a.first == b.first && a.second == b.second; }
  friend constexpr bool operator!=(const Pair& a, const Pair& b) { return !(a == b); }
  friend constexpr bool operator<(const Pair& a, const Pair& b) {
    return a.first != b.first ? a.first < b.first : a.second < b.second;
  }
  friend constexpr bool operator>(const Pair& a, const Pair& b) { return b < a; }
  friend constexpr bool operator<=(const Pair& a, const Pair& b) { return !(b < a); }
  friend constexpr bool operator>=(const Pair& a, const Pair& b) { return !(a < b); }
#endif
};

}  // namespace allpairs
