// SPDX-License-Identifier: MIT
// Queries whose numbers are at the ends of what float32 and float64 hold, where bounds in float32 must not lose a box.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <random>
#include <span>
#include <stdexcept>
#include <vector>

#include "WorldOracle.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "support/Numbers.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

using test::kInfinity;

constexpr int kQueries = test::repeats(300);

/// Small and large numbers of both signs, some of which no float32 can hold.
class ExtremeNumbers {
 public:
  explicit ExtremeNumbers(std::uint32_t seed) : m_random(seed) {}

  std::size_t below(std::size_t n) { return m_random() % n; }

  double any() {
    static constexpr double kScales[] = {0.0,    1.0,  1.0,  1.0,    1e-3, 1e-30, 1e-44,
                                         1e-200, 1e20, 1e30, 3.4e38, 1e39, 1e300};
    const double value = static_cast<double>(m_random()) * 0x1p-31 - 1.0;
    return value * kScales[below(std::size(kScales))];
  }

  double margin() {
    const std::size_t kind = below(8);
    if (kind == 0) return kInfinity;
    return kind == 1 ? -0.125 : std::abs(any());
  }

  std::array<double, 3> point() { return {any(), any(), any()}; }

  Box box() {
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double a = any();
      const double b = below(2) == 0 ? any() : a + 0.5;
      box.min[axis] = below(20) == 0 ? -kInfinity : std::min(a, b);
      box.max[axis] = below(20) == 0 ? kInfinity : std::max(a, b);
      if (below(40) == 0) box.min[axis] = box.max[axis] = below(2) == 0 ? kInfinity : -kInfinity;
    }
    if (below(20) == 0) box.max[below(3)] = -1e35;  // most often empty
    return box;
  }

 private:
  std::mt19937 m_random;
};

class WorldQueryExtremes : public ::testing::TestWithParam<std::string_view> {
 protected:
  void SetUp() override { fill(false); }

  void fill(bool withMargins) {
    m_withMargins = withMargins;
    m_oracle = {};
    WorldOptions options;
    options.instructionSet = GetParam();
    m_world = World(options);
    for (int i = 0; i < 700; ++i) {
      const Box box = m_numbers.box();
      BoxProperties properties;
      properties.isStatic = m_numbers.below(3) == 0;
      if (m_withMargins) properties.margin = m_numbers.margin();
      m_oracle.boxes[m_world.add(box, properties)] = {box, properties};
    }
  }

  void compareSweeps();
  void compareNearest();
  void compareNearestToBoxes();
  void compareOverlapping();
  void compareVisits();

  template <class T>
  static std::vector<T> listOf(Span<const T> values) {
    return {values.begin(), values.end()};
  }

  ExtremeNumbers m_numbers{5};
  bool m_withMargins = false;
  World m_world;
  test::WorldOracle m_oracle;
};

INSTANTIATE_TEST_SUITE_P(EachInstructionSet, WorldQueryExtremes,
                         ::testing::ValuesIn(instructionSets().begin(), instructionSets().end()));

void WorldQueryExtremes::compareSweeps() {
  std::vector<BoxSweep> sweeps;
  for (int i = 0; i < 400; ++i) sweeps.push_back({m_numbers.box(), m_numbers.point(), std::abs(m_numbers.any())});
  for (int i = 0; i < 50; ++i) sweeps.push_back({m_numbers.box(), m_numbers.point(), kInfinity});
  std::vector<SweepHit> first(sweeps.size());
  m_world.findFirst(sweeps, first);
  const ResultLists<SweepHit> all = m_world.findAll(sweeps);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const std::vector<SweepHit> expected = m_oracle.along(sweeps[i], {});
    EXPECT_EQ(listOf(all[i]), expected) << "sweep " << i;
    EXPECT_EQ(first[i], expected.empty() ? SweepHit{} : expected.front()) << "sweep " << i;
    hits += expected.size();
  }
  EXPECT_GT(hits, 1000U);
}

void WorldQueryExtremes::compareNearest() {
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < kQueries; ++i) points.push_back(m_numbers.point());
  for (const std::size_t count : {std::size_t{1}, std::size_t{9}, std::size_t{1000}}) {
    const ResultLists<Neighbor> lists = m_world.findNearest(points, count);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_EQ(listOf(lists[i]), m_oracle.nearest(points[i], count, {})) << "point " << i << ", " << count;
    }
  }
}

void WorldQueryExtremes::compareNearestToBoxes() {
  std::vector<Box> boxes;
  for (int i = 0; i < kQueries; ++i) boxes.push_back(m_numbers.box());
  for (const std::size_t count : {std::size_t{1}, std::size_t{9}, std::size_t{1000}}) {
    const ResultLists<Neighbor> lists = m_world.findNearest(BoxView(std::span<const Box>(boxes)), count);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const std::vector<Neighbor> expected = m_oracle.nearest(boxes[i], count, {});
      EXPECT_EQ(listOf(lists[i]), expected) << "box " << i << ", " << count;
      EXPECT_EQ(m_world.findNearest(boxes[i], count), expected) << "box " << i << " alone, " << count;
    }
  }
}

void WorldQueryExtremes::compareOverlapping() {
  std::vector<Box> boxes;
  for (int i = 0; i < kQueries; ++i) boxes.push_back(m_numbers.box());
  const ResultLists<BoxId> lists = m_world.findOverlapping(BoxView(std::span<const Box>(boxes)));
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_EQ(listOf(lists[i]), m_oracle.overlapping(boxes[i], {})) << "box " << i;
  }
}

/// A fixed distance, and one that ends at that of the nearest box.
void WorldQueryExtremes::compareVisits() {
  for (int i = 0; i < kQueries; ++i) {
    const Box box = m_numbers.box();
    const double distance = std::abs(m_numbers.any());
    std::map<BoxId, double> distances;
    for (const Neighbor& near : m_oracle.nearest(box, 1000, {})) distances[near.id] = near.distance;
    std::map<BoxId, std::size_t> visits;
    m_world.visitNear(box, distance, [&](BoxId id) { return ++visits[id], kInfinity; });
    for (const auto& [id, far] : distances) {
      if (far <= distance) {
        EXPECT_EQ(visits[id], 1U) << "box " << i << ", " << id;
      }
    }
    for (const auto& [id, times] : visits) EXPECT_LE(times, distances.count(id)) << "box " << i << ", " << id;
    double least = kInfinity;
    m_world.visitNear(box, kInfinity, [&](BoxId id) { return least = std::min(least, distances.at(id)); });
    const std::vector<Neighbor> nearest = m_oracle.nearest(box, 1, {});
    EXPECT_EQ(least, nearest.empty() ? kInfinity : nearest.front().distance) << "box " << i;
  }
}

TEST_P(WorldQueryExtremes, SweptBoxesMeetWhatTheOracleMeets) { compareSweeps(); }
TEST_P(WorldQueryExtremes, PointsAreAsFarFromBoxesAsTheOracleSays) { compareNearest(); }
TEST_P(WorldQueryExtremes, AVisitMissesNoBoxWithinTheDistance) {
  compareVisits();
  fill(true);
  compareVisits();
}
TEST_P(WorldQueryExtremes, BoxesAreAsFarFromBoxesAsTheOracleSays) { compareNearestToBoxes(); }
TEST_P(WorldQueryExtremes, BoxesOverlapWhatTheOracleSays) { compareOverlapping(); }

TEST_P(WorldQueryExtremes, MarginsOfAnySizeChangeNothingOfThat) {
  fill(true);
  compareSweeps();
  compareNearest();
  compareNearestToBoxes();
  compareOverlapping();
}

TEST_P(WorldQueryExtremes, PairsAreThoseOfTheOracle) {
  for (const bool withMargins : {false, true}) {
    fill(withMargins);
    m_oracle.step();
    const std::span<const Pair> pairs = m_world.step().pairs;
    EXPECT_EQ(std::vector<Pair>(pairs.begin(), pairs.end()), m_oracle.pairs);
    EXPECT_GT(pairs.size(), 1000U);
  }
}

/// So small that float32 rounds a product of them by half of itself: 2^-149 is its least number.
TEST_P(WorldQueryExtremes, TimesThatFloat32HardlyTellsFromZeroLoseNoBox) {
  constexpr double kLeast = 0x1p-149;
  WorldOptions options;
  options.instructionSet = GetParam();
  World world(options);
  const BoxId id = world.add(Box{{15.0 * kLeast, -1.0, 0.0}, {1.0, 5.0 * kLeast, 1.0}});
  const BoxSweep sweep{{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, {6.0, 2.0, 0.0}, 1.0};  // enters it on x as it leaves on y
  const SweepHit hit{id, 2.5 * kLeast};
  EXPECT_EQ(world.findFirst(sweep), hit);
  EXPECT_EQ(world.findAll(sweep), std::vector<SweepHit>{hit});
}

TEST_P(WorldQueryExtremes, SquaresThatFloat32HardlyTellsFromZeroLoseNoBox) {
  const double near = test::asFloat32(std::sqrt(0.6 * 0x1p-149));  // on each axis; its square is rounded up
  const double far = test::asFloat32(std::sqrt(1.9 * 0x1p-149));
  WorldOptions options;
  options.instructionSet = GetParam();
  World world(options);
  test::WorldOracle oracle;
  for (const Box& box : {Box{{far, 0.0, 0.0}, {1.0, 1.0, 1.0}}, Box{{near, near, near}, {1.0, 1.0, 1.0}}}) {
    oracle.boxes[world.add(box)] = {box, {}};
  }
  const std::array<double, 3> origin{0.0, 0.0, 0.0};
  EXPECT_EQ(world.findNearest(origin, 1), oracle.nearest(origin, 1, {}));
}

TEST(WorldQuery, ABoxAtInfinityWithAnInfiniteMarginIsNearestToEveryPoint) {
  World world;
  BoxProperties everywhere;
  everywhere.margin = kInfinity;
  const BoxId near = world.add(Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  const BoxId all = world.add(Box{{kInfinity, 0.0, 0.0}, {kInfinity, 1.0, 1.0}}, everywhere);
  const BoxId far = world.add(Box{{kInfinity, 0.0, 0.0}, {kInfinity, 1.0, 1.0}});
  const std::vector<Neighbor> found = world.findNearest({5.0, 0.5, 0.5}, 3);
  EXPECT_EQ(std::vector<Neighbor>(found.begin(), found.end()),
            (std::vector<Neighbor>{{all, 0.0}, {near, 4.0}, {far, kInfinity}}));
}

TEST(WorldQuery, TheNearestToABoxOfEitherPrecisionAreTheSame) {
  World world;
  const BoxId overlapping = world.add(Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  const BoxId apart = world.add(Box{{4.0, 5.0, 0.0}, {5.0, 6.0, 1.0}});
  const std::vector<Neighbor> expected{{overlapping, 0.0}, {apart, 5.0}};
  EXPECT_EQ(world.findNearest(Box{{0.5, 0.5, 0.5}, {1.0, 1.0, 2.0}}, 2), expected);
  EXPECT_EQ(world.findNearest(BoxF{{0.5F, 0.5F, 0.5F}, {1.0F, 1.0F, 2.0F}}, 2), expected);
}

TEST(WorldQuery, TheNearestToABoxWithANanOrAMarginAreRefused) {
  World world;
  world.add(Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  EXPECT_THROW(static_cast<void>(world.findNearest(Box{{0.0, std::nan(""), 0.0}, {1.0, 1.0, 1.0}}, 1)), InvalidBox);
  const std::vector<Box> boxes(3);
  BoxView wide(boxes);
  wide.setMargin(0.5);
  EXPECT_THROW(static_cast<void>(world.findNearest(wide, 1)), InvalidArgument);
}

TEST(WorldQuery, AVisitAsksAboutLessTheNearerItHasFound) {
  World world;
  for (int i = 0; i < 4000; ++i) {
    const double x = i;
    world.add(Box{{x, 0.0, 0.0}, {x + 0.5, 1.0, 1.0}});
  }
  const Box query{{2000.6, 0.0, 0.0}, {2000.6, 1.0, 1.0}};
  std::vector<BoxId> visited;
  const auto visit = [&](BoxId id) {
    visited.push_back(id);
    return id == 1990 ? 0.2 : 20.0;  // that shape is the nearest
  };
  world.visitNear(query, 30.0, visit);
  EXPECT_LE(visited.size(), 50U);
  std::sort(visited.begin(), visited.end());
  EXPECT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end());
  const std::array<BoxId, 2> expected{1990, 2000};
  EXPECT_TRUE(std::includes(visited.begin(), visited.end(), expected.begin(), expected.end()));
}

TEST(WorldQuery, AVisitEndsWhenTheVisitorWantsNoMore) {
  World world;
  for (int i = 0; i < 100; ++i) world.add(Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  for (const double end : {-1.0, -kInfinity, std::nan("")}) {
    int visits = 0;
    world.visitNear(Box{}, kInfinity, [&](BoxId) { return ++visits == 3 ? end : kInfinity; });
    EXPECT_EQ(visits, 3);
  }
  const auto none = [](BoxId) -> double { throw std::logic_error("visited"); };
  EXPECT_THROW(world.visitNear(Box{}, 0.0, none), std::logic_error);
  EXPECT_NO_THROW(world.visitNear(Box{}, -1.0, none));
  EXPECT_NO_THROW(world.visitNear(kEmptyBox, kInfinity, none));
  EXPECT_NO_THROW(World().visitNear(Box{}, kInfinity, none));
}

TEST(WorldQuery, AVisitOfABoxOrADistanceThatIsANanIsRefused) {
  World world;
  world.add(Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  const auto visit = [](BoxId) { return 1.0; };
  EXPECT_THROW(world.visitNear(Box{{0.0, std::nan(""), 0.0}, {1.0, 1.0, 1.0}}, 1.0, visit), InvalidBox);
  EXPECT_THROW(world.visitNear(Box{}, std::nan(""), visit), InvalidArgument);
}

TEST(WorldQuery, DistancesWhoseSquaresNoNumberHoldsAreStillTold) {
  World world;
  const BoxId far = world.add(Box{{3e200, 4e200, 0.0}, {3e200, 4e200, 0.0}});
  const BoxId farther = world.add(Box{{6e200, 8e200, 0.0}, {6e200, 8e200, 0.0}});
  const BoxId near = world.add(Box{{-3e-200, -4e-200, 0.0}, {-3e-200, -4e-200, 0.0}});
  const std::vector<Neighbor> found = world.findNearest({0.0, 0.0, 0.0}, 3);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].id, near);
  EXPECT_DOUBLE_EQ(found[0].distance, 5e-200);
  EXPECT_EQ(found[1].id, far);
  EXPECT_DOUBLE_EQ(found[1].distance, 5e200);
  EXPECT_EQ(found[2].id, farther);
}

TEST(WorldQuery, AnEmptyBoxOverlapsNothingNotEvenWhatLiesAroundIt) {
  World world;
  world.add(Box{{0.0, 0.0, 0.0}, {10.0, 10.0, 10.0}});
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Box query{{4.0, 4.0, 4.0}, {5.0, 5.0, 5.0}};
    EXPECT_EQ(world.findOverlapping(query).size(), 1U);
    std::swap(query.min[axis], query.max[axis]);
    EXPECT_TRUE(world.findOverlapping(query).empty());
  }
}

/// A world of boxes along a line that overlap their neighbours, and queries: some are empty and one overlaps all.
void expectListsOfEachAlone(std::size_t boxes, std::size_t queries) {
  World world;
  for (std::size_t i = 0; i < boxes; ++i) {
    const auto at = static_cast<double>(i * 7919 % boxes);
    world.add(Box{{at, at / 3.0, 0.0}, {at + 1.5, at / 3.0 + 1.1, 1.0 / 3.0}});
  }
  std::vector<Box> asked;
  for (std::size_t i = 0; i < queries; ++i) {
    const auto at = static_cast<double>(i * 31 % boxes);
    asked.push_back({{at, at / 3.0, 0.1}, {at + (i % 5 == 3 ? -1.0 : 2.5), at / 3.0 + 1.0, 1.0}});
    if (i == queries / 2) asked.back() = {{-1.0, -1.0, -1.0}, {1e9, 1e9, 1.0}};
  }
  const ResultLists<BoxId> lists = world.findOverlapping(BoxView(std::span<const Box>(asked)));
  ASSERT_EQ(lists.size(), queries);
  for (std::size_t i = 0; i < queries; ++i) {
    std::vector<BoxId> expected;
    for (BoxId id = 0; id < boxes; ++id) {
      if (!test::WorldOracle::apart(world.box(id), asked[i], 0.0)) expected.push_back(id);
    }
    ASSERT_EQ(std::vector<BoxId>(lists[i].begin(), lists[i].end()), expected) << boxes << " boxes, query " << i;
    ASSERT_EQ(world.findOverlapping(asked[i]), expected) << boxes << " boxes, query " << i << " alone";
  }
}

TEST(WorldQuery, BoxesThatAreAskedTogetherHaveTheListOfEachAlone) {
  for (const std::size_t boxes : {1U, 16U, 17U, 300U, 5000U}) {
    for (const std::size_t queries : {0U, 1U, 2U, 15U, 16U, 17U, 63U, 64U, 65U, 200U}) {
      ASSERT_NO_FATAL_FAILURE(expectListsOfEachAlone(boxes, queries));
    }
  }
}

TEST(WorldQuery, ARayOfNoLengthIsItsOrigin) {
  World world;
  const BoxId id = world.add(Box{{0, 0, 0}, {1, 1, 1}});
  const Ray within{{0.5, 0.5, 0.5}, {1, 0, 0}, 0.0};
  const Ray before{{-0.5, 0.5, 0.5}, {1, 0, 0}, 0.0};
  EXPECT_EQ(world.findFirst(within).id, id);
  EXPECT_EQ(world.findFirst(before).id, kNoBox);
  EXPECT_EQ(world.findAll(within).size(), 1U);
}

TEST(WorldQuery, ASweepThatLastsForeverIsRefused) {
  World world;
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const BoxId id = world.add(box);
  const std::vector<double> velocity{1.0, 2.0, 3.0};  // with one of 0 the box would end at a NaN
  const std::span<const BoxId> ids(&id, 1);
  EXPECT_THROW(world.moveSwept(ids, std::span<const Box>(&box, 1), velocity, kInfinity), InvalidArgument);
  EXPECT_EQ(world.box(id), box);
}

}  // namespace
}  // namespace allpairs
