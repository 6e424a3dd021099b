// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <typeindex>
#include <utility>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/collision/NormalCone.h"

namespace allpairs::collision {

class BoundingBoxModel;

/// A body, or part of one, that may collide: a chain of levels from a root (one box) down to the elements.
///
/// The user creates and owns the last level, the one with the elements; it owns the levels above it, which
/// computeBoundingTree() creates. Name, flags, groups, distance and owner belong to the chain: they may be read and set
/// on any level. A custom model derives from this class and returns the number of its elements and the box of each.
/// Geometry:  boxes are closed; an element or a model with min > max on an axis is empty and overlaps nothing.
/// Bad input: setters and the bounding trees throw InvalidArgument or InvalidBox, naming the model and the element.
/// Threads:   const use from any number of threads; one at a time otherwise.
class CollisionModel {
 public:
  explicit CollisionModel(std::string name = {});
  CollisionModel(const CollisionModel&) = delete;
  CollisionModel& operator=(const CollisionModel&) = delete;
  CollisionModel(CollisionModel&&) = delete;
  CollisionModel& operator=(CollisionModel&&) = delete;
  virtual ~CollisionModel();

  /// How many elements this level has.
  [[nodiscard]] virtual std::size_t getSize() const = 0;
  [[nodiscard]] bool empty() const { return getSize() == 0; }

  /// The box of one element, contact distance included where the type of model includes it.
  [[nodiscard]] virtual Box elementBox(std::size_t index) const = 0;

  /// The box that bounds an element at the start and at the end of a step of length dt; by default elements do not
  /// move.
  [[nodiscard]] virtual Box elementSweptBox(std::size_t index, double dt) const;

  /// The cone of normals of an element; by default nothing is known.
  [[nodiscard]] virtual NormalCone elementCone(std::size_t index) const;

  /// The cone of an element's normals at the start and at the end of a step.
  [[nodiscard]] virtual NormalCone elementSweptCone(std::size_t index, double dt) const;

  /// The type of the model, by SOFA's name if it has one.
  [[nodiscard]] virtual std::string_view typeName() const;

  /// The key under which intersectors for this level's elements are looked up; by default its dynamic type.
  [[nodiscard]] virtual std::type_index typeKey() const;

  /// The key under which intersectors for this model's root box are looked up; by default that of BoundingBoxModel.
  [[nodiscard]] virtual std::type_index rootTypeKey() const;

  /// Whether this model agrees to collide with another. Both are asked, and both must agree.
  ///
  /// Same owner (null is an owner too): selfCollision of this model. Different owners: true if either has no
  /// group or they have none in common.
  [[nodiscard]] virtual bool canCollideWith(CollisionModel* other);

  /// Creates or updates the levels above the elements from the current elements.
  ///
  /// `maxDepth` 0 creates the root alone; each further level splits every box of the one above in two. The box and the
  /// cone of the root do not depend on it. A second call allocates nothing. Levels of an earlier,
  /// deeper tree are destroyed.
  ///
  /// Bad input: a NaN in an element's box throws InvalidBox.
  /// Cost:      O(n), deep: O(n log n) per level.
  virtual void computeBoundingTree(int maxDepth = 0);

  /// The same for a continuous method: each box bounds its elements at the start and at the end of a step of length dt.
  virtual void computeContinuousBoundingTree(double dt, int maxDepth = 0);

  /// Whether the levels above the elements exist and have not been invalidated since.
  [[nodiscard]] bool hasBoundingTree() const { return m_last->m_treeIsCurrent; }

  /// Invalidates the bounding tree after elements have moved or changed; it is recomputed when next needed.
  void boundsChanged() { m_last->m_treeIsCurrent = false; }

  /// The levels: the root, the elements, and the neighbours of this one; null past either end. A model without a
  /// bounding tree is its own first and last.
  [[nodiscard]] CollisionModel* getFirst();
  [[nodiscard]] const CollisionModel* getFirst() const;
  [[nodiscard]] CollisionModel* getLast() { return m_last; }
  [[nodiscard]] const CollisionModel* getLast() const { return m_last; }
  [[nodiscard]] CollisionModel* getNext() { return m_next; }
  [[nodiscard]] const CollisionModel* getNext() const { return m_next; }
  [[nodiscard]] CollisionModel* getPrevious() { return m_previous; }
  [[nodiscard]] const CollisionModel* getPrevious() const { return m_previous; }

  /// The name that errors and results use.
  [[nodiscard]] const std::string& getName() const { return m_last->m_name; }
  void setName(std::string name) { m_last->m_name = std::move(name); }

  /// The pipeline skips inactive models; the broad phase ignores the flag.
  [[nodiscard]] bool isActive() const { return m_last->m_active; }
  void setActive(bool active) { m_last->m_active = active; }

  /// The pipeline does not recompute the bounding trees of models that do not move.
  [[nodiscard]] bool isMoving() const { return m_last->m_moving; }
  void setMoving(bool moving) { m_last->m_moving = moving; }

  /// Two models that are both not simulated are never paired.
  [[nodiscard]] bool isSimulated() const { return m_last->m_simulated; }
  void setSimulated(bool simulated) { m_last->m_simulated = simulated; }

  /// Whether the model may collide with itself and with others of the same owner.
  [[nodiscard]] bool getSelfCollision() const { return m_last->m_selfCollision; }
  void setSelfCollision(bool selfCollision) { m_last->m_selfCollision = selfCollision; }

  /// The groups, ascending, each once. Models of different owners that share one do not collide. Any integer is a
  /// group.
  [[nodiscard]] const std::vector<int>& getGroups() const;
  void setGroups(std::vector<int> groups);
  void addGroup(int group);

  /// The distance around its elements within which the model reports contacts.
  ///
  /// Bad input: NaN and infinities throw InvalidArgument. A negative distance shrinks the boxes.
  [[nodiscard]] double getContactDistance() const { return m_last->m_contactDistance; }
  void setContactDistance(double distance);

  /// The body that the model belongs to, identified by any address. Null is an owner like any other.
  [[nodiscard]] const void* getOwner() const { return m_last->m_owner; }
  void setOwner(const void* owner) { m_last->m_owner = owner; }

  /// "model 'name'", or "model of type T" without a name, as in error messages.
  [[nodiscard]] std::string describe() const;

 protected:
  /// For custom implementations of computeBoundingTree(): creates the root alone, with this box and cone.
  ///
  /// Bad input: a box with a NaN throws InvalidBox.
  void setRoot(const Box& box, const NormalCone& cone = {});

  /// For a model that is one box and nothing below it: the model is its own root, with this box, until
  /// computeBoundingTree() puts a level above it.
  ///
  /// Bad input: a box with a NaN throws InvalidBox.
  void setOwnRoot(const Box& box) {
    if (m_hasLevels || hasNan(box)) return setRoot(box);
    m_rootBox = box;
    m_hasRoot = true;
    m_treeIsCurrent = true;
  }

  /// The box at the root, whether it is current or not; empty before there is one.
  [[nodiscard]] const Box& rootBox() const { return m_last->m_rootBox; }

 private:
  friend class BoundingBoxModel;
  friend class BoundingTreeBuilder;
  friend class ModelTable;

  // What the broad phase reads of each model comes first, so that it lies within two cache lines.
  CollisionModel* m_last = this;
  const void* m_owner = nullptr;
  double m_contactDistance = 0.0;
  std::uint64_t m_groupBits = 0;  // a bit per group, by its number modulo 64: no bit in common means no group in common
  std::shared_ptr<const std::vector<int>> m_groups;  // null where there are none
  bool m_active = true;
  bool m_moving = true;
  bool m_simulated = true;
  bool m_selfCollision = false;
  bool m_treeIsCurrent = false;
  bool m_hasRoot = false;  // levels, or a root box of its own; false of a model without elements
  bool m_hasLevels = false;
  Box m_rootBox = kEmptyBox;
  CollisionModel* m_next = nullptr;
  CollisionModel* m_previous = nullptr;
  std::vector<std::unique_ptr<BoundingBoxModel>> m_levels;
  std::string m_name;
};

}  // namespace allpairs::collision

namespace allpairs {
/// The seed writes `core::CollisionModel`.
namespace core = collision;
}  // namespace allpairs
