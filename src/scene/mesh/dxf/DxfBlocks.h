// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "input/ReadScope.h"
#include "mesh/MeshObject.h"
#include "mesh/Transform.h"

namespace allpairs::scene {

/// Places of a block, in columns and rows: one or more.
struct DxfInsert {
  std::string block;
  std::string layer;
  Transform place{kIdentity};  ///< Of the first, from the block with its base at the origin.
  std::uint64_t columns = 1;
  std::uint64_t rows = 1;
  Point columnStep{};
  Point rowStep{};
};

/// An object for each layer, in the order in which they come.
class DxfLayers {
 public:
  /// That of a layer, made where there is none.
  [[nodiscard]] MeshObject& of(std::string_view layer, ReadScope& scope);
  [[nodiscard]] std::vector<MeshObject>& objects() { return m_objects; }
  [[nodiscard]] const std::vector<MeshObject>& objects() const { return m_objects; }

 private:
  std::vector<MeshObject> m_objects;
  std::map<std::string, std::size_t, std::less<>> m_places;  ///< In that list.
};

/// What is in a block of a drawing, or in the drawing itself.
struct DxfBlock {
  std::string name{};
  Point base{};
  bool isElsewhere = false;  ///< Its content is in another drawing.
  std::vector<DxfInsert> inserts{};
  std::size_t hidden = 0;                       ///< How many entities it does not show.
  std::map<std::string, std::size_t> unread{};  ///< How many of each kind of shape.
  std::size_t problemLine = 0;                  ///< Of the first shape without which the drawing is of no use.
  std::string problem{};
  DxfLayers layers{};  ///< What it shows itself, in its own coordinates.
};

/// Shows the first block, which is the drawing itself, with the blocks in their places: an object for each layer. What a
/// block has in layer 0 is in the layer in which the block is inserted. `notes` gets what is missing.
///
/// Bad input: throws FileError where something shown has a problem, or blocks are in each other without end.
[[nodiscard]] std::vector<MeshObject> showDrawing(const std::vector<DxfBlock>& blocks,
                                                  const std::filesystem::path& path, ReadScope& scope,
                                                  FileNotes& notes);

}  // namespace allpairs::scene
