// SPDX-License-Identifier: MIT
// Large worlds with numbers whose boxes come, go and change, against an oracle; and changes of a few boxes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "CompareStep.h"
#include "WorldOracle.h"
#include "allpairs/Error.h"
#include "allpairs/World.h"
#include "support/Boxes.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

/// Boxes that come to a few large worlds, go, and change, and what must be found.
struct LargeWorlds {
  World world;
  test::WorldOracle oracle;
  std::vector<BoxId> ids;
  std::mt19937 random;

  explicit LargeWorlds(unsigned seed) : random(seed) {}

  static BoxProperties inWorld(std::uint32_t number) {
    BoxProperties result;
    result.world = number;
    return result;
  }

  static QueryFilter ofWorld(std::uint32_t number) {
    QueryFilter filter;
    filter.world = number;
    return filter;
  }

  std::size_t below(std::size_t bound) { return random() % bound; }

  Box box() {
    const auto at = [&] { return static_cast<double>(below(100)) / 10.0; };
    return test::cube(at(), at(), at());
  }

  BoxProperties properties() {
    BoxProperties result = inWorld(below(40) == 0 ? kEveryWorld : static_cast<std::uint32_t>(2 * below(5)));
    result.isStatic = below(4) == 0;
    return result;
  }

  void add(const BoxProperties& given) {
    const Box at = box();
    ids.push_back(world.add(at, given));
    oracle.boxes[ids.back()] = {at, given};
  }

  void remove(std::size_t i) {
    world.remove(ids[i]);
    oracle.boxes.erase(ids[i]);
    ids[i] = ids.back();
    ids.pop_back();
  }

  void change() {
    const std::size_t i = below(ids.size());
    switch (below(5)) {
      case 0:
        return add(properties());
      case 1:
        return remove(i);
      case 2: {
        const BoxProperties now = properties();
        world.setProperties(ids[i], now);
        oracle.boxes[ids[i]].properties = now;
        return;
      }
      default: {
        const Box to = box();
        world.move(ids[i], to);
        oracle.boxes[ids[i]].box = to;
      }
    }
  }

  void removeWorld(std::uint32_t number) {
    for (std::size_t i = ids.size(); i-- > 0;) {
      if (oracle.boxes[ids[i]].properties.world == number) remove(i);
    }
  }

  void compareQueries() {
    const Box query{{2, 2, 2}, {7, 7, 7}};
    for (const std::uint32_t number : {0U, 1U, 4U, 77U, kEveryWorld}) {
      std::vector<BoxId> found = world.findOverlapping(query, ofWorld(number));
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, oracle.overlapping(query, ofWorld(number)));
    }
  }

  void compareStep() {
    const StepResult step = world.step();
    oracle.step();
    ASSERT_EQ(test::toVector(step.pairs), oracle.pairs);
    ASSERT_EQ(test::toVector(step.began), oracle.began);
    ASSERT_EQ(test::toVector(step.persisted), oracle.persisted);
    ASSERT_EQ(test::toVector(step.ended), oracle.ended);
  }
};

TEST(WorldLife, LargeWorldsFollowTheBoxesThatComeAndGo) {
  for (unsigned seed = 0; seed < test::repeats(4U); ++seed) {
    LargeWorlds worlds(seed);
    for (std::size_t i = 0; i < 900; ++i) worlds.add(worlds.properties());
    for (std::size_t frame = 0; frame < 40; ++frame) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", frame " + std::to_string(frame));
      const std::size_t changes = worlds.below(10) == 0 ? 300 : worlds.below(12);
      for (std::size_t i = 0; i < changes; ++i) worlds.change();
      if (worlds.below(8) == 0) worlds.removeWorld(static_cast<std::uint32_t>(2 * worlds.below(5)));
      const auto number = static_cast<std::uint32_t>(worlds.below(12));
      for (std::size_t i = worlds.below(6) == 0 ? 180 : 0; i > 0; --i) worlds.add(LargeWorlds::inWorld(number));
      if (worlds.below(3) == 0) {
        ASSERT_NO_FATAL_FAILURE(worlds.compareQueries());
      }
      if (worlds.below(4) != 0) {
        ASSERT_NO_FATAL_FAILURE(worlds.compareStep());
      }
      if (worlds.below(15) == 0) worlds.world.shrink();
    }
  }
}

/// Worlds of ten boxes, so few that the lists are copied, end in the first, a middle and the last place, and others
/// begin.
TEST(WorldLife, FewBoxesEndAWorldWhileAnotherBegins) {
  LargeWorlds worlds(7);
  for (std::size_t i = 0; i < 900; ++i) worlds.add(worlds.properties());
  for (const std::uint32_t number : {1U, 5U, 77U}) {
    for (std::size_t i = 0; i < 10; ++i) {
      BoxProperties properties = LargeWorlds::inWorld(number);
      properties.isStatic = i % 4 == 0;
      worlds.add(properties);
    }
  }
  worlds.removeWorld(0);
  ASSERT_NO_FATAL_FAILURE(worlds.compareStep());
  for (const auto& [ending, beginning] :
       {std::pair{1U, 3U}, std::pair{5U, 0U}, std::pair{77U, 78U}, std::pair{0U, 7U}}) {
    SCOPED_TRACE("world " + std::to_string(ending));
    ASSERT_NO_FATAL_FAILURE(worlds.compareQueries());
    worlds.removeWorld(ending);
    for (std::size_t i = 0; i < 10; ++i) worlds.add(LargeWorlds::inWorld(beginning));
    ASSERT_NO_FATAL_FAILURE(worlds.compareQueries());
    ASSERT_NO_FATAL_FAILURE(worlds.compareStep());
  }
}

TEST(World, ABoxThatIsGivenTheBoundsThatItHasIsAskedAboutAgainOnlyIfItIsTouched) {
  bool accepts = true;
  WorldOptions options;
  options.accept = [&](BoxId, BoxId) { return accepts; };
  World world(options);
  const Box box = test::cube(0, 0, 0);
  const BoxId a = world.add(box);
  world.add(box);
  EXPECT_EQ(world.step().pairs.size(), 1U);
  accepts = false;
  world.move(a, box);
  EXPECT_EQ(world.step().pairs.size(), 1U);
  world.invalidate({&a, 1});
  EXPECT_EQ(world.step().ended.size(), 1U);
}

TEST(World, RoomMayBeMadeBetweenAMoveAndAStep) {
  World world;
  const std::vector<BoxId> ids = world.add(test::lent(std::vector{test::cube(0, 0, 0), test::cube(5, 0, 0)}));
  EXPECT_EQ(world.step().pairs.size(), 0U);
  world.move(ids[1], test::cube(0.5, 0, 0));
  world.reserve(100000);
  EXPECT_EQ(world.step().pairs.size(), 1U);
}

TEST(World, AnEmptyBoxThatMovesByAVelocityStaysEmpty) {
  World world;
  const BoxId id = world.add(test::cube(0, 0, 0));
  static_cast<void>(world.add(Box{{1e10, 0, 0}, {1e10, 1, 1}}));
  const Box empty{{0.5, 0, 0}, {0.4999999999, 1, 1}};  // At 1e10 its bounds are rounded to one number.
  world.moveSwept({&id, 1}, test::lent(std::array{empty}), std::array{1e10, 0.0, 0.0}, 1.0);
  EXPECT_TRUE(isEmpty(world.box(id)));
  EXPECT_TRUE(world.step().pairs.empty());

  world.moveSwept({&id, 1}, test::lent(std::array{kEmptyBox}), std::array{1e308, 0.0, 0.0}, 10.0);  // ends at NaNs
  EXPECT_TRUE(isEmpty(world.box(id)));
}

TEST(World, AStartThatIsNotANumberIsNamedAsSuch) {
  World world;
  const BoxId id = world.add(test::cube(0, 0, 0));
  const Box box{{0, std::numeric_limits<double>::quiet_NaN(), 0}, {1, 1, 1}};
  try {
    world.moveSwept({&id, 1}, test::lent(std::array{box}), std::array{1.0, 0.0, 0.0}, 1.0);
    ADD_FAILURE() << "a NaN was taken";
  } catch (const InvalidBox& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("min y"));
  }
}

}  // namespace
}  // namespace allpairs
