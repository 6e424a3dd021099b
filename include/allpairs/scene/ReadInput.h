// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/ReadOptions.h"
#include "allpairs/scene/Scene.h"

namespace allpairs::scene {

/// Reads whatever the path is: a SOFA scene (.scn, .xml), boxes (.npy, .csv), a mesh file, or a folder of mesh files.
///
/// Bad input: throws FileError.
[[nodiscard]] Scene readInput(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads a mesh file: OBJ, PLY, STL and OFF, and whatever else Assimp knows, such as glTF.
///
/// Each object, or node that shows a mesh, is a body of its own: a model of its triangles, one of its lines and one of
/// its points, whichever it has, named as in the file, after the file where there is no name; a name that comes again
/// gets a number: "wheel#2".
/// Bad input: throws FileError; a file without any geometry too.
[[nodiscard]] Scene readMesh(const std::filesystem::path& path, const ReadOptions& options = {});

/// Reads all mesh files of a folder, by name; what else is in it gets a remark.
///
/// Bad input: a folder without mesh files throws FileError; so does a mesh file that can't be read, unless
///            options.partial is set.
[[nodiscard]] Scene readMeshFolder(const std::filesystem::path& path, const ReadOptions& options = {});

/// Boxes as collision models, each a body of its own.
[[nodiscard]] Scene toScene(const BoxArray& boxes);

}  // namespace allpairs::scene
