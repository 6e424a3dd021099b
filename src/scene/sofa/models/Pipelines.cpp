// SPDX-License-Identifier: MIT
#include "sofa/models/Pipelines.h"

#include <algorithm>
#include <set>

#include "input/Words.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

using enum ComponentKind;

/// The first wanted component below a node, in the order of traversal; inactive nodes do not count.
const Component* firstBelow(const Node& node, const Wanted& wanted) {
  if (!node.active) return nullptr;
  if (const auto* here = firstIn(node, wanted)) return here;
  for (const auto& child : node.children)
    if (const auto* below = firstBelow(*child, wanted)) return below;
  return nullptr;
}

bool isBroadPhase(const Component& component) { return component.kind() == BroadPhase; }
bool isContactManager(const Component& component) { return component.kind() == ContactManager; }

/// Also one that is a broad phase too, or makes both, such as BruteForceDetection, and those of plugins.
bool isNarrowPhase(const Component& component) {
  if (component.kind() == BroadPhase) return !component.type.ends_with("BroadPhase");
  return component.kind() == NarrowPhase || component.type.ends_with("NarrowPhase") ||
         component.type.ends_with("Detection");
}

bool isSubPipeline(const Component& component) { return component.kind() == SubPipeline; }

void addModelsBelow(const Node& node, std::vector<const Component*>& models) {
  if (!node.active) return;
  for (const auto& component : node.components)
    if (isModel(*component)) models.push_back(component.get());
  for (const auto& child : node.children) addModelsBelow(*child, models);
}

/// What a pipeline needs to detect anything, and does not find in its node and below. Older SOFA goes without.
std::string missingBelow(const Node& node, const PipelineParts& pipeline, Generation generation) {
  if (pipeline.component == nullptr || pipeline.models.empty()) return {};
  if (pipeline.broadPhase == nullptr) return "a broad phase";
  if (generation == Generation::Sofa20) return {};
  if (pipeline.method == nullptr) return "an intersection method";
  if (firstBelow(node, isNarrowPhase) == nullptr) return "a narrow phase";
  return firstBelow(node, isContactManager) == nullptr ? "a contact manager" : std::string{};
}

/// A pipeline of everything in a node and below.
PipelineParts pipelineOver(const Node& node, const Component* component, Generation generation) {
  PipelineParts pipeline{.component = component,
                         .models = modelsBelow(node),
                         .method = firstBelow(node, isMethod),
                         .broadPhase = firstBelow(node, isBroadPhase),
                         .missing = {}};
  pipeline.missing = missingBelow(node, pipeline, generation);
  return pipeline;
}

/// The components that a link of a pipeline names, each once.
std::vector<const Component*> linked(const Component& pipeline, std::string_view name, const Wanted& wanted) {
  std::vector<const Component*> components;
  std::set<const Component*> seen;
  for (const std::string& link : allWords(pipeline.attributes.value(name))) {
    const auto* component = followTo(pipeline, link, wanted);
    if (component == nullptr)
      throw Unplaceable(pipeline, std::string{name} + ": '" + link.substr(0, 80) + "' leads to no such component");
    if (seen.insert(component).second) components.push_back(component);
  }
  return components;
}

const Component* lastOf(const std::vector<const Component*>& components) {
  return components.empty() ? nullptr : components.back();
}

/// Whether the simulation sees a component: that of an inactive node is there, but is not asked.
bool isInActiveNode(const Component* component) {
  for (const auto* node = component->node; node != nullptr; node = node->parent)
    if (!node->active) return false;
  return true;
}

std::string missingOf(const PipelineParts& pipeline) {
  const auto& attributes = pipeline.component->attributes;
  if (pipeline.models.empty()) return "collision models";
  if (pipeline.method == nullptr) return "an intersection method";
  if (!attributes.has("broadPhaseDetection")) return "a broad phase";
  if (!attributes.has("narrowPhaseDetection")) return "a narrow phase";
  return attributes.has("contactManager") ? std::string{} : "a contact manager";
}

PipelineParts subPipeline(const Component& component) {
  PipelineParts pipeline{
      .component = &component,
      .models = linked(component, "collisionModels", isModel),
      .method = lastOf(linked(component, "intersectionMethod", isMethod)),
      .broadPhase = lastOf(linked(component, "broadPhaseDetection", [](const Component&) { return true; })),
      .missing = {}};
  pipeline.missing = missingOf(pipeline);
  std::erase_if(pipeline.models, [](const Component* model) { return !isInActiveNode(model); });
  return pipeline;
}

/// A node runs one pipeline: the last that it has been given.
const Component* pipelineOf(const Node& node) {
  const auto last = std::find_if(node.components.rbegin(), node.components.rend(), [](const auto& component) {
    return component->kind() == Pipeline || component->kind() == CompositePipeline;
  });
  return last == node.components.rend() ? nullptr : last->get();
}

void addPipelinesBelow(const Node& node, Generation generation, std::vector<PipelineParts>& pipelines) {
  if (!node.active) return;
  if (const auto* component = pipelineOf(node)) {
    if (component->kind() == CompositePipeline)
      for (const auto* sub : linked(*component, "subCollisionPipelines", isSubPipeline))
        pipelines.push_back(subPipeline(*sub));
    else
      pipelines.push_back(pipelineOver(node, component, generation));
  }
  for (const auto& child : node.children) addPipelinesBelow(*child, generation, pipelines);
}

}  // namespace

std::vector<const Component*> modelsBelow(const Node& node) {
  std::vector<const Component*> models;
  addModelsBelow(node, models);
  return models;
}

std::vector<PipelineParts> findPipelines(const Node& root, Generation generation) {
  std::vector<PipelineParts> pipelines;
  addPipelinesBelow(root, generation, pipelines);
  if (pipelines.empty()) pipelines.push_back(pipelineOver(root, nullptr, generation));
  return pipelines;
}

}  // namespace allpairs::scene::sofa
