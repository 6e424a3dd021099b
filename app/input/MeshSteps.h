// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "allpairs/Box.h"
#include "cli/Options.h"

namespace allpairs::app {

/// The triangles of one mesh of a file.
struct TriangleMesh {
  std::string name;
  bool isNamed = false;                  ///< By its file, not after it.
  std::vector<double> positions;         ///< Rows of 3.
  std::vector<std::uint32_t> triangles;  ///< Rows of 3.
};

/// A mesh at the start and at the end of a step, with the same triangles.
struct MeshStep {
  TriangleMesh start;
  std::vector<double> endPositions;
};

/// The triangle meshes of one of the inputs: a mesh file, or the mesh files of a folder. If `isFirst`,
/// it prints the warnings of the readers, and how many models are not triangle meshes: later steps would repeat them.
///
/// Bad input: throws FileError; a file without triangles too, and one that would be written.
[[nodiscard]] std::vector<TriangleMesh> readTriangleMeshes(const InputSettings& settings, std::size_t input,
                                                           bool isFirst);

/// Bad input: throws UsageError where an input is a SOFA scene, of which only the start is read, and not frames.
void refuseScenesAsFrames(const InputSettings& settings);

/// The boxes of all their triangles, mesh by mesh.
[[nodiscard]] std::vector<Box> triangleBoxes(const std::vector<TriangleMesh>& meshes);

/// Throws FileError that names both files, the mesh and the element unless the meshes of `later` are those of `earlier`
/// moved: as many, with as many vertices and the same triangles.
void checkSameMeshes(const std::vector<TriangleMesh>& earlier, const std::filesystem::path& earlierPath,
                     const std::vector<TriangleMesh>& later, const std::filesystem::path& laterPath);

/// The meshes of two inputs, `start` and the one after it, that hold the start and the end of a step.
///
/// Bad input: as of the two functions above.
[[nodiscard]] std::vector<MeshStep> readMeshSteps(const InputSettings& settings, std::size_t start);

}  // namespace allpairs::app
