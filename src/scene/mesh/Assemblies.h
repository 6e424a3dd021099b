// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace allpairs::scene {

class ReadScope;

/// A node of a file whose objects are nested.
struct NestedNode {
  static constexpr std::size_t kNoParent = static_cast<std::size_t>(-1);
  std::size_t parent = kNoParent;  ///< Its place in the list, before the node's own.
  bool hasObject = false;
  std::string name{};
};

/// Of each node the name of the assembly that it is in: what lies below the node where the file first branches, leaving
/// out nodes that show nothing, such as cameras. Names are told apart. Empty: in none, as all nodes of a file with one
/// object are.
///
/// Cost: linear in the nodes.
[[nodiscard]] std::vector<std::string> assembliesOf(const std::vector<NestedNode>& nodes, ReadScope& scope);

}  // namespace allpairs::scene
