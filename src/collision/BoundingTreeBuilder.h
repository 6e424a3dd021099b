// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "allpairs/collision/BoundingBoxModel.h"

namespace allpairs::collision {

/// Makes the levels of boxes above the elements of one model.
class BoundingTreeBuilder {
 public:
  /// `swept`: boxes hold the elements over a step of length dt.
  BoundingTreeBuilder(CollisionModel& model, double dt, bool swept) : m_model(model), m_dt(dt), m_swept(swept) {}

  /// Builds the root and up to maxDepth levels below it, and links the chain.
  void build(int maxDepth);

  /// Makes the root alone, with what a model of the user's own says of it.
  static void setRoot(CollisionModel& model, const Box& box, const NormalCone& cone);

 private:
  [[nodiscard]] Box boxOf(std::size_t element) const;
  [[nodiscard]] NormalCone coneOf(std::size_t element) const;
  [[nodiscard]] Box checkedBoxOf(std::size_t element) const;
  [[nodiscard]] BoundingBoxModel::Node makeRoot() const;

  void buildDeep(int maxDepth);
  void split(BoundingBoxModel& parents, BoundingBoxModel& children);
  void addChild(BoundingBoxModel& children, std::uint32_t begin, std::uint32_t end) const;
  std::uint32_t partition(const BoundingBoxModel::Node& node);

  static BoundingBoxModel& level(CollisionModel& model, std::size_t depth);
  static void link(CollisionModel& model, std::size_t levels);

  CollisionModel& m_model;
  double m_dt;
  bool m_swept;
  std::vector<std::uint32_t> m_order;
};

}  // namespace allpairs::collision
