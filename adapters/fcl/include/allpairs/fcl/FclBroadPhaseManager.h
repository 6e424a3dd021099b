// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Span.h"
#include "allpairs/World.h"
#include "allpairs/fcl/FclObjects.h"
#include "allpairs/fcl/FclTree.h"
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
/// takes the place of one that left. The order of the pairs is the same each time. A callback that returns true ends
/// the query.
///
/// For distances, a callback gets no pair twice, and near pairs early. It gets every pair whose boxes overlap, and every
/// pair whose boxes are no farther apart than the smallest distance that it has set so far. So a callback that always
/// sets the same distance, a threshold or 0, gets all pairs within it.
///
/// Objects stay the caller's. Their boxes are read when they are registered and by update(), as in FCL's managers; an
/// octree counts with its box, like any other geometry. An object that is registered again, or that leaves without
/// having come, changes nothing else.
/// Other managers: a query with another manager takes that one's objects, of whatever kind it is. The other way round,
///            a DynamicAABBTreeCollisionManager takes this one as the other manager; size() keeps a tree for it. No other
///            manager of FCL may get this one: each takes the other for one of its own kind without asking.
/// Geometry:  boxes are closed, in the precision of S. An empty box has no pairs and no distance.
/// Bad input: a box with a NaN throws InvalidBox: an object that comes with one is not registered, one that was keeps the
///            box that it had. No object, a null pointer, is none.
/// Cost:      nothing is searched before it is asked for. The first collide() after a change finds the pairs, by a
///            search of all boxes or, where few change, by a step of allpairs::World; each further one is a pass over
///            them. The first queries with an object after a change scan all boxes; more, O(log n + found). A query outside
///            of all boxes since the last clear() ends at once.
/// Threads:   const members, queries, may be called concurrently while no other member runs. A callback may query the
///            manager, and must not register, update or unregister.
template <class S>
class FclBroadPhaseManager : public FclTree<S> {
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

  void registerObject(Object* object) override {
    if (object == nullptr) return;
    const std::size_t before = m_objects.size();
    const BoxId number = m_objects.add(object);
    try {
      m_search.reserve(m_objects.bound());  // so that no change of a row is lost for want of memory
      refresh(number);
    } catch (...) {
      if (m_objects.size() != before) unregisterObject(object);
      throw;
    }
  }

  void unregisterObject(Object* object) override {
    const BoxId number = m_objects.remove(object);
    if (number == kNoBox) return;
    this->leaveTree(number, object);
    m_search.note(number);
  }

  /// Nothing is left to do: each query finds what it needs.
  void setup() override {}

  void update() override {
    for (BoxId number = 0; number < m_objects.bound(); ++number) refresh(number);
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
    this->clearTree();
  }

  /// The objects, in the order of their numbers.
  void getObjects(std::vector<Object*>& objects) const override {
    objects.clear();
    for (BoxId number = 0; number < m_objects.bound(); ++number) {
      if (m_objects[number] != nullptr) objects.push_back(m_objects[number]);
    }
  }

  void collide(Object* object, void* data, CollisionCallBack callback) const override {
    eachOverlapping(object->getAABB(), [&](BoxId id) { return callback(object, m_objects[id], data); });
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
      if (callback(m_objects[pair.first], m_objects[pair.second], data, least)) return;
    }
    for (BoxId id = 0; id < m_objects.bound(); ++id) {
      if (m_objects.hasBox(id) && nearerApart(id, callback, data, least)) return;
    }
  }

  void collide(Base* otherManager, void* data, CollisionCallBack callback) const override {
    if (otherManager == this) return collide(data, callback);
    if (const auto* other = dynamic_cast<const FclBroadPhaseManager*>(otherManager)) {
      return collideWith(*other, data, callback);
    }
    for (Object* object : objectsOf(*otherManager)) {
      const auto ask = [&](BoxId id) { return callback(m_objects[id], object, data); };
      if (eachOverlapping(object->getAABB(), ask)) return;
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

  /// The first call after a change brings FCL's tree up to date, which FCL's trees read after they have called this.
  [[nodiscard]] std::size_t size() const override {
    this->bringTree(m_objects);
    return m_objects.size();
  }

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

  /// Up to so many objects, comparing batches of them costs more than it saves.
  static constexpr BoxId kOneByOne = 8;

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
    if (!m_objects.read(number)) return;
    m_search.note(number);
    this->noteTree();
  }

  [[nodiscard]] Span<const Pair> pairs() const { return m_search.pairs(m_objects.rows()); }
  [[nodiscard]] const World& world() const { return m_search.world(m_objects.rows()); }

  /// Whether a box is one; empty ones have no pairs.
  static bool isBox(const Bounds& bounds) {
    const auto& min = bounds.min_;
    const auto& max = bounds.max_;
    if (min[0] <= max[0] && min[1] <= max[1] && min[2] <= max[2]) return true;
    if (hasNan(toBox(bounds))) throw InvalidBox(0, "the box of the query has a NaN");
    return false;
  }

  /// Calls visit(id) for the objects whose boxes overlap a box until it returns true, and says whether it did.
  template <class Visit>
  bool eachOverlapping(const Bounds& bounds, const Visit& visit) const {
    if (!isBox(bounds) || !m_objects.mayOverlap(bounds)) return false;
    const World* const world = m_search.worldForQuery(m_objects.rows());
    if (world == nullptr) return scan(bounds, visit);
    const std::vector<BoxId> found = world->findOverlapping(toBox(bounds));
    return std::any_of(found.begin(), found.end(), visit);
  }

  template <class Visit>
  bool scan(const Bounds& bounds, const Visit& visit) const {
    if (m_objects.bound() <= kOneByOne) return scanOneByOne(bounds, visit);
    constexpr std::size_t kBatch = RowSearch<S>::kBatch;
    const typename RowSearch<S>::Row row{bounds.min_[0], bounds.min_[1], bounds.min_[2],
                                         bounds.max_[0], bounds.max_[1], bounds.max_[2]};
    for (std::size_t begin = 0; begin < m_objects.bound(); begin += kBatch) {
      auto found = RowSearch<S>::overlapping(m_objects.rows().subspan(6 * begin), row);
      for (; found != 0; found &= found - 1) {
        const BoxId id = static_cast<BoxId>(begin) + lowestBit(found);
        if (m_objects.hasBox(id) && visit(id)) return true;
      }
    }
    return false;
  }

  template <class Visit>
  bool scanOneByOne(const Bounds& bounds, const Visit& visit) const {
    for (BoxId id = 0; id < m_objects.bound(); ++id) {
      if (m_objects.overlaps(id, bounds) && visit(id)) return true;
    }
    return false;
  }

  void collideWith(const FclBroadPhaseManager& other, void* data, CollisionCallBack callback) const {
    if (m_search.isFasterByScans(m_objects.rows(), other.m_objects.bound())) return scanWith(other, data, callback);
    for (const Pair& pair : world().findBetween(other.world())) {
      if (callback(m_objects[pair.first], other.m_objects[pair.second], data)) return;
    }
  }

  void scanWith(const FclBroadPhaseManager& other, void* data, CollisionCallBack callback) const {
    for (BoxId id = 0; id < m_objects.bound(); ++id) {
      const auto ask = [&](BoxId found) { return callback(m_objects[id], other.m_objects[found], data); };
      if (!m_objects.hasBox(id) || !other.m_objects.mayOverlap(m_objects.bounds(id))) continue;
      if (other.scan(m_objects.bounds(id), ask)) return;
    }
  }

  /// Asks the callback about the objects of this manager that are nearer to one of another than the least distance.
  // NOLINTNEXTLINE(readability-function-size): the role, and what FCL hands on.
  bool nearer(Object* object, Role role, DistanceCallBack callback, void* data, S& least) const {
    const Bounds& bounds = object->getAABB();
    const auto ask = [&](BoxId id) {
      Object* const own = m_objects[id];
      return role == Role::ObjectFirst ? callback(object, own, data, least) : callback(own, object, data, least);
    };
    const auto isWanted = [](BoxId) { return true; };
    return isBox(bounds) && askNear(Question<decltype(isWanted), decltype(ask)>{bounds, isWanted, ask}, least);
  }

  /// Asks about the objects behind one of this manager that are apart from it and nearer than the least distance.
  bool nearerApart(BoxId id, DistanceCallBack callback, void* data, S& least) const {
    const Bounds bounds = m_objects.bounds(id);
    const auto ask = [&](BoxId other) { return callback(m_objects[id], m_objects[other], data, least); };
    const auto isWanted = [&](BoxId other) { return other > id && !bounds.overlap(m_objects.bounds(other)); };
    return askNear(Question<decltype(isWanted), decltype(ask)>{bounds, isWanted, ask}, least);
  }

  /// Which objects to ask about that are near a box, and how.
  template <class IsWanted, class Ask>
  struct Question {
    const Bounds& bounds;
    const IsWanted& isWanted;
    const Ask& ask;
  };

  /// Boxes that overlap are asked about however small the least distance is.
  static S limitOf(S least) { return std::max(least, S(0)); }

  template <class AnyQuestion>
  bool askNear(const AnyQuestion& question, S& least) const {
    if (RowSearch<S>::areFew(m_objects.rows())) return askFew(question, least);
    const World* const world = m_search.worldForQuery(m_objects.rows());
    return world != nullptr ? askByWorld(*world, question, least) : askByScan(question, least);
  }

  /// Asks about objects from the nearest on, as long as they are near enough.
  template <class AnyQuestion>
  bool askFew(const AnyQuestion& question, S& least) const {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): read only where it has been written
    std::array<S, RowSearch<S>::kBatch> squares;
    std::uint64_t left = 0;
    for (BoxId id = 0; id < m_objects.bound(); ++id) {
      squares[id] = m_objects.squaredDistance(id, question.bounds);
      left |= std::uint64_t{m_objects.hasBox(id)} << id;
    }
    while (left != 0) {
      const BoxId id = nearestOf(squares, left);
      if (squares[id] > squaredLimit(least)) return false;
      if (question.isWanted(id) && question.ask(id)) return true;
      left &= ~(std::uint64_t{1} << id);
    }
    return false;
  }

  /// The index of the lowest bit that is set, of which there is one; std::countr_zero is of C++20.
  static BoxId lowestBit(std::uint64_t bits) {
#ifdef __GNUC__
    return static_cast<BoxId>(__builtin_ctzll(bits));
#else
    BoxId index = 0;
    for (; (bits & 1U) == 0; bits >>= 1U) ++index;
    return index;
#endif
  }

  static BoxId nearestOf(const std::array<S, RowSearch<S>::kBatch>& squares, std::uint64_t left) {
    BoxId nearest = lowestBit(left);
    for (left &= left - 1; left != 0; left &= left - 1) {
      const BoxId id = lowestBit(left);
      if (squares[id] < squares[nearest]) nearest = id;
    }
    return nearest;
  }

  /// The square of the distance up to which objects are asked about, and more than squares are off by rounding.
  static S squaredLimit(S least) {
    const S limit = limitOf(least);
    return limit * limit * (1 + 16 * std::numeric_limits<S>::epsilon());
  }

  /// The same for more objects.
  template <class AnyQuestion>
  bool askByScan(const AnyQuestion& question, S& least) const {
    const auto isFarther = [](const Candidate& a, const Candidate& b) { return b < a; };
    std::vector<Candidate> left;
    for (BoxId id = 0; id < m_objects.bound(); ++id) {
      if (m_objects.hasBox(id) && question.isWanted(id)) addCandidate(question.bounds, id, least, left);
    }
    std::make_heap(left.begin(), left.end(), isFarther);
    while (!left.empty() && left.front().distance <= limitOf(least)) {
      if (question.ask(left.front().id)) return true;
      std::pop_heap(left.begin(), left.end(), isFarther);
      left.pop_back();
    }
    return false;
  }

  /// Asks about an object that is near, which makes the least distance small, and then about all that are nearer.
  template <class AnyQuestion>
  bool askByWorld(const World& world, const AnyQuestion& question, S& least) const {
    const BoxId first = least == std::numeric_limits<S>::max() ? nearest(world, question.bounds) : kNoBox;
    if (first != kNoBox && question.isWanted(first) && question.ask(first)) return true;
    std::vector<Candidate> found;
    for (const BoxId id : world.findOverlapping(widened(question.bounds, limitOf(least)))) {
      if (id != first && question.isWanted(id)) addCandidate(question.bounds, id, least, found);
    }
    std::sort(found.begin(), found.end());
    for (const Candidate& candidate : found) {
      if (candidate.distance > limitOf(least)) return false;
      if (question.ask(candidate.id)) return true;
    }
    return false;
  }

  void addCandidate(const Bounds& bounds, BoxId id, S least, std::vector<Candidate>& candidates) const {
    const S distance = bounds.distance(m_objects.bounds(id));
    if (distance <= limitOf(least)) candidates.push_back({distance, id});
  }

  /// An object near the middle of a box; kNoBox if there is none, or if the box has no middle.
  [[nodiscard]] static BoxId nearest(const World& world, const Bounds& bounds) {
    std::array<double, 3> middle{};
    const Box box = toBox(bounds);
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = (box.min[axis] + box.max[axis]) / 2.0;
    if (!std::all_of(middle.begin(), middle.end(), [](double x) { return std::isfinite(x); })) return kNoBox;
    const std::vector<Neighbor> found = world.findNearest(middle, 1);
    return found.empty() ? kNoBox : found.front().id;
  }

  /// Holds all boxes that FCL finds within a distance, however it rounds.
  [[nodiscard]] static Box widened(const Bounds& bounds, S distance) {
    Box box = toBox(bounds);
    const auto by = static_cast<double>(distance);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double most = std::max({std::abs(box.min[axis]), std::abs(box.max[axis]), by});
      const double slack =
          std::isfinite(most) ? 8.0 * static_cast<double>(std::numeric_limits<S>::epsilon()) * most : 0;
      box.min[axis] -= by + slack;
      box.max[axis] += by + slack;
    }
    return box;
  }

  FclObjects<S> m_objects;
  mutable RowSearch<S> m_search;  // FCL's queries are const; these find what they need when it is asked for
};

using FclBroadPhaseManagerf = FclBroadPhaseManager<float>;
using FclBroadPhaseManagerd = FclBroadPhaseManager<double>;

}  // namespace allpairs
