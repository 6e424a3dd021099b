// SPDX-License-Identifier: MIT
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/distance.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "FclScene.h"
#include "allpairs/Error.h"
#include "allpairs/Executor.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/fcl/FclBroadPhaseManager.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

template <class S>
class FclManager : public FclScene<S> {};

TYPED_TEST_SUITE(FclManager, FclPrecisions);

TYPED_TEST(FclManager, FindsTheCollisionsOfTheNaiveManager) {
  for (const int size : {3, 8, 20}) {
    const auto objects = this->addObjects(150, static_cast<TypeParam>(size));
    this->m_ours.clear();
    this->m_naive.clear();
    this->m_ours.registerObjects(objects);
    this->m_naive.registerObjects(objects);
    this->m_ours.setup();
    EXPECT_EQ(this->collisions(this->m_ours), this->collisions(this->m_naive))
        << "seed " << kSceneSeed << ", size " << size;
    for (auto* probe : this->addObjects(10, static_cast<TypeParam>(size))) {
      EXPECT_EQ(this->collisions(this->m_ours, probe), this->collisions(this->m_naive, probe));
    }
  }
}

TYPED_TEST(FclManager, TellsItsSizeWithHalfSpacesToo) {
  using S = TypeParam;
  const auto objects = this->addObjects(19, S(10));
  this->m_ours.registerObjects(objects);
  auto ground = std::make_unique<::fcl::CollisionObject<S>>(
      std::make_shared<::fcl::Halfspace<S>>(::fcl::Vector3<S>(0, 0, 1), S(0)));
  ground->computeAABB();
  this->m_ours.registerObject(ground.get());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(this->m_ours.size(), 20U);
    this->m_ours.update();
  }
  this->m_ours.unregisterObject(ground.get());
  EXPECT_EQ(this->m_ours.size(), 19U);
}

TYPED_TEST(FclManager, ReadsTheBoxesOfAnotherOfItsKindAsTheyWereLastUpdated) {
  using S = TypeParam;
  const auto mine = this->addObjects(5, S(1));
  const auto theirs = this->addObjects(5, S(1));
  this->m_ours.registerObjects(mine);
  FclBroadPhaseManager<S> other;
  other.registerObjects(theirs);
  const auto count = [&] {
    int asked = 0;
    this->m_ours.distance(&other, &asked, [](auto*, auto*, void* data, S&) {
      ++*static_cast<int*>(data);
      return false;
    });
    return asked;
  };
  EXPECT_EQ(count(), 25);
  const_cast<::fcl::AABB<S>&>(theirs[2]->getAABB()).min_[0] = std::numeric_limits<S>::quiet_NaN();
  EXPECT_EQ(count(), 25);
  EXPECT_THROW(other.update(), InvalidBox);
}

TYPED_TEST(FclManager, FindsTheLeastDistancesOfTheNaiveManager) {
  for (const int size : {10, 40, 200}) {
    const auto objects = this->addObjects(60, static_cast<TypeParam>(size));
    this->m_ours.clear();
    this->m_naive.clear();
    this->m_ours.registerObjects(objects);
    this->m_naive.registerObjects(objects);
    this->m_ours.setup();
    ::fcl::DynamicAABBTreeCollisionManager<TypeParam> tree;
    tree.registerObjects(objects);
    tree.setup();
    EXPECT_EQ(this->distance(this->m_ours), this->distance(this->m_naive))
        << "seed " << kSceneSeed << ", size " << size;
    for (auto* probe : this->addObjects(10, static_cast<TypeParam>(size))) {
      EXPECT_EQ(this->distance(this->m_ours, probe), this->distance(tree, probe)) << "asked in the same order";
    }
  }
}

TYPED_TEST(FclManager, MeetsAnotherManagerOfItsOwnKindAndOfFcl) {
  const auto objects = this->addObjects(80, TypeParam(8));
  const auto others = this->addObjects(70, TypeParam(8));
  FclBroadPhaseManager<TypeParam> ourOther;
  ::fcl::NaiveCollisionManager<TypeParam> naiveOther;
  ::fcl::DynamicAABBTreeCollisionManager<TypeParam> treeOther;
  this->m_ours.registerObjects(objects);
  this->m_naive.registerObjects(objects);
  for (auto* manager : std::vector<typename TestFixture::Base*>{&ourOther, &naiveOther, &treeOther}) {
    manager->registerObjects(others);
    manager->setup();
  }
  const auto expected = this->collisions(this->m_naive, static_cast<typename TestFixture::Base*>(&naiveOther));
  EXPECT_FALSE(expected.empty());
  const auto nearest = this->distance(this->m_naive, static_cast<typename TestFixture::Base*>(&naiveOther));
  for (auto* manager : std::vector<typename TestFixture::Base*>{&ourOther, &naiveOther, &treeOther}) {
    EXPECT_EQ(this->collisions(this->m_ours, manager), expected);
    EXPECT_EQ(this->distance(this->m_ours, manager), nearest);
  }
  typename TestFixture::Base* itself = &this->m_ours;
  EXPECT_EQ(this->collisions(this->m_ours, itself), this->collisions(this->m_naive));
  EXPECT_EQ(this->distance(this->m_ours, itself), this->distance(this->m_naive));
}

TYPED_TEST(FclManager, IsTheOtherManagerOfATreeOfFcl) {
  using Manager = typename TestFixture::Base;
  auto objects = this->addObjects(120, TypeParam(8));
  const auto others = this->addObjects(70, TypeParam(8));
  ::fcl::DynamicAABBTreeCollisionManager<TypeParam> tree;
  ::fcl::NaiveCollisionManager<TypeParam> naiveOther;
  tree.registerObjects(others);
  naiveOther.registerObjects(others);
  Manager* const ours = &this->m_ours;
  EXPECT_TRUE(this->collisions(tree, ours).empty());
  this->m_ours.registerObjects(objects);
  for (int step = 0; step < 12; ++step) {
    this->m_naive.clear();
    this->m_naive.registerObjects(objects);
    const auto expected = this->collisions(naiveOther, static_cast<Manager*>(&this->m_naive));
    EXPECT_FALSE(expected.empty());
    ASSERT_EQ(this->collisions(tree, ours), expected) << "seed " << kSceneSeed << ", step " << step;
    ASSERT_EQ(this->distance(tree, ours), this->distance(naiveOther, static_cast<Manager*>(&this->m_naive)));
    if (step == 6) this->m_ours.clear();
    if (step == 6) this->m_ours.registerObjects(objects);
    for (auto* object : objects) this->place(*object, TypeParam(8));
    this->m_ours.update();
    this->m_ours.unregisterObject(objects[2]);
    objects[2] = this->addObjects(1, TypeParam(8)).front();
    this->m_ours.registerObject(objects[2]);
  }
}

TYPED_TEST(FclManager, TellsApartManagersThatAreApart) {
  const auto objects = this->addObjects(20, TypeParam(5));
  const auto others = this->addObjects(20, TypeParam(5));
  for (auto* object : others) {
    object->setTranslation(object->getTranslation() + ::fcl::Vector3<TypeParam>(30, 0, 0));
    object->computeAABB();
  }
  FclBroadPhaseManager<TypeParam> ourOther;
  ::fcl::NaiveCollisionManager<TypeParam> naiveOther;
  this->m_ours.registerObjects(objects);
  this->m_naive.registerObjects(objects);
  ourOther.registerObjects(others);
  naiveOther.registerObjects(others);
  using Manager = typename TestFixture::Base;
  EXPECT_EQ(this->distance(this->m_ours, static_cast<Manager*>(&ourOther)),
            this->distance(this->m_naive, static_cast<Manager*>(&naiveOther)));
  EXPECT_TRUE(this->collisions(this->m_ours, static_cast<Manager*>(&ourOther)).empty());
}

TYPED_TEST(FclManager, FollowsObjectsThatMoveComeAndGo) {
  auto objects = this->addObjects(100, TypeParam(8));
  this->m_ours.registerObjects(objects);
  for (std::size_t step = 0; step < 60; ++step) {
    std::vector<typename TestFixture::Object*> moved;
    for (std::size_t i = step % 3; i < objects.size(); i += 3) moved.push_back(objects[i]);
    for (auto* object : moved) this->place(*object, TypeParam(8));
    if (step % 3 == 0) this->m_ours.update();
    if (step % 3 == 1) this->m_ours.update(moved);
    if (step % 3 == 2) {
      for (auto* object : moved) this->m_ours.update(object);
    }
    this->m_ours.unregisterObject(objects[step]);
    objects[step] = this->addObjects(1, TypeParam(8)).front();
    this->m_ours.registerObject(objects[step]);
    this->m_naive.clear();
    this->m_naive.registerObjects(objects);
    ASSERT_EQ(this->collisions(this->m_ours), this->collisions(this->m_naive))
        << "seed " << kSceneSeed << ", step " << step;
    ASSERT_EQ(this->distance(this->m_ours), this->distance(this->m_naive));
    ASSERT_EQ(this->m_ours.size(), 100U);
  }
}

TYPED_TEST(FclManager, StopsWhenTheCallbackSaysSo) {
  this->m_ours.registerObjects(this->addObjects(50, TypeParam(3)));
  using Body = typename TestFixture::Object;
  int calls = 0;
  const auto stopAtThree = [](Body*, Body*, void* data) { return ++*static_cast<int*>(data) == 3; };
  this->m_ours.collide(&calls, stopAtThree);
  EXPECT_EQ(calls, 3);
  const auto stopAtFive = [](Body*, Body*, void* data, TypeParam&) { return ++*static_cast<int*>(data) == 5; };
  calls = 0;
  this->m_ours.distance(&calls, stopAtFive);
  EXPECT_EQ(calls, 5);
}

TYPED_TEST(FclManager, ListsItsObjectsAndIsEmptyWithoutAny) {
  EXPECT_TRUE(this->m_ours.empty());
  const auto objects = this->addObjects(4, TypeParam(3));
  this->m_ours.registerObjects({objects[0], objects[1], objects[0]});
  this->m_ours.registerObjects(objects);
  this->m_ours.registerObject(objects[1]);
  std::vector<typename TestFixture::Object*> listed;
  this->m_ours.getObjects(listed);
  EXPECT_THAT(listed, ::testing::UnorderedElementsAreArray(objects));
  EXPECT_EQ(this->m_ours.size(), 4U);
  this->m_ours.unregisterObject(objects[2]);
  this->m_ours.unregisterObject(objects[2]);
  EXPECT_EQ(this->m_ours.size(), 3U);
  this->m_ours.clear();
  EXPECT_TRUE(this->m_ours.empty());
  EXPECT_TRUE(this->collisions(this->m_ours).empty());
}

/// Which objects a manager hands to a callback, as it does.
template <class S>
std::vector<std::pair<::fcl::CollisionObject<S>*, ::fcl::CollisionObject<S>*>> candidates(
    const ::fcl::BroadPhaseCollisionManager<S>& manager) {
  using Object = ::fcl::CollisionObject<S>;
  std::vector<std::pair<Object*, Object*>> given;
  manager.collide(&given, [](Object* a, Object* b, void* data) {
    static_cast<decltype(given)*>(data)->emplace_back(a, b);
    return false;
  });
  return given;
}

/// The pairs of objects whose boxes overlap, by FCL's own test, in the order of the list.
template <class S>
auto overlapping(const std::vector<::fcl::CollisionObject<S>*>& objects) {
  std::vector<std::pair<::fcl::CollisionObject<S>*, ::fcl::CollisionObject<S>*>> pairs;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = i + 1; j < objects.size(); ++j) {
      if (objects[i]->getAABB().overlap(objects[j]->getAABB())) pairs.emplace_back(objects[i], objects[j]);
    }
  }
  return pairs;
}

TYPED_TEST(FclManager, GivesEachPairOnceAndTheObjectThatCameFirstAsTheFirst) {
  const auto objects = this->addObjects(400, TypeParam(10));
  this->m_ours.registerObjects(objects);
  EXPECT_THAT(candidates(this->m_ours), ::testing::UnorderedElementsAreArray(overlapping(objects)));
  EXPECT_EQ(candidates(this->m_ours), candidates(this->m_ours));
}

TYPED_TEST(FclManager, GivesThePairsInTheOrderOfRegistrationIfAsked) {
  FclBroadPhaseManager<TypeParam> ordered({.isOrdered = true});
  const auto objects = this->addObjects(400, TypeParam(10));
  ordered.registerObjects(objects);
  EXPECT_EQ(candidates(ordered), overlapping(objects));
}

TYPED_TEST(FclManager, OrdersAnObjectByThePlaceOfTheOneThatLeft) {
  FclBroadPhaseManager<TypeParam> ordered({.isOrdered = true});
  auto objects = this->addObjects(400, TypeParam(10));
  ordered.registerObjects({objects.begin(), objects.begin() + 300});
  for (std::size_t i = 300; i < 400; ++i) {
    std::swap(objects[i - 300], objects[i]);
    ordered.unregisterObject(objects[i]);
    ordered.registerObject(objects[i - 300]);
  }
  objects.resize(300);
  EXPECT_EQ(candidates(ordered), overlapping(objects));
}

TYPED_TEST(FclManager, FindsTheSamePairsWhetherFewObjectsMoveOrMany) {
  // GoogleMock compares each pair with each, of which there are a third then.
  const auto objects = this->addObjects(kIsSanitized ? 300U : 500U, TypeParam(10));
  this->m_ours.registerObjects(objects);
  for (const std::size_t stride : {100U, 1U, 100U, 100U, 250U, 2U, 100U, 500U, 3U, 3U}) {
    for (std::size_t i = 0; i < objects.size(); i += stride) this->place(*objects[i], TypeParam(10));
    this->m_ours.update();
    EXPECT_THAT(candidates(this->m_ours), ::testing::UnorderedElementsAreArray(overlapping(objects)))
        << "seed " << kSceneSeed << ", every " << stride;
  }
}

/// Counts the searches that ask it how to divide their work.
class CountingExecutor final : public Executor {
 public:
  [[nodiscard]] std::size_t concurrency() const noexcept override {
    ++m_asked;
    return 2;
  }

  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    ++m_asked;
    for (std::size_t i = 0; i < count; ++i) task(i);
  }

  [[nodiscard]] int takeAsked() { return std::exchange(m_asked, 0); }

 private:
  mutable int m_asked = 0;
};

TYPED_TEST(FclManager, SearchesNothingBeforeItIsAskedFor) {
  CountingExecutor executor;
  FclBroadPhaseManager<TypeParam> manager({.executor = &executor});
  const auto objects = this->addObjects(3000, TypeParam(40));
  const auto changeAll = [&] {
    for (auto* object : objects) this->place(*object, TypeParam(40));
    manager.update();
  };
  manager.registerObjects(objects);
  manager.setup();
  changeAll();
  EXPECT_EQ(executor.takeAsked(), 0);
  this->collisions(manager);
  EXPECT_GT(executor.takeAsked(), 0);
  changeAll();
  EXPECT_EQ(executor.takeAsked(), 0);
  this->collisions(manager, objects[7]);  // one query is a scan
  EXPECT_EQ(executor.takeAsked(), 0);
}

TYPED_TEST(FclManager, FindsWhatHasLeftTheBoxAroundAllWhereverItIs) {
  using S = TypeParam;
  for (const unsigned count : {2U, 30U, 200U}) {
    FclBroadPhaseManager<S> ours;
    const auto objects = this->addObjects(count, S(4));
    const auto probes = this->addObjects(10, S(4));
    FclBroadPhaseManager<S> probing;
    ::fcl::NaiveCollisionManager<S> naiveProbing;
    ours.registerObjects(objects);
    for (int step = 0; step < 7; ++step) {
      const S offset = S(30) * S(step % 2 == 0 ? step : -step);
      for (const auto& all : {objects, probes}) {
        for (auto* object : all) this->place(*object, S(4));
        for (auto* object : all) object->setTranslation(object->getTranslation().array() + offset);
        for (auto* object : all) object->computeAABB();
      }
      if (step == 3) ours.unregisterObject(objects[1]);
      if (step == 4) ours.registerObject(objects[1]);
      if (step == 5) ours.clear();
      if (step == 5) ours.registerObjects(objects);
      ours.update();
      for (typename TestFixture::Base* manager : {static_cast<typename TestFixture::Base*>(&probing),
                                                  static_cast<typename TestFixture::Base*>(&naiveProbing)}) {
        manager->clear();
        manager->registerObjects(probes);
      }
      this->m_naive.clear();
      for (auto* object : objects) {
        if (step != 3 || object != objects[1]) this->m_naive.registerObject(object);
      }
      std::size_t found = 0;
      for (auto* probe : probes) {
        const auto expected = this->collisions(this->m_naive, probe);
        ASSERT_EQ(this->collisions(ours, probe), expected) << count << " objects, step " << step;
        found += expected.size();
      }
      EXPECT_TRUE(count == 2 || found > 0) << "probes are among the objects";
      ASSERT_EQ(this->collisions(ours, static_cast<typename TestFixture::Base*>(&probing)),
                this->collisions(this->m_naive, static_cast<typename TestFixture::Base*>(&naiveProbing)));
    }
  }
}

TYPED_TEST(FclManager, IsAskedToRegisterAFewAtATime) {
  const auto objects = this->addObjects(300, TypeParam(12));
  for (std::size_t i = 0; i < objects.size(); i += 3) {
    this->m_ours.registerObjects({objects[i], objects[i + 1], nullptr, objects[i + 2], objects[i / 2]});
  }
  this->m_naive.registerObjects(objects);
  EXPECT_EQ(this->m_ours.size(), objects.size());
  EXPECT_EQ(this->collisions(this->m_ours), this->collisions(this->m_naive));
}

TYPED_TEST(FclManager, BoxesThatTouchAreAPairAndTheNextNumberIsApart) {
  using S = TypeParam;
  const S next = std::nextafter(S(1), S(2));  // in double the same as 1 when it is rounded to float
  const S most = std::numeric_limits<S>::max();
  const S infinity = std::numeric_limits<S>::infinity();
  BoxedObject<S> low(S(0), S(1));
  BoxedObject<S> touching(S(1), S(2));
  BoxedObject<S> apart(next, S(2));
  BoxedObject<S> far(most, infinity);
  BoxedObject<S> nearlyFar(std::nextafter(most, S(0)), std::nextafter(most, S(0)));
  BoxedObject<S> everywhere(-infinity, infinity);
  const std::vector<::fcl::CollisionObject<S>*> objects{&low, &touching, &apart, &far, &nearlyFar, &everywhere};
  this->m_ours.registerObjects(objects);
  for (int step = 0; step < 3; ++step) {
    EXPECT_THAT(candidates(this->m_ours), ::testing::UnorderedElementsAreArray(overlapping(objects)));
  }
  EXPECT_EQ(overlapping(objects).size(), 7U);
}

TYPED_TEST(FclManager, AnEmptyBoxOverlapsNothing) {
  using S = TypeParam;
  BoxedObject<S> big(S(-9), S(9));
  BoxedObject<S> empty(std::nextafter(S(1), S(2)), S(1));
  this->m_ours.registerObjects({&big, &empty});
  EXPECT_TRUE(candidates(this->m_ours).empty());
  empty.set(S(1), S(1));
  this->m_ours.update(&empty);
  EXPECT_EQ(candidates(this->m_ours).size(), 1U);
}

TYPED_TEST(FclManager, NamesTheObjectWhoseBoxHasANan) {
  using S = TypeParam;
  BoxedObject<S> good(S(0), S(1));
  BoxedObject<S> bad(S(0), S(1));
  this->m_ours.registerObjects({&good, &bad});
  this->m_ours.setup();
  good.set(S(3), S(4));
  bad.set(std::numeric_limits<S>::quiet_NaN(), S(1));
  try {
    this->m_ours.update();
    FAIL() << "a NaN was taken";
  } catch (const InvalidBox& error) {
    EXPECT_EQ(error.index(), 1U);
  }
  EXPECT_TRUE(candidates(this->m_ours).empty()) << "the other has moved, this one is where it was";
  bad.set(S(4), S(5));
  this->m_ours.update();
  EXPECT_EQ(candidates(this->m_ours).size(), 1U);
  BoxedObject<S> fresh(std::numeric_limits<S>::quiet_NaN(), S(1));
  EXPECT_THROW(this->m_ours.registerObject(&fresh), InvalidBox);
  EXPECT_EQ(this->m_ours.size(), 2U) << "it was not registered";
  fresh.set(S(5), S(6));
  this->m_ours.registerObject(&fresh);
  EXPECT_EQ(candidates(this->m_ours).size(), 2U);
}

TYPED_TEST(FclManager, ReadsAllObjectsThoughOneHasANan) {
  using S = TypeParam;
  const S nan = std::numeric_limits<S>::quiet_NaN();
  BoxedObject<S> bad(S(0), S(1));
  BoxedObject<S> worse(S(10), S(11));
  BoxedObject<S> still(S(20), S(21));
  BoxedObject<S> moving(S(30), S(31));
  this->m_ours.registerObjects({&bad, &worse, &still, &moving});
  bad.set(nan, S(1));
  worse.set(S(10), nan);
  for (const bool areSome : {false, true}) {
    moving.set(areSome ? S(30) : S(20), areSome ? S(31) : S(21));
    try {
      areSome ? this->m_ours.update({&bad, &worse, &moving}) : this->m_ours.update();
      FAIL() << "a NaN was taken";
    } catch (const InvalidBox& error) {
      EXPECT_EQ(error.index(), 0U);
    }
    EXPECT_EQ(candidates(this->m_ours).size(), areSome ? 0U : 1U);
  }
}

}  // namespace
}  // namespace allpairs::test
