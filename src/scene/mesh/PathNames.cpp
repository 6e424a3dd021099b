// SPDX-License-Identifier: MIT
#include "mesh/PathNames.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "input/UniqueNames.h"

namespace allpairs::scene {
namespace {

constexpr std::size_t kNowhere = NestedNode::kNoParent;
constexpr std::size_t kMostLevels = 64;  // more than any assembly has; a chain of nodes may be as long as its file

constexpr std::size_t kBytesPerItem = sizeof(NestedItem) + sizeof(PathName) + 400;  // with the nodes of maps

/// What has the same name in the same place is told apart: bolt, bolt#2; bolt#3 where another is called bolt#2.
using NamesInPlaces = std::unordered_map<std::size_t, UniqueNames>;

/// The nodes of a file that have names and items below them.
class NamedNodes {
 public:
  NamedNodes(const std::vector<NestedNode>& nodes, const std::vector<NestedItem>& items)
      : m_nearest(nodes.size()), m_parents(nodes.size(), kNowhere), m_labels(nodes.size()) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      m_parents[i] = nearest(nodes[i].parent);
      m_nearest[i] = nodes[i].name.empty() ? m_parents[i] : i;
    }
    std::vector<bool> isUsed(nodes.size());
    for (const NestedItem& item : items) {
      for (std::size_t at = nearest(item.node); at != kNowhere && !isUsed[at]; at = m_parents[at]) isUsed[at] = true;
    }
    NamesInPlaces taken;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (isUsed[i]) taken[m_parents[i]].note(nodes[i].name);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (isUsed[i]) m_labels[i] = taken[m_parents[i]].unique(nodes[i].name);
    }
  }

  /// A node, or the first above it that has a name.
  [[nodiscard]] std::size_t nearest(std::size_t node) const { return node == kNowhere ? kNowhere : m_nearest[node]; }
  [[nodiscard]] std::size_t above(std::size_t node) const { return m_parents[node]; }

  /// The name, with its number.
  [[nodiscard]] const std::string& label(std::size_t node) const { return m_labels[node]; }

 private:
  std::vector<std::size_t> m_nearest;
  std::vector<std::size_t> m_parents;
  std::vector<std::string> m_labels;
};

/// Names items, and says where they are.
class PathNaming {
 public:
  PathNaming(const std::vector<NestedNode>& nodes, const std::vector<NestedItem>& items, ReadScope& scope)
      : m_nodes(nodes, items), m_items(items), m_scope(scope), m_levels(items.size()) {
    m_scope.takeElements(items.size(), kBytesPerItem);
    m_places.resize(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) m_places[i] = m_nodes.nearest(items[i].node);
    m_next = m_places;
    std::map<std::string_view, std::vector<std::size_t>> alike;
    for (std::size_t i = 0; i < items.size(); ++i) alike[items[i].name].push_back(i);
    for (auto& [name, group] : alike) tellApart(std::move(group));
  }

  std::vector<PathName> names() {
    std::vector<PathName> names;
    NamesInPlaces taken;
    for (std::size_t i = 0; i < m_items.size(); ++i) taken[m_places[i]].note(m_items[i].name);
    for (std::size_t i = 0; i < m_items.size(); ++i) {
      PathName& name = names.emplace_back();
      name.name = join(i, m_levels[i], m_items[i].name);
      const std::string label = taken[m_places[i]].unique(m_items[i].name);
      if (m_places[i] != kNowhere) name.path = join(i, kMostLevels, label);
    }
    return names;
  }

 private:
  /// Items of one name of which nothing, or the same nodes, have been looked at.
  struct Group {
    std::vector<std::size_t> items;
    std::size_t levels = 0;  ///< How many nodes have been.
  };

  [[nodiscard]] bool areInOnePlace(const std::vector<std::size_t>& items) const {
    return std::all_of(items.begin(), items.end(),
                       [&](std::size_t item) { return m_places[item] == m_places[items.front()]; });
  }

  /// Finds how many nodes it takes.
  void tellApart(std::vector<std::size_t> alike) {
    std::vector<Group> groups;
    groups.push_back({std::move(alike)});
    while (!groups.empty()) {
      const Group group = std::move(groups.back());
      groups.pop_back();
      for (const std::size_t item : group.items) m_levels[item] = group.levels;
      if (group.levels == kMostLevels || areInOnePlace(group.items)) continue;
      std::map<std::size_t, std::vector<std::size_t>> ofNodes;  // whose labels, which may be long, are compared once
      for (const std::size_t item : group.items) {
        if (m_next[item] == kNowhere) continue;  // all is said
        ofNodes[m_next[item]].push_back(item);
        m_next[item] = m_nodes.above(m_next[item]);
      }
      std::map<std::string_view, std::vector<std::size_t>> parts;
      for (const auto& [node, items] : ofNodes) {
        std::vector<std::size_t>& part = parts[m_nodes.label(node)];
        part.insert(part.end(), items.begin(), items.end());
      }
      for (auto& [label, items] : parts) groups.push_back({std::move(items), group.levels + 1});
    }
  }

  /// A name behind those of so many nodes.
  std::string join(std::size_t item, std::size_t levels, std::string_view name) {
    std::vector<std::size_t> nodes;
    std::size_t size = name.size();
    for (std::size_t at = m_places[item]; at != kNowhere && nodes.size() < levels; at = m_nodes.above(at)) {
      nodes.push_back(at);
      size += m_nodes.label(at).size() + 1;
    }
    m_scope.take(size);
    std::string text;
    std::for_each(nodes.rbegin(), nodes.rend(), [&](std::size_t node) { text += m_nodes.label(node) + '/'; });
    text += name;
    if (name.empty() && !text.empty()) text.pop_back();
    return text;
  }

  NamedNodes m_nodes;
  const std::vector<NestedItem>& m_items;
  ReadScope& m_scope;
  std::vector<std::size_t> m_places;  ///< Of each item the nearest node with a name that it is in.
  std::vector<std::size_t> m_next;    ///< Of each item the node that is looked at next.
  std::vector<std::size_t> m_levels;  ///< Of each item how many nodes its name has.
};

}  // namespace

std::vector<PathName> pathNames(const std::vector<NestedNode>& nodes, const std::vector<NestedItem>& items,
                                ReadScope& scope) {
  return PathNaming(nodes, items, scope).names();
}

void nameByPath(std::vector<MeshObject>& objects, const std::vector<std::size_t>& places,
                const std::vector<NestedNode>& nodes, ReadScope& scope) {
  std::vector<NestedItem> items;
  for (std::size_t i = 0; i < objects.size(); ++i) items.push_back({nodes[places[i]].parent, objects[i].name});
  std::vector<PathName> names = pathNames(nodes, items, scope);
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].name = std::move(names[i].name);
    objects[i].path = std::move(names[i].path);
  }
}

}  // namespace allpairs::scene
