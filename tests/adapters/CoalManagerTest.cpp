// SPDX-License-Identifier: MIT
#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>
#include <coal/shape/geometric_shapes.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/coal/CoalBroadPhaseManager.h"

namespace allpairs::test {
namespace {

using Object = ::coal::CollisionObject;
using Base = ::coal::BroadPhaseCollisionManager;
using Names = std::vector<std::pair<std::size_t, std::size_t>>;
using Bounds = std::array<double, 6>;  // minima, maxima

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Objects whose boxes are known to the test, which compares them itself.
class Objects {
 public:
  explicit Objects(unsigned seed, bool haveEmptyOnes = true) : m_random(seed), m_haveEmptyOnes(haveEmptyOnes) {}

  Object* add() {
    m_objects.push_back(std::make_unique<Object>(std::make_shared<::coal::Sphere>(1.0)));
    m_bounds.emplace_back();
    move(m_objects.size() - 1);
    return m_objects.back().get();
  }

  /// To corners that are whole numbers, so that boxes often touch: a few are flat, empty or infinite.
  void move(std::size_t at) {
    Bounds bounds{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds[axis] = static_cast<double>(number(20));
      bounds[axis + 3] = bounds[axis] + static_cast<double>(number(4));
    }
    const unsigned kind = number(40);
    if (kind == 0 && m_haveEmptyOnes) bounds[1] = bounds[4] + 1;
    if (kind == 1) bounds = {-kInfinity, 0, -kInfinity, kInfinity, 1, kInfinity};
    set(at, bounds);
  }

  void set(std::size_t at, const Bounds& bounds) {
    m_bounds[at] = bounds;
    auto& box = m_objects[at]->getAABB();
    box.min_ = {bounds[0], bounds[1], bounds[2]};
    box.max_ = {bounds[3], bounds[4], bounds[5]};
  }

  [[nodiscard]] bool isBox(std::size_t at) const {
    const Bounds& b = m_bounds[at];
    return b[0] <= b[3] && b[1] <= b[4] && b[2] <= b[5];
  }

  /// The distance of two boxes; not a number where one is none.
  [[nodiscard]] double distance(std::size_t i, std::size_t j) const {
    if (!isBox(i) || !isBox(j)) return std::numeric_limits<double>::quiet_NaN();
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double gap =
          std::max({0.0, m_bounds[i][axis] - m_bounds[j][axis + 3], m_bounds[j][axis] - m_bounds[i][axis + 3]});
      square += gap * gap;
    }
    return std::sqrt(square);
  }

  [[nodiscard]] std::size_t indexOf(const Object* object) const {
    const auto isIt = [&](const auto& owned) { return owned.get() == object; };
    return static_cast<std::size_t>(std::find_if(m_objects.begin(), m_objects.end(), isIt) - m_objects.begin());
  }

  /// The pairs no farther apart than that, of a member of one set and one of another; of one set if they are the same.
  [[nodiscard]] Names pairs(const std::set<std::size_t>& some, const std::set<std::size_t>& others, double most) const {
    Names names;
    for (const std::size_t i : some) {
      for (const std::size_t j : others) {
        if (&some == &others ? i < j && distance(i, j) <= most : distance(i, j) <= most) names.emplace_back(i, j);
      }
    }
    return names;
  }

  Object* operator[](std::size_t at) const { return m_objects[at].get(); }
  [[nodiscard]] std::size_t size() const { return m_objects.size(); }
  unsigned number(unsigned end) { return static_cast<unsigned>(m_random() % end); }

 private:
  std::mt19937 m_random;
  bool m_haveEmptyOnes;
  std::vector<std::unique_ptr<Object>> m_objects;
  std::vector<Bounds> m_bounds;
};

/// Collects pairs by the numbers of their objects.
class Collect : public ::coal::CollisionCallBackBase {
 public:
  explicit Collect(const Objects& objects) : m_objects(objects) {}

  void init() override {
    ++begun;
    names.clear();
  }

  bool collide(Object* first, Object* second) override {
    names.emplace_back(m_objects.indexOf(first), m_objects.indexOf(second));
    return names.size() == most;
  }

  /// In order; the members of a pair too where they are of one set.
  [[nodiscard]] Names sorted(bool areOfOneSet = true) const {
    Names result = names;
    for (auto& [first, second] : result) {
      if (areOfOneSet && first > second) std::swap(first, second);
    }
    std::sort(result.begin(), result.end());
    return result;
  }

  Names names;
  std::size_t most = std::numeric_limits<std::size_t>::max();
  int begun = 0;

 private:
  const Objects& m_objects;
};

/// Collects pairs that are no farther apart than a distance, which it always asks for, or finds the least distance.
class Measure : public ::coal::DistanceCallBackBase {
 public:
  Measure(const Objects& objects, double threshold) : m_objects(objects), m_threshold(threshold) {}

  void init() override {
    ++begun;
    names.clear();
    nearest = kInfinity;
  }

  bool distance(Object* first, Object* second, ::coal::CoalScalar& least) override {
    const std::size_t i = m_objects.indexOf(first);
    const std::size_t j = m_objects.indexOf(second);
    const double between = m_objects.distance(i, j);
    EXPECT_FALSE(std::isnan(between));
    nearest = std::min(nearest, between);
    if (between <= m_threshold) names.emplace_back(i, j);
    least = std::isnan(m_threshold) ? nearest : m_threshold;
    return false;
  }

  Names names;
  double nearest = kInfinity;
  int begun = 0;

 private:
  const Objects& m_objects;
  double m_threshold;  // not a number: the least distance is wanted
};

constexpr double kLeast = std::numeric_limits<double>::quiet_NaN();

Names sortedNames(Names names) {
  for (auto& [first, second] : names) {
    if (first > second) std::swap(first, second);
  }
  std::sort(names.begin(), names.end());
  return names;
}

double leastOf(const Objects& objects, const std::set<std::size_t>& some, const std::set<std::size_t>& others) {
  double least = kInfinity;
  for (const auto& [i, j] : objects.pairs(some, others, kInfinity)) least = std::min(least, objects.distance(i, j));
  return least;
}

/// Compares what a manager finds within itself with the double loop.
void expectItself(const Base& manager, const Objects& objects, const std::set<std::size_t>& members) {
  Collect collect(objects);
  manager.collide(&collect);
  EXPECT_EQ(collect.sorted(), objects.pairs(members, members, 0));
  EXPECT_EQ(collect.begun, 1);
  Measure least(objects, kLeast);
  manager.distance(&least);
  EXPECT_EQ(least.nearest, leastOf(objects, members, members));
  EXPECT_EQ(least.begun, 1);
  Measure within(objects, 2.5);
  manager.distance(&within);
  EXPECT_EQ(sortedNames(within.names), objects.pairs(members, members, 2.5));
}

/// The same of one object with a manager.
void expectWithObject(const Base& manager, const Objects& objects, const std::set<std::size_t>& members) {
  const std::set<std::size_t> probe{objects.size() - 1};
  Object* const object = objects[objects.size() - 1];
  Collect collect(objects);
  manager.collide(object, &collect);
  EXPECT_EQ(collect.sorted(false), objects.pairs(members, probe, 0));
  EXPECT_EQ(collect.begun, 1);
  Measure least(objects, kLeast);
  manager.distance(object, &least);
  EXPECT_EQ(least.nearest, leastOf(objects, members, probe));
  EXPECT_EQ(least.begun, 1);
}

/// The same of two managers.
void expectWithOther(const Base& manager, Base& other,
                     const std::pair<std::set<std::size_t>, std::set<std::size_t>>& members, const Objects& objects) {
  Collect collect(objects);
  manager.collide(&other, &collect);
  EXPECT_EQ(collect.sorted(false), objects.pairs(members.first, members.second, 0));
  EXPECT_EQ(collect.begun, 1);
  Measure least(objects, kLeast);
  manager.distance(&other, &least);
  EXPECT_EQ(least.nearest, leastOf(objects, members.first, members.second));
  EXPECT_EQ(least.begun, 1);
}

TEST(CoalManager, FindsWhatTheDoubleLoopFinds) {
  for (const unsigned count : {0U, 1U, 2U, 7U, 40U, 130U, 300U}) {
    SCOPED_TRACE(testing::Message() << "seed and count " << count);
    Objects objects(count);
    CoalBroadPhaseManager manager;
    std::set<std::size_t> members;
    for (std::size_t i = 0; i < count; ++i) members.insert(i);
    std::vector<Object*> some;
    for (std::size_t i = 0; i < count; ++i) some.push_back(objects.add());
    objects.add();  // which is asked about
    manager.registerObjects(some);
    manager.setup();
    EXPECT_EQ(manager.size(), count);
    EXPECT_EQ(manager.empty(), count == 0);
    EXPECT_EQ(manager.getObjects(), some);
    expectItself(manager, objects, members);
    expectWithObject(manager, objects, members);
  }
}

TEST(CoalManager, MeetsOtherManagers) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Objects objects(seed, false);  // which Coal's own tree takes for boxes
    CoalBroadPhaseManager manager;
    CoalBroadPhaseManager ours;
    ::coal::DynamicAABBTreeCollisionManager tree;
    std::set<std::size_t> mine;
    std::set<std::size_t> theirs;
    for (std::size_t i = 0; i < 20U + 10U * seed; ++i) {
      Object* const object = objects.add();
      const bool isMine = objects.number(2) == 0;
      (isMine ? mine : theirs).insert(i);
      for (Base* where : isMine ? std::vector<Base*>{&manager} : std::vector<Base*>{&ours, &tree})
        where->registerObject(object);
    }
    tree.setup();
    expectWithOther(manager, ours, {mine, theirs}, objects);
    expectWithOther(manager, tree, {mine, theirs}, objects);
    expectWithOther(tree, manager, {theirs, mine}, objects);
    for (const std::size_t i : mine) objects.move(i);
    manager.update();
    expectWithOther(tree, manager, {theirs, mine}, objects);
    expectWithOther(manager, ours, {mine, theirs}, objects);
    Collect withItself(objects);
    manager.collide(static_cast<Base*>(&manager), &withItself);
    EXPECT_EQ(withItself.sorted(), objects.pairs(mine, mine, 0));
    EXPECT_EQ(withItself.begun, 1);
  }
}

TEST(CoalManager, FollowsObjectsThatMoveComeAndGo) {
  Objects objects(77);
  CoalBroadPhaseManager manager;
  std::set<std::size_t> members;
  for (std::size_t step = 0; step < 80; ++step) {
    SCOPED_TRACE(testing::Message() << "step " << step);
    for (unsigned i = 0; i < 4; ++i) {
      members.insert(objects.size());
      manager.registerObject(objects.add());
    }
    std::vector<Object*> moved;
    for (const std::size_t i : members) {
      if (objects.number(8) != 0) continue;
      objects.move(i);
      moved.push_back(objects[i]);
    }
    if (step % 3 == 0) manager.update();
    if (step % 3 == 1) manager.update(moved);
    for (Object* object : moved) manager.update(object);
    const std::size_t leaving = objects.number(static_cast<unsigned>(objects.size()));
    members.erase(leaving);
    manager.unregisterObject(objects[leaving]);
    manager.unregisterObject(objects[leaving]);  // no longer there
    manager.registerObject(objects[*members.begin()]);
    manager.registerObject(nullptr);
    if (step == 50) manager.clear();
    if (step == 50) members.clear();
    EXPECT_EQ(manager.size(), members.size());
    expectItself(manager, objects, members);
  }
}

TEST(CoalManager, ACallbackEndsTheQuery) {
  Objects objects(3);
  CoalBroadPhaseManager manager;
  for (int i = 0; i < 100; ++i) manager.registerObject(objects.add());
  Collect collect(objects);
  collect.most = 5;
  manager.collide(&collect);
  EXPECT_EQ(collect.names.size(), 5U);
}

TEST(CoalManager, OrdersPairsByRegistrationWhereThatIsAskedFor) {
  Objects objects(4);
  CoalBroadPhaseManagerOptions options;
  options.isOrdered = true;
  CoalBroadPhaseManager manager(options);
  for (int i = 0; i < 200; ++i) manager.registerObject(objects.add());
  Collect collect(objects);
  manager.collide(&collect);
  EXPECT_FALSE(collect.names.empty());
  EXPECT_EQ(collect.names, collect.sorted());
}

TEST(CoalManager, RefusesABoxWithANan) {
  Objects objects(5);
  CoalBroadPhaseManager manager;
  for (int i = 0; i < 3; ++i) objects.add();
  objects.set(0, {0, 0, 0, 1, 1, 1});
  objects.set(1, {1, 1, 1, 2, 2, 2});
  objects.set(2, {0, 0, kLeast, 1, 1, 1});
  manager.registerObject(objects[0]);
  manager.registerObject(objects[1]);
  EXPECT_THROW(manager.registerObject(objects[2]), InvalidBox);
  EXPECT_EQ(manager.size(), 2U);
  Collect collect(objects);
  EXPECT_THROW(manager.collide(objects[2], &collect), InvalidBox);
  objects[1]->getAABB().min_[0] = kLeast;
  EXPECT_THROW(manager.update(), InvalidBox);
  manager.collide(&collect);
  EXPECT_EQ(collect.sorted(), (Names{{0, 1}}));
}

TEST(CoalManager, AnswersSeveralThreadsAtOnce) {
  Objects objects(6);
  CoalBroadPhaseManager manager;
  std::set<std::size_t> members;
  for (std::size_t i = 0; i < 150; ++i) {
    members.insert(i);
    manager.registerObject(objects.add());
  }
  objects.add();
  ::coal::DynamicAABBTreeCollisionManager tree;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      for (int round = 0; round < 3; ++round) {
        expectItself(manager, objects, members);
        expectWithObject(manager, objects, members);
        expectWithOther(tree, manager, {{}, members}, objects);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace allpairs::test
