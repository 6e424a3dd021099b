// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace allpairs::bench {

/// Where centres can lie: in a cube, on a plane or on a line.
enum class Support : std::uint8_t { Volume, Plane, TiltedPlane, AxisLine, DiagonalLine };

/// How centres are spread there.
enum class Spacing : std::uint8_t { Uniform, Clusters, Fractal, Lattice };

/// How the sizes of boxes are distributed.
enum class Sizes : std::uint8_t { Equal, Uniform, LogNormal, PowerLaw };

/// Plates are thin on one axis, needles long on one; that axis is the same for all boxes, or drawn for each.
enum class Shape : std::uint8_t { Cubes, Plates, MixedPlates, Needles, MixedNeedles };

/// A distribution of scenes: all that there is to know about it follows from its seed.
struct SceneFamily {
  std::uint64_t seed = 0;
  std::size_t first = 0;   ///< Boxes in the first set, or in the only one.
  std::size_t second = 0;  ///< In the second set; 0 of one set.
  bool isFloat64 = false;
  bool isLocal = false;  ///< Whether the second set fills a small part of the first set's space.
  double offset = 0.0;   ///< Of the scene, which measures one, from the origin on each axis.
  double pairs = 0.0;    ///< Pairs a box, about; lattices have others.
  Support support = Support::Volume;
  Spacing spacing = Spacing::Uniform;
  Sizes sizes = Sizes::Equal;
  Shape shape = Shape::Cubes;
  double aspect = 1.0;       ///< Of plates and needles.
  std::size_t clusters = 1;  ///< Where centres are clustered.

  [[nodiscard]] bool areTwo() const noexcept { return second != 0; }
  [[nodiscard]] std::size_t boxes() const noexcept { return first + second; }
};

/// No scene has more boxes.
inline constexpr std::size_t kMostBoxes = 1000000;

/// The family that belongs to a seed.
[[nodiscard]] SceneFamily familyOf(std::uint64_t seed);

/// The same with at most so many boxes, and as many pairs a box.
[[nodiscard]] SceneFamily shrunk(const SceneFamily& family, std::size_t boxes);

/// The number of dimensions of the space of the centres.
[[nodiscard]] std::size_t dimensionOf(Support support) noexcept;

/// In a few words, but for the seed and the number of boxes.
[[nodiscard]] std::string describe(const SceneFamily& family);

}  // namespace allpairs::bench
