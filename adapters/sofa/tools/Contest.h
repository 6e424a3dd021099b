// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "SceneRun.h"

namespace allpairs::tools {

/// A broad phase of a Contest, and the microseconds of the steps in which it came first.
struct Contestant {
  std::string name;
  BroadPhase::SPtr phase;
  std::vector<double> processor;  // of the calling thread
  std::vector<double> elapsed;
  bool sameLists = true;
};

/// Stands in a pipeline as its broad phase, and hands the models of each step to several others.
///
/// Each in its turn comes first, and only then its time counts: right after the pipeline has computed the bounding
/// trees, with whatever that leaves in the processor's caches, as if it stood there alone. The others follow, so that
/// all lists can be compared with the first one's, which is what the pipeline gets.
class Contest : public BroadPhase {
 public:
  SOFA_CLASS(Contest, BroadPhase);

  /// Lets SOFA make one by the name Contest.
  static void enterInFactory();

  void enter(const std::string& name, BroadPhase& phase);
  [[nodiscard]] const std::vector<Contestant>& contestants() const { return m_contestants; }

  /// How many models there were, and how many pairs, in the last step.
  [[nodiscard]] std::size_t models() const { return m_models; }
  [[nodiscard]] std::size_t pairs() const { return cmPairs.size(); }

  void addCollisionModel(sofa::core::CollisionModel* cm) override;
  void addCollisionModels(const sofa::type::vector<sofa::core::CollisionModel*>& models) override;
  [[nodiscard]] bool needsDeepBoundingTree() const override { return false; }

 protected:
  Contest() = default;

 private:
  std::vector<Contestant> m_contestants;
  std::size_t m_turn = 0;
  std::size_t m_models = 0;
};

}  // namespace allpairs::tools
