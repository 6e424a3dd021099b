// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "mesh/MeshObject.h"

namespace allpairs::scene {

/// Some kinds of shapes, as a sentence: "IfcCsgSolid is not read".
[[nodiscard]] std::string notRead(const std::set<std::string>& kinds);

/// An IFC's product, by Assimp's name of its node.
struct IfcProduct {
  std::string name;  ///< Its class where it has none of its own.
  std::string kind;
  std::string id;
};

/// Says what is missing in the objects of an IFC: kinds of shapes that are not read, and the names of products of which
/// nothing is shown, though the file has a shape of them.
void warnOfMissing(const std::filesystem::path& path, const std::set<std::string>& kinds,
                   const std::vector<IfcProduct>& shapeless, std::vector<FileWarning>& warnings);

/// Says how much Assimp, which computes in float32, rounds coordinates that are far from the origin; metresPerUnit is 0
/// where it is unknown.
void warnOfRounding(const std::vector<MeshObject>& objects, double metresPerUnit, std::vector<FileWarning>& warnings);

}  // namespace allpairs::scene
