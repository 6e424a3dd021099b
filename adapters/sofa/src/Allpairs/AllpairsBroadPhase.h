// SPDX-License-Identifier: MIT
#pragma once

#include <Allpairs/config.h>
#include <sofa/core/collision/BroadPhaseDetection.h>
#include <sofa/helper/OptionsGroup.h>
#include <sofa/type/Vec.h>
#include <sofa/type/fixed_array.h>

#include <memory>
#include <string>

namespace allpairs::plugin {

/// SOFA's broad phase by Allpairs: stands wherever BruteForceBroadPhase or ParallelBruteForceBroadPhase stands.
///
/// The list of pairs is that of BruteForceBroadPhase on the same models: the same pairs, orientation and order. Models'
/// root boxes, flags, groups and nodes are read when they are added.
/// Geometry:  as SOFA's: closed boxes, per axis, in double, within the intersection method's distance.
/// Bad input: settings that make no sense are reported as errors of the component, and the default is used; a reversed
///            `box` as a warning, and it counts as in SOFA. Root boxes that are reversed or hold a NaN are tested by
///            SOFA's own intersection method, as without the plugin.
/// Cost:      one pass over the models and that of allpairs::OverlapSearch on their root boxes. A method that isn't one
///            of SOFA's own can't be bounded: each pair of models is asked then, as BruteForceBroadPhase does.
/// Threads:   the search runs on `threads` threads; SOFA's models and methods are called from the calling thread. Two
///            of these components that share a model, as two pipelines may, must not run at once: reading links the
///            model's Data.
class ALLPAIRS_SOFA_API AllpairsBroadPhase : public sofa::core::collision::BroadPhaseDetection {
 public:
  SOFA_CLASS(AllpairsBroadPhase, sofa::core::collision::BroadPhaseDetection);

  using Region = sofa::type::fixed_array<sofa::type::Vec3, 2>;

  ~AllpairsBroadPhase() override;

  sofa::core::objectmodel::Data<Region> d_box;
  sofa::core::objectmodel::Data<sofa::helper::OptionsGroup> d_strategy;
  sofa::core::objectmodel::Data<int> d_threads;
  sofa::core::objectmodel::Data<bool> d_verify;

  void init() override;

  /// Reads the settings again.
  void reinit() override;

  /// Reads one setting from a scene's text.
  bool parseField(const std::string& attribute, const std::string& value) override;

  void beginBroadPhase() override;
  void addCollisionModel(sofa::core::CollisionModel* cm) override;
  void addCollisionModels(const sofa::type::vector<sofa::core::CollisionModel*>& models) override;
  void endBroadPhase() override;

  /// Lets go of SOFA's models, which it holds between steps.
  void cleanup() override;

  /// False: roots are enough.
  [[nodiscard]] bool needsDeepBoundingTree() const override { return false; }

 protected:
  AllpairsBroadPhase();

 private:
  struct State;

  void readRegion();
  void readStrategy();
  void readThreads();
  [[nodiscard]] bool isInRegion(sofa::core::CollisionModel& model) const;
  void addAll(sofa::core::CollisionModel* const* models, std::size_t count);
  void collectPairs();
  void comparePairs();

  std::unique_ptr<State> m_state;
};

}  // namespace allpairs::plugin
