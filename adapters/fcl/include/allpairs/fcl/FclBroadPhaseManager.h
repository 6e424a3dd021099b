// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "allpairs/World.h"
#include "allpairs/fcl/FclObjects.h"
#include "allpairs/fcl/RowSearch.h"

namespace allpairs {

/// Settings of FclBroadPhaseManager; the defaults are right for most programs.
struct FclBroadPhaseManagerOptions {
  /// Runs parallel work; null means on the calling thread. Not owned.
  Executor* executor = nullptr;

  /// Orders the pairs of collide() by the registration of their first object, and then of their second. It takes time.
  bool isOrdered = false;
};

/// A broad phase for FCL: use it where you use an fcl::DynamicAABBTreeCollisionManager.
///
/// Callbacks get the pairs whose boxes overlap, each once: first the object that was registered first, where an object
/// takes the place of one that left. The order of the pairs is the same each time. For distances they get the pairs
/// whose boxes are nearer than the least distance so far, near ones early. A callback that returns true ends the query.
///
/// Objects stay the caller's. Their boxes are read when they are registered and by update(), as in FCL's managers; an
/// octree counts with its box, like any other geometry. An object that is registered again, or that leaves without
/// having come, changes nothing else.
/// Geometry:  boxes are closed, in the precision of S.
/// Bad input: a box with a NaN throws InvalidBox.
/// Cost:      the first collide() after a change finds the pairs, by a search of all boxes or, where few change, by a
///            step of allpairs::World; each further one is a pass over them. Queries with an object: O(log n + found).
/// Threads:   one call at a time per object, const ones included. A callback may query the manager, and must not
///            register, update or unregister.
template <class S>
class FclBroadPhaseManager : public ::fcl::BroadPhaseCollisionManager<S> {
 public:
  using Object = ::fcl::CollisionObject<S>;
  using Base = ::fcl::BroadPhaseCollisionManager<S>;
  using CollisionCallBack = ::fcl::CollisionCallBack<S>;
  using DistanceCallBack = ::fcl::DistanceCallBack<S>;

  explicit FclBroadPhaseManager(const FclBroadPhaseManagerOptions& options = {})
      : m_search(options.executor, options.isOrdered) {}

  void registerObjects(const std::vector<Object*>& objects) override {
    m_objects.reserve(m_objects.size() + objects.size());
    for (Object* object : objects) registerObject(object);
  }

  void registerObject(Object* object) override { refresh(m_objects.add(object)); }

  void unregisterObject(Object* object) override {
    const BoxId number = m_objects.remove(object);
    if (number != kNoBox) m_search.note(number);
  }

  /// Finds the pairs in advance of the next collide().
  void setup() override { static_cast<void>(pairs()); }

  void update() override {
    for (BoxId number = 0; number < m_objects.bound(); ++number) refresh(number);
    setup();
  }

  void update(Object* object) override {
    const BoxId number = m_objects.numberOf(object);
    if (number != kNoBox) refresh(number);
  }

  void update(const std::vector<Object*>& objects) override {
    for (Object* object : objects) update(object);
  }

  void clear() override {
    m_objects.clear();
    m_search.clear();
  }

  /// The objects, in the order of their numbers.
  void getObjects(std::vector<Object*>& objects) const override {
    objects.clear();
    for (BoxId number = 0; number < m_objects.bound(); ++number) {
      if (m_objects[number] != nullptr) objects.push_back(m_objects[number]);
    }
  }

  void collide(Object* object, void* data, CollisionCallBack callback) const override {
    for (const BoxId id : overlapping(object->getAABB(), S(0))) {
      if (callback(object, m_objects[id], data)) return;
    }
  }

  void distance(Object* object, void* data, DistanceCallBack callback) const override {
    S least = std::numeric_limits<S>::max();
    nearer(object, Role::ObjectFirst, callback, data, least);
  }

  void collide(void* data, CollisionCallBack callback) const override {
    for (const Pair& pair : pairs()) {
      if (callback(m_objects[pair.first], m_objects[pair.second], data)) return;
    }
  }

  void distance(void* data, DistanceCallBack callback) const override {
    S least = std::numeric_limits<S>::max();
    for (const Pair& pair : pairs()) {
      if (!(least > S(0))) return;
      if (callback(m_objects[pair.first], m_objects[pair.second], data, least)) return;
    }
    for (BoxId id = 0; id < m_objects.bound(); ++id) {
      if (m_objects[id] != nullptr && nearerApart(id, callback, data, least)) return;
    }
  }

  void collide(Base* otherManager, void* data, CollisionCallBack callback) const override {
    if (otherManager == this) return collide(data, callback);
    if (const auto* other = dynamic_cast<const FclBroadPhaseManager*>(otherManager)) {
      const auto found = world().findBetween(other->world());
      const std::vector<Pair> pairs(found.begin(), found.end());  // the callback may query
      for (const Pair& pair : pairs) {
        if (callback(m_objects[pair.first], other->m_objects[pair.second], data)) return;
      }
      return;
    }
    for (Object* object : objectsOf(*otherManager)) {
      for (const BoxId id : overlapping(object->getAABB(), S(0))) {
        if (callback(m_objects[id], object, data)) return;
      }
    }
  }

  void distance(Base* otherManager, void* data, DistanceCallBack callback) const override {
    if (otherManager == this) return distance(data, callback);
    S least = std::numeric_limits<S>::max();
    for (Object* object : objectsOf(*otherManager)) {
      if (nearer(object, Role::ObjectSecond, callback, data, least)) return;
    }
  }

  [[nodiscard]] bool empty() const override { return m_objects.size() == 0; }
  [[nodiscard]] std::size_t size() const override { return m_objects.size(); }

 private:
  using Bounds = ::fcl::AABB<S>;

  struct Candidate {
    S distance = S(0);
    BoxId id = kNoBox;

    friend bool operator<(const Candidate& a, const Candidate& b) {
      return std::pair(a.distance, a.id) < std::pair(b.distance, b.id);
    }
  };

  /// Whether an object that is asked about is the callback's first or its second.
  enum class Role { ObjectFirst, ObjectSecond };

  /// So many of the nearest are asked first: enough that one of them usually gives a distance close to the least.
  static constexpr std::size_t kFirstAsked = 4;

  static Box toBox(const Bounds& bounds) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      box.min[a] = static_cast<double>(bounds.min_[axis]);
      box.max[a] = static_cast<double>(bounds.max_[axis]);
    }
    return box;
  }

  static std::vector<Object*> objectsOf(const Base& manager) {
    std::vector<Object*> objects;
    manager.getObjects(objects);
    return objects;
  }

  /// Reads where the object with this number is now.
  void refresh(BoxId number) {
    if (m_objects.read(number)) m_search.note(number);
  }

  [[nodiscard]] std::span<const Pair> pairs() const { return m_search.pairs(m_objects.rows()); }
  [[nodiscard]] World& world() const { return m_search.world(m_objects.rows()); }

  /// The objects whose boxes are at most so far from a box on every axis, and maybe others a little further.
  std::vector<BoxId> overlapping(const Bounds& bounds, S distance) const {
    Box box = toBox(bounds);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] -= static_cast<double>(distance);
      box.max[axis] += static_cast<double>(distance);
    }
    const auto found = world().findOverlapping(box);
    return {found.begin(), found.end()};
  }

  /// Asks the callback about the objects of this manager that are nearer to one of another than the least distance.
  // NOLINTNEXTLINE(readability-function-size): the role, and what FCL hands on.
  bool nearer(Object* object, Role role, DistanceCallBack callback, void* data, S& least) const {
    const auto ask = [&](BoxId id) {
      Object* const own = m_objects[id];
      return role == Role::ObjectFirst ? callback(object, own, data, least) : callback(own, object, data, least);
    };
    const auto isWanted = [](BoxId) { return true; };
    return askNear(object->getAABB(), isWanted, ask, least);
  }

  /// Asks about the objects behind one of this manager that are apart from it and nearer than the least distance.
  bool nearerApart(BoxId id, DistanceCallBack callback, void* data, S& least) const {
    const Bounds bounds = m_objects.bounds(id);
    const auto ask = [&](BoxId other) { return callback(m_objects[id], m_objects[other], data, least); };
    const auto isWanted = [&](BoxId other) { return other > id && !bounds.overlap(m_objects.bounds(other)); };
    return askNear(bounds, isWanted, ask, least);
  }

  /// Asks about a few near objects, which makes the least distance small, and then about all that are nearer.
  template <class IsWanted, class Ask>
  bool askNear(const Bounds& bounds, const IsWanted& isWanted, const Ask& ask, S& least) const {
    std::vector<BoxId> asked;
    if (least == std::numeric_limits<S>::max()) asked = nearest(bounds);
    std::erase_if(asked, [&](BoxId id) { return !isWanted(id); });
    for (const BoxId id : asked) {
      if (ask(id)) return true;
    }
    const auto isNew = [&](BoxId id) {
      return isWanted(id) && std::find(asked.begin(), asked.end(), id) == asked.end();
    };
    for (const Candidate& candidate : candidates(bounds, least, isNew)) {
      if (!(candidate.distance < least)) return false;
      if (ask(candidate.id)) return true;
    }
    return false;
  }

  [[nodiscard]] std::vector<BoxId> nearest(const Bounds& bounds) const {
    std::array<double, 3> middle{};
    const Box box = toBox(bounds);
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = (box.min[axis] + box.max[axis]) / 2.0;
    std::vector<BoxId> ids;
    for (const Neighbor& neighbor : world().findNearest(middle, kFirstAsked)) ids.push_back(neighbor.id);
    return ids;
  }

  /// What is wanted and nearer than the least distance by its box, near ones first.
  template <class IsWanted>
  std::vector<Candidate> candidates(const Bounds& bounds, S least, const IsWanted& isWanted) const {
    std::vector<Candidate> found;
    for (const BoxId id : overlapping(bounds, least)) {
      if (!isWanted(id)) continue;
      const S distance = bounds.distance(m_objects.bounds(id));
      if (distance < least) found.push_back({distance, id});
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  FclObjects<S> m_objects;
  mutable RowSearch<S> m_search;  // FCL's queries are const; these find what they need when it is asked for
};

using FclBroadPhaseManagerf = FclBroadPhaseManager<float>;
using FclBroadPhaseManagerd = FclBroadPhaseManager<double>;

}  // namespace allpairs
