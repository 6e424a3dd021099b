// SPDX-License-Identifier: MIT
#include "sofa/graph/Generation.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <unordered_map>

#include "input/Words.h"

namespace allpairs::scene::sofa {
namespace {

bool isNew(const Component& component) {
  static constexpr std::array<std::string_view, 11> kNewNames{"AllpairsBroadPhase",
                                                              "BruteForceBroadPhase",
                                                              "BVHNarrowPhase",
                                                              "ParallelBruteForceBroadPhase",
                                                              "ParallelBVHNarrowPhase",
                                                              "RayTraceNarrowPhase",
                                                              "CompositeCollisionPipeline",
                                                              "FixedProjectiveConstraint",
                                                              "SubCollisionPipeline",
                                                              "MeshOBJLoader",
                                                              "TriangleOctreeCollisionModel"};
  if (std::ranges::find(kNewNames, component.type) != kNewNames.end()) return true;
  if (component.type != "RequiredPlugin") return false;
  std::string_view plugins = component.attributes.value("pluginName", component.name);
  for (std::string_view plugin = takeWord(plugins); !plugin.empty(); plugin = takeWord(plugins))
    if (plugin == "Allpairs" || plugin.starts_with("Sofa.")) return true;
  return false;
}

/// Names that SOFA 24.12 and 26.06 dropped (its Sofa.Helper, ComponentChange.cpp); those of collision models have a
/// rule.
bool isDropped(const Component& component) {
  static constexpr std::array<std::string_view, 12> kDropped{"DefaultPipeline",
                                                             "DefaultContactManager",
                                                             "RuleBasedCollisionResponse",
                                                             "MeshObjLoader",
                                                             "Mesh",
                                                             "RegularGrid",
                                                             "SparseGrid",
                                                             "SparseGridRamification",
                                                             "SparseGridMultiple",
                                                             "CylinderGrid",
                                                             "SphereGrid",
                                                             "IncrementalSAP"};
  if (std::ranges::find(kDropped, component.type) != kDropped.end()) return true;
  return isModel(component) && !component.what.name.empty() && !component.type.ends_with("CollisionModel") &&
         component.type.find("Bullet") == std::string::npos && !component.type.starts_with("Cuda");
}

bool anyIsNew(const Node& node) {
  return std::ranges::any_of(node.components, [](const auto& component) { return isNew(*component); }) ||
         std::ranges::any_of(node.children, [](const auto& child) { return anyIsNew(*child); });
}

}  // namespace

Generation generationOf(const Node& root, SofaVersion asked) {
  if (asked == SofaVersion::FromScene) return anyIsNew(root) ? Generation::Sofa26 : Generation::Sofa20;
  return asked == SofaVersion::Sofa2612 ? Generation::Sofa26 : Generation::Sofa20;
}

std::string newClassName(const Component& component) {
  static const std::unordered_map<std::string_view, std::string_view> kRenamed{
      {"DefaultPipeline", "CollisionPipeline"},     {"MeshObjLoader", "MeshOBJLoader"},
      {"TPointModel", "PointCollisionModel"},       {"TLineModel", "LineCollisionModel"},
      {"TTriangleModel", "TriangleCollisionModel"}, {"TSphereModel", "SphereCollisionModel"},
      {"TCapsuleModel", "CapsuleCollisionModel"},   {"TCylinderModel", "CylinderCollisionModel"},
      {"TOBBModel", "OBBCollisionModel"},           {"TetrahedronModel", "TetrahedronCollisionModel"}};
  const std::string_view name = component.what.name.empty() ? component.type : component.what.name;
  const auto renamed = kRenamed.find(name);
  return std::string{renamed == kRenamed.end() ? name : renamed->second};
}

std::string doubtAboutName(const Component& component, Generation generation) {
  if (generation == Generation::Sofa26 && isDropped(component))
    return "SOFA 26.12 has no component of the name '" + component.type + "' any more; it is read as before here";
  if (component.kind() != ComponentKind::Other) return {};
  const bool isInclude = component.type == "Include";
  if (isInclude || component.type == "node" || component.type == "NODE")
    return "SOFA has no component '" + component.type + "', and what is in it is left out; is " +
           (isInclude ? "include" : "Node") + " meant?";
  const auto similar = similarClass(component.type);
  if (similar.empty()) return {};
  return "this reader knows no component '" + component.type + "', and leaves it out; is " + std::string{similar} +
         " meant?";
}

void nameByClass(Node& node) {
  if (!node.isNamed) node.name.clear();
  std::map<std::string, std::size_t> counters;
  for (const auto& component : node.components) {
    if (component->isNamed) continue;
    const auto name = newClassName(*component);
    component->name = name + std::to_string(++counters[name]);
  }
  for (const auto& child : node.children) nameByClass(*child);
}

}  // namespace allpairs::scene::sofa
