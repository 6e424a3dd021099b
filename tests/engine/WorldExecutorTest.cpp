// SPDX-License-Identifier: MIT
// Threads change nothing: the same lists, step by step, with one and with several.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "CompareStep.h"
#include "allpairs/World.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Boxes.h"
#include "support/ChangingExecutor.h"
#include "support/PoolExecutor.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

/// Some of the boxes, each a little way off.
void moveSome(std::vector<BoxF>& boxes, std::size_t every, std::size_t frame, std::vector<BoxId>& ids) {
  ids.clear();
  for (std::size_t i = frame % every; i < boxes.size(); i += every) {
    const float by = 0.05F * static_cast<float>((i * 7 + frame * 3) % 9) - 0.2F;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[i].min[axis] += by;
      boxes[i].max[axis] += by;
    }
    ids.push_back(static_cast<BoxId>(i));
  }
}

class WorldThreads : public ::testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(OneBoxInSoManyMoves, WorldThreads, ::testing::Values(1, 50));

TEST_P(WorldThreads, SeveralThreadsGiveTheListsOfOne) {
  parallel::TbbExecutor threads(4);
  WorldOptions options;
  World serial(options);
  options.executor = &threads;
  World many(options);
  std::vector<BoxF> boxes = test::randomBoxes(20000, 11);
  std::vector<BoxId> ids = serial.add(boxes);
  ASSERT_EQ(many.add(boxes), ids);
  for (std::size_t frame = 0; frame < 12; ++frame) {
    const StepResult one = serial.step();
    const StepResult several = many.step();
    ASSERT_GT(one.began.size(), 0U);
    ASSERT_NO_FATAL_FAILURE(test::compareLists(several, one));
    ASSERT_EQ(many.statistics().rebuilds, serial.statistics().rebuilds);
    moveSome(boxes, GetParam(), frame, ids);
    std::vector<BoxF> moved;
    for (const BoxId id : ids) moved.push_back(boxes[id]);
    serial.move(ids, moved);
    many.move(ids, moved);
  }
}

TEST_P(WorldThreads, MayBeMoreOrFewerEachTimeTheExecutorIsAsked) {
  for (std::size_t first = 0; first < test::ChangingExecutor::kAnswers.size(); ++first) {
    test::ChangingExecutor executor(first);
    World serial;
    World many({.executor = &executor});
    std::vector<BoxF> boxes = test::randomBoxes(20000, 12);
    std::vector<BoxId> ids = serial.add(boxes);
    ASSERT_EQ(many.add(boxes), ids);
    for (std::size_t frame = 0; frame < (test::kIsSanitized ? 2 : 4); ++frame) {
      ASSERT_NO_FATAL_FAILURE(test::compareLists(many.step(), serial.step()));
      ASSERT_EQ(many.findBetween(many), serial.findBetween(serial));
      ASSERT_EQ(many.findOverlapping(BoxView(boxes)).values, serial.findOverlapping(BoxView(boxes)).values);
      moveSome(boxes, GetParam(), frame, ids);
      std::vector<BoxF> moved;
      for (const BoxId id : ids) moved.push_back(boxes[id]);
      serial.move(ids, moved);
      many.move(ids, moved);
    }
  }
}

/// Worlds of boxes in a row, each of which touches the next one. Neither thread goes on before both have a pair.
TEST(WorldExecutor, PairsThatEachThreadHasInOrderAreListedTogether) {
  constexpr BoxId kWorlds = 200;
  constexpr BoxId kBoxes = 60;
  std::mutex mutex;
  std::condition_variable both;
  std::set<std::thread::id> threads;
  test::PoolExecutor executor(2);
  WorldOptions options;
  options.executor = &executor;
  options.accept = [&](BoxId, BoxId) {
    std::unique_lock lock(mutex);
    threads.insert(std::this_thread::get_id());
    both.notify_all();
    return both.wait_for(lock, std::chrono::seconds(5), [&threads] { return threads.size() == 2; });
  };
  World world(options);
  std::vector<Pair> expected;
  for (BoxId i = 0; i < kWorlds * kBoxes; ++i) {
    BoxProperties properties;
    properties.world = i / kBoxes;
    ASSERT_EQ(world.add(test::cube(i % kBoxes, 0, 0), properties), i);
    if (i % kBoxes != 0) expected.push_back({i - 1, i});
  }
  const StepResult step = world.step();
  EXPECT_TRUE(std::vector<Pair>(step.pairs.begin(), step.pairs.end()) == expected);
  EXPECT_EQ(step.began.size(), expected.size());
}

TEST(WorldExecutor, SeveralThreadsGiveTheQueriesOfOne) {
  parallel::TbbExecutor threads(4);
  WorldOptions options;
  World serial(options);
  options.executor = &threads;
  World many(options);
  const std::vector<BoxF> boxes = test::randomBoxes(5000, 12);
  const std::vector<BoxF> queries = test::randomBoxes(1000, 13);
  static_cast<void>(serial.add(boxes));
  static_cast<void>(many.add(boxes));
  const ResultLists<BoxId> one = serial.findOverlapping(queries);
  const ResultLists<BoxId> several = many.findOverlapping(queries);
  ASSERT_GT(one.values.size(), 1000U);
  EXPECT_EQ(std::vector(several.offsets.begin(), several.offsets.end()),
            std::vector(one.offsets.begin(), one.offsets.end()));
  EXPECT_EQ(std::vector(several.values.begin(), several.values.end()),
            std::vector(one.values.begin(), one.values.end()));
}

/// Everything that a query of each kind finds.
struct Answers {
  std::vector<BoxId> overlapping;
  std::vector<SweepHit> hits;
  SweepHit first;
  std::vector<Neighbor> nearest;
  std::vector<std::size_t> offsets;
  std::vector<Pair> between;

  friend bool operator==(const Answers&, const Answers&) = default;
};

Answers answersOf(const World& world, const World& other, const Box& box) {
  Answers answers;
  answers.overlapping = world.findOverlapping(box);
  const Ray ray{box.min, {0.5, 0.25, 1.0}, 20.0};
  answers.hits = world.findAll(ray);
  answers.first = world.findFirst(BoxSweep{box, {1.0, 0.0, 0.0}, 5.0});
  answers.nearest = world.findNearest(box.min, 7);
  const std::vector<Box> boxes{box, world.box(0), world.box(1)};
  answers.offsets = world.findOverlapping(BoxView(boxes)).offsets;
  answers.between = world.findBetween(other);
  return answers;
}

TEST(WorldQueries, AnswerSeveralThreadsAtOnceEvenTheFirstOnesAfterAMove) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(1500, 81));
  std::vector<Box> moved = test::toDouble(test::randomBoxes(1500, 82));
  World world;
  World other;
  const std::vector<BoxId> ids = world.add(BoxView(boxes));
  (void)other.add(BoxView(std::span<const Box>(boxes).first(200)));
  for (int round = 0; round < 5; ++round) {
    World calm;
    (void)calm.add(BoxView(moved));
    std::vector<Answers> expected;
    for (int i = 0; i < 8; ++i) expected.push_back(answersOf(calm, other, boxes[static_cast<std::size_t>(i)]));

    world.move(ids, moved);  // Whichever thread asks first brings the order up to date.
    std::vector<Answers> found(8);
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < 8; ++i) {
      threads.emplace_back([&, i] { found[i] = answersOf(world, other, boxes[i]); });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(found, expected);
    std::ranges::reverse(moved);
  }
}

/// The first query after a change brings the order up to date, while others look at boxes and at statistics.
TEST(WorldQueries, MayBeFirstAfterAStepWhileOtherConstMembersAreCalled) {
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(60, 83));
  std::vector<Box> moved = test::toDouble(test::randomBoxes(60, 84));
  World world;
  const std::vector<BoxId> ids = world.add(BoxView(boxes));
  const Box all{{-100, -100, -100}, {100, 100, 100}};
  for (int round = 0; round < 50; ++round) {
    world.move(ids, moved);
    static_cast<void>(world.step());
    std::vector<std::thread> threads;
    std::vector<std::size_t> found(4);
    for (std::size_t& size : found) {
      threads.emplace_back([&] { size = world.findOverlapping(all).size(); });
      threads.emplace_back([&] {
        for (const BoxId id : ids) {
          EXPECT_TRUE(world.contains(id) && !world.properties(id).isStatic && world.box(id) == moved[id]);
        }
        EXPECT_LE(world.statistics().rebuilds, 50U);
        EXPECT_FALSE(world.result().pairs.empty());
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(found, std::vector<std::size_t>(4, 60));
    std::ranges::reverse(moved);
  }
}

TEST(WorldThreads, QueriesBetweenTwoWorldsAtOnceLeaveBothUsable) {
  constexpr int kThreads = 3;
  constexpr int kQueries = test::repeats(200'000);
  World first;
  World second;
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreads; ++i) {
    threads.emplace_back([&] {
      for (int query = 0; query < kQueries; ++query) static_cast<void>(first.findBetween(second));
    });
  }
  for (std::thread& thread : threads) thread.join();
  // A world that counted its users wrongly would say that it is called by its own filter.
  EXPECT_NO_THROW(static_cast<void>(first.step()));
  EXPECT_NO_THROW(static_cast<void>(second.step()));
}

}  // namespace
}  // namespace allpairs
