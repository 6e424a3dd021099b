// SPDX-License-Identifier: MIT
#include "sofa/graph/Links.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace allpairs::scene::sofa {
namespace {

template <class Found>
const Found* named(const std::unordered_map<std::string_view, const Found*>& byName, std::string_view name) {
  const auto found = byName.find(name);
  return found == byName.end() ? nullptr : found->second;
}

const Node& rootOf(const Node& node) { return node.parent == nullptr ? node : rootOf(*node.parent); }

/// "[-2]" is the second before `self`; without `self`, before the end.
LinkTarget countBack(const Node& node, const Component* self, std::string_view path) {
  const int back = std::atoi(std::string{path.substr(1)}.c_str());
  const auto start = self != nullptr && self->node == &node ? self->index : node.components.size() - 1;
  if (back > 0 || static_cast<std::size_t>(-static_cast<long>(back)) > start) return {};
  return {&node, node.components[start - static_cast<std::size_t>(-static_cast<long>(back))].get()};
}

/// A name in a node, or, for the first name of a path that starts with one, in the nearest ancestor that has it.
LinkTarget findName(const Node* node, std::string_view name, bool alsoInAncestors) {
  for (; node != nullptr; node = node->parent) {
    if (const auto* child = named(node->childByName, name)) return {child, nullptr};
    if (const auto* component = named(node->componentByName, name)) return {node, component};
    if (!alsoInAncestors) break;
  }
  return {};
}

/// The list that a node has of the wanted components; null where it has none.
const std::vector<const Component*>* indexed(const Node& node, const Wanted& wanted) {
  const auto* known = wanted.target<bool (*)(const Component&)>();
  if (known == nullptr) return nullptr;
  if (*known == isState) return &node.states;
  return *known == isTopology ? &node.topologies : nullptr;
}

const Component* lastIn(const Node& node, const Wanted& wanted) {
  if (const auto* list = indexed(node, wanted)) return list->empty() ? nullptr : list->back();
  const auto last =
      std::find_if(node.components.rbegin(), node.components.rend(), [&](const auto& c) { return wanted(*c); });
  return last != node.components.rend() ? last->get() : nullptr;
}

}  // namespace

void indexNames(Node& node) {
  for (const auto& component : node.components) {
    node.componentByName.emplace(component->name, component.get());
    if (isState(*component)) node.states.push_back(component.get());
    if (isTopology(*component)) node.topologies.push_back(component.get());
  }
  for (const auto& child : node.children) {
    node.childByName.emplace(child->name, child.get());
    indexNames(*child);
  }
}

std::optional<LinkText> parseLink(std::string_view text) {
  if (!text.starts_with('@')) return std::nullopt;
  text.remove_prefix(1);
  const auto slash = text.rfind('/');
  auto dot = text.rfind('.');
  const auto nameStart = slash == std::string_view::npos ? 0 : slash + 1;
  if (dot == std::string_view::npos || dot < nameStart) return LinkText{std::string{text}, {}};
  const auto last = text.substr(nameStart);
  if (last == "." || last == "..") return LinkText{std::string{text}, {}};
  return LinkText{std::string{text.substr(0, dot)}, std::string{text.substr(dot + 1)}};
}

LinkTarget followPath(const Node& from, const Component* self, std::string_view path) {
  if (path.empty() || path == "[]") return {&from, self};
  if (path.starts_with('['))
    return path.ends_with(']') && !from.components.empty() ? countBack(from, self, path) : LinkTarget{};
  LinkTarget at{&from, nullptr};
  bool anchored = path.starts_with('/');
  if (anchored) at.node = &rootOf(from);
  while (!path.empty()) {
    const auto step = path.substr(0, path.find('/'));
    path.remove_prefix(std::min(step.size() + 1, path.size()));
    if (step.empty()) continue;
    if (at.component != nullptr) return {};  // Components have no components of their own here.
    if (step == "..")
      at.node = at.node->parent;
    else if (step != ".")
      at = findName(at.node, step, !anchored);
    if (at.node == nullptr) return {};
    anchored = true;
  }
  return at;
}

LinkedData followLink(const Component& self, std::string_view text) {
  auto link = parseLink(text);
  if (!link) return {};
  return {followPath(*self.node, &self, link->path).component, std::move(link->data)};
}

LinkedData followLinkOf(const Component& self, std::string_view name) {
  return followLink(self, self.attributes.value(name, self.attributes.value("src")));
}

const Component* firstIn(const Node& node, const Wanted& wanted) {
  if (const auto* list = indexed(node, wanted)) return list->empty() ? nullptr : list->front();
  const auto first = std::ranges::find_if(node.components, [&](const auto& c) { return wanted(*c); });
  return first == node.components.end() ? nullptr : first->get();
}

const Component* inContext(const Node& node, const Wanted& wanted) {
  if (const auto* last = lastIn(node, wanted)) return last;
  return node.parent != nullptr ? firstInContext(*node.parent, wanted) : nullptr;
}

const Component* firstInContext(const Node& node, const Wanted& wanted) {
  for (const auto* at = &node; at != nullptr; at = at->parent)
    if (const auto* first = firstIn(*at, wanted)) return first;
  return nullptr;
}

const Component* followTo(const Component& self, std::string_view text, const Wanted& wanted) {
  if (!text.starts_with('@')) return nullptr;
  const auto target = followPath(*self.node, &self, text.substr(1));
  if (target.component != nullptr) return wanted(*target.component) ? target.component : nullptr;
  if (target.node == nullptr) return nullptr;
  const auto* first = firstIn(*target.node, wanted);
  if (first == nullptr) return inContext(*target.node, wanted);
  return first == lastIn(*target.node, wanted) ? first : nullptr;
}

const Component* mappingInput(const Component& mapping, const Wanted& wanted) {
  return followTo(mapping, mapping.attributes.value("input", "@../"), wanted);
}

const Component* mappingOutput(const Component& mapping, const Wanted& wanted) {
  return followTo(mapping, mapping.attributes.value("output", "@./"), wanted);
}

const Component* namedTopology(const Component& self, std::string_view attribute, const Node& node) {
  const auto link = self.attributes.value(attribute);
  if (link.empty()) return inContext(node, isTopology);
  const auto* found = followTo(self, link, isTopology);
  if (found == nullptr)
    throw Unplaceable(self,
                      std::string{attribute} + "=\"" + std::string{link.substr(0, 80)} + "\" leads to no topology");
  return found;
}

}  // namespace allpairs::scene::sofa
