// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/CollisionModel.h>
#include <sofa/core/behavior/BaseMechanicalState.h>
#include <sofa/core/collision/BroadPhaseDetection.h>
#include <sofa/core/collision/Pipeline.h>
#include <sofa/simulation/Node.h>

#include <string>
#include <vector>

#include "Settings.h"

namespace allpairs::tools {

using BroadPhase = sofa::core::collision::BroadPhaseDetection;

/// Makes SOFA ready, and loads plugins of it.
///
/// Bad input: a plugin that SOFA can't load throws std::runtime_error.
void loadPlugins(const std::vector<std::string>& names);

/// A scene of SOFA, loaded, with other broad phases than its own, and run step by step.
class SceneRun {
 public:
  /// Loads a scene. With a class, every broad phase of the scene is replaced by one of it, under the same name, with
  /// the same box, before the scene is initialised.
  ///
  /// Bad input: a scene or a class that SOFA can't make throws std::runtime_error.
  SceneRun(const Settings& settings, const std::string& broadPhaseClass = {});
  SceneRun(const SceneRun&) = delete;
  SceneRun& operator=(const SceneRun&) = delete;
  SceneRun(SceneRun&&) = delete;
  SceneRun& operator=(SceneRun&&) = delete;
  ~SceneRun();

  void step();

  /// Makes and initialises another broad phase in the scene's root; the pipelines don't know it.
  [[nodiscard]] BroadPhase& make(const std::string& broadPhaseClass);

  [[nodiscard]] std::vector<BroadPhase*> broadPhases() const;
  [[nodiscard]] std::vector<sofa::core::behavior::BaseMechanicalState*> states() const;

  [[nodiscard]] std::vector<sofa::core::collision::Pipeline*> pipelines() const;

  /// The collision models, each by its level with the elements.
  [[nodiscard]] std::vector<sofa::core::CollisionModel*> models() const;

  /// How many collision models there are, whatever their levels.
  [[nodiscard]] std::size_t countModels() const;

 private:
  void replace(BroadPhase& old, const std::string& broadPhaseClass);

  sofa::simulation::Node::SPtr m_root;
};

}  // namespace allpairs::tools
