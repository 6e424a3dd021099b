// SPDX-License-Identifier: MIT
// Many worlds in one World: boxes with world numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <map>
#include <memory_resource>
#include <new>
#include <span>
#include <vector>

#include "CompareStep.h"
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

TEST(WorldNumbers, ABoxThatMovesToWhereFloat32RoundsItIsComparedExactly) {
  World world;
  std::vector<BoxId> ids;
  for (int i = 0; i < 300; ++i) ids.push_back(world.add(cube(2.0 * i, 0, 0), inWorld(3)));
  EXPECT_THAT(world.step().pairs, IsEmpty());
  const double below = 22.0 - 0x1p-40;  // float32 makes it 22, where the next box begins
  world.move(ids[10], Box{{20, 0, 0}, {below, 1, 1}});
  EXPECT_THAT(world.step().pairs, IsEmpty());
  world.move(ids[200], Box{{400, 0, 0}, {402, 1, 1}});
  EXPECT_THAT(world.step().pairs, ElementsAre(Pair{ids[200], ids[201]}));
  QueryFilter three;
  three.world = 3;
  EXPECT_THAT(world.findOverlapping(Box{{22, 0, 0}, {23, 1, 1}}, three), ElementsAre(ids[11]));
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

std::vector<BoxId> addRandom(World& world, std::size_t count, unsigned seed, const BoxProperties& properties) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(count, seed));
  return world.add(boxes, properties);
}

/// Memory of which one allocation fails.
class FailingMemory final : public std::pmr::memory_resource {
 public:
  std::ptrdiff_t left = -1;  ///< Allocations until the one that fails; below 0 none does.

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    if (left >= 0 && left-- == 0) throw std::bad_alloc();
    return std::pmr::new_delete_resource()->allocate(bytes, alignment);
  }
  void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override {
    std::pmr::new_delete_resource()->deallocate(block, bytes, alignment);
  }
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

/// Small worlds, and a large one which is updated although the small ones are gone and many static boxes have come.
void makeWorlds(World& world) {
  std::vector<BoxId> small;
  for (std::uint32_t number = 0; number < 40; ++number) {
    const std::vector<BoxId> ids = addRandom(world, 3, number, inWorld(number));
    small.insert(small.end(), ids.begin(), ids.end());
  }
  addRandom(world, 600, 3, inWorld(1'000'000));
  static_cast<void>(world.step());
  static_cast<void>(world.findOverlapping(cube(0, 0, 0)));
  world.remove(small);
  BoxProperties fixed = inWorld(1'000'000);
  fixed.isStatic = true;
  addRandom(world, 900, 4, fixed);
}

/// Large worlds, of which one loses and gets a few boxes, one gets more than it has room for, one ends and one begins.
void changeWorlds(World& world) {
  std::vector<std::vector<BoxId>> ids;
  for (std::uint32_t number = 0; number < 5; ++number) ids.push_back(addRandom(world, 600, number, inWorld(number)));
  const std::vector<BoxId> ending = addRandom(world, 20, 8, inWorld(5));
  BoxProperties fixed = inWorld(5);
  fixed.isStatic = true;
  const std::vector<BoxId> endingToo = addRandom(world, 5, 9, fixed);
  fixed.world = 0;
  addRandom(world, 30, 10, fixed);
  addRandom(world, 3, 11, inWorld(kEveryWorld));
  static_cast<void>(world.step());
  static_cast<void>(world.findOverlapping(cube(0, 0, 0)));
  world.remove(ending);
  world.remove(endingToo);
  world.remove(std::span(ids[1]).first(3));
  addRandom(world, 2, 6, inWorld(1));
  addRandom(world, 100, 7, inWorld(2));
  const std::vector<BoxProperties> others(10, inWorld(9));
  world.setProperties(std::span(ids[3]).first(10), others);
}

class WorldNumbersFailing : public ::testing::TestWithParam<void (*)(World&)> {};

INSTANTIATE_TEST_SUITE_P(After, WorldNumbersFailing, ::testing::Values(&makeWorlds, &changeWorlds));

TEST_P(WorldNumbersFailing, AStepOrAQueryThatFailsAnywhereIsMadeUpFor) {
  const auto make = GetParam();
  World whole;
  make(whole);
  const std::vector<Pair> expected = toVector(whole.step().pairs);
  ASSERT_GT(expected.size(), 100U);
  for (const bool isStep : {true, false}) {
    bool hasFailed = true;
    for (std::ptrdiff_t k = 0; hasFailed; ++k) {
      FailingMemory memory;
      WorldOptions options;
      options.memory = &memory;
      World world(options);
      make(world);
      memory.left = k;
      hasFailed = false;
      try {
        if (isStep) {
          static_cast<void>(world.step());
        } else {
          static_cast<void>(world.findOverlapping(cube(0, 0, 0)));
        }
      } catch (const std::bad_alloc&) {
        hasFailed = true;
        if (isStep) {
          EXPECT_THAT(world.result().began, IsEmpty()) << "a step that throws leaves no changes";
        }
      }
      memory.left = -1;
      ASSERT_EQ(world.findOverlapping(Box{{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}}).size(), world.size()) << k;
      ASSERT_EQ(toVector(world.step().pairs), expected) << k;
    }
  }
}

TEST(WorldNumbers, ShrinkReleasesIdsAndLeavesRoomForTheNextStep) {
  World world;
  std::vector<BoxId> ids;
  for (std::uint32_t number = 0; number < 50; ++number) {
    const std::vector<BoxId> added = addRandom(world, 5, number, inWorld(number));
    ids.insert(ids.end(), added.begin(), added.end());
  }
  static_cast<void>(world.step());
  world.remove(std::span(ids).subspan(5));
  for (int i = 0; i < 2; ++i) static_cast<void>(world.step());
  world.shrink();
  EXPECT_EQ(world.idBound(), 5U);

  FailingMemory memory;  // The ids of removed boxes are freed in the step, where nothing may fail.
  WorldOptions options;
  options.memory = &memory;
  for (std::ptrdiff_t k = 0; k < 60; ++k) {
    World other(options);
    for (int i = 0; i < 3; ++i) other.add(cube(0, 0, 0));
    static_cast<void>(other.step());
    other.remove(0);
    other.shrink();
    memory.left = k;
    try {
      static_cast<void>(other.step());
    } catch (const std::bad_alloc&) {
      memory.left = -1;
      static_cast<void>(other.step());
    }
    memory.left = -1;
    EXPECT_THAT(toVector(other.result().pairs), ElementsAre(Pair{1, 2}));
  }
}

TEST(WorldNumbers, AWorldWhoseBoxesWithFiltersHaveAllLeftIsSearched) {
  World world, other;
  const BoxId id = world.add(cube(0, 0, 0), {.category = 2});
  other.add(cube(0, 0, 0));
  ASSERT_EQ(world.findBetween(other).size(), 1U);
  world.remove(id);
  for (int i = 0; i < 2; ++i) static_cast<void>(world.step());
  world.shrink();
  EXPECT_EQ(world.findBetween(other).size(), 0U);
  EXPECT_EQ(other.findBetween(world).size(), 0U);
  EXPECT_THAT(world.step().pairs, IsEmpty());
  world.add(cube(0, 0, 0), {.category = 4});
  EXPECT_EQ(world.findBetween(other).size(), 1U);
}

TEST(WorldNumbers, AcceptMayAskForTheListsAndQueriesOfTheWorldThatIsStepped) {
  for (const std::uint32_t boxes : {20U, 600U}) {
    parallel::TbbExecutor executor(4);
    const World* self = nullptr;
    std::atomic<std::size_t> found = 0;
    WorldOptions options;
    options.executor = &executor;
    options.accept = [&](BoxId first, BoxId) {
      if (first % 7 == 0) found += self->findOverlapping(self->box(first), ofWorld(1)).size();
      if (first % 11 == 0) found += self->result(1).pairs.size();
      return true;
    };
    World world(options);
    self = &world;
    for (std::uint32_t number = 0; number < 30; ++number) {
      addRandom(world, boxes, number, inWorld(number));
    }
    for (int i = 0; i < 3; ++i) {
      addRandom(world, boxes, 99, inWorld(1));
      const std::vector<Pair> pairs = toVector(world.step().pairs);
      std::vector<Pair> ofOne;
      for (const Pair pair : pairs) {
        if (world.properties(pair.first).world == 1) ofOne.push_back(pair);
      }
      ASSERT_EQ(toVector(world.result(1).pairs), ofOne) << boxes << " boxes, step " << i;
    }
    EXPECT_GT(found, 0U);
  }
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
    ASSERT_NO_FATAL_FAILURE(test::compareLists(several, one));
    ASSERT_EQ(many.statistics().boxTests, serial.statistics().boxTests);
    ASSERT_EQ(many.statistics().rebuilds, serial.statistics().rebuilds);
    copies.move(frame);
    serial.move(ids, copies.boxes);
    many.move(ids, copies.boxes);
  }
}

}  // namespace
}  // namespace allpairs
