// SPDX-License-Identifier: MIT
#include "sofa/graph/SceneGraph.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "allpairs/scene/FileError.h"
#include "input/Edits.h"
#include "input/Words.h"

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

/// Names of SOFA's that are near to another of its names, and no slips.
bool isAnother(std::string_view written, std::string_view meant) {
  static constexpr std::array<std::string_view, 4> kAlike{"rest_position", "reset_position", "defaultHeight",
                                                          "dafaultHeight"};
  if (withoutDigits(written) == withoutDigits(meant)) return true;  // rotation and rotation2
  return std::ranges::find(kAlike, written) != kAlike.end();
}

/// Whether a name is so near to another that it is likely to be meant: a letter off, of long ones two.
bool isSlipOf(std::string_view meant, std::string_view written) {
  constexpr std::size_t kLeastLength = 5;
  constexpr std::size_t kLongName = 8;
  const std::size_t length = std::min(written.size(), meant.size());
  const std::size_t most = length < kLongName ? 1 : 2;
  if (length < kLeastLength || std::max(written.size(), meant.size()) > length + most) return false;
  return !isAnother(written, meant) && editsBetween(written, meant) <= most;
}

}  // namespace

const std::string* Attributes::find(std::string_view name) const {
  const auto found = std::ranges::find(m_entries, name, &Attribute::name);
  if (found == m_entries.end()) {
    noteInVain(name);
    return nullptr;
  }
  m_uses[static_cast<std::size_t>(found - m_entries.begin())].isAskedFor = true;
  return &found->value;
}

void Attributes::noteInVain(std::string_view name) const {
  for (std::size_t i = 0; i < m_entries.size(); ++i) {
    if (m_uses[i].meant.empty() && isSlipOf(name, m_entries[i].name)) m_uses[i].meant = name;
  }
}

std::vector<LikelySlip> Attributes::slips() const {
  std::vector<LikelySlip> slips;
  for (std::size_t i = 0; i < m_entries.size(); ++i) {
    if (!m_uses[i].isAskedFor && !m_uses[i].meant.empty()) slips.push_back({m_entries[i].name, m_uses[i].meant});
  }
  return slips;
}

std::string_view Attributes::value(std::string_view name, std::string_view standard) const {
  const auto* found = find(name);
  return found != nullptr ? std::string_view{*found} : standard;
}

void Attributes::set(std::string_view name, std::string_view value) {
  replace(name, value);
  if (std::ranges::find(m_entries, name, &Attribute::name) != m_entries.end()) return;
  m_uses.emplace_back();
  m_entries.push_back({std::string{name}, std::string{value}});
}

void Attributes::replace(std::string_view name, std::string_view value) {
  const auto found = std::ranges::find(m_entries, name, &Attribute::name);
  if (found != m_entries.end()) found->value = value;
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
