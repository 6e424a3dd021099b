// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "SceneFile.h"

namespace allpairs::fuzz {

/// Writes a mesh file of a kind that only scenes read, and a scene with a loader of it that uses all of the mesh.
inline std::filesystem::path loadedMesh(const std::string& loader, const std::string& name, Bytes bytes) {
  writeFile(name, bytes);
  return folder().write("input.scn", "<Node><" + loader + " name='loader' filename='" + name +
                                         "' createSubelements='1'/><MeshTopology src='@loader'/><MechanicalObject "
                                         "src='@loader'/><Triangle/><Line/><Point/></Node>");
}

}  // namespace allpairs::fuzz
