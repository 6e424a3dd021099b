// SPDX-License-Identifier: MIT
#pragma once

#include <Allpairs/TrackedModel.h>

#include <cstddef>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace allpairs::plugin {

/// Our models that stand for SOFA's of a step, one for each that is added, kept from step to step.
///
/// SOFA adds its models in the same order in nearly every step, so each is looked for first where it was in the last
/// one.
class ModelPool {
 public:
  /// Begins a step.
  void begin();

  /// Adds models that stand for SOFA's as those are now, and gives them in their order; valid until the next addition.
  [[nodiscard]] std::span<collision::HostedModel* const> add(std::span<sofa::core::CollisionModel* const> hosts);

  /// Lets go of the models that were not added since begin().
  void end();

  /// Whether a model of this step has a root that only SOFA can test: no box, a NaN, or min > max on some axis.
  [[nodiscard]] bool anyOddRoot() const { return m_anyOddRoot; }

  /// The first root of this step that is a box; null where there is none.
  [[nodiscard]] sofa::core::CollisionModel* firstBox() const { return m_firstBox; }

  /// Whether a model of this step may collide with itself or its neighbours in the node.
  [[nodiscard]] bool anySelfCollision() const { return m_anySelfCollision; }

 private:
  void addSome(std::span<sofa::core::CollisionModel* const> hosts);
  [[nodiscard]] TrackedModel& next(sofa::core::CollisionModel& root);
  void bring(sofa::core::CollisionModel& root);
  void notePlaces();

  // Those of this step, then those of the last that didn't come yet.
  std::vector<std::unique_ptr<TrackedModel>> m_models;
  std::size_t m_used = 0;                                                       // how many there are of this step
  std::unordered_map<const sofa::core::CollisionModel*, std::size_t> m_places;  // of the others, once one is looked for
  bool m_hasPlaces = false;
  std::vector<collision::HostedModel*> m_added;
  sofa::core::CollisionModel* m_firstBox = nullptr;
  bool m_anyOddRoot = false;
  bool m_anySelfCollision = false;
};

}  // namespace allpairs::plugin
