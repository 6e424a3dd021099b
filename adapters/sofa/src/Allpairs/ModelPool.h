// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/CollisionModel.h>

#include <cstddef>
#include <memory>
#include <set>
#include <span>
#include <typeinfo>
#include <vector>

#include "allpairs/collision/HostedModel.h"

namespace allpairs::plugin {

/// The model of SOFA that one of ours stands for, as it was added to the broad phase.
[[nodiscard]] inline sofa::core::CollisionModel* hostOf(const collision::CollisionModel& model) {
  return static_cast<sofa::core::CollisionModel*>(static_cast<const collision::HostedModel*>(model.getLast())->host());
}

/// Our models that stand for SOFA's of a step, one for each that is added, kept from step to step.
class ModelPool {
 public:
  /// Begins a step: all models are free again.
  void clear();

  /// Adds models that stand for SOFA's as those are now, and gives them in their order; valid until the next addition.
  [[nodiscard]] std::span<collision::HostedModel* const> add(std::span<sofa::core::CollisionModel* const> hosts);

  /// Whether a model of this step has a root that only SOFA can test: no box, a NaN, or min > max on some axis.
  [[nodiscard]] bool anyOddRoot() const { return m_anyOddRoot; }

  /// The first root of this step that is a box; null where there is none.
  [[nodiscard]] sofa::core::CollisionModel* firstBox() const { return m_firstBox; }

  /// Whether a model of this step may collide with itself or its neighbours in the node.
  [[nodiscard]] bool anySelfCollision() const { return m_anySelfCollision; }

 private:
  /// What is read of one of SOFA's models before it is written to ours.
  struct Note {
    sofa::core::CollisionModel* host = nullptr;
    sofa::core::CollisionModel* last = nullptr;
    const void* owner = nullptr;
    const std::set<int>* groups = nullptr;
    double contactDistance = 0.0;
    Box box;
    bool simulated = false;
    bool selfCollision = false;
    bool hasDefaultRules = false;
    bool hasGroups = false;
  };

  void readAll(std::span<sofa::core::CollisionModel* const> hosts);
  void read(std::span<Note> notes);
  void readRoot(Note& note);
  [[nodiscard]] collision::HostedModel& takeFor(const Note& note);
  [[nodiscard]] bool hasDefaultRules(const sofa::core::CollisionModel& last);

  std::vector<Note> m_notes;
  std::vector<collision::HostedModel*> m_added;
  std::vector<std::unique_ptr<collision::HostedModel>> m_plain;
  std::vector<std::unique_ptr<collision::HostedModel>> m_asking;
  std::size_t m_plainUsed = 0;
  std::size_t m_askingUsed = 0;
  const std::type_info* m_lastType = nullptr;
  bool m_lastTypeHasDefaultRules = false;
  sofa::core::CollisionModel* m_firstBox = nullptr;
  bool m_anyOddRoot = false;
  bool m_anySelfCollision = false;
};

}  // namespace allpairs::plugin
