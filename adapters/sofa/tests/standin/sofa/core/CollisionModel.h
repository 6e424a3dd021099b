// SPDX-License-Identifier: MIT
#pragma once

#include <sofa/core/objectmodel/BaseComponent.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

namespace sofa::core {

class CollisionModel;

/// One element of a model.
class CollisionElementIterator {
 public:
  CollisionElementIterator(CollisionModel* model, Index index) : m_model(model), m_index(index) {}

  [[nodiscard]] CollisionModel* getCollisionModel() const { return m_model; }
  [[nodiscard]] Index getIndex() const { return m_index; }

 private:
  CollisionModel* m_model;
  Index m_index;
};

/// One level of a model, from the root, which is one element, to the last.
class CollisionModel : public objectmodel::BaseComponent {
 public:
  [[nodiscard]] bool empty() const { return m_size == 0; }
  virtual void resize(Size size) { m_size = size; }
  [[nodiscard]] CollisionElementIterator begin() { return {this, 0}; }

  [[nodiscard]] CollisionModel* getLast() { return m_next == nullptr ? this : m_next->getLast(); }
  void setNext(CollisionModel* next) { m_next = next; }

  [[nodiscard]] virtual bool isSimulated() const { return m_simulated; }
  virtual void setSimulated(bool simulated) { m_simulated = simulated; }
  [[nodiscard]] bool getSelfCollision() const { return m_selfCollision; }
  void setSelfCollision(bool selfCollision) { m_selfCollision = selfCollision; }
  [[nodiscard]] SReal getContactDistance() const { return m_contactDistance; }
  void setContactDistance(SReal distance) { m_contactDistance = distance; }
  [[nodiscard]] const std::set<int>& getGroups() const { return m_groups; }
  void setGroups(const std::set<int>& groups) { m_groups = groups; }

  virtual bool canCollideWith(CollisionModel* other) {
    if (getContext() == other->getContext()) return m_selfCollision;
    std::vector<int> common;
    std::set_intersection(m_groups.begin(), m_groups.end(), other->m_groups.begin(), other->m_groups.end(),
                          std::back_inserter(common));
    return common.empty();
  }

 private:
  Size m_size = 0;
  CollisionModel* m_next = nullptr;
  bool m_simulated = true;
  bool m_selfCollision = false;
  SReal m_contactDistance = 0.0;
  std::set<int> m_groups;
};

}  // namespace sofa::core
