// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "allpairs/scene/ReadOptions.h"

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

/// The triangle meshes of a mesh file, or of the mesh files of a folder.
///
/// Bad input: throws FileError; a file without triangles too.
[[nodiscard]] std::vector<TriangleMesh> readTriangleMeshes(const std::filesystem::path& path,
                                                           const scene::ReadOptions& options);

/// Throws FileError that names both files, the mesh and the element unless the meshes of `later` are those of `earlier`
/// moved: as many, with as many vertices and the same triangles.
void checkSameMeshes(const std::vector<TriangleMesh>& earlier, const std::filesystem::path& earlierPath,
                     const std::vector<TriangleMesh>& later, const std::filesystem::path& laterPath);

/// The meshes of two files that hold the start and the end of a step.
///
/// Bad input: as of the two functions above.
[[nodiscard]] std::vector<MeshStep> readMeshSteps(const std::filesystem::path& start, const std::filesystem::path& end,
                                                  const scene::ReadOptions& options);

}  // namespace allpairs::app
