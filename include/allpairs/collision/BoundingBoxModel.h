// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "allpairs/Span.h"
#include "allpairs/collision/CollisionModel.h"

namespace allpairs::collision {

/// A level of boxes above the elements of a model: the root has one, each further level at most twice as many.
///
/// Made by CollisionModel::computeBoundingTree() and owned by the model whose elements it bounds.
class BoundingBoxModel final : public CollisionModel {
 public:
  /// What lies under one box: elements [begin, end) of the next level, or, on the last level of boxes, the model's
  /// elements elementOrder()[begin] … elementOrder()[end - 1].
  struct Node {
    Box box = kEmptyBox;
    NormalCone cone;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };

  /// A level of the given model. Users need not create one; computeBoundingTree() does.
  explicit BoundingBoxModel(CollisionModel& model);

  [[nodiscard]] std::size_t getSize() const override { return m_nodes.size(); }
  [[nodiscard]] Box elementBox(std::size_t index) const override { return m_nodes[index].box; }
  [[nodiscard]] NormalCone elementCone(std::size_t index) const override { return m_nodes[index].cone; }
  [[nodiscard]] std::string_view typeName() const override { return "BoundingBoxModel"; }
  [[nodiscard]] std::type_index typeKey() const override;

  [[nodiscard]] Span<const Node> nodes() const { return m_nodes; }

  /// The model's elements, ordered so that those of one box are contiguous. Empty means 0, 1, 2, …
  [[nodiscard]] Span<const std::uint32_t> elementOrder() const { return m_elementOrder; }

 private:
  friend class CollisionModel;
  friend class BoundingTreeBuilder;

  std::vector<Node> m_nodes;
  std::vector<std::uint32_t> m_elementOrder;
};

}  // namespace allpairs::collision
