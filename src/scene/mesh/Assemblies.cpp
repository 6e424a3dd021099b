// SPDX-License-Identifier: MIT
#include "mesh/Assemblies.h"

#include "input/ReadScope.h"
#include "input/UniqueNames.h"

namespace allpairs::scene {
namespace {

constexpr std::size_t kNoNode = NestedNode::kNoParent;

/// Whether there is an object at a node or below it.
std::vector<bool> whichShow(const std::vector<NestedNode>& nodes) {
  std::vector<bool> shows(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    shows[i] = shows[i] || nodes[i].hasObject;
    if (shows[i] && nodes[i].parent != kNoNode) shows[nodes[i].parent] = true;
  }
  return shows;
}

/// The node below which the file first branches; kNoNode: the roots are several, or nothing branches.
struct Branching {
  bool exists = false;
  std::size_t node = kNoNode;
};

Branching branchingOf(const std::vector<NestedNode>& nodes, const std::vector<bool>& shows) {
  std::vector<std::size_t> children(nodes.size() +
                                    1);  // how many of them show something; the last entry is of the roots
  std::vector<std::size_t> onlyChild(nodes.size() + 1, kNoNode);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!shows[i]) continue;
    const std::size_t parent = nodes[i].parent == kNoNode ? nodes.size() : nodes[i].parent;
    ++children[parent];
    onlyChild[parent] = i;
  }
  std::size_t at = nodes.size();
  while (children[at] == 1 && !nodes[onlyChild[at]].hasObject) at = onlyChild[at];
  return {children[at] > 1, at == nodes.size() ? kNoNode : at};
}

}  // namespace

std::vector<std::string> assembliesOf(const std::vector<NestedNode>& nodes, ReadScope& scope) {
  std::vector<std::string> assemblies(nodes.size());
  const std::vector<bool> shows = whichShow(nodes);
  const Branching branching = branchingOf(nodes, shows);
  if (!branching.exists) return assemblies;
  const auto nameOf = [](const NestedNode& node) { return node.name.empty() ? "node" : node.name; };
  UniqueNames names;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (shows[i] && nodes[i].parent == branching.node) names.note(nameOf(nodes[i]));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!shows[i]) continue;
    if (nodes[i].parent == branching.node)
      assemblies[i] = names.unique(nameOf(nodes[i]));
    else if (nodes[i].parent != kNoNode)
      assemblies[i] = assemblies[nodes[i].parent];
    scope.take(assemblies[i].size());
  }
  return assemblies;
}

}  // namespace allpairs::scene
