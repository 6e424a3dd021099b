// SPDX-License-Identifier: MIT
// Queries of few objects and of many, the first ones and later ones, which a manager answers in different ways.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <set>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "FclScene.h"
#include "allpairs/Error.h"
#include "allpairs/fcl/FclBroadPhaseManager.h"

namespace allpairs::test {
namespace {

template <class S>
class FclQueries : public FclScene<S> {};

TYPED_TEST_SUITE(FclQueries, FclPrecisions);

/// Collects the pairs that a query for distances gives, and sets the same least distance in each call.
template <class S>
struct Threshold {
  using Object = ::fcl::CollisionObject<S>;

  S distance = S(0);
  std::vector<std::pair<Object*, Object*>> given;

  static bool call(Object* a, Object* b, void* data, S& least) {
    auto& self = *static_cast<Threshold*>(data);
    self.given.emplace_back(std::minmax(a, b));
    least = self.distance;
    return false;
  }

  /// Those of the given pairs whose boxes are near enough, in ascending order.
  [[nodiscard]] auto within() const {
    auto pairs = given;
    std::erase_if(pairs, [&](const auto& pair) { return !isWithin(pair.first, pair.second); });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  [[nodiscard]] bool isWithin(const Object* a, const Object* b) const {
    return a->getAABB().distance(b->getAABB()) <= distance;
  }
};

/// Expects that a callback that holds a distance gets all pairs within it, each once.
template <class Object, class S>
void expectAllWithin(const std::vector<Object*>& objects, const FclBroadPhaseManager<S>& manager, S distance) {
  Threshold<S> expected{distance, {}};
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) expected.given.emplace_back(std::minmax(objects[i], objects[j]));
  }
  Threshold<S> self{distance, {}};
  manager.distance(&self, Threshold<S>::call);
  EXPECT_EQ(self.within(), expected.within()) << objects.size() << " objects, distance " << distance;
  EXPECT_EQ(std::set(self.given.begin(), self.given.end()).size(), self.given.size()) << "a pair came twice";
}

TYPED_TEST(FclQueries, GivesACallbackThatHoldsADistanceAllPairsWithinItOnce) {
  using S = TypeParam;
  for (const std::size_t count : {3U, 20U, 64U, 65U, 200U}) {
    const auto objects = this->addObjects(count, S(9));
    FclBroadPhaseManager<S> manager;
    manager.registerObjects(objects);
    for (const S distance : {S(0), S(0.25), S(2)}) {
      expectAllWithin(objects, manager, distance);
    }
  }
}

TYPED_TEST(FclQueries, GivesThePairsOfManagersOfAnySizesOnceAndItsOwnFirst) {
  using S = TypeParam;
  const std::vector<std::size_t> counts{3, 12, 70, 400};
  for (const std::size_t ours : counts) {
    for (const std::size_t theirs : counts) {
      const auto objects = this->addObjects(ours, S(9));
      const auto others = this->addObjects(theirs, S(9));
      FclBroadPhaseManager<S> manager;
      FclBroadPhaseManager<S> other;
      manager.registerObjects(objects);
      other.registerObjects(others);
      manager.unregisterObject(objects.front());
      other.unregisterObject(others.back());
      for (const S distance : {S(-1), S(0), S(0.25)}) {
        std::set<std::pair<void*, void*>> expected;
        for (auto* object : std::span(objects).subspan(1)) {
          for (auto* second : std::span(others).first(theirs - 1)) {
            const bool isIn = distance < 0 ? object->getAABB().overlap(second->getAABB())
                                           : object->getAABB().distance(second->getAABB()) <= distance;
            if (isIn) expected.emplace(object, second);
          }
        }
        Threshold<S> found{distance, {}};
        if (distance < 0) {
          manager.collide(&other, &found, [](auto* a, auto* b, void* data) {
            static_cast<Threshold<S>*>(data)->given.emplace_back(a, b);
            return false;
          });
        } else {
          manager.distance(&other, &found, [](auto* a, auto* b, void* data, S& least) {
            auto& self = *static_cast<Threshold<S>*>(data);
            least = self.distance;
            self.given.emplace_back(a, b);
            return false;
          });
        }
        std::set<std::pair<void*, void*>> given(found.given.begin(), found.given.end());
        EXPECT_EQ(given.size(), found.given.size()) << "a pair came twice";
        std::erase_if(given, [&](const auto& pair) {
          const auto& a = static_cast<::fcl::CollisionObject<S>*>(pair.first)->getAABB();
          const auto& b = static_cast<::fcl::CollisionObject<S>*>(pair.second)->getAABB();
          return distance >= 0 && a.distance(b) > distance;
        });
        EXPECT_EQ(given, expected) << ours << " with " << theirs << ", distance " << distance;
      }
    }
  }
}

TYPED_TEST(FclQueries, GivesThePairsWithinADistanceFarFromTheOrigin) {
  using S = TypeParam;
  const S far = std::is_same_v<S, float> ? S(1e4) : S(1e12);
  for (const std::size_t count : {12U, 100U, 300U}) {
    const auto objects = this->addObjects(count, S(9));
    for (auto* object : objects) {
      object->setTranslation(object->getTranslation() + ::fcl::Vector3<S>(far, -far, far));
      object->computeAABB();
    }
    FclBroadPhaseManager<S> manager;
    manager.registerObjects(objects);
    for (const S distance : {S(0.0625), S(0.5)}) {
      expectAllWithin(objects, manager, distance);
    }
  }
}

TYPED_TEST(FclQueries, ADistanceThatIsNotANumberIsNoErrorOfTheQuery) {
  using S = TypeParam;
  const auto setNan = [](auto*, auto*, void* data, S& least) {
    ++*static_cast<int*>(data);
    least = std::numeric_limits<S>::quiet_NaN();
    return false;
  };
  for (const std::size_t count : {3U, 100U, 400U}) {
    FclBroadPhaseManager<S> manager;
    FclBroadPhaseManager<S> other;
    manager.registerObjects(this->addObjects(count, S(9)));
    other.registerObjects(this->addObjects(300, S(9)));
    for (int query = 0; query < 3; ++query) {
      int asked = 0;
      manager.distance(&other, &asked, setNan);
      manager.distance(&asked, setNan);
      EXPECT_GT(asked, 0);
    }
  }
}

TYPED_TEST(FclQueries, GivesAllObjectsWithinADistanceInTheFirstQueryAndInTheHundredth) {
  using S = TypeParam;
  for (const std::size_t count : {3U, 64U, 65U, 300U}) {
    const auto objects = this->addObjects(count, S(9));
    FclBroadPhaseManager<S> manager;
    manager.registerObjects(objects);
    const auto probes = this->addObjects(100, S(9));
    for (auto* probe : probes) {
      Threshold<S> expected{S(0.5), {}};
      for (auto* object : objects) expected.given.emplace_back(std::minmax(probe, object));
      Threshold<S> found{S(0.5), {}};
      manager.distance(probe, &found, Threshold<S>::call);
      ASSERT_EQ(found.within(), expected.within()) << "of " << count << " objects";
    }
  }
}

TYPED_TEST(FclQueries, GivesTheSameCollisionsInTheFirstQueryAndInTheHundredth) {
  using S = TypeParam;
  for (const std::size_t count : {1U, 2U, 8U, 9U, 64U, 65U, 300U}) {
    const auto objects = this->addObjects(count, S(9));
    FclBroadPhaseManager<S> manager;
    manager.registerObjects(objects);
    manager.unregisterObject(objects[count / 2]);
    const auto probes = this->addObjects(100, S(9));
    for (auto* probe : probes) {
      typename TestFixture::Pairs expected;
      for (auto* object : objects) {
        const bool isThere = object != objects[count / 2];
        if (isThere && object->getAABB().overlap(probe->getAABB())) expected.emplace_back(object, probe);
      }
      typename TestFixture::Pairs found;
      manager.collide(probe, &found, [](auto* a, auto* b, void* data) {
        static_cast<typename TestFixture::Pairs*>(data)->emplace_back(a, b);
        return false;
      });
      ASSERT_THAT(found, ::testing::UnorderedElementsAreArray(expected)) << "of " << count << " objects";
    }
  }
}

TYPED_TEST(FclQueries, AGroundThatReachesToTheLeastNumberIsMeasuredAsAnyOther) {
  using S = TypeParam;
  constexpr S kMost = std::numeric_limits<S>::max();
  for (const int count : {1, 2, 4, 5, 8, 12, 70, 150}) {
    FclBroadPhaseManager<S> manager;
    std::vector<std::unique_ptr<BoxedObject<S>>> objects;
    objects.push_back(std::make_unique<BoxedObject<S>>(-kMost, kMost));
    objects.back()->set(2, -kMost, S(0));
    for (int i = 0; i < count; ++i) {
      objects.push_back(std::make_unique<BoxedObject<S>>(S(3 * i), S(3 * i + 1)));
      objects.back()->set(2, S(2), S(3));
    }
    for (const auto& object : objects) manager.registerObject(object.get());
    const auto measure = [](auto* a, auto* b, void* data, S& least) {
      least = std::min(least, a->getAABB().distance(b->getAABB()));
      *static_cast<S*>(data) = least;
      return false;
    };
    S least = kMost;
    manager.distance(&least, measure);
    EXPECT_EQ(least, S(2)) << count;
    BoxedObject<S> below(-kMost, kMost);
    below.set(2, -kMost, S(1));
    manager.unregisterObject(objects.front().get());
    least = kMost;
    manager.distance(&below, &least, measure);
    EXPECT_EQ(least, S(1)) << count;
  }
}

TYPED_TEST(FclQueries, AnInfiniteBoxMeetsAllBoxesAndNoEmptyOne) {
  using S = TypeParam;
  const S infinity = std::numeric_limits<S>::infinity();
  for (const int count : {3, 20, 100}) {
    FclBroadPhaseManager<S> manager;
    std::vector<std::unique_ptr<BoxedObject<S>>> objects;
    for (int i = 0; i < count; ++i) {
      objects.push_back(std::make_unique<BoxedObject<S>>(S(3 * i), S(3 * i + (i % 3 == 0 ? -1 : 1))));
      manager.registerObject(objects.back().get());
    }
    BoxedObject<S> everywhere(-infinity, infinity);
    BoxedObject<S> empty(S(1), S(0));
    for (int query = 0; query < 30; ++query) {
      int met = 0;
      const auto meet = [](auto*, auto*, void* data) { return ++*static_cast<int*>(data) < 0; };
      const auto measure = [](auto*, auto*, void* data, S&) { return ++*static_cast<int*>(data) < 0; };
      manager.collide(&everywhere, &met, meet);
      EXPECT_EQ(met, count - (count + 2) / 3);
      manager.distance(&everywhere, &met, measure);
      EXPECT_EQ(met, 2 * (count - (count + 2) / 3));
      manager.collide(&empty, &met, meet);
      manager.distance(&empty, &met, measure);
      EXPECT_EQ(met, 2 * (count - (count + 2) / 3));
    }
  }
}

TYPED_TEST(FclQueries, ABoxAtExactlyTheDistanceFromAnEndlessGroundIsGivenByEachQuery) {
  using S = TypeParam;
  for (const S floor : {S(-100), -std::numeric_limits<S>::infinity()}) {
    for (const int count : {3, 100}) {
      FclBroadPhaseManager<S> manager;
      std::vector<std::unique_ptr<BoxedObject<S>>> objects;
      const auto add = [&](S left, S right, S bottom, S top) {
        objects.push_back(std::make_unique<BoxedObject<S>>(left, right));
        objects.back()->set(1, bottom, top);
        manager.registerObject(objects.back().get());
        return objects.back().get();
      };
      auto* const ground = add(S(-1000), S(1000), floor, S(-0.1));  // Rounded, as the distance to the box is.
      auto* const box = add(S(0), S(1), S(4), S(9));
      add(S(500), S(501), S(-1), S(0));  // Asked about first: it lies in the ground.
      for (int i = 3; i < count; ++i) add(S(3 * i), S(3 * i + 1), S(50), S(51));
      for (int query = 0; query < 40; ++query) {
        Threshold<S> found{ground->getAABB().distance(box->getAABB()), {}};
        if (query % 4 == 0)
          manager.distance(&found, Threshold<S>::call);
        else
          manager.distance(ground, &found, Threshold<S>::call);
        const std::pair<::fcl::CollisionObject<S>*, ::fcl::CollisionObject<S>*> pair =
            std::minmax<::fcl::CollisionObject<S>*>(ground, box);
        ASSERT_THAT(found.within(), ::testing::Contains(pair)) << "query " << query << ", ground from " << floor;
      }
    }
  }
}

TYPED_TEST(FclQueries, RefusesAQueryWithANan) {
  using S = TypeParam;
  BoxedObject<S> bad(std::numeric_limits<S>::quiet_NaN(), S(1));
  for (const std::size_t count : {3U, 100U}) {
    FclBroadPhaseManager<S> manager;
    manager.registerObjects(this->addObjects(count, S(9)));
    for (int query = 0; query < 30; ++query) {
      EXPECT_THROW(manager.collide(&bad, nullptr, [](auto*, auto*, void*) { return false; }), InvalidBox);
      EXPECT_THROW(manager.distance(&bad, nullptr, [](auto*, auto*, void*, S&) { return false; }), InvalidBox);
    }
  }
}

TYPED_TEST(FclQueries, AnObjectThatIsAddedAgainWithANanStaysWhereItWas) {
  using S = TypeParam;
  const auto objects = this->addObjects(3, S(0.1));
  FclBroadPhaseManager<S> manager;
  manager.registerObjects(objects);
  Threshold<S> before{S(2), {}};
  manager.distance(&before, Threshold<S>::call);
  objects[1]->setTranslation({std::numeric_limits<S>::quiet_NaN(), S(0), S(0)});
  objects[1]->computeAABB();
  EXPECT_THROW(manager.registerObject(objects[1]), InvalidBox);
  EXPECT_EQ(manager.size(), 3U);
  Threshold<S> after{S(2), {}};
  manager.distance(&after, Threshold<S>::call);
  EXPECT_EQ(after.given.size(), before.given.size());
}

TYPED_TEST(FclQueries, WhatIsGoneIsInNoPair) {
  using S = TypeParam;
  for (const std::size_t count : {20U, 65U, 1000U}) {
    auto objects = this->addObjects(count, S(9));
    FclBroadPhaseManager<S> manager;
    manager.registerObjects(objects);
    for (int step = 0; step < 3; ++step) {
      Threshold<S> all{S(0), {}};
      manager.collide(&all, [](auto* a, auto* b, void* data) {
        static_cast<Threshold<S>*>(data)->given.emplace_back(std::minmax(a, b));
        return false;
      });
      for (const auto& pair : all.given) {
        EXPECT_EQ(std::count(objects.begin(), objects.end(), pair.first), 1);
        EXPECT_EQ(std::count(objects.begin(), objects.end(), pair.second), 1);
      }
      manager.unregisterObject(objects.back());
      objects.pop_back();
    }
  }
}

}  // namespace
}  // namespace allpairs::test
