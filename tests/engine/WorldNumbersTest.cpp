// SPDX-License-Identifier: MIT
// Many worlds in one World: boxes with world numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "allpairs/World.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Boxes.h"

namespace allpairs {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using test::cube;
using test::toVector;

BoxProperties inWorld(std::uint32_t number) {
  BoxProperties properties;
  properties.world = number;
  return properties;
}

QueryFilter ofWorld(std::uint32_t number) {
  QueryFilter filter;
  filter.world = number;
  return filter;
}

TEST(WorldNumbers, BoxesOfDifferentWorldsAreNoPairWhereverTheyAre) {
  World world;
  const BoxId a = world.add(cube(0, 0, 0), inWorld(7));
  const BoxId b = world.add(cube(0, 0, 0), inWorld(kEveryWorld - 1));
  const BoxId c = world.add(cube(0.5, 0, 0), inWorld(7));
  const BoxId d = world.add(cube(0.5, 0, 0));
  const BoxId e = world.add(cube(0.5, 0, 0), inWorld(0));
  EXPECT_THAT(world.step().pairs, ElementsAre(Pair{a, c}, Pair{d, e}));
  EXPECT_THAT(world.result(7).pairs, ElementsAre(Pair{a, c}));
  EXPECT_THAT(world.result(0).began, ElementsAre(Pair{d, e}));
  EXPECT_THAT(world.result(kEveryWorld - 1).pairs, IsEmpty());
  EXPECT_THAT(world.result(8).pairs, IsEmpty());
  EXPECT_EQ(world.properties(b).world, kEveryWorld - 1);
}

TEST(WorldNumbers, ABoxOfEveryWorldIsAPairWithBoxesOfEach) {
  World world;
  const BoxId a = world.add(cube(0, 0, 0), inWorld(1));
  const BoxId ground = world.add(cube(0, 0, 0), inWorld(kEveryWorld));
  const BoxId b = world.add(cube(0, 0, 0), inWorld(2));
  const BoxId wall = world.add(cube(0, 0, 0), inWorld(kEveryWorld));
  EXPECT_THAT(world.step().pairs,
              ElementsAre(Pair{a, ground}, Pair{a, wall}, Pair{ground, b}, Pair{ground, wall}, Pair{b, wall}));
  EXPECT_THAT(world.result(1).pairs, ElementsAre(Pair{a, ground}, Pair{a, wall}));
  EXPECT_THAT(world.result(2).pairs, ElementsAre(Pair{ground, b}, Pair{b, wall}));
  EXPECT_THAT(world.result(kEveryWorld).pairs, ElementsAre(Pair{ground, wall}));
  world.move(ground, cube(5, 0, 0));
  world.step();
  EXPECT_THAT(world.result(1).ended, ElementsAre(Pair{a, ground}));
  EXPECT_THAT(world.result(kEveryWorld).ended, ElementsAre(Pair{ground, wall}));
}

TEST(WorldNumbers, ABoxThatGoesToAnotherWorldEndsItsPairsThereAndBeginsThemHere) {
  World world;
  const BoxId a = world.add(cube(0, 0, 0), inWorld(1));
  const BoxId b = world.add(cube(0, 0, 0), inWorld(1));
  const BoxId c = world.add(cube(0, 0, 0), inWorld(2));
  const BoxId ground = world.add(cube(0, 0, 0), inWorld(kEveryWorld));
  world.step();
  world.setProperties(b, inWorld(2));
  const StepResult step = world.step();
  EXPECT_THAT(step.ended, ElementsAre(Pair{a, b}));
  EXPECT_THAT(step.began, ElementsAre(Pair{b, c}));
  EXPECT_THAT(step.persisted, ElementsAre(Pair{a, ground}, Pair{b, ground}, Pair{c, ground}));
  EXPECT_THAT(world.result(1).ended, ElementsAre(Pair{a, b}, Pair{b, ground}));
  EXPECT_THAT(world.result(1).persisted, ElementsAre(Pair{a, ground}));
  EXPECT_THAT(world.result(2).began, ElementsAre(Pair{b, c}, Pair{b, ground}));
  EXPECT_THAT(world.result(2).persisted, ElementsAre(Pair{c, ground}));
}

TEST(WorldNumbers, WithoutNumbersAllBoxesAreOfWorldZero) {
  World world;
  const BoxId a = world.add(cube(0, 0, 0));
  const BoxId b = world.add(cube(0, 0, 0));
  world.step();
  EXPECT_THAT(world.result(0).began, ElementsAre(Pair{a, b}));
  EXPECT_THAT(world.result(1).pairs, IsEmpty());
  EXPECT_THAT(world.result(kEveryWorld).pairs, IsEmpty());
  EXPECT_THAT(world.findOverlapping(cube(0, 0, 0), ofWorld(0)), ElementsAre(a, b));
  EXPECT_THAT(world.findOverlapping(cube(0, 0, 0), ofWorld(1)), IsEmpty());
}

TEST(WorldNumbers, TheListsOfAWorldStayWhenBoxesChangeAfterTheStep) {
  World world;
  const BoxId a = world.add(cube(0, 0, 0), inWorld(1));
  const BoxId b = world.add(cube(0, 0, 0), inWorld(1));
  world.step();
  world.remove(b);
  world.step();
  const BoxId again = world.add(cube(0, 0, 0), inWorld(2));
  ASSERT_EQ(again, b);
  EXPECT_THAT(world.result(1).ended, ElementsAre(Pair{a, b}));
  EXPECT_THAT(world.result(2).ended, IsEmpty());
}

TEST(WorldNumbers, QueriesFindTheBoxesOfOneWorldAndOfEveryWorld) {
  World world;
  const BoxId a = world.add(cube(1, 0, 0), inWorld(1));
  const BoxId b = world.add(cube(2, 0, 0), inWorld(2));
  const BoxId ground = world.add(cube(3, 0, 0), inWorld(kEveryWorld));
  const Box all{{0, 0, 0}, {9, 1, 1}};
  EXPECT_THAT(world.findOverlapping(all), ElementsAre(a, b, ground));
  EXPECT_THAT(world.findOverlapping(all, ofWorld(1)), ElementsAre(a, ground));
  EXPECT_THAT(world.findOverlapping(all, ofWorld(3)), ElementsAre(ground));
  const Ray ray{{0, 0.5, 0.5}, {1, 0, 0}};
  EXPECT_EQ(world.findFirst(ray).id, a);
  EXPECT_EQ(world.findFirst(ray, ofWorld(2)).id, b);
  EXPECT_EQ(world.findFirst(ray, ofWorld(3)).id, ground);
  const std::vector<Neighbor> nearest = world.findNearest({0, 0, 0}, 2, ofWorld(2));
  ASSERT_EQ(nearest.size(), 2U);
  EXPECT_EQ(nearest[0].id, b);
  EXPECT_EQ(nearest[1].id, ground);
}

TEST(WorldNumbers, FindBetweenFindsPairsOfBoxesOfTheSameWorld) {
  World one;
  World other;
  const BoxId a = one.add(cube(0, 0, 0), inWorld(1));
  const BoxId b = one.add(cube(0, 0, 0), inWorld(2));
  const BoxId ground = one.add(cube(0, 0, 0), inWorld(kEveryWorld));
  const BoxId c = other.add(cube(0, 0, 0), inWorld(2));
  const BoxId d = other.add(cube(0, 0, 0), inWorld(kEveryWorld));
  EXPECT_THAT(one.findBetween(other),
              ElementsAre(Pair{a, d}, Pair{b, c}, Pair{b, d}, Pair{ground, c}, Pair{ground, d}));
  World plain;
  const BoxId e = plain.add(cube(0, 0, 0));
  EXPECT_THAT(plain.findBetween(other), ElementsAre(Pair{e, d}));
  EXPECT_THAT(other.findBetween(plain), ElementsAre(Pair{d, e}));
}

TEST(WorldNumbers, AcceptIsAskedAboutPairsOfOneWorldOnly) {
  std::vector<Pair> asked;
  WorldOptions options;
  options.accept = [&](BoxId a, BoxId b) {
    asked.push_back({a, b});
    return a != 0;
  };
  World world(options);
  for (std::uint32_t i = 0; i < 6; ++i) world.add(cube(0, 0, 0), inWorld(i % 2));
  EXPECT_THAT(world.step().pairs, ElementsAre(Pair{1, 3}, Pair{1, 5}, Pair{2, 4}, Pair{3, 5}));
  for (const Pair pair : asked) EXPECT_EQ(pair.first % 2, pair.second % 2);
}

/// Worlds of boxes at the same coordinates.
struct Copies {
  std::vector<BoxF> boxes;
  std::vector<BoxProperties> properties;

  Copies(std::size_t worlds, std::size_t each, bool scattered) {
    for (std::size_t i = 0; i < worlds * each; ++i) {
      properties.push_back(inWorld(static_cast<std::uint32_t>(scattered ? i % worlds : i / each)));
    }
    for (std::size_t world = 0; world < worlds; ++world) {
      const std::vector<BoxF> some = test::randomBoxes(each, static_cast<unsigned>(world));
      boxes.insert(boxes.end(), some.begin(), some.end());
    }
  }

  [[nodiscard]] std::vector<BoxId> addTo(World& world) const {
    std::vector<BoxId> ids(boxes.size());
    world.add(boxes, properties, ids);
    return ids;
  }

  void move(std::size_t frame) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const float by = 0.05F * static_cast<float>((i * 7 + frame * 3) % 9) - 0.2F;
      for (std::size_t axis = 0; axis < 3; ++axis) boxes[i].min[axis] += by, boxes[i].max[axis] += by;
    }
  }
};

TEST(WorldNumbers, TheListsOfEachWorldAreThoseOfAWorldOfItsOwn) {
  constexpr std::size_t kWorlds = 50;
  constexpr std::size_t kEach = 40;
  Copies copies(kWorlds, kEach, false);
  World together;
  const std::vector<BoxId> ids = copies.addTo(together);
  std::vector<World> alone(kWorlds);
  for (std::size_t k = 0; k < kWorlds; ++k) {
    static_cast<void>(alone[k].add(BoxView(copies.boxes).slice(k * kEach, (k + 1) * kEach)));
  }
  const auto numberedFrom = [](std::span<const Pair> pairs, std::size_t k) {
    std::vector<Pair> result = toVector(pairs);
    for (Pair& pair : result)
      pair = {pair.first + static_cast<BoxId>(k * kEach), pair.second + static_cast<BoxId>(k * kEach)};
    return result;
  };
  for (std::size_t frame = 0; frame < 8; ++frame) {
    together.step();
    for (std::size_t k = 0; k < kWorlds; ++k) {
      const StepResult own = alone[k].step();
      const StepResult part = together.result(static_cast<std::uint32_t>(k));
      ASSERT_EQ(toVector(part.pairs), numberedFrom(own.pairs, k));
      ASSERT_EQ(toVector(part.began), numberedFrom(own.began, k));
      ASSERT_EQ(toVector(part.persisted), numberedFrom(own.persisted, k));
      ASSERT_EQ(toVector(part.ended), numberedFrom(own.ended, k));
    }
    copies.move(frame);
    together.move(ids, copies.boxes);
    for (std::size_t k = 0; k < kWorlds; ++k) {
      std::vector<BoxId> own(kEach);
      for (std::size_t i = 0; i < kEach; ++i) own[i] = static_cast<BoxId>(i);
      alone[k].move(own, BoxView(copies.boxes).slice(k * kEach, (k + 1) * kEach));
    }
  }
}

/// What a step tested.
std::uint64_t testsOf(const World& world) { return world.statistics().boxTests + world.statistics().groupTests; }

class WorldNumbersReset : public ::testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(OfWorldsOfSoManyBoxes, WorldNumbersReset, ::testing::Values(60, 600));

TEST_P(WorldNumbersReset, TheResetOfOneWorldTestsOnlyThatWorld) {
  const std::size_t each = GetParam();
  const std::size_t worlds = 30000 / each;
  const Copies copies(worlds, each, false);
  World world;
  const std::vector<BoxId> ids = copies.addTo(world);
  world.step();
  const std::uint64_t all = testsOf(world);
  const std::uint64_t rebuilds = world.statistics().rebuilds;
  const std::span<const BoxId> reset = std::span(ids).subspan(3 * each, each);
  const std::vector<BoxF> now = test::randomBoxes(each, 99);
  world.move(reset, now);
  world.step();
  EXPECT_EQ(world.statistics().changed, each);
  EXPECT_FALSE(world.statistics().joinedAll);
  EXPECT_LE(world.statistics().rebuilds, rebuilds + 1);
  EXPECT_LT(testsOf(world), 3 * all / worlds);
  EXPECT_GT(testsOf(world), 0U);
}

TEST_P(WorldNumbersReset, TestsGrowInProportionToTheWorldsHoweverTheyOverlap) {
  const auto testsFor = [&](std::size_t worlds) {
    const Copies copies(worlds, GetParam(), true);
    World world;
    static_cast<void>(copies.addTo(world));
    world.step();
    return testsOf(world);
  };
  EXPECT_LT(testsFor(32), 2 * 32 * testsFor(1));
}

class WorldNumbersThreads : public ::testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(OfWorldsOfSoManyBoxes, WorldNumbersThreads, ::testing::Values(50, 600, 6000));

TEST_P(WorldNumbersThreads, SeveralThreadsGiveTheListsOfOne) {
  parallel::TbbExecutor threads(4);
  WorldOptions options;
  World serial(options);
  options.executor = &threads;
  World many(options);
  Copies copies(18000 / GetParam(), GetParam(), true);
  copies.properties[5].world = kEveryWorld;
  const std::vector<BoxId> ids = copies.addTo(serial);
  ASSERT_EQ(copies.addTo(many), ids);
  for (std::size_t frame = 0; frame < 8; ++frame) {
    const StepResult one = serial.step();
    const StepResult several = many.step();
    ASSERT_GT(one.began.size(), 0U);
    ASSERT_EQ(toVector(several.pairs), toVector(one.pairs));
    ASSERT_EQ(toVector(several.began), toVector(one.began));
    ASSERT_EQ(toVector(several.persisted), toVector(one.persisted));
    ASSERT_EQ(toVector(several.ended), toVector(one.ended));
    ASSERT_EQ(many.statistics().boxTests, serial.statistics().boxTests);
    ASSERT_EQ(many.statistics().rebuilds, serial.statistics().rebuilds);
    copies.move(frame);
    serial.move(ids, copies.boxes);
    many.move(ids, copies.boxes);
  }
}

}  // namespace
}  // namespace allpairs
