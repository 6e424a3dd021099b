// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "allpairs/FunctionRef.h"
#include "allpairs/StopFlag.h"
#include "sofa/mesh/Math.h"

namespace allpairs::scene::sofa {

using Index = std::uint32_t;
template <std::size_t N>
using Elements = std::vector<std::array<Index, N>>;

/// Counts pairs of what is about to be compared, and throws where they are too many or reading is to stop.
using TakeWork = FunctionRef<void(std::uint64_t)>;

/// More points than this no list of elements can number.
inline constexpr double kMaxPoints = 4e9;

/// The corners of an element without their order, as a key for those that have the same.
template <std::size_t N>
[[nodiscard]] std::array<Index, N> sorted(std::array<Index, N> corners) {
  std::ranges::sort(corners);
  return corners;
}

/// Points and the elements between them, in the order of the file that they come from: indices matter.
struct Mesh {
  std::vector<Vec3> positions;
  Elements<2> edges;
  Elements<3> triangles;
  Elements<4> quads;
  Elements<4> tetrahedra;
  Elements<8> hexahedra;
  std::vector<double> radii;   ///< Of sphere files: one for each point.
  std::size_t passedOver = 0;  ///< Elements in the file that are of kinds that SOFA does not read.
};

/// Cuts quads in two, from the first corner to the third.
inline void addHalves(const Elements<4>& quads, Elements<3>& triangles) {
  for (const auto& q : quads) triangles.insert(triangles.end(), {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}});
}

/// Whether the surfaces of VTK's XML format, PolyData, are read, which SOFA 20.06 and those before it do not.
enum class XmlSurfaces { Read, Refused };

/// What the loaders of a scene may ask of a Wavefront file.
struct ObjOptions {
  bool triangulate = false;  ///< Faces of four corners become triangles at once, as larger ones always do.
  bool splitSeams = false;   ///< One point for each combination of position, texture coordinate and normal.
};

// Each of these throws FileError, with the line, for what is malformed, cut off, or refers to points that don't exist,
// and Stopped soon after a flag that is given is set.

[[nodiscard]] Mesh readObj(const std::filesystem::path& path, const ObjOptions& options, const StopFlag* stop);
[[nodiscard]] Mesh readGmsh(const std::filesystem::path& path, const StopFlag* stop);
[[nodiscard]] Mesh readSpheres(const std::filesystem::path& path, const StopFlag* stop);
[[nodiscard]] Mesh readVtk(const std::filesystem::path& path, XmlSurfaces surfaces, const StopFlag* stop);
[[nodiscard]] Mesh readOff(const std::filesystem::path& path, const StopFlag* stop);
[[nodiscard]] Mesh readTrian(const std::filesystem::path& path, const StopFlag* stop);

/// Reads whatever of these the file's extension says; throws FileError for others.
[[nodiscard]] Mesh readMesh(const std::filesystem::path& path, const StopFlag* stop);

/// Throws FileError unless every element's corners are points of the mesh and every point is finite.
void checkMesh(const Mesh& mesh, const std::filesystem::path& path);

}  // namespace allpairs::scene::sofa
