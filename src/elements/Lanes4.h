// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "allpairs/Box.h"
#include "allpairs/elements/MeshTopology.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace allpairs::elements {

#if defined(__GNUC__) || defined(__clang__)

// Four numbers at once, in the language extension that GCC and Clang share: every processor that they know has at least
// that, and a pair to check is too little work for more.
using Float4 [[gnu::vector_size(16)]] = float;
using UInt4 [[gnu::vector_size(16)]] = std::uint32_t;

/// The lanes of `from` with these indices.
template <int... kIndices>
[[nodiscard]] inline UInt4 select(UInt4 from) noexcept {
  return __builtin_shufflevector(from, from, kIndices...);
}

#if defined(__SSE2__)
/// Whether any lane of a comparison says yes, or all do.
template <class Mask>
[[nodiscard]] inline bool anyLane(Mask mask) noexcept {
  return _mm_movemask_epi8(std::bit_cast<__m128i>(mask)) != 0;
}

template <class Mask>
[[nodiscard]] inline bool allLanes(Mask mask) noexcept {
  return _mm_movemask_epi8(std::bit_cast<__m128i>(mask)) == 0xFFFF;
}
#else
/// Whether any lane of a comparison says yes, or all do.
template <class Mask>
[[nodiscard]] inline bool anyLane(Mask mask) noexcept {
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2> >(mask);
  return (halves[0] | halves[1]) != 0;
}

template <class Mask>
[[nodiscard]] inline bool allLanes(Mask mask) noexcept {
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2> >(mask);
  return (halves[0] & halves[1]) == ~std::uint64_t{0};
}
#endif

#else

// The same for compilers without the extension, such as Visual C++.
template <class T>
struct Four {
  std::array<T, 4> lanes;

  Four(T a, T b, T c, T d) noexcept : lanes{a, b, c, d} {}
  T operator[](std::size_t i) const noexcept { return lanes[i]; }
};

using Float4 = Four<float>;
using UInt4 = Four<std::uint32_t>;

/// A comparison has 1 or 0 in each lane.
template <class T, class Test>
[[nodiscard]] inline UInt4 eachLane(const Four<T>& a, const Four<T>& b, Test test) noexcept {
  const auto of = [&](std::size_t i) { return static_cast<std::uint32_t>(test(a.lanes[i], b.lanes[i])); };
  return {of(0), of(1), of(2), of(3)};
}

[[nodiscard]] inline UInt4 operator==(const UInt4& a, const UInt4& b) noexcept {
  return eachLane(a, b, [](auto x, auto y) { return x == y; });
}
[[nodiscard]] inline UInt4 operator<(const Float4& a, const Float4& b) noexcept {
  return eachLane(a, b, [](auto x, auto y) { return x < y; });
}
[[nodiscard]] inline UInt4 operator|(const UInt4& a, const UInt4& b) noexcept {
  return eachLane(a, b, [](auto x, auto y) { return x | y; });
}
[[nodiscard]] inline UInt4 operator&(const UInt4& a, const UInt4& b) noexcept {
  return eachLane(a, b, [](auto x, auto y) { return x & y; });
}

[[nodiscard]] inline bool anyLane(const UInt4& m) noexcept {
  return (m.lanes[0] | m.lanes[1] | m.lanes[2] | m.lanes[3]) != 0;
}
[[nodiscard]] inline bool allLanes(const UInt4& m) noexcept {
  return (m.lanes[0] & m.lanes[1] & m.lanes[2] & m.lanes[3]) != 0;
}

/// The lanes of `from` with these indices.
template <int... kIndices>
[[nodiscard]] inline UInt4 select(const UInt4& from) noexcept {
  return {from.lanes[kIndices]...};
}

#endif

/// The vertices of a triangle, the last of them twice.
struct Corners {
  UInt4 vertices;

  explicit Corners(const Triangle& t) noexcept : vertices{t[0], t[1], t[2], t[2]} {}

  [[nodiscard]] bool has(std::uint32_t vertex) const noexcept {
    return anyLane(vertices == UInt4{vertex, vertex, vertex, vertex});
  }

  [[nodiscard]] bool hasAnyOf(const Corners& other) const noexcept {
    const UInt4 turned = select<1, 2, 0, 0>(other.vertices);
    const UInt4 turnedTwice = select<2, 0, 1, 1>(other.vertices);
    return anyLane((vertices == other.vertices) | (vertices == turned) | (vertices == turnedTwice));
  }
};

/// A float32 box whose fourth lane overlaps that of any other.
struct LaneBounds {
  Float4 min;
  Float4 max;

  explicit LaneBounds(const BoxF& box) noexcept
      : min{box.min[0], box.min[1], box.min[2], 0.0F}, max{box.max[0], box.max[1], box.max[2], 1.0F} {}

  /// Whether the two overlap by more than a common face, edge or corner.
  [[nodiscard]] bool overlapsInside(const LaneBounds& other) const noexcept {
    return allLanes((min < other.max) & (other.min < max));
  }
};

}  // namespace allpairs::elements
