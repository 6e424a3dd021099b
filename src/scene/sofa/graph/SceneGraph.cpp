// SPDX-License-Identifier: MIT
#include "sofa/graph/SceneGraph.h"
#include "allpairs/scene/FileError.h"

#include <algorithm>

namespace allpairs::scene::sofa {
namespace {

using enum ComponentKind;

bool isFromTo(const Component& component, ComponentKind first, ComponentKind last) {
  return component.kind() >= first && component.kind() <= last;
}

const std::filesystem::path& fileOf(const Place& place) {
  static const std::filesystem::path unknown{"(scene)"};
  return place.file ? *place.file : unknown;
}

}  // namespace

const std::string* Attributes::find(std::string_view name) const {
  const auto found = std::ranges::find(m_entries, name, &Attribute::name);
  return found == m_entries.end() ? nullptr : &found->value;
}

std::string_view Attributes::value(std::string_view name, std::string_view standard) const {
  const auto* found = find(name);
  return found != nullptr ? std::string_view{*found} : standard;
}

void Attributes::set(std::string_view name, std::string_view value) {
  const auto found = std::ranges::find(m_entries, name, &Attribute::name);
  if (found != m_entries.end())
    found->value = value;
  else
    m_entries.push_back({std::string{name}, std::string{value}});
}

std::string Component::path() const {
  const auto above = node->path();
  return above == "/" ? above + name : above + '/' + name;  // SOFA takes a node without a name for the root.
}

std::string Component::describe() const { return type + " '" + name + "' (" + path() + ')'; }

std::string Node::path() const { return parent == nullptr ? std::string{} : parent->path() + '/' + name; }

bool isModel(const Component& component) { return isFromTo(component, PointModel, UnknownModel); }

bool isTopology(const Component& component) { return isFromTo(component, MeshTopology, UnknownTopology); }

bool isTopologicalMapping(const Component& component) {
  return isFromTo(component, Tetra2Triangle, UnknownTopologicalMapping);
}

bool isMapping(const Component& component) { return isFromTo(component, RigidMapping, UnknownMapping); }

bool isState(const Component& component) { return component.kind() == MechanicalState; }

bool isMethod(const Component& component) { return isFromTo(component, DiscreteMethod, OtherMethod); }

Unplaceable::Unplaceable(const Component& component, const std::string& reason)
    : FileError(fileOf(component.place), component.describe() + ": " + reason, component.place.line),
      m_reason(component.describe() + ": " + reason) {}

Unplaceable::Unplaceable(const Place& place, const std::string& problem)
    : FileError(fileOf(place), problem, place.line), m_reason(problem) {}

}  // namespace allpairs::scene::sofa
