// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "input/ReadScope.h"
#include "mesh/Assemblies.h"
#include "mesh/MeshObject.h"

namespace allpairs::scene {

/// Something in a file whose objects are nested.
struct NestedItem {
  std::size_t node = NestedNode::kNoParent;  ///< The node that it is in; kNoParent: it is at the top.
  std::string name{};                        ///< As in the file; empty where it has none.
};

/// What an item is called, and where it is.
struct PathName {
  /// The item's own where no other has it, or none in another place; else with as many of the nodes that it is in as
  /// tell it apart from those: "left door/bolt". Items in one place have the same. Empty: nothing in the file says one.
  std::string name{};
  /// The names of all nodes that it is in, and its own: "car/left door/bolt". Empty where none of these has a name.
  std::string path{};
};

/// What to call items, by the nodes that they are in. Nodes of one name, and for paths items of one name, that are in
/// the same node are numbered in their order: door, door#2. Nodes without a name, and those without items, are as if
/// they were not there. Of nodes above the nearest 64 nothing is said.
///
/// Cost: a logarithm of the number of items for each, times the nodes that are said of it.
/// Bad input: throws FileError where the names take more memory than the scope allows.
[[nodiscard]] std::vector<PathName> pathNames(const std::vector<NestedNode>& nodes,
                                              const std::vector<NestedItem>& items, ReadScope& scope);

/// Gives the objects of a file such names and paths. `places` has the node of each that shows it.
void nameByPath(std::vector<MeshObject>& objects, const std::vector<std::size_t>& places,
                const std::vector<NestedNode>& nodes, ReadScope& scope);

}  // namespace allpairs::scene
