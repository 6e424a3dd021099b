// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "allpairs/scene/FileError.h"
#include "input/Words.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Generation.h"
#include "sofa/graph/Links.h"
#include "sofa/graph/SceneXml.h"
#include "sofa/graph/Values.h"
#include "sofa/models/ModelDescription.h"
#include "sofa/models/Models.h"
#include "sofa/models/Pipelines.h"

namespace allpairs::scene::sofa {
namespace {

void warnOfMotion(Evaluation& evaluation, const Component& method) {
  const auto type = method.attributes.value("continuousCollisionType", "None");
  if (type != "None" && type != "0")
    evaluation.warn(method,
                    "the method is continuous; boxes here are those of the start, without the motion of a step");
}

MethodDescription describeMethod(Evaluation& evaluation, const Component* method) {
  if (method == nullptr) return {};
  if (method->kind() == ComponentKind::OtherMethod)
    throw Unplaceable(*method, "this intersection method is not known to this reader");
  MethodDescription result{.name = method->type};
  if (method->kind() == ComponentKind::ProximityMethod) {
    result.alarmDistance = evaluation.number(*method, {"alarmDistance"}, 1.0);
    result.contactDistance = evaluation.number(*method, {"contactDistance"}, 0.5);
    result.addsContactDistances = !evaluation.hasOldDistances() || method->type == "LocalMinDistance";
  } else if (method->type != "DiscreteIntersection") {
    result.alarmDistance = evaluation.number(*method, {"alarmDistance"}, 0.0);
  } else if (method->attributes.has("alarmDistance")) {
    evaluation.warn(*method, "its alarmDistance is not read, as in SOFA, where this method has none");
  }
  warnOfMotion(evaluation, *method);
  if (method->type == "BulletIntersection")
    evaluation.warn(*method,
                    "Bullet detects in this scene, with margins of its own; here the models' own boxes are tested");
  return result;
}

/// Newer SOFA makes a broad phase in the place of an old detection, and gives it nothing of what was written there.
bool hasRegion(const Component& broadPhase, Generation generation) {
  if (generation == Generation::Sofa20) return broadPhase.type != "RayTraceDetection";
  return broadPhase.type.ends_with("BroadPhase") || broadPhase.type == "IncrSAP" || broadPhase.type == "IncrementalSAP";
}

std::optional<Box> describeRegion(Evaluation& evaluation, const Component* broadPhase) {
  if (broadPhase == nullptr || !broadPhase->attributes.has("box")) return std::nullopt;
  if (!hasRegion(*broadPhase, evaluation.generation())) {
    evaluation.warn(*broadPhase, "its box is not read, as in SOFA, where this component has none");
    return std::nullopt;
  }
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
  return Box{corners[0], corners[1]};
}

/// Describes each model once, however many pipelines take it.
class ModelList {
 public:
  ModelList(Evaluation& evaluation, bool partial, SceneDescription& scene)
      : m_evaluation(evaluation), m_partial(partial), m_scene(scene) {}

  /// The index of a model, nothing if it was left out.
  std::optional<std::size_t> indexOf(const Component& component) {
    const auto [place, isNew] = m_indices.emplace(&component, std::nullopt);
    if (isNew && add(component)) place->second = m_scene.models.size() - 1;
    return place->second;
  }

  [[nodiscard]] bool has(const Component& component) const { return m_indices.contains(&component); }
  [[nodiscard]] const std::vector<ModelDescription>& descriptions() const { return m_scene.models; }

 private:
  bool add(const Component& component) {
    if (!isMade(m_evaluation, component)) return false;
    try {
      auto model = describeModel(m_evaluation, component);
      model.owner = ownerOf(component);
      m_scene.models.push_back(std::move(model));
      return true;
    } catch (const Unplaceable& problem) {
      const auto needed = problem.reason().starts_with(component.describe())
                              ? std::string{}
                              : "; " + component.describe() + " depends on it";
      leaveOut(component, problem, problem.reason() + needed);
    } catch (const FileError& problem) {
      leaveOut(component, problem, problem.problem() + "; " + component.describe() + " depends on it");
    }
    return false;
  }

  void leaveOut(const Component& component, const FileError& problem, const std::string& reason) {
    if (!m_partial) throw FileError(problem.path(), reason, problem.line(), problem.column());
    m_scene.remarks.push_back({.file = problem.path(),
                               .line = problem.line(),
                               .subject = component.path(),
                               .reason = oneLine(reason),
                               .isPartial = true});
  }

  std::size_t ownerOf(const Component& component) {
    const auto [place, isNew] = m_owners.emplace(component.node, m_scene.owners.size());
    if (isNew) m_scene.owners.push_back(component.node->path());
    return place->second;
  }

  Evaluation& m_evaluation;
  bool m_partial;
  SceneDescription& m_scene;
  std::map<const Component*, std::optional<std::size_t>> m_indices;
  std::map<const Node*, std::size_t> m_owners;
};

Remark remarkOn(const Component& component, std::string reason) {
  return {.file = *component.place.file,
          .line = component.place.line,
          .subject = component.path(),
          .reason = std::move(reason)};
}

/// Says where SOFA would detect nothing at all.
void warnOf(const PipelineParts& parts, const Node& root, SceneDescription& scene) {
  if (parts.component == nullptr && !parts.models.empty())
    scene.warnings.push_back({.file = *root.place.file,
                              .line = root.place.line,
                              .subject = root.path(),
                              .reason = "the scene has no collision pipeline: SOFA detects nothing in it; all its "
                                        "models are tested against one another here"});
  if (parts.missing.empty()) return;
  const std::string who = parts.broadPhase == nullptr ? "SOFA" : "SOFA from 26.06 on";
  scene.warnings.push_back(
      remarkOn(*parts.component, "the pipeline lacks " + parts.missing + ": " + who + " detects nothing with it"));
}

/// Says which detections of SOFA have rules of their own. Newer SOFA makes a broad phase in the place of old ones.
void warnOfOwnRules(Evaluation& evaluation, const Component& detection, bool anySelfCollision) {
  const bool isOld = evaluation.generation() == Generation::Sofa20;
  if (detection.type.starts_with("Incr") || (isOld && detection.type == "DirectSAP"))
    evaluation.warn(
        detection,
        "SOFA compares the boxes of elements with this component, without contact distances, without groups "
        "across nodes and whatever its box is; here the models' boxes are tested by the rules of "
        "BruteForceBroadPhase");
  if (isOld && detection.type == "RayTraceDetection" && anySelfCollision)
    evaluation.warn(
        detection,
        "SOFA pairs no model with itself or with another of its node with this component; here the rules of "
        "BruteForceBroadPhase pair them");
}

/// Nothing in a scene may tell whether it is meant for a SOFA that adds contact distances to those of all its methods.
void warnOfNewDistances(Evaluation& evaluation, const Component& method) {
  if (method.kind() != ComponentKind::ProximityMethod || method.type == "LocalMinDistance") return;
  if (evaluation.generation() == Generation::Sofa20 && !evaluation.hasOldDistances())
    evaluation.warn(method,
                    "the contact distances of its models count between root boxes, as in SOFA since 21.06; they do not "
                    "if 20.06 is asked for");
}

/// Says, once of each, which data of models came with a newer SOFA than the one that was asked for, which does not read
/// them, if that makes a difference.
void warnOfNewData(Evaluation& evaluation, const Node& root, const ModelList& models) {
  if (!evaluation.hasOldDistances()) return;
  const auto warn = [&](const std::string& name, const std::string& reason, const auto& isMissed) {
    auto missed = modelsBelow(root);
    std::erase_if(missed, [&](const Component* model) { return !models.has(*model) || !isMissed(model->attributes); });
    if (missed.empty()) return;
    std::string text = "its " + name + " is not read, as in SOFA before " + reason;
    if (const auto others = missed.size() - 1; others != 0)
      text += fmt::format("; nor is that of {} other model{}", others, others == 1 ? "" : "s");
    evaluation.warn(*missed.front(), std::move(text));
  };
  warn("useCurvature", "20.12",
       [](const Attributes& given) { return parseBool(given.value("useCurvature")).value_or(false); });
  warn("contactDistance", "25.12, which calls it proximity", [](const Attributes& given) {
    return given.has("contactDistance") && !given.has("proximity") &&
           parseWholeFloat(given.value("contactDistance")) != 0.0;
  });
}

PipelineDescription describePipeline(Evaluation& evaluation, const PipelineParts& parts, ModelList& models) {
  PipelineDescription pipeline;
  if (parts.component != nullptr) pipeline.path = parts.component->path();
  pipeline.method = describeMethod(evaluation, parts.method);
  pipeline.region = describeRegion(evaluation, parts.broadPhase);
  for (const auto* component : parts.models)
    if (const auto index = models.indexOf(*component)) pipeline.models.push_back(*index);
  const bool anySelfCollision = std::ranges::any_of(
      pipeline.models, [&](std::size_t model) { return models.descriptions()[model].selfCollision; });
  if (parts.broadPhase != nullptr) warnOfOwnRules(evaluation, *parts.broadPhase, anySelfCollision);
  const bool anyContactDistance = std::ranges::any_of(
      pipeline.models, [&](std::size_t model) { return models.descriptions()[model].contactDistance != 0; });
  if (parts.method != nullptr && anyContactDistance) warnOfNewDistances(evaluation, *parts.method);
  return pipeline;
}

/// Says which nodes are taken as active although they do not say so in a way that can be read.
void warnOfActivation(const Node& node, SceneDescription& scene) {
  if (!node.active) return;
  if (const std::string_view text = node.badActivation; !text.empty())
    scene.warnings.push_back(
        {.file = *node.place.file,
         .line = node.place.line,
         .subject = node.path(),
         .reason = "activated: " + quotedWord(text) +
                   (text.starts_with('@') ? " is a link, which this reader does not follow; the node is taken as active"
                                          : " is neither true nor false; the node is active, as in SOFA")});
  for (const auto& child : node.children) warnOfActivation(*child, scene);
}

/// Says of each class name once why it is doubtful.
void warnOfNames(const Node& node, Generation generation, std::set<std::string>& seen, SceneDescription& scene) {
  for (const auto& component : node.components) {
    if (!seen.insert(component->type).second) continue;
    if (auto doubt = doubtAboutName(*component, generation); !doubt.empty())
      scene.warnings.push_back(remarkOn(*component, std::move(doubt)));
  }
  for (const auto& child : node.children) warnOfNames(*child, generation, seen, scene);
}

/// Says which attributes of the components that were read are not read, and most likely mean one that is.
void warnOfSlips(const Node& node, SceneDescription& scene) {
  for (const auto& component : node.components)
    for (const auto& [name, meant] : component->attributes.slips())
      scene.warnings.push_back(remarkOn(*component, "its attribute '" + std::string{name}.substr(0, 80) +
                                                        "' is not read; is '" + std::string{meant} + "' meant?"));
  for (const auto& child : node.children) warnOfSlips(*child, scene);
}

/// The axis against gravity: 1 to 3 for x to z, below 0 for the other way; y where there is none.
int upOf(const Node& root) {
  constexpr int kUp = 2;
  std::string bad;
  const auto gravity = parseNumbers(root.gravity, bad);
  if (!gravity || gravity->size() != 3) return kUp;
  const auto isWeaker = [](double a, double b) { return std::abs(a) < std::abs(b); };
  const auto strongest = std::max_element(gravity->begin(), gravity->end(), isWeaker);
  if (*strongest == 0.0) return kUp;
  const auto axis = static_cast<int>(strongest - gravity->begin()) + 1;
  return *strongest < 0.0 ? axis : -axis;
}

}  // namespace

SceneDescription describeScene(const std::filesystem::path& path, const ReadOptions& options) {
  ReadScope scope(path, options);
  const auto root = readSceneGraph(path, scope);
  const auto generation = generationOf(*root, options.sofa);
  if (generation == Generation::Sofa26) nameByClass(*root);
  indexNames(*root);
  Evaluation evaluation(*root, scope, generation);
  evaluation.setOldDistances(options.sofa == SofaVersion::Sofa2006);
  SceneDescription scene;
  scene.up = upOf(*root);
  ModelList models(evaluation, options.partial, scene);
  for (const auto& parts : findPipelines(*root, generation)) {
    scene.pipelines.push_back(describePipeline(evaluation, parts, models));
    warnOf(parts, *root, scene);
  }
  warnOfNewData(evaluation, *root, models);
  warnOfActivation(*root, scene);
  std::set<std::string> seen;
  warnOfNames(*root, generation, seen, scene);
  warnOfSlips(*root, scene);
  for (const auto& [component, text] : evaluation.warnings()) scene.warnings.push_back(remarkOn(*component, text));
  for (const auto* component : modelsBelow(*root))
    if (!models.has(*component))
      scene.remarks.push_back(remarkOn(*component, "no collision pipeline of the scene takes this model"));
  scene.inputs = scope.files();
  return scene;
}

}  // namespace allpairs::scene::sofa
