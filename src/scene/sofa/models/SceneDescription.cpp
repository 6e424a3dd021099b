// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "allpairs/scene/FileError.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"
#include "sofa/graph/SceneXml.h"
#include "sofa/models/ModelDescription.h"
#include "sofa/models/Models.h"

namespace allpairs::scene::sofa {
namespace {

/// The first wanted component below a node, in the order of traversal; inactive nodes do not count.
const Component* firstBelow(const Node& node, const Wanted& wanted) {
  if (!node.active) return nullptr;
  const auto found = std::ranges::find_if(node.components, [&](const auto& c) { return wanted(*c); });
  if (found != node.components.end()) return found->get();
  for (const auto& child : node.children)
    if (const auto* below = firstBelow(*child, wanted)) return below;
  return nullptr;
}

Wanted ofKind(ComponentKind kind) {
  return [kind](const Component& component) { return component.kind() == kind; };
}

MethodDescription describeMethod(Evaluation& evaluation, const Component* method) {
  if (method == nullptr) return {};
  if (method->kind() == ComponentKind::OtherMethod)
    throw Unplaceable(*method, "this intersection method is not known to this reader");
  MethodDescription result{.name = method->type, .proximity = method->kind() == ComponentKind::ProximityMethod};
  result.alarmDistance = evaluation.number(*method, {"alarmDistance"}, result.proximity ? 1.0 : 0.0);
  result.contactDistance = evaluation.number(*method, {"contactDistance"}, result.proximity ? 0.5 : 0.0);
  return result;
}

std::optional<RegionDescription> describeRegion(Evaluation& evaluation, const Component* broadPhase) {
  if (broadPhase == nullptr || !broadPhase->attributes.has("box")) return std::nullopt;
  const auto corners = evaluation.points(*broadPhase, {"box"});
  if (corners.empty()) return std::nullopt;
  if (corners.size() != 2) throw Unplaceable(*broadPhase, "a box has two corners");
  if (corners[0] == Vec3{} && corners[1] == Vec3{}) return std::nullopt;  // What SOFA writes for no box.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double min = corners[0][axis];
    const double max = corners[1][axis];
    if (min < max) continue;
    throw Unplaceable(*broadPhase,
                      fmt::format("a region's min must be less than its max on every axis; in {} they are {} and {}",
                                  "xyz"[axis], min, max));
  }
  return RegionDescription{corners[0], corners[1]};
}

class Traversal {
 public:
  Traversal(Evaluation& evaluation, bool partial, SceneDescription& scene)
      : m_evaluation(evaluation), m_partial(partial), m_scene(scene) {}

  void visit(const Node& node) {
    if (!node.active) return;
    for (const auto& component : node.components)
      if (isModel(component->kind())) add(*component);
    for (const auto& child : node.children) visit(*child);
  }

 private:
  void add(const Component& component) {
    try {
      auto model = describeModel(m_evaluation, component);
      model.owner = ownerOf(component);
      m_scene.models.push_back(std::move(model));
    } catch (const Unplaceable& problem) {
      const auto needed = problem.reason().starts_with(component.describe())
                              ? std::string{}
                              : "; " + component.describe() + " depends on it";
      leaveOut(component, problem, problem.reason() + needed);
    } catch (const FileError& problem) {
      leaveOut(component, problem, problem.problem() + "; " + component.describe() + " depends on it");
    }
  }

  void leaveOut(const Component& component, const FileError& problem, const std::string& reason) {
    if (!m_partial) throw FileError(problem.path(), reason, problem.line(), problem.column());
    m_scene.ignored.push_back({problem.path(), problem.line(), component.path(), oneLine(reason)});
  }

  std::size_t ownerOf(const Component& component) {
    if (component.node != m_owner) m_scene.owners.push_back(component.node->path());
    m_owner = component.node;
    return m_scene.owners.size() - 1;
  }

  Evaluation& m_evaluation;
  bool m_partial;
  SceneDescription& m_scene;
  const Node* m_owner = nullptr;
};

}  // namespace

SceneDescription describeScene(const std::filesystem::path& path, const ReadOptions& options) {
  ReadScope scope(path, options);
  const auto root = readSceneGraph(path, scope);
  Evaluation evaluation(*root, scope);
  SceneDescription scene;
  const auto* pipeline = firstBelow(*root, ofKind(ComponentKind::Pipeline));
  const Node& top = pipeline != nullptr ? *pipeline->node : *root;
  scene.method = describeMethod(evaluation, firstBelow(top, [](const Component& c) { return isMethod(c.kind()); }));
  scene.region = describeRegion(evaluation, firstBelow(top, ofKind(ComponentKind::BroadPhase)));
  Traversal(evaluation, options.partial, scene).visit(top);
  return scene;
}

}  // namespace allpairs::scene::sofa
