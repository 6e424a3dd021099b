// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "sofa/graph/SceneGraph.h"

namespace allpairs::scene::sofa {

/// Notes who has which name in a node and all below it; names are final then, and links can be followed.
void indexNames(Node& node);

/// "@../mesh.position": the path "../mesh" and the data "position".
struct LinkText {
  std::string path;
  std::string data;  ///< Empty where the link names none.
};

/// Takes a link apart; nothing if the text is not a link.
[[nodiscard]] std::optional<LinkText> parseLink(std::string_view text);

/// Where a path leads: to a component, or to a node and then `component` is null. Both are null where it leads nowhere.
struct LinkTarget {
  const Node* node = nullptr;
  const Component* component = nullptr;
};

/// Follows a path from a node; "[-2]" counts back from `self`.
[[nodiscard]] LinkTarget followPath(const Node& from, const Component* self, std::string_view path);

/// What a link leads to: a component, null where there is no link or nothing there, and the data that it names of it.
struct LinkedData {
  const Component* component = nullptr;
  std::string data;
};

/// Follows the link that a data of a component is; the component is in it.
[[nodiscard]] LinkedData followLink(const Component& self, std::string_view text);

/// Likewise of an attribute, or without it of `src`.
[[nodiscard]] LinkedData followLinkOf(const Component& self, std::string_view name);

/// isState and isTopology, given as they are, are answered from the lists that indexNames() has made, which must have
/// been called before. Any others, such as a lambda around one of these, are asked of all components of a node.
using Wanted = std::function<bool(const Component&)>;

/// The first wanted component of a node itself; null if there is none.
[[nodiscard]] const Component* firstIn(const Node& node, const Wanted& wanted);

/// The component that a path leads to if it is wanted; for a path to a node the only wanted one in it, else (for `self`
/// in that node or not) the nearest in its ancestors. Null if there is none, or more than one.
[[nodiscard]] const Component* followTo(const Component& self, std::string_view text, const Wanted& wanted);

/// The one that a node's own components see: the last wanted one in it, or else the first in its nearest ancestor.
[[nodiscard]] const Component* inContext(const Node& node, const Wanted& wanted);

/// The one that SOFA's get() finds from a node: the first wanted one in it, or else in its nearest ancestor.
[[nodiscard]] const Component* firstInContext(const Node& node, const Wanted& wanted);

/// What a mapping reads: the wanted component that `input` links to; by default that of the node above.
[[nodiscard]] const Component* mappingInput(const Component& mapping, const Wanted& wanted);

/// What it writes: that of `output`; by default that of its own node.
[[nodiscard]] const Component* mappingOutput(const Component& mapping, const Wanted& wanted);

/// The topology that an attribute of a component links to; without one, that in the context of a node, or null.
/// Throws Unplaceable where the link leads to no topology.
[[nodiscard]] const Component* namedTopology(const Component& self, std::string_view attribute, const Node& node);

}  // namespace allpairs::scene::sofa
