// SPDX-License-Identifier: MIT
// What statistics say, and what they show that no result does: that a world rebuilds its hierarchy when it has
// degraded.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string_view>
#include <vector>

#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "allpairs/Worlds.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"
#include "support/Strategies.h"

namespace allpairs {
namespace {

/// Claims many threads and runs tasks one after the other: work is cut and joined as for threads, and counts repeat.
class ManyInTurn final : public Executor {
 public:
  [[nodiscard]] std::size_t concurrency() const noexcept override { return 5; }
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = 0; i < count; ++i) task(i);
  }
};

std::vector<Box> allOverlapping(std::size_t n) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < n; ++i) boxes.push_back(test::cube(0x1p-10 * static_cast<double>(i), 0, 0, 16.0));
  return boxes;
}

TEST(Statistics, AnExhaustiveSearchTestsEachPairOnceHoweverItIsCut) {
  ManyInTurn many;
  for (const std::size_t n : {2U, 17U, 200U, 1500U}) {
    const std::vector<Box> boxes = allOverlapping(n);
    for (Executor* executor : std::initializer_list<Executor*>{nullptr, &many}) {
      OverlapOptions options;
      options.strategy = Strategy::Exhaustive;
      options.executor = executor;
      OverlapSearch search(options);
      ASSERT_EQ(test::toVector(search.find(boxes)), test::oracle(boxes)) << n;
      EXPECT_EQ(search.statistics().pairs, n * (n - 1) / 2) << n;
      EXPECT_EQ(search.statistics().boxTests, n * (n - 1) / 2) << n;
      EXPECT_EQ(search.statistics().groupTests, 0U) << n;
    }
  }
}

TEST(Statistics, RowsOfAllHitsEndWhereTheTaskEnds) {
  ManyInTurn many;
  const std::vector<Box> first = allOverlapping(900);
  const std::vector<Box> second = allOverlapping(700);
  OverlapOptions options;
  options.strategy = Strategy::Exhaustive;
  options.executor = &many;
  OverlapSearch search(options);
  EXPECT_EQ(test::toVector(search.find(first, second)), test::oracleBetween(first, second));
  EXPECT_EQ(search.statistics().boxTests, 900U * 700U);
  EXPECT_EQ(search.count(first, second), 900U * 700U);
}

TEST(Statistics, CountingTestsEachPairOnceToo) {
  const std::vector<BoxF> boxes = test::randomBoxes(1503, 74, 3.0F);
  const std::vector<BoxF> others = test::randomBoxes(902, 75, 3.0F);
  for (const std::string_view name : instructionSets()) {
    OverlapSearch search({.strategy = Strategy::Exhaustive, .instructionSet = name});
    const std::uint64_t pairs = search.count(boxes);
    EXPECT_EQ(search.statistics().boxTests, 1503U * 1502U / 2U) << name;
    OverlapSearch bySecond({.strategy = Strategy::Exhaustive, .order = Order::BySecond, .instructionSet = name});
    EXPECT_EQ(bySecond.count(boxes), pairs) << name;
    EXPECT_EQ(bySecond.statistics().boxTests, 1503U * 1502U / 2U) << name;
    static_cast<void>(search.count(boxes, others));
    EXPECT_EQ(search.statistics().boxTests, 1503U * 902U) << name;
  }
}

TEST(Statistics, SearchesForNeighborsAndForManyPartnersCountTheirTests) {
  const std::vector<BoxF> boxes = test::randomBoxes(4000, 76, 4.0F);
  for (const bool inRows : {true, false}) {
    OverlapSearch search({.strategy = Strategy::Bvh});
    inRows ? static_cast<void>(search.findNeighbors(boxes)) : static_cast<void>(search.find(boxes));
    EXPECT_GE(search.statistics().boxTests, search.statistics().pairs);
    EXPECT_LT(search.statistics().boxTests, 4000U * 4000U);
    EXPECT_GT(search.statistics().groupTests, 0U);
    EXPECT_LT(search.statistics().groupTests, search.statistics().boxTests);
  }
  for (const std::vector<Box>& few : {test::toDouble(test::randomBoxes(900, 77)), allOverlapping(900)}) {
    OverlapSearch search({.strategy = Strategy::Exhaustive});
    static_cast<void>(search.findNeighbors(few));
    EXPECT_GE(search.statistics().boxTests, 900U * 899U / 2U);
    EXPECT_LE(search.statistics().boxTests, 900U * 900U);
  }
}

/// So many boxes end a hair, in float32 nothing, more than a distance before the others begin; each begins elsewhere on
/// another axis, so that bounds do not take few values.
std::vector<Box> aHairApart(std::size_t ending, std::size_t beginning, double distance = 0.0) {
  std::vector<Box> boxes(ending, Box{{-1, 0, 0}, {0.1, 1, 1}});
  boxes.resize(ending + beginning, Box{{std::nextafter(0.1 + distance, 1.0), 0, 0}, {2, 1, 1}});
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].min[1] -= 1e-4 * static_cast<double>(i);
  return boxes;
}

TEST(Statistics, ExactTestsAreCountedWhereLanesCannotDecideAndNowhereElse) {
  ManyInTurn many;
  for (const std::size_t side : {30U, 40U, 200U}) {
    const std::vector<Box> boxes = aHairApart(side, 2 * side);
    const std::vector<Box> nearby = aHairApart(side, 2 * side, 0.25);
    const std::uint64_t pairs = side * (side - 1) / 2 + side * (2 * side - 1);
    const std::vector<Box> plain = allOverlapping(3 * side);
    for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Bvh}) {
      for (Executor* executor : std::initializer_list<Executor*>{nullptr, &many}) {
        OverlapOptions options;
        options.strategy = strategy;
        options.executor = executor;
        OverlapSearch search(options);
        EXPECT_EQ(search.count(boxes), pairs) << side;
        // Few boxes of which only bounds matter are not rounded to lanes (FewBoxes.cpp).
        const bool isRounded = strategy == Strategy::Bvh || 3 * side > 384;
        EXPECT_EQ(search.statistics().exactTests, isRounded ? 2 * side * side : 0) << side;
        EXPECT_EQ(search.count(plain), 3 * side * (3 * side - 1) / 2) << side;
        EXPECT_EQ(search.statistics().exactTests, 0U) << side;
        options.distance = 0.25;
        search.setOptions(options);
        EXPECT_EQ(search.find(boxes).size(), 3 * side * (3 * side - 1) / 2) << side;
        EXPECT_EQ(search.statistics().exactTests, 0U) << side;
        EXPECT_EQ(search.count(nearby), pairs) << side;
        EXPECT_EQ(search.statistics().exactTests, 2 * side * side) << side;
        // Lanes of boxes that shrink decide nothing.
        options.distance = -0.25;
        search.setOptions(options);
        EXPECT_EQ(search.find(boxes).size(), pairs) << side;
        EXPECT_EQ(search.statistics().exactTests, pairs) << side;
      }
    }
  }
}

TEST(Statistics, BoxesFarFromTheOriginNeedHardlyAnyExactTests) {
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(3000, 73));
  const double places[] = {1e7, -3e9, 2.5e11};
  std::vector<Box> others(boxes.begin(), boxes.begin() + 500);
  for (std::vector<Box>* set : {&boxes, &others}) {
    for (Box& box : *set) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.min[axis] += places[axis];
        box.max[axis] += places[axis];
      }
    }
  }
  for (const Strategy strategy : test::kStrategies) {
    OverlapOptions options;
    options.strategy = strategy;
    OverlapSearch search(options);
    EXPECT_EQ(test::toVector(search.find(boxes)), test::oracle(boxes));
    EXPECT_LT(search.statistics().exactTests, 200U);
    EXPECT_EQ(test::toVector(search.find(others)), test::oracle(others));
    EXPECT_EQ(test::toVector(search.find(boxes, others)), test::oracleBetween(boxes, others));
    EXPECT_LT(search.statistics().exactTests, 700U);  // 500 of them with themselves
    std::vector<Pair> streamed;
    search.stream(boxes,
                  [&](std::span<const Pair> pairs) { streamed.insert(streamed.end(), pairs.begin(), pairs.end()); });
    EXPECT_EQ(streamed, test::oracle(boxes));
    options.distance = 0.3;
    search.setOptions(options);
    EXPECT_EQ(test::toVector(search.find(boxes)), test::oracle(boxes, 0.3));
  }
}

TEST(Statistics, FewBoxesElsewhereMakeNoMoreExactTestsOfThoseThatAreFarFromTheOrigin) {
  const Box elsewhere[] = {{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}},
                           {{1.0, 0.0, 0.0}, {-1.0, 1.0, 1.0}},
                           {{-1e12, 0.0, 1e12}, {-1e12, 1.0, 1e12}},
                           {{-test::kInfinity, -test::kInfinity, 0.0}, {test::kInfinity, test::kInfinity, 0.0}}};
  for (const Box& other : elsewhere) {
    std::vector<Box> boxes = test::toDouble(test::randomBoxes(3000, 74));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        boxes[i].min[axis] += 1e8;
        boxes[i].max[axis] += 1e8;
      }
      if (i % 10 == 3) boxes[i] = other;
      for (double* bounds : {boxes[i].min.data(), boxes[i].max.data()}) {
        if (i % 10 == 5) std::transform(bounds, bounds + 3, bounds, [](double x) { return x * 1.05; });
        if (i % 10 == 7) std::transform(bounds, bounds + 3, bounds, [](double x) { return x * 0.95; });
      }
    }
    OverlapSearch search;
    EXPECT_EQ(test::toVector(search.find(boxes)), test::oracle(boxes));
    EXPECT_LT(search.statistics().exactTests, 100'000U);  // those elsewhere overlap each other, 44,850 times
  }
}

/// The boxes as they lie in planes, the one after the other in the next of these.
std::vector<Box> inPlanes(std::vector<Box> boxes, std::span<const double> planes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].min[1] = boxes[i].max[1] = planes[i % planes.size()];
  return boxes;
}

TEST(Statistics, FlatScenesNeedHardlyAnyExactTests) {
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(3000, 74, 0.3F));
  for (Box& box : boxes) box.max[0] += 1e-9;  // no float32
  const std::vector<Box> others(boxes.begin(), boxes.begin() + 1000);
  for (const double plane : {0.0, 2.5, 0.1, -1e7 - 0.3, 1e300, 1e-300}) {
    const std::vector<Box> flat = inPlanes(boxes, {&plane, 1});
    const std::vector<Box> flatOthers = inPlanes(others, {&plane, 1});
    const std::vector<Pair> expected = test::oracle(flat);
    const std::vector<Pair> expectedBetween = test::oracleBetween(flat, flatOthers);
    for (const std::string_view name : instructionSets()) {
      OverlapOptions options;
      options.strategy = Strategy::Bvh;
      options.instructionSet = name;
      OverlapSearch search(options);
      EXPECT_EQ(test::toVector(search.find(flat)), expected) << name;
      EXPECT_LT(search.statistics().exactTests, 300U) << name << ' ' << plane;
      EXPECT_EQ(test::toVector(search.find(flat, flatOthers)), expectedBetween) << name;
      EXPECT_LT(search.statistics().exactTests, 1300U) << name << ' ' << plane;  // 1000 of them with themselves
    }
  }
}

/// Some have lanes a unit apart, which makes none of them a large one.
TEST(Statistics, BoxesSmallerThanAUnitOfFloat32TakeNoMoreTestsThanOthers) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(20000, 77, 0.0F));
  const auto testsOf = [&](double side) {
    std::vector<Box> cubes = boxes;
    for (Box& cube : cubes) {
      for (std::size_t axis = 0; axis < 3; ++axis) cube.min[axis] *= 1.0 + 1e-9;  // no float32
      for (std::size_t axis = 0; axis < 3; ++axis) cube.max[axis] = cube.min[axis] + side;
    }
    OverlapSearch search({.strategy = Strategy::Bvh});
    const std::vector<Pair> found = test::toVector(search.find(cubes));
    if (!test::kIsSanitized) {  // 200 million tests
      EXPECT_EQ(found, test::oracle(cubes));
    }
    return search.statistics().groupTests;
  };
  EXPECT_LT(testsOf(2e-7), testsOf(1e-3) * 11 / 10);
}

/// As those of triangles are.
TEST(Statistics, BoxesThatAreFlatEachInAPlaneOfItsOwnNeedHardlyAnyExactTests) {
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(3000, 76, 2.0F));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const std::size_t axis = i % 3;
    boxes[i].min[axis] += 1e-9;  // no float32
    boxes[i].max[axis] = boxes[i].min[axis];
  }
  const std::vector<Pair> expected = test::oracle(boxes);
  ASSERT_GT(expected.size(), 1000U);
  for (const std::string_view name : instructionSets()) {
    for (const Strategy strategy : test::kStrategies) {
      OverlapSearch search({.strategy = strategy, .instructionSet = name});
      EXPECT_EQ(test::toVector(search.find(boxes)), expected) << name;
      EXPECT_LT(search.statistics().exactTests, 50U) << name;
    }
  }
}

TEST(Statistics, PlanesThatFloat32DoesNotTellApartAreNotOne) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(800, 75, 0.6F));
  const double inf = test::kInfinity;
  const std::vector<std::vector<double>> all = {{0.1, std::nextafter(0.1, 1.0)},
                                                {0.0, 1e-300},
                                                {0.0, 4.9e-324},
                                                {1e-50, 2e-50},
                                                {1e300, 1e301},
                                                {inf, 1e300},
                                                {inf, -inf},
                                                {1e7, 1e7 + 2e-9},
                                                {0.0, -0.0},
                                                {2.5, 2.5 + 1e-12}};
  for (const std::vector<double>& planes : all) {
    const std::vector<Box> flat = inPlanes(boxes, planes);
    const std::vector<Box> first = inPlanes(boxes, {&planes[0], 1});
    const std::vector<Box> second = inPlanes(boxes, {&planes[1], 1});
    for (const double distance : {0.0, 1e-12, -1e-12}) {
      const std::vector<Pair> ofFlat = test::oracle(flat, distance);
      const std::vector<Pair> ofFirst = test::oracle(first, distance);
      const std::vector<Pair> between = test::oracleBetween(first, second, distance);
      for (const std::string_view name : instructionSets()) {
        OverlapOptions options;
        options.strategy = Strategy::Bvh;
        options.instructionSet = name;
        options.distance = distance;
        EXPECT_EQ(overlaps(flat, options), ofFlat) << name << ' ' << planes[1];
        EXPECT_EQ(overlaps(first, options), ofFirst) << name << ' ' << planes[0];
        EXPECT_EQ(overlaps(first, second, options), between) << name << ' ' << planes[1];
      }
    }
  }
}

#if defined(__SSE2__)
/// Has the processor take tiny numbers for 0 while it exists, as programs built with -ffast-math do.
class TinyNumbersAreZero {
 public:
  TinyNumbersAreZero() : m_before(_mm_getcsr()) { _mm_setcsr(m_before | 0x8040U); }
  ~TinyNumbersAreZero() { _mm_setcsr(m_before); }
  TinyNumbersAreZero(const TinyNumbersAreZero&) = delete;
  TinyNumbersAreZero& operator=(const TinyNumbersAreZero&) = delete;

 private:
  unsigned m_before;
};

TEST(Statistics, PlanesAreNotOneWhereTheProcessorTakesTinyNumbersForZero) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(800, 76, 0.6F));
  const TinyNumbersAreZero mode;
  for (const std::vector<double>& planes :
       {std::vector<double>{0.0, 1e-50}, std::vector<double>{1e-307, 1e-307 + 1e-310},
        std::vector<double>{1e-39, 2e-39}}) {
    const std::vector<Box> flat = inPlanes(boxes, planes);
    const std::vector<Pair> expected = test::oracle(flat);
    for (const std::string_view name : instructionSets()) {
      OverlapOptions options;
      options.strategy = Strategy::Bvh;
      options.instructionSet = name;
      EXPECT_EQ(overlaps(flat, options), expected) << name << ' ' << planes[1];
    }
  }
}
#endif

TEST(Statistics, GroupTestsOfSeveralTasksAddUp) {
  const std::vector<BoxF> boxes = test::randomBoxes(4000, 75);
  ManyInTurn many;
  OverlapOptions options;
  options.strategy = Strategy::Bvh;
  options.executor = &many;
  OverlapSearch search(options);
  static_cast<void>(search.find(boxes));
  EXPECT_GT(search.statistics().groupTests, 0U);
  EXPECT_LT(search.statistics().groupTests, search.statistics().boxTests);
}

TEST(Statistics, AWorldCountsItsExactTests) {
  World world;
  const std::vector<Box> boxes = aHairApart(200, 400);
  static_cast<void>(world.add(BoxView(boxes)));
  EXPECT_EQ(world.step().pairs.size(), 200U * 199U / 2U + 200U * 399U);
  EXPECT_EQ(world.statistics().exactTests, 200U * 400U);
}

TEST(Statistics, RebuildsOfNumberedWorldsAreCountedForMovingAndForStaticBoxes) {
  const std::vector<BoxF> boxes = test::randomBoxes(1000, 73);
  for (const bool isStatic : {false, true}) {
    World world;
    static_cast<void>(world.add(BoxView(boxes), {.isStatic = isStatic, .world = 3}));
    static_cast<void>(world.step());
    EXPECT_EQ(world.statistics().rebuilds, 1U) << isStatic;
  }
}

TEST(Statistics, SmallWorldsCountATestForEachPairOfBoxes) {
  std::vector<Box> boxes(3 * 20, Box{{0, 0, 0}, {1, 1, 1}});
  for (Box& box : boxes) box.max[0] += 0x1p-40;
  WorldsSearch search;
  static_cast<void>(search.find(Worlds::ofEqualSize(boxes, 3)));
  EXPECT_EQ(search.statistics().pairs, 3U * 190U);
  EXPECT_EQ(search.statistics().boxTests, 3U * 190U);
  const std::vector<BoxF> ofFloats(3 * 20, BoxF{{0, 0, 0}, {1, 1, 1}});
  static_cast<void>(search.find(Worlds::ofEqualSize(ofFloats, 3)));
  EXPECT_EQ(search.statistics().boxTests, 3U * 190U);
}

TEST(Statistics, AStepOfAFewBoxesTestsThemAsTheyLieWithoutHierarchies) {
  std::vector<BoxF> boxes = test::randomBoxes(40, 76);
  World world;
  const std::vector<BoxId> ids = world.add(BoxView(boxes));
  (void)world.step();
  EXPECT_TRUE(world.statistics().joinedAll);
  EXPECT_EQ(world.statistics().boxTests, 40U * 39U / 2U);

  for (const std::size_t i : {std::size_t{3}, std::size_t{17}}) boxes[i].max[0] += 2.0F;
  world.move(ids, boxes);  // Two of which change.
  EXPECT_EQ(test::toVector(world.step().pairs), test::oracle(test::toDouble(boxes)));
  EXPECT_FALSE(world.statistics().joinedAll);
  EXPECT_EQ(world.statistics().boxTests, 2U * 40U);
  EXPECT_EQ(world.statistics().groupTests, 0U);
  EXPECT_EQ(world.statistics().rebuilds, 0U);

  EXPECT_THAT(world.findOverlapping(world.box(ids[3])), ::testing::Contains(ids[3]));
  (void)world.step();
  EXPECT_EQ(world.statistics().rebuilds, 1U);  // The query needed one.
}

TEST(Statistics, AStepOfMoreBoxesJoinsThemInHierarchies) {
  std::vector<BoxF> boxes = test::randomBoxes(700, 77);
  World world;
  const std::vector<BoxId> ids = world.add(BoxView(boxes));
  (void)world.step();
  EXPECT_LT(world.statistics().boxTests, 700U * 699U / 2U);
  boxes[5].max[0] += 2.0F;
  world.move(ids, boxes);
  EXPECT_EQ(test::toVector(world.step().pairs), test::oracle(test::toDouble(boxes)));
  EXPECT_LT(world.statistics().boxTests, 700U);
}

TEST(Statistics, AWorldWhoseBoxesChangePlacesMakesItsOrderAnew) {
  std::vector<BoxF> boxes = test::randomBoxes(4000, 71);
  World world;
  const std::vector<BoxId> ids = world.add(BoxView(boxes));
  (void)world.step();
  const std::uint64_t before = world.statistics().rebuilds;
  std::mt19937 generator(72);
  std::ranges::shuffle(boxes, generator);
  world.move(ids, boxes);
  (void)world.step();
  // The order is as bad as possible: the loss of a step exceeds the cost of a rebuild.
  for (BoxF& box : boxes) box.max[0] += 0.01F;
  world.move(ids, boxes);
  (void)world.step();
  EXPECT_GT(world.statistics().rebuilds, before);

  World fresh;
  (void)fresh.add(BoxView(boxes));
  (void)fresh.step();
  EXPECT_LT(world.statistics().boxTests, 2 * fresh.statistics().boxTests);
  EXPECT_EQ(test::toVector(world.result().pairs), test::toVector(fresh.result().pairs));
}

TEST(Statistics, AWorldOfWhichATenthGoesElsewhereMakesItsOrderAnewBeforeItJoinsThem) {
  std::vector<BoxF> boxes = test::randomBoxes(4000, 76);
  World world;
  const std::vector<BoxId> ids = world.add(BoxView(boxes));
  (void)world.step();
  std::mt19937 generator(77);
  std::shuffle(boxes.begin(), boxes.begin() + 400, generator);
  world.move(std::span(ids).first(400), std::span(boxes).first(400));
  EXPECT_EQ(test::toVector(world.step().pairs), test::oracle(test::toDouble(boxes)));
  EXPECT_FALSE(world.statistics().joinedAll);
  EXPECT_EQ(world.statistics().rebuilds, 2U);
}

TEST(Statistics, AWorldWhoseBoxesStayNearKeepsItsOrder) {
  std::vector<BoxF> boxes = test::randomBoxes(4000, 73);
  World world;
  const std::vector<BoxId> ids = world.add(BoxView(boxes));
  (void)world.step();
  const std::uint64_t before = world.statistics().rebuilds;
  for (int step = 0; step < 50; ++step) {
    for (BoxF& box : boxes) {
      const float shift = step % 2 == 0 ? 0.01F : -0.01F;
      box.min[0] += shift;
      box.max[0] += shift;
    }
    world.move(ids, boxes);
    (void)world.step();
  }
  EXPECT_EQ(world.statistics().rebuilds, before);
}

TEST(Statistics, QueriesAfterEveryMoveMakeTheOrderAnewTooOnceItHasGoneBad) {
  // All boxes leave for another place, many times; only few changed boxes are joined with all others in each step.
  std::vector<BoxF> boxes = test::randomBoxes(4000, 74);
  World world;
  const std::vector<BoxId> ids = world.add(BoxView(boxes));
  (void)world.step();
  const std::uint64_t before = world.statistics().rebuilds;
  std::mt19937 generator(75);
  for (int step = 0; step < 120; ++step) {
    std::vector<BoxId> some;
    std::vector<BoxF> places;
    for (int k = 0; k < 100; ++k) {
      some.push_back(ids[generator() % ids.size()]);
      places.push_back(boxes[generator() % boxes.size()]);
    }
    world.move(some, places);
    (void)world.step();
  }
  EXPECT_GT(world.statistics().rebuilds, before);
  std::vector<Box> now;
  for (const BoxId id : ids) now.push_back(world.box(id));
  EXPECT_EQ(test::toVector(world.result().pairs), test::oracle(now));
}

}  // namespace
}  // namespace allpairs
