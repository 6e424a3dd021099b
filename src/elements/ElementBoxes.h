// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "Lanes4.h"
#include "allpairs/Box.h"
#include "allpairs/elements/MeshTopology.h"

namespace allpairs::elements {

enum class ElementKind : std::uint8_t { Vertices, Edges, Faces };

/// The boxes of vertices, edges and faces over a step, made when they are asked for.
///
/// They are kept in float32 too, each bound rounded to the nearest: half the memory to go through. That keeps their
/// order, so that boxes which overlap still do, and some that don't come to touch.
class ElementBoxes {
 public:
  /// The topology must outlive it.
  explicit ElementBoxes(const MeshTopology& topology);

  /// Takes the positions of the vertices of a mesh, rows of 3, after checking all of them.
  template <class T>
  void setPositions(std::size_t mesh, std::span<const T> start, std::span<const T> end);

  /// Whether the rounded boxes are the exact ones.
  [[nodiscard]] bool roundedAreExact() const noexcept;

  [[nodiscard]] std::span<const BoxF> rounded(ElementKind kind);
  [[nodiscard]] std::span<const Box> exact(ElementKind kind);

  /// The rounded boxes in the form in which two are compared.
  [[nodiscard]] std::span<const LaneBounds> lanes(ElementKind kind);

 private:
  template <class T>
  struct Tables {
    std::array<std::vector<BasicBox<T>>, 3> boxes;  ///< By kind.
    std::array<bool, 3> areCurrent{};
  };

  template <class T>
  std::span<const BasicBox<T>> current(Tables<T>& tables, ElementKind kind) const;

  const MeshTopology& m_topology;
  Tables<float> m_rounded;
  Tables<double> m_exact;
  std::array<std::vector<LaneBounds>, 3> m_lanes;
  std::array<bool, 3> m_lanesAreCurrent{};
  std::vector<bool> m_meshIsExact;
};

}  // namespace allpairs::elements
