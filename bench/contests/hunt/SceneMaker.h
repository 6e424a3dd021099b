// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "SceneFamily.h"
#include "SetPeer.h"

namespace allpairs::bench {

/// The boxes of a scene.
template <class T>
struct Scene {
  std::vector<T> first;
  std::vector<T> second;
  bool areTwo = false;

  [[nodiscard]] Sets<T> sets() const { return {first, second, areTwo}; }
};

/// Draws scenes of a family, as large as needed for its pairs a box.
class SceneMaker {
 public:
  explicit SceneMaker(const SceneFamily& family);

  /// The family that was given; it has lost its offset where too many boxes would lie in one point with it.
  [[nodiscard]] const SceneFamily& family() const noexcept { return m_family; }

  /// The scene of a number; scenes of different numbers have no box in common.
  template <class T>
  [[nodiscard]] Scene<T> make(std::uint64_t number) const;

 private:
  /// A box before it is scaled.
  struct Placed {
    std::array<double, 3> centre;
    std::array<double, 3> half;
  };

  /// Which box of which scene, and where its randomness comes from.
  struct Draw {
    std::uint64_t stream;
    std::size_t box;
    bool isSecond;
  };

  /// Some boxes of some scenes, and how many pairs they have to have.
  struct Sample {
    std::vector<std::vector<Placed>> first;
    std::vector<std::vector<Placed>> second;
    double pairs = 0.0;
  };

  [[nodiscard]] Placed place(const Draw& draw) const;
  [[nodiscard]] std::vector<Placed> placeSet(std::uint64_t number, bool isSecond, std::size_t count) const;
  [[nodiscard]] double latticeScale() const;
  [[nodiscard]] double scaleForPairs() const;
  [[nodiscard]] bool hasTooManyPairs() const;
  void shrink();
  [[nodiscard]] Sample drawSample() const;
  template <class T>
  [[nodiscard]] std::vector<T> rowsOf(const std::vector<Placed>& boxes, double scale, double offset) const;

  SceneFamily m_family;
  std::size_t m_axis = 0;                ///< Of the support, and of parallel plates and needles.
  std::array<double, 8> m_cumulative{};  ///< Shares of the parts of a fractal.
  std::array<std::size_t, 2> m_sides{};  ///< Of the lattices of both sets, in cells.
  double m_scale = 1.0;
};

}  // namespace allpairs::bench
