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
///
/// As in SOFA a level holds the one above it, which knows the one below but does not hold it.
class CollisionModel : public objectmodel::BaseComponent {
 public:
  using SPtr = objectmodel::SharedPointer<CollisionModel>;

  [[nodiscard]] bool empty() const { return m_size == 0; }
  virtual void resize(Size size) { m_size = size; }
  [[nodiscard]] CollisionElementIterator begin() { return {this, 0}; }

  [[nodiscard]] CollisionModel* getLast() { return m_next == nullptr ? this : m_next->getLast(); }
  [[nodiscard]] CollisionModel* getNext() { return m_next; }
  [[nodiscard]] CollisionModel* getPrevious() { return m_previous.get(); }

  /// Puts a level above this one. What either was linked with before is linked with nothing then.
  void setPrevious(const SPtr& previous) {
    if (previous.get() == m_previous.get()) return;
    const SPtr before = m_previous;
    if (before) {
      if (before->m_next != nullptr) before->m_next->m_previous.reset();
      before->m_next = nullptr;
    }
    if (previous && previous->m_next != nullptr) previous->m_next->m_previous.reset();
    m_previous = previous;
    if (previous) previous->m_next = this;
  }

  [[nodiscard]] virtual bool isSimulated() const { return bSimulated.getValue(); }
  virtual void setSimulated(bool simulated) { bSimulated.setValue(simulated); }
  [[nodiscard]] bool getSelfCollision() const { return bSelfCollision.getValue(); }
  void setSelfCollision(bool selfCollision) { bSelfCollision.setValue(selfCollision); }
  [[nodiscard]] SReal getContactDistance() const { return d_contactDistance.getValue(); }
  void setContactDistance(SReal distance) { d_contactDistance.setValue(distance); }
  [[nodiscard]] const std::set<int>& getGroups() const { return group.getValue(); }
  void setGroups(const std::set<int>& groups) { group.setValue(groups); }
  void addGroup(int number) {
    group.beginEdit()->insert(number);
    group.endEdit();
  }

  virtual bool canCollideWith(CollisionModel* other) {
    if (getContext() == other->getContext()) return getSelfCollision();
    const std::set<int>& mine = getGroups();
    const std::set<int>& others = other->getGroups();
    std::vector<int> common;
    std::set_intersection(mine.begin(), mine.end(), others.begin(), others.end(), std::back_inserter(common));
    return common.empty();
  }

 protected:
  objectmodel::Data<bool> bSimulated{initData(&bSimulated, true, "simulated", "")};
  objectmodel::Data<bool> bSelfCollision{initData(&bSelfCollision, false, "selfCollision", "")};
  objectmodel::Data<SReal> d_contactDistance{initData(&d_contactDistance, 0.0, "contactDistance", "")};
  objectmodel::Data<std::set<int>> group{initData(&group, "group", "")};

 private:
  Size m_size = 0;
  CollisionModel* m_next = nullptr;
  SPtr m_previous;
};

}  // namespace sofa::core
