// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "allpairs/World.h"

namespace allpairs {

/// A broad phase for FCL on allpairs::World: use it where you use an fcl::DynamicAABBTreeCollisionManager.
///
/// Callbacks get the pairs whose boxes overlap, each once, ordered by when the two objects were registered; where a
/// number was freed by an object that left, the next one that comes takes its place in the order. For distances they get
/// the pairs whose boxes are nearer than the least distance so far, near ones early. A callback that returns true ends
/// the query.
///
/// Objects stay the caller's. Their boxes are read when they are registered and by update(), as in FCL's managers; an
/// octree counts with its box, like any other geometry. An object that is registered again, or that leaves without
/// having come, changes nothing else.
/// Geometry:  boxes are closed, in the precision of S.
/// Bad input: a box with a NaN throws InvalidBox.
/// Cost:      update() and the first collide() after it: a step of allpairs::World, O(n + pairs) and less for objects
///            that did not move; each further collide() a pass over the pairs. Queries with an object: O(log n + found).
/// Threads:   one call at a time per object, const ones included. A callback may query the manager, and must not
///            register, update or unregister.
template <class S>
class FclBroadPhaseManager : public ::fcl::BroadPhaseCollisionManager<S> {
 public:
  using Object = ::fcl::CollisionObject<S>;
  using Base = ::fcl::BroadPhaseCollisionManager<S>;
  using CollisionCallBack = ::fcl::CollisionCallBack<S>;
  using DistanceCallBack = ::fcl::DistanceCallBack<S>;

  /// The executor is where parallel work runs; null means on the calling thread. Not owned.
  explicit FclBroadPhaseManager(Executor* executor = nullptr) : m_executor(executor), m_world(makeWorld()) {}

  void registerObjects(const std::vector<Object*>& objects) override {
    std::vector<Object*> fresh;
    std::vector<Box> boxes;
    for (Object* object : objects) {
      if (m_ids.contains(object)) {
        update(object);
      } else {
        fresh.push_back(object);
        boxes.push_back(toBox(object->getAABB()));
      }
    }
    const std::vector<BoxId> ids = m_world.add(BoxSet(boxes));
    m_ids.reserve(m_ids.size() + fresh.size());
    for (std::size_t i = 0; i < fresh.size(); ++i) note(fresh[i], ids[i]);
  }

  void registerObject(Object* object) override {
    if (m_ids.contains(object)) return update(object);
    note(object, m_world.add(toBox(object->getAABB())));
  }

  void unregisterObject(Object* object) override {
    const auto found = m_ids.find(object);
    if (found == m_ids.end()) return;
    m_world.remove(found->second);
    m_objects[found->second] = {};
    m_ids.erase(found);
    m_isCurrent = false;
  }

  /// Finds the pairs, so that the next collide() need not.
  void setup() override { findPairs(); }

  void update() override {
    for (BoxId id = 0; id < m_objects.size(); ++id) refresh(id);
    findPairs();
  }

  void update(Object* object) override {
    const auto found = m_ids.find(object);
    if (found != m_ids.end()) refresh(found->second);
  }

  void update(const std::vector<Object*>& objects) override {
    for (Object* object : objects) update(object);
  }

  void clear() override {
    m_world = makeWorld();
    m_objects.clear();
    m_ids.clear();
    m_isCurrent = false;
  }

  /// The objects, in the order of their numbers.
  void getObjects(std::vector<Object*>& objects) const override {
    objects.clear();
    for (const Entry& entry : m_objects) {
      if (entry.object != nullptr) objects.push_back(entry.object);
    }
  }

  void collide(Object* object, void* data, CollisionCallBack callback) const override {
    for (const BoxId id : overlapping(object->getAABB(), S(0))) {
      if (callback(object, m_objects[id].object, data)) return;
    }
  }

  void distance(Object* object, void* data, DistanceCallBack callback) const override {
    S least = std::numeric_limits<S>::max();
    nearer(object, Order::ObjectFirst, callback, data, least);
  }

  void collide(void* data, CollisionCallBack callback) const override {
    findPairs();
    for (const Pair& pair : m_world.result().pairs) {
      if (callback(m_objects[pair.first].object, m_objects[pair.second].object, data)) return;
    }
  }

  void distance(void* data, DistanceCallBack callback) const override {
    findPairs();
    S least = std::numeric_limits<S>::max();
    for (const Pair& pair : m_world.result().pairs) {
      if (!(least > S(0))) return;
      if (callback(m_objects[pair.first].object, m_objects[pair.second].object, data, least)) return;
    }
    for (BoxId id = 0; id < m_objects.size(); ++id) {
      if (m_objects[id].object != nullptr && nearerApart(id, callback, data, least)) return;
    }
  }

  void collide(Base* otherManager, void* data, CollisionCallBack callback) const override {
    if (otherManager == this) return collide(data, callback);
    if (const auto* other = dynamic_cast<const FclBroadPhaseManager*>(otherManager)) {
      const auto found = m_world.findBetween(other->m_world);
      const std::vector<Pair> pairs(found.begin(), found.end());  // the callback may query
      for (const Pair& pair : pairs) {
        if (callback(m_objects[pair.first].object, other->m_objects[pair.second].object, data)) return;
      }
      return;
    }
    for (Object* object : objectsOf(*otherManager)) {
      for (const BoxId id : overlapping(object->getAABB(), S(0))) {
        if (callback(m_objects[id].object, object, data)) return;
      }
    }
  }

  void distance(Base* otherManager, void* data, DistanceCallBack callback) const override {
    if (otherManager == this) return distance(data, callback);
    S least = std::numeric_limits<S>::max();
    for (Object* object : objectsOf(*otherManager)) {
      if (nearer(object, Order::ObjectSecond, callback, data, least)) return;
    }
  }

  [[nodiscard]] bool empty() const override { return m_world.size() == 0; }
  [[nodiscard]] std::size_t size() const override { return m_world.size(); }

 private:
  using Bounds = ::fcl::AABB<S>;

  struct Entry {
    Object* object = nullptr;
    Bounds bounds{};
  };

  struct Candidate {
    S distance = S(0);
    BoxId id = kNoBox;

    friend bool operator<(const Candidate& a, const Candidate& b) {
      return std::pair(a.distance, a.id) < std::pair(b.distance, b.id);
    }
  };

  /// Whether an object that is asked about is the callback's first or its second.
  enum class Order { ObjectFirst, ObjectSecond };

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

  World makeWorld() const {
    WorldOptions options;
    options.executor = m_executor;
    return World(std::move(options));
  }

  /// Remembers an object by the number of its box; one that came twice in a list keeps the first.
  void note(Object* object, BoxId id) {
    m_isCurrent = false;
    if (!m_ids.emplace(object, id).second) return m_world.remove(id);
    if (m_objects.size() <= id) m_objects.resize(std::size_t{id} + 1);
    m_objects[id] = {object, object->getAABB()};
  }

  /// Tells the world where an object is now.
  void refresh(BoxId id) {
    Entry& entry = m_objects[id];
    if (entry.object == nullptr) return;
    const Bounds& now = entry.object->getAABB();
    if (now.min_ == entry.bounds.min_ && now.max_ == entry.bounds.max_) return;
    m_world.move(id, toBox(now));
    entry.bounds = now;
    m_isCurrent = false;
  }

  void findPairs() const {
    if (!m_isCurrent) m_world.step();
    m_isCurrent = true;
  }

  /// The objects whose boxes are at most so far from a box on every axis, and maybe others a little further.
  std::vector<BoxId> overlapping(const Bounds& bounds, S distance) const {
    Box box = toBox(bounds);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] -= static_cast<double>(distance);
      box.max[axis] += static_cast<double>(distance);
    }
    const auto found = m_world.findOverlapping(box);
    return {found.begin(), found.end()};
  }

  /// Asks the callback about the objects of this manager that are nearer to one of another than the least distance.
  // NOLINTNEXTLINE(readability-function-size): the order, and what FCL hands on.
  bool nearer(Object* object, Order order, DistanceCallBack callback, void* data, S& least) const {
    const auto ask = [&](BoxId id) {
      Object* const own = m_objects[id].object;
      return order == Order::ObjectFirst ? callback(object, own, data, least) : callback(own, object, data, least);
    };
    const auto isWanted = [](BoxId) { return true; };
    return askNear(object->getAABB(), isWanted, ask, least);
  }

  /// Asks about the objects behind one of this manager that are apart from it and nearer than the least distance.
  bool nearerApart(BoxId id, DistanceCallBack callback, void* data, S& least) const {
    const Bounds& bounds = m_objects[id].bounds;
    const auto ask = [&](BoxId other) { return callback(m_objects[id].object, m_objects[other].object, data, least); };
    const auto isWanted = [&](BoxId other) { return other > id && !bounds.overlap(m_objects[other].bounds); };
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
    for (const Neighbor& neighbor : m_world.findNearest(middle, kFirstAsked)) ids.push_back(neighbor.id);
    return ids;
  }

  /// What is wanted and nearer than the least distance by its box, near ones first.
  template <class IsWanted>
  std::vector<Candidate> candidates(const Bounds& bounds, S least, const IsWanted& isWanted) const {
    std::vector<Candidate> found;
    for (const BoxId id : overlapping(bounds, least)) {
      if (!isWanted(id)) continue;
      const S distance = bounds.distance(m_objects[id].bounds);
      if (distance < least) found.push_back({distance, id});
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  Executor* m_executor;
  mutable World m_world;             // FCL's queries are const; the world's keep scratch memory
  mutable bool m_isCurrent = false;  // whether the world's pairs are those of the boxes as they were last read
  std::vector<Entry> m_objects;      // by id; without an object where one left
  std::unordered_map<Object*, BoxId> m_ids;
};

using FclBroadPhaseManagerf = FclBroadPhaseManager<float>;
using FclBroadPhaseManagerd = FclBroadPhaseManager<double>;

}  // namespace allpairs
