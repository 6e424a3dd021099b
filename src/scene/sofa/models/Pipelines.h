// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "sofa/graph/Generation.h"
#include "sofa/graph/SceneGraph.h"

namespace allpairs::scene::sofa {

/// A collision pipeline of a scene, and the components that it works with.
struct PipelineParts {
  const Component* component = nullptr;  ///< Null for that of a scene without one.
  std::vector<const Component*> models;  ///< In the order in which the pipeline takes them.
  const Component* method = nullptr;     ///< Null where there is none.
  const Component* broadPhase = nullptr;
  std::string missing;  ///< What it lacks to detect anything in SOFA, "an intersection method"; empty for nothing.
};

/// The pipelines that SOFA runs, in its order; where there are none, one with all models of the scene.
///
/// Bad input: throws Unplaceable for a link of a pipeline that leads nowhere.
[[nodiscard]] std::vector<PipelineParts> findPipelines(const Node& root, Generation generation);

/// All models of a scene in the order of traversal; those in inactive nodes do not count.
[[nodiscard]] std::vector<const Component*> modelsBelow(const Node& node);

}  // namespace allpairs::scene::sofa
