// SPDX-License-Identifier: MIT
#include "allpairs/World.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/Numbers.h"
#include "support/Oracle.h"

namespace allpairs {
namespace {

/// A sum of three depends on its order: that of the ids, whichever box has changed.
TEST(World, AddsMarginsInTheOrderOfIds) {
  const double distance = 0.1;
  const double marginA = 0.1;
  const double marginB = 0.4;
  const double gap = (distance + marginA) + marginB;
  ASSERT_GT(gap, (distance + marginB) + marginA);
  for (const bool isNumbered : {false, true}) {
    World world({.distance = distance});
    const std::uint32_t number = isNumbered ? 3 : 0;
    const BoxId a = world.add(Box{{gap, 0, 0}, {gap + 1, 1, 1}}, {.margin = marginA, .world = number});
    const BoxId b = world.add(Box{{-1, 0, 0}, {0, 1, 1}}, {.margin = marginB, .world = number});
    for (int k = 0; k < 20; ++k) {
      static_cast<void>(world.add(Box{{1000.0 + 10 * k, 0, 0}, {1001.0 + 10 * k, 1, 1}}, {.world = number}));
    }
    EXPECT_EQ(world.step().pairs.size(), 1U);
    for (const BoxId changed : {a, b}) {
      world.invalidate({&changed, 1});
      EXPECT_EQ(world.step().pairs.size(), 1U) << changed;
    }
  }
}

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using test::cube;

using test::kInfinity;
using test::kNan;

/// The index that an InvalidBox names, after a look at its message.
template <class Call>
std::size_t invalidBox(const Call& call, const std::string& text) {
  try {
    call();
  } catch (const InvalidBox& error) {
    EXPECT_THAT(error.what(), HasSubstr(text));
    return error.index();
  }
  ADD_FAILURE() << "no InvalidBox was thrown";
  return 99;
}

TEST(World, APairBeginsPersistsAndEnds) {
  World world;
  const BoxId a = world.add(cube(0, 0, 0));
  const BoxId b = world.add(cube(5, 0, 0));
  EXPECT_THAT(world.step().pairs, IsEmpty());

  world.move(b, cube(1, 0, 0));  // They share a face.
  StepResult result = world.step();
  EXPECT_THAT(result.pairs, ElementsAre(Pair{a, b}));
  EXPECT_THAT(result.began, ElementsAre(Pair{a, b}));
  EXPECT_THAT(result.persisted, IsEmpty());

  world.move(a, cube(0.5, 0, 0));
  result = world.step();
  EXPECT_THAT(result.persisted, ElementsAre(Pair{a, b}));
  EXPECT_THAT(result.began, IsEmpty());
  EXPECT_THAT(result.ended, IsEmpty());

  world.move(a, cube(-0.5, 0, 0));
  result = world.step();
  EXPECT_THAT(result.pairs, IsEmpty());
  EXPECT_THAT(result.ended, ElementsAre(Pair{a, b}));
  EXPECT_THAT(world.result().ended, ElementsAre(Pair{a, b}));
}

TEST(World, AStepWithoutAnyChangeKeepsAllPairs) {
  World world;
  static_cast<void>(world.add(test::lent(test::randomBoxes(500, 3))));
  const std::vector<Pair> pairs = test::toVector(world.step().pairs);
  ASSERT_GT(pairs.size(), 100U);
  const StepResult result = world.step();
  EXPECT_EQ(test::toVector(result.pairs), pairs);
  EXPECT_EQ(test::toVector(result.persisted), pairs);
  EXPECT_THAT(result.began, IsEmpty());
  EXPECT_THAT(result.ended, IsEmpty());
  EXPECT_EQ(world.statistics().boxTests, 0U);
}

TEST(World, AnIdIsUsedAgainOnlyAfterItsPairsHaveEnded) {
  World world;
  const BoxId a = world.add(cube(0, 0, 0));
  const BoxId b = world.add(cube(0, 0, 0));
  static_cast<void>(world.step());
  world.remove(b);
  EXPECT_FALSE(world.contains(b));
  const BoxId c = world.add(cube(0, 0, 0));
  EXPECT_NE(c, b);
  const StepResult result = world.step();
  EXPECT_THAT(result.ended, ElementsAre(Pair{a, b}));
  EXPECT_THAT(result.began, ElementsAre(Pair{a, c}));
  EXPECT_EQ(world.add(cube(9, 9, 9)), b);
}

TEST(World, StaticBoxesMeetOnlyOthers) {
  World world;
  BoxProperties fixed;
  fixed.isStatic = true;
  const BoxId wall = world.add(cube(0, 0, 0), fixed);
  const BoxId floor = world.add(cube(0, 0, 0), fixed);
  const BoxId ball = world.add(cube(0, 0, 0));
  EXPECT_THAT(world.step().pairs, ElementsAre(Pair{wall, ball}, Pair{floor, ball}));
  world.setProperties(wall, {});
  EXPECT_THAT(world.step().pairs, ElementsAre(Pair{wall, floor}, Pair{wall, ball}, Pair{floor, ball}));
  world.setProperties(ball, fixed);
  EXPECT_THAT(world.step().pairs, ElementsAre(Pair{wall, floor}, Pair{wall, ball}));
}

TEST(World, ASweptBoxMeetsWhatIsOnItsWay) {
  World world;
  const BoxId wall = world.add(cube(5, 0, 0, 0.1));
  const BoxId bullet = world.add(cube(0, 0, 0));
  const std::vector<BoxId> ids{bullet};
  world.moveSwept(ids, test::lent(std::vector{cube(0, 0, 0)}), test::lent(std::vector{cube(10, 0, 0)}));
  EXPECT_THAT(world.step().pairs, ElementsAre(Pair{wall, bullet}));
  const std::vector<double> velocity{2.0, 0.0, 0.0};
  world.moveSwept(ids, test::lent(std::vector{cube(0, 0, 0)}), velocity, 1.0);
  EXPECT_THAT(world.step().ended, ElementsAre(Pair{wall, bullet}));
  world.moveSwept(ids, test::lent(std::vector{cube(0, 0, 0)}), velocity, 2.0);  // Ends where the wall begins.
  EXPECT_THAT(world.step().began, ElementsAre(Pair{wall, bullet}));
  EXPECT_EQ(world.box(bullet), (Box{{0, 0, 0}, {5, 1, 1}}));
}

TEST(World, AcceptIsAskedAgainAboutTouchedBoxes) {
  bool accepts = true;
  WorldOptions options;
  options.accept = [&](BoxId, BoxId) { return accepts; };
  World world(options);
  const BoxId a = world.add(cube(0, 0, 0));
  const BoxId b = world.add(cube(0, 0, 0));
  EXPECT_THAT(world.step().pairs, ElementsAre(Pair{a, b}));
  accepts = false;
  const std::vector<BoxId> touched{b};
  world.invalidate(touched);
  EXPECT_THAT(world.step().ended, ElementsAre(Pair{a, b}));
}

TEST(World, AStepThatThrewLeavesThePairsOfTheLastWithoutChanges) {
  bool fails = false;
  WorldOptions options;
  options.accept = [&](BoxId, BoxId) { return fails ? throw std::runtime_error("refused") : true; };
  World world(options);
  const BoxId a = world.add(cube(0, 0, 0));
  const BoxId b = world.add(cube(0, 0, 0));
  EXPECT_THAT(world.step().began, ElementsAre(Pair{a, b}));
  fails = true;
  world.move(b, cube(0.5, 0, 0));
  EXPECT_THROW(static_cast<void>(world.step()), std::runtime_error);
  EXPECT_THAT(world.result().pairs, ElementsAre(Pair{a, b}));
  EXPECT_THAT(world.result().began, IsEmpty());
  EXPECT_THAT(world.result().persisted, ElementsAre(Pair{a, b}));
  EXPECT_THAT(world.result().ended, IsEmpty());
}

TEST(World, UnknownIdsAndNansAreNamedAndNothingIsDone) {
  World world;
  const BoxId a = world.add(cube(0, 0, 0));
  const BoxId b = world.add(cube(3, 0, 0));
  const std::vector<BoxId> unknown{a, b, 17};
  const std::vector<BoxId> twice{b, a, b};
  const std::vector<Box> boxes(3, cube(1, 1, 1));
  EXPECT_EQ(invalidBox([&] { world.move(unknown, boxes); }, "17"), 2U);
  EXPECT_EQ(invalidBox([&] { world.remove(unknown); }, "17"), 2U);
  EXPECT_EQ(invalidBox([&] { world.remove(twice); }, "id 1, entry 2 of the ids, was named before"), 2U);
  EXPECT_EQ(invalidBox([&] { world.invalidate(unknown); }, "17"), 2U);
  EXPECT_EQ(invalidBox([&] { world.setProperties(17, {}); }, "17"), 0U);
  EXPECT_EQ(invalidBox([&] { static_cast<void>(world.box(17)); }, "17"), 0U);
  EXPECT_EQ(invalidBox([&] { world.move(b, Box{{0, kNan, 0}, {1, 1, 1}}); }, "id 1"), 0U);
  EXPECT_EQ(invalidBox(
                [&] {
                  world.move(twice, test::lent(std::vector{boxes[0], boxes[0], Box{{0, 0, 0}, {1, 1, kNan}}}));
                },
                "2"),
            2U);
  BoxProperties bad;
  bad.margin = kNan;
  EXPECT_EQ(invalidBox([&] { world.setProperties(b, bad); }, "the box with the id 1: its margin"), 0U);
  const std::vector<BoxSweep> sweeps{{cube(0, 0, 0), {1, 0, 0}}, {{{0, kNan, 0}, {1, 1, 1}}, {1, 0, 0}}};
  EXPECT_EQ(invalidBox([&] { static_cast<void>(world.findFirst(sweeps[1])); }, "sweep 0: its box has a NaN"), 0U);
  EXPECT_EQ(invalidBox([&] { static_cast<void>(world.findAll(sweeps)); }, "sweep 1: its box has a NaN"), 1U);
  EXPECT_EQ(world.size(), 2U);
  EXPECT_EQ(world.box(a), cube(0, 0, 0));
  EXPECT_EQ(world.box(b), cube(3, 0, 0));
}

TEST(World, ArgumentsThatMakeNoSenseAreRefused) {
  World world;
  const std::vector<BoxId> ids{world.add(cube(0, 0, 0))};
  EXPECT_THROW(world.move(ids, test::lent(std::vector<Box>(2))), InvalidArgument);
  EXPECT_THROW(world.moveSwept(ids, test::lent(std::vector<Box>(1)), test::lent(std::vector<Box>(2))), InvalidArgument);
  EXPECT_THROW(world.setProperties(ids, std::vector<BoxProperties>()), InvalidArgument);
  EXPECT_THROW(static_cast<void>(world.findFirst(Ray{{kNan, 0, 0}, {1, 0, 0}})), InvalidArgument);
  EXPECT_THROW(static_cast<void>(world.findAll(Ray{{0, 0, 0}, {1, 0, 0}, -1.0})), InvalidArgument);
  EXPECT_THROW(static_cast<void>(world.findNearest({kNan, 0, 0}, 1)), InvalidArgument);
  EXPECT_THROW(static_cast<void>(world.findOverlapping(Box{{kNan, 0, 0}, {1, 1, 1}})), InvalidBox);
  WorldOptions options;
  options.distance = kNan;
  EXPECT_THROW(World{options}, InvalidArgument);
  options = {};
  options.instructionSet = "abacus";
  EXPECT_THROW(World{options}, InvalidArgument);
}

TEST(World, MotionsThatAreNotOneForEachBoxAreRefused) {
  World world;
  const std::vector<BoxId> ids{world.add(cube(0, 0, 0))};
  const std::vector<Box> one(1);
  const std::vector<Box> two(2);
  const std::vector<double> three(3);
  const std::vector<double> six(6);
  EXPECT_THROW(world.moveSwept(ids, two, one), InvalidArgument);
  EXPECT_THROW(world.moveSwept(ids, one, two), InvalidArgument);
  EXPECT_THROW(world.moveSwept(ids, two, three, 1.0), InvalidArgument);
  EXPECT_THROW(world.moveSwept(ids, one, six, 1.0), InvalidArgument);
  EXPECT_EQ(world.box(ids[0]), cube(0, 0, 0));
}

TEST(World, RaysAndSweepsThatMakeNoSenseAreNamed) {
  const World world;
  const std::vector<Ray> rays{{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {kInfinity, 0, 0}}};
  const std::vector<BoxSweep> sweeps{{cube(0, 0, 0), {1, 0, 0}, 1.0}, {cube(0, 0, 0), {1, 0, 0}, kNan}};
  const auto messageOf = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const InvalidArgument& error) {
      return error.what();
    }
    return "nothing was thrown";
  };
  const std::string ray = "ray 0: its direction is not finite";
  EXPECT_EQ(messageOf([&] { static_cast<void>(world.findFirst(rays[1])); }), ray);
  EXPECT_EQ(messageOf([&] { static_cast<void>(world.findAll(rays[1])); }), ray);
  EXPECT_EQ(messageOf([&] { static_cast<void>(world.findAll(rays)); }), "ray 1: its direction is not finite");
  const std::string sweep = "sweep 0: its length is NaN or negative";
  EXPECT_EQ(messageOf([&] { static_cast<void>(world.findFirst(sweeps[1])); }), sweep);
  EXPECT_EQ(messageOf([&] { static_cast<void>(world.findAll(sweeps[1])); }), sweep);
  EXPECT_EQ(messageOf([&] { static_cast<void>(world.findAll(sweeps)); }), "sweep 1: its length is NaN or negative");
  EXPECT_EQ(messageOf([&] {
              static_cast<void>(world.findFirst(Ray{{kInfinity, 0, 0}, {1, 0, 0}}));
            }),
            "ray 0: its origin is not finite");
  EXPECT_EQ(messageOf([&] {
              static_cast<void>(world.findFirst(BoxSweep{cube(0, 0, 0), {1, kInfinity, 0}}));
            }),
            "sweep 0: its motion is not finite");
  std::vector<SweepHit> hits(1);
  EXPECT_EQ(messageOf([&] { world.findFirst(rays, hits); }),
            std::to_string(std::size(rays)) + " rays, and room for 1 hits");
  EXPECT_EQ(messageOf([&] { world.findFirst(sweeps, hits); }),
            std::to_string(std::size(sweeps)) + " sweeps, and room for 1 hits");
}

TEST(World, AQueryOfNoCategoryOrNoMaskFindsNothing) {
  World world;
  static_cast<void>(world.add(cube(0, 0, 0)));
  for (const bool hasFilters : {false, true}) {
    for (const QueryFilter& filter : {QueryFilter{.category = 0}, QueryFilter{.mask = 0}}) {
      EXPECT_THAT(world.findOverlapping(cube(0, 0, 0), filter), IsEmpty());
      EXPECT_EQ(world.findFirst(Ray{{-1, 0.5, 0.5}, {1, 0, 0}}, filter), SweepHit{});
      EXPECT_THAT(world.findNearest({0, 0, 0}, 1, filter), IsEmpty());
    }
    EXPECT_EQ(world.findOverlapping(cube(0, 0, 0)).size(), 1U + (hasFilters ? 1U : 0U));
    if (!hasFilters) static_cast<void>(world.add(cube(0, 0, 0), {.category = 2}));
  }
}

TEST(World, AQueryIsExactWhereFloat32RoundsItsBox) {
  World world;
  const BoxId box = world.add(cube(0, 0, 0));
  EXPECT_THAT(world.findOverlapping(Box{{1, 0, 0}, {2, 1, 1}}), ElementsAre(box));
  EXPECT_THAT(world.findOverlapping(Box{{std::nextafter(1.0, 2.0), 0, 0}, {2, 1, 1}}), IsEmpty());
}

TEST(World, PairsBetweenTwoWorldsAreExactIfOneOfThemIsRounded) {
  const double below = std::nextafter(1.0, 0.0);  // float32 makes it 1
  const Box first{{0, 0, 0}, {1, 1, 1}};
  const Box near{{1, 0, 0}, {2, 1, 1}};
  const Box rounded{{0, 0, 0}, {below, 1, 1}};
  const auto between = [](const Box& mine, double distance, const Box& theirs, double theirDistance) {
    World world({.distance = distance});
    World other({.distance = theirDistance});
    static_cast<void>(world.add(mine));
    static_cast<void>(other.add(theirs));
    return world.findBetween(other).size();
  };
  EXPECT_EQ(between(first, 0.0, near, 0.0), 1U);
  EXPECT_EQ(between(rounded, 0.0, near, 0.0), 0U);
  EXPECT_EQ(between(near, 0.0, rounded, 0.0), 0U);
  // Half of each distance counts.
  const Box apart{{1.25, 0, 0}, {2, 1, 1}};
  EXPECT_EQ(between(first, 0.5, apart, 0.0), 1U);
  EXPECT_EQ(between(first, 0.25, apart, 0.25), 1U);
  EXPECT_EQ(between(first, 0.5 - 0x1p-50, apart, 0.0), 0U);
  EXPECT_EQ(between(first, 0.0, apart, 0.5 - 0x1p-50), 0U);
}

TEST(World, PairsBetweenTwoWorldsAreAtTheMeanOfTheirDistancesWhateverTheirSigns) {
  const std::vector<Box> mine =
      test::toDouble(test::randomBoxes(400, 5));  // float32 has them exactly, as hierarchies do
  const std::vector<Box> theirs = test::toDouble(test::randomBoxes(300, 6));
  const std::array kDistances{-0.5, -0.25, 0.0, 0.25, 0.5};
  for (const double distance : kDistances) {
    for (const double theirDistance : kDistances) {
      World first({.distance = distance});
      World second({.distance = theirDistance});
      static_cast<void>(first.add(mine));
      static_cast<void>(second.add(theirs));
      EXPECT_EQ(test::toVector(first.findBetween(second)),
                test::oracleBetween(mine, theirs, (distance + theirDistance) / 2))
          << distance << ' ' << theirDistance;
    }
  }
}

TEST(World, QueriesSeeWhatHasChangedSinceTheLastStep) {
  World world;
  const BoxId a = world.add(cube(0, 0, 0));
  EXPECT_THAT(world.findOverlapping(cube(1, 0, 0)), ElementsAre(a));
  const BoxId b = world.add(cube(4, 0, 0));
  EXPECT_THAT(world.findAll(Ray{{-1, 0.5, 0.5}, {2, 0, 0}}), ElementsAre(SweepHit{a, 0.5}, SweepHit{b, 2.5}));
  EXPECT_EQ(world.findFirst(BoxSweep{cube(8, 0, 0), {-3, 0, 0}, 1.0}), (SweepHit{b, 1.0}));
  world.remove(a);
  EXPECT_THAT(world.findNearest({0, 0, 0}, 5), ElementsAre(Neighbor{b, 4.0}));
  EXPECT_EQ(world.findFirst(Ray{{-1, 0.5, 0.5}, {0, 1, 0}}), SweepHit{});
}

TEST(World, PairsBetweenTwoWorldsAreAtTheMeanOfTheLeastDistances) {
  constexpr double kLeast = std::numeric_limits<double>::denorm_min();
  WorldOptions options;
  options.distance = kLeast;
  World first(options);
  World second(options);
  first.add(Box{{0, 0, 0}, {0, 1, 1}});
  second.add(Box{{kLeast, 0, 0}, {1, 1, 1}});
  EXPECT_EQ(first.findBetween(second).size(), 1U);
}

TEST(World, PairsBetweenTwoWorldsAreThoseOfTwoSets) {
  const std::vector<BoxF> mine = test::randomBoxes(700, 5);
  const std::vector<BoxF> theirs = test::randomBoxes(300, 6);
  World first;
  World second;
  static_cast<void>(first.add(mine));
  BoxProperties fixed;
  fixed.isStatic = true;
  static_cast<void>(second.add(theirs, fixed));
  EXPECT_EQ(test::toVector(first.findBetween(second)), overlaps(mine, theirs));
  EXPECT_THAT(first.step().ended, IsEmpty());
}

TEST(World, BoxesThatComeOneByOneMeetAllThatWereThere) {
  World world;
  std::vector<Pair> expected;
  for (BoxId id = 0; id < 300; ++id) {
    ASSERT_EQ(world.add(cube(0.01 * id, 0, 0)), id);
    expected.clear();
    for (BoxId earlier = id < 100 ? 0 : id - 100; earlier < id; ++earlier) {
      if (0.01 * id <= 0.01 * earlier + 1.0) expected.push_back({earlier, id});
    }
    ASSERT_EQ(test::toVector(world.step().began), expected) << "box " << id;
  }
}

TEST(World, StepsOfAllBoxesAndOfSomeGiveWhatBeganAndEndedByTurns) {
  constexpr std::size_t kBoxes = 1500;
  std::vector<BoxF> boxes = test::randomBoxes(kBoxes, 11);
  World world;
  const std::vector<BoxId> ids = world.add(boxes);
  static_cast<void>(world.step());
  std::mt19937 generator(12);
  std::vector<Pair> before = overlaps(boxes);
  for (const std::size_t stride : {1U, 1U, 9U, 40U, 1U, 9U, 1U, 40U, 40U, 1U}) {
    for (std::size_t i = generator() % stride; i < kBoxes; i += stride) {
      const float shift = static_cast<float>(generator() % 256U) / 512.0F - 0.25F;
      boxes[i].min[i % 3] += shift;
      boxes[i].max[i % 3] += shift;
    }
    world.move(ids, boxes);
    const StepResult result = world.step();
    EXPECT_EQ(world.statistics().joinedAll, stride == 1);
    const std::vector<Pair> now = overlaps(boxes);
    std::vector<Pair> began;
    std::vector<Pair> persisted;
    std::vector<Pair> ended;
    std::set_difference(now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(began));
    std::set_intersection(now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(persisted));
    std::set_difference(before.begin(), before.end(), now.begin(), now.end(), std::back_inserter(ended));
    EXPECT_FALSE(began.empty() || persisted.empty() || ended.empty());
    EXPECT_EQ(test::toVector(result.pairs), now);
    EXPECT_EQ(test::toVector(result.began), began);
    EXPECT_EQ(test::toVector(result.persisted), persisted);
    EXPECT_EQ(test::toVector(result.ended), ended);
    before = now;
  }
}

// Half of the boxes in a thousandth of the width: they share cells of the grid that fits all.
TEST(World, ACrowdCostsNoMoreTestsThanOthers) {
  std::vector<BoxF> boxes = test::randomBoxes(20000, 13);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (i % 2 == 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[i].min[axis] *= 0.001F;
      boxes[i].max[axis] *= 0.001F;
    }
  }
  World world;
  static_cast<void>(world.add(boxes));
  EXPECT_EQ(test::toVector(world.step().pairs), overlaps(boxes));
  EXPECT_LT(world.statistics().boxTests + world.statistics().groupTests, 20000U * 200U);
}

TEST(World, AMotionThatEndsAtANanIsRefusedAndNothingIsDone) {
  World world;
  const Box endless{{0, 0, 0}, {kInfinity, 1, 1}};
  const BoxId id = world.add(endless);
  const std::array velocity{-1e300, 0.0, 0.0};
  const auto move = [&] { world.moveSwept({&id, 1}, test::lent(std::array{endless}), velocity, 1e300); };
  EXPECT_EQ(invalidBox(move, "ends at a NaN"), 0U);
  EXPECT_EQ(world.box(id), endless);
}

TEST(World, MakingRoomMovesNoBoxAwayFromUnderAStepOrAQuery) {
  World world;
  const BoxId near = world.add(cube(0, 0, 0));
  const BoxId far = world.add(cube(5, 0, 0));
  (void)world.step();
  world.reserve(100'000);
  EXPECT_THAT(world.findNearest({-1, 0, 0}, 1), ElementsAre(Neighbor{near, 1.0}));
  world.reserve(200'000);
  world.move(far, cube(1, 0, 0));
  EXPECT_THAT(world.step().pairs, ElementsAre(Pair{near, far}));
}

TEST(World, IsEmptyAfterClear) {
  World world;
  static_cast<void>(world.add(test::lent(test::randomBoxes(200, 8))));
  const std::vector<Pair> pairs = test::toVector(world.step().pairs);
  world.clear();
  EXPECT_EQ(world.size(), 0U);
  EXPECT_EQ(test::toVector(world.step().ended), pairs);
  EXPECT_THAT(world.step().pairs, IsEmpty());
  EXPECT_THAT(world.findNearest({0, 0, 0}, 3), IsEmpty());
}

TEST(World, RefusesAnOrderThatItDoesNotKeepAndMarginsThatItWouldNotLookAt) {
  EXPECT_THROW(World({.order = Order::Unordered}), InvalidArgument);
  World world;
  const std::vector<Box> boxes{cube(0, 0, 0)};
  BoxView wide(boxes);
  wide.setMargin(1.0);
  EXPECT_THROW(static_cast<void>(world.add(wide)), InvalidArgument);
  const std::vector<BoxId> ids = world.add(boxes);
  EXPECT_THROW(world.move(ids, wide), InvalidArgument);
  EXPECT_THROW(world.moveSwept(ids, boxes, wide), InvalidArgument);
  EXPECT_THROW(static_cast<void>(world.findOverlapping(wide)), InvalidArgument);
}

TEST(World, GivesItsListsBySecondIfToldTo) {
  World world({.order = Order::BySecond});
  static_cast<void>(world.add(test::lent(std::vector{cube(0, 0, 0), cube(0.5, 0, 0), cube(0.75, 0, 0)})));
  const std::vector<Pair> bySecond{{0, 1}, {0, 2}, {1, 2}};
  EXPECT_EQ(test::toVector(world.step().pairs), bySecond);
  static_cast<void>(world.add(test::lent(std::vector{cube(-0.5, 0, 0), cube(0.25, 0, 0)})));
  const std::vector<Pair> more{{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
  EXPECT_EQ(test::toVector(world.step().pairs), more);
}

}  // namespace
}  // namespace allpairs
