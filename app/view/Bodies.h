// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "ViewScene.h"
#include "allpairs/scene/Scene.h"

namespace allpairs::app {

/// Which pairs of models are one row of a list.
enum class Grouping : std::uint8_t {
  Body,  ///< Those of the same two bodies: models of a SOFA node, of an object of a mesh file, or of an IFC's product.
  Assembly,  ///< Those of the same two assemblies, or bodies that are in none.
  File,      ///< Those of the same two files.
  None,      ///< Each pair is a row.
};

/// What models or bodies are known by, told apart: one that has been given before gets a number.
class Identities {
 public:
  [[nodiscard]] std::string unique(std::string identity);

 private:
  std::map<std::string, std::size_t> m_counts;
};

/// What the files of a scene are known by, wherever they are: their names, and of those of one name the folders below
/// the one that they have in common.
[[nodiscard]] std::vector<std::string> fileIdentities(const scene::Scene& scene);

/// Gives a scene that is shown, and whose models have their identities, the bodies of the one that was read, and what
/// these are called. Where each is one model, it gets none.
void addBodies(const scene::Scene& from, Grouping grouping, view::ViewScene& to);

}  // namespace allpairs::app
