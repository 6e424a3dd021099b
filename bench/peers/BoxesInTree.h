// SPDX-License-Identifier: MIT
// The search for boxes in a binary hierarchy that a library for rays has built.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "SetPeer.h"

namespace allpairs::bench {

/// Searches the tree for each box of the first set, depth first; of one set a pair is kept where it is met by its box
/// of the lower number. Both children of a node are beside each other. The tree has a NodeId and says its `root()`,
/// whether a node `reaches` a box and `isLeaf`, its `firstChild`, and the numbers of its boxes through `visitLeaf`.
template <class Tree, class T>
void findInTree(const Tree& tree, const Sets<T>& sets, std::vector<Pair>& pairs) {
  const std::span<const T> searched = sets.areTwo ? sets.second : sets.first;
  std::vector<typename Tree::NodeId> stack;
  for (std::size_t i = 0; i < sets.first.size() / 6; ++i) {
    const T* const row = sets.first.data() + 6 * i;
    if (tree.reaches(tree.root(), row)) stack.push_back(tree.root());
    while (!stack.empty()) {
      const auto node = stack.back();
      stack.pop_back();
      if (tree.isLeaf(node)) {
        tree.visitLeaf(node, [&](std::size_t j) {
          if ((sets.areTwo || i < j) && boxesOverlap(row, searched.data() + 6 * j)) {
            pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
          }
        });
        continue;
      }
      const auto child = tree.firstChild(node);
      if (tree.reaches(child, row)) stack.push_back(child);
      if (tree.reaches(child + 1, row)) stack.push_back(child + 1);
    }
  }
}

}  // namespace allpairs::bench
