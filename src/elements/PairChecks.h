// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "Lanes4.h"
#include "allpairs/Box.h"
#include "allpairs/Pair.h"
#include "allpairs/elements/MeshTopology.h"

namespace allpairs::elements {

// Whether two elements have a vertex in common. All comparisons are made, so that there are no branches to miss.

struct VertexAndFace {
  const Corners* faces;

  [[nodiscard]] bool share(Pair pair) const noexcept { return faces[pair.second].has(pair.first); }
  [[nodiscard]] std::uint32_t firstVertex(Pair pair) const noexcept { return pair.first; }
  [[nodiscard]] std::uint32_t secondVertex(Pair pair) const noexcept { return faces[pair.second].vertices[0]; }
};

struct TwoEdges {
  const Edge* edges;

  [[nodiscard]] bool share(Pair pair) const noexcept {
    const Edge& a = edges[pair.first];
    const Edge& b = edges[pair.second];
    return (a[0] == b[0]) | (a[0] == b[1]) | (a[1] == b[0]) | (a[1] == b[1]);
  }
  [[nodiscard]] std::uint32_t firstVertex(Pair pair) const noexcept { return edges[pair.first][0]; }
  [[nodiscard]] std::uint32_t secondVertex(Pair pair) const noexcept { return edges[pair.second][0]; }
};

struct TwoFaces {
  const Corners* faces;

  [[nodiscard]] bool share(Pair pair) const noexcept { return faces[pair.first].hasAnyOf(faces[pair.second]); }
  [[nodiscard]] std::uint32_t firstVertex(Pair pair) const noexcept { return faces[pair.first].vertices[0]; }
  [[nodiscard]] std::uint32_t secondVertex(Pair pair) const noexcept { return faces[pair.second].vertices[0]; }
};

/// Which meshes the two elements may be of.
struct MeshRule {
  const std::uint32_t* meshOfVertex = nullptr;  ///< Null if meshes need not be distinguished.
  bool wantSame;

  template <class Elements>
  [[nodiscard]] bool allows(const Elements& elements, Pair pair) const noexcept {
    if (meshOfVertex == nullptr) return true;
    const bool same = meshOfVertex[elements.firstVertex(pair)] == meshOfVertex[elements.secondVertex(pair)];
    return same == wantSame;
  }
};

/// Boxes before and after they were rounded to float32. Null where rounding changed nothing, or the engine has compared
/// in double.
struct BoxTables {
  const LaneBounds* rounded = nullptr;
  const Box* exact = nullptr;
};

/// Whether boxes that overlap when they are rounded do so before. Rounding keeps their order: bounds that differ after
/// it differed the same way, and only where it makes two equal must be looked at again.
[[nodiscard]] inline bool overlapExactly(const BoxTables& first, const BoxTables& second, Pair pair) noexcept {
  if (first.rounded[pair.first].overlapsInside(second.rounded[pair.second])) return true;
  return overlap(first.exact[pair.first], second.exact[pair.second]);
}

/// Copies the pairs that pass to `to`, which has room for all; returns how many. `to` may be where the pairs are.
template <class Check>
std::size_t selectPairs(std::span<const Pair> pairs, const Check& check, Pair* to) noexcept {
  std::size_t size = 0;
  for (const Pair pair : pairs) {
    to[size] = pair;
    size += check(pair) ? 1U : 0U;
  }
  return size;
}

}  // namespace allpairs::elements
