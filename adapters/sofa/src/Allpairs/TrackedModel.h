// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/CollisionModel.h>
#include <sofa/core/objectmodel/DDGNode.h>

#include <memory>
#include <span>

#include "allpairs/collision/HostedModel.h"

namespace allpairs::plugin {

/// The model of SOFA that one of ours stands for, as it was added to the broad phase.
[[nodiscard]] inline sofa::core::CollisionModel* hostOf(const collision::CollisionModel& model) {
  return static_cast<sofa::core::CollisionModel*>(static_cast<const collision::HostedModel*>(model.getLast())->host());
}

/// One of SOFA's models, known by its root, and the model of ours that stands for it from step to step.
///
/// Each step reads the root's box, the node, and the links of the levels. Flags, groups and the contact distance are
/// SOFA's Data, and are read when SOFA reports a change: this object depends on them in SOFA's graph of Data. The root
/// and the last level are held, so that no other model can have their addresses.
///
/// Of a model with four levels and more, a level that is neither first nor last and that somebody links to another
/// model goes unnoticed. SOFA itself makes and removes levels at the root only.
class TrackedModel final : public sofa::core::objectmodel::DDGNode {
 public:
  explicit TrackedModel(sofa::core::CollisionModel& root) : m_root(&root) {}

  /// Reads models as they are now.
  static void read(std::span<TrackedModel* const> models);

  [[nodiscard]] const sofa::core::CollisionModel* root() const { return m_root.get(); }
  [[nodiscard]] collision::HostedModel& model() { return *m_model; }

  /// Whether the root is a box.
  [[nodiscard]] bool hasBox() const { return m_hasBox; }

  /// Whether only SOFA can test the root: no box, a NaN, or min > max on some axis.
  [[nodiscard]] bool hasOddRoot() const { return m_hasOddRoot; }

  /// Whether it may collide with itself or with its neighbours in the node.
  [[nodiscard]] bool mayCollideWithItself() const { return m_mayCollideWithItself; }

  /// Nothing depends on it.
  void update() override {}

  /// Data whose edit ends are read in the next step, whatever was read while they were edited.
  void notifyEndEdit() override { setDirtyValue(); }

 private:
  [[nodiscard]] bool hasSameLevels() const;
  void readLevels();
  void readData();
  void readNode();
  void readBox();

  sofa::core::CollisionModel::SPtr m_root;
  sofa::core::CollisionModel::SPtr m_last;
  const sofa::core::objectmodel::BaseComponent* m_lastAsComponent = nullptr;  // a virtual base, far from the rest
  const sofa::core::CollisionModel* m_belowRoot = nullptr;
  const sofa::core::CollisionModel* m_aboveLast = nullptr;
  std::unique_ptr<collision::HostedModel> m_model;
  bool m_hasBox = false;
  bool m_hasContactDistance = false;  // one that is a number
  bool m_hasOddRoot = false;
  bool m_mayCollideWithItself = false;
};

}  // namespace allpairs::plugin
