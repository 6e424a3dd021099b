// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "mesh/MeshObject.h"
#include "mesh/Transform.h"

struct aiScene;
template <typename Real>
class aiMatrix4x4t;

namespace allpairs::scene {

[[nodiscard]] Transform transformOf(const aiMatrix4x4t<float>& matrix);

/// The transform of a scene's root into the coordinates of its file. Assimp turns some formats so that y is up, and
/// measures in metres, by the root's own transform: of IFC, COLLADA, 3DS, ASE and Blender files this is taken
/// back. So is the mirror that DirectX files come through.
///
/// Reference: Assimp 5.2, the ends of IFCLoader, ColladaLoader, 3DSConverter, ASELoader, DXFLoader, XFileImporter and
/// BlenderLoader; UpAxis in FBXConverter.
[[nodiscard]] Transform rootOfFile(const aiScene& scene, const std::string& extension, MeshFrame& frame);

/// How long the unit of an FBX file is in metres; 0 where the file, of these bytes, does not say so.
[[nodiscard]] double unitOfFbx(const aiScene& scene, std::string_view bytes);

}  // namespace allpairs::scene
