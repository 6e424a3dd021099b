// SPDX-License-Identifier: MIT
// Searches that are stopped: soon, at whatever moment, and with objects that can be used on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include "CompareStep.h"
#include "WorldOracle.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "allpairs/Worlds.h"
#include "support/Boxes.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

/// Sets a flag once so many tasks have run.
class StoppingExecutor final : public Executor {
 public:
  explicit StoppingExecutor(std::size_t threads) : m_threads(threads) {}

  [[nodiscard]] std::size_t concurrency() const noexcept override { return m_threads; }
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = 0; i < count; ++i) {
      if (left-- == 0) stop.set();
      task(i);
    }
  }

  StopFlag stop;
  std::size_t left = 0;

 private:
  std::size_t m_threads;
};

/// Runs work with a stop at its first task, at its second, and so on, until there is none left; returns how often it
/// was stopped. After each stop `check` runs without one. Under a sanitizer only every fourth of the later tasks.
std::size_t stopAtEachTask(StoppingExecutor& executor, const std::function<void()>& work,
                           const std::function<void()>& check) {
  for (std::size_t tasks = 0;; tasks += test::kIsSanitized && tasks >= 8 ? 4 : 1) {
    executor.left = tasks;
    executor.stop.clear();
    bool stopped = false;
    try {
      work();
    } catch (const Stopped&) {
      stopped = true;
    }
    const bool wasSet = executor.stop.isSet();
    executor.stop.clear();
    executor.left = static_cast<std::size_t>(-1);
    check();
    if (!wasSet) return tasks;
    EXPECT_TRUE(stopped) << "after " << tasks << " tasks";
  }
}

/// A sanitizer makes a search that tests every pair last for minutes.
bool isSlow(Strategy strategy) { return test::kIsSanitized && strategy == Strategy::Exhaustive; }

TEST(Stop, AtAnyTaskLeavesASearchThatCanBeUsedOn) {
  for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
    for (const Strategy strategy : {Strategy::Bvh, Strategy::Exhaustive}) {
      const std::vector<BoxF> boxes = test::randomBoxes(isSlow(strategy) ? 1500 : 3000, 91);
      StoppingExecutor executor(3);
      OverlapOptions options;
      options.order = order;
      options.strategy = strategy;
      const std::vector<Pair> expected = overlaps(boxes, options);
      options.executor = &executor;
      options.stop = &executor.stop;
      OverlapSearch search(options);
      const auto check = [&] { ASSERT_EQ(test::toVector(search.find(boxes)), expected); };
      const auto ignore = [](std::span<const Pair>) {};
      EXPECT_GT(stopAtEachTask(
                    executor, [&] { static_cast<void>(search.find(boxes)); }, check),
                2U);
      EXPECT_GT(stopAtEachTask(
                    executor, [&] { static_cast<void>(search.count(boxes)); }, check),
                2U);
      static_cast<void>(stopAtEachTask(
          executor, [&] { search.stream(boxes, ignore, 100); }, check));
    }
  }
}

TEST(Stop, AtAnyTaskOfASearchOfDenseBoxesOrOfManyWorldsIsHeeded) {
  const std::vector<BoxF> dense = test::randomBoxes(3000, 96, 2.5F);
  std::vector<std::size_t> begin{0};
  while (begin.back() < dense.size()) begin.push_back(std::min(dense.size(), begin.back() + 7 * begin.size()));
  const Worlds worlds(dense, begin);
  for (const std::size_t threads : {std::size_t{1}, std::size_t{3}}) {
    StoppingExecutor executor(threads);
    OverlapOptions options;
    const std::vector<Pair> expected = overlaps(dense, options);
    const WorldPairs expectedInWorlds = overlapsInWorlds(worlds, options);
    ASSERT_GT(expected.size(), 15 * dense.size()) << "too few for lists";
    options.executor = &executor;
    options.stop = &executor.stop;
    OverlapSearch search(options);
    EXPECT_GT(stopAtEachTask(
                  executor, [&] { static_cast<void>(search.find(dense)); },
                  [&] { ASSERT_EQ(test::toVector(search.find(dense)), expected); }),
              2U);
    WorldsSearch inWorlds(options);
    const auto check = [&] {
      const WorldPairsView found = inWorlds.find(worlds);
      ASSERT_EQ(test::toVector(found.pairs), expectedInWorlds.pairs);
      ASSERT_TRUE(std::equal(found.begin.begin(), found.begin.end(), expectedInWorlds.begin.begin(),
                             expectedInWorlds.begin.end()));
    };
    EXPECT_GE(stopAtEachTask(
                  executor, [&] { static_cast<void>(inWorlds.find(worlds)); }, check),
              1U);
    executor.stop.set();
    EXPECT_THROW(static_cast<void>(inWorlds.count(worlds)), Stopped);
    executor.stop.clear();
    EXPECT_EQ(inWorlds.count(worlds).back(), expectedInWorlds.pairs.size());
  }
}

TEST(Stop, AFlagThatIsNotSetChangesNothing) {
  const std::vector<BoxF> others = test::randomBoxes(test::kIsSanitized ? 2000 : 5000, 93);
  const StopFlag stop;
  for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
    for (const Strategy strategy : {Strategy::Bvh, Strategy::Exhaustive}) {
      const std::vector<BoxF> boxes = test::randomBoxes(isSlow(strategy)     ? 2500
                                                        : test::kIsSanitized ? 8000
                                                                             : 20000,
                                                        92);
      OverlapOptions options;
      options.order = order;
      options.strategy = strategy;
      const std::vector<Pair> one = overlaps(boxes, options);
      const std::vector<Pair> two = overlaps(boxes, others, options);
      options.stop = &stop;
      EXPECT_EQ(overlaps(boxes, options), one);
      EXPECT_EQ(overlaps(boxes, others, options), two);
      EXPECT_EQ(countOverlaps(boxes, options), one.size());
    }
  }
}

/// A world some steps old that has moved since the last one.
struct MovedWorld {
  explicit MovedWorld(const WorldOptions& options) : world(options) {
    const std::vector<Box> boxes = test::toDouble(test::randomBoxes(700, 94));
    const std::vector<Box> moved = test::toDouble(test::randomBoxes(700, 95));
    ids = world.add(BoxView(boxes));
    static_cast<void>(world.step());
    for (const BoxId id : ids) oracle.boxes[id] = {boxes[id], {}};
    oracle.step();
    for (std::size_t i = 0; i < boxes.size(); i += 20) {
      world.move(ids[i], moved[i]);
      oracle.boxes[ids[i]].box = moved[i];
    }
  }

  void compareStep() { test::compareStep(world, oracle); }

  World world;
  test::WorldOracle oracle;
  std::vector<BoxId> ids;
};

TEST(Stop, OfAStepOfFewBoxesIsHeededHoweverFewHaveChanged) {
  for (const std::size_t count : {2U, 50U, 200U, 350U}) {
    StopFlag stop;
    WorldOptions options;
    options.stop = &stop;
    World world(options);
    const std::vector<BoxId> ids = world.add(test::lent(test::randomBoxes(count, 9)));
    static_cast<void>(world.step());
    const std::vector<Pair> before = test::toVector(world.result().pairs);
    world.move(ids[0], Box{{0, 0, 0}, {100, 100, 100}});
    stop.set();
    EXPECT_THROW(static_cast<void>(world.step()), Stopped) << count;
    EXPECT_EQ(test::toVector(world.result().pairs), before);
    stop.clear();
    EXPECT_GE(world.step().pairs.size(), count - 1) << count;
  }
}

TEST(Stop, OfAStepAtAnyTaskLeavesItsChangesToTheNext) {
  for (const bool movesAll : {false, true}) {
    std::size_t stops = 0;
    for (std::size_t tasks = 0;; ++tasks) {
      StoppingExecutor executor(3);
      executor.left = static_cast<std::size_t>(-1);
      WorldOptions options;
      options.executor = &executor;
      options.stop = &executor.stop;
      MovedWorld moved(options);
      if (movesAll) {
        for (const BoxId id : moved.ids) {
          Box box = moved.world.box(id);
          box.max[0] += 0.5;
          moved.world.move(id, box);
          moved.oracle.boxes[id].box = box;
        }
      }
      executor.left = tasks;
      try {
        const StepResult found = moved.world.step();
        ASSERT_FALSE(executor.stop.isSet()) << "after " << tasks << " tasks";
        ASSERT_GT(found.began.size(), 0U);
        break;
      } catch (const Stopped&) {
        ++stops;
      }
      const std::vector<Box> queries(99, moved.world.box(1));
      EXPECT_THROW(static_cast<void>(moved.world.findOverlapping(BoxView(queries))), Stopped);
      executor.stop.clear();
      executor.left = static_cast<std::size_t>(-1);
      ASSERT_NO_FATAL_FAILURE(moved.compareStep()) << "after " << tasks << " tasks";
      moved.world.move(moved.ids[3], moved.world.box(moved.ids[4]));
      moved.oracle.boxes[moved.ids[3]].box = moved.world.box(moved.ids[4]);
      ASSERT_NO_FATAL_FAILURE(moved.compareStep()) << "after " << tasks << " tasks";
    }
    EXPECT_GT(stops, 5U);
  }
}

std::vector<BoxF> boxesAtOnePlace(std::size_t n) { return std::vector<BoxF>(n, {{0, 0, 0}, {1, 1, 1}}); }

TEST(Stop, EndsOneQueryOfAWorldWithinSomeHundredBoxes) {
  std::size_t looks = 0;
  std::size_t most = static_cast<std::size_t>(-1);
  const auto ask = [&] { return ++looks > most; };
  const StopFlag stop{FunctionRef<bool()>(ask)};
  WorldOptions options;
  options.stop = &stop;
  World world(options);
  BoxProperties properties;
  properties.isStatic = true;  // which makes no pairs of them
  static_cast<void>(world.add(test::lent(boxesAtOnePlace(10'000)), properties));
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const Ray ray{{-1, 0.5, 0.5}, {1, 0, 0}};
  const std::vector<std::function<void()>> queries{
      [&] { EXPECT_EQ(world.findOverlapping(box).size(), 10'000U); },
      [&] { EXPECT_EQ(world.findOverlapping(test::lent(std::vector<Box>(3, box))).values.size(), 30'000U); },
      [&] { EXPECT_EQ(world.findAll(ray).size(), 10'000U); },
      [&] { EXPECT_EQ(world.findFirst(ray).id, 0U); },
      [&] {
        EXPECT_EQ(world.findNearest({3, 3, 3}, 10'000).size(), 10'000U);
      },
  };
  for (const auto& query : queries) {
    most = static_cast<std::size_t>(-1);
    query();  // which may prepare something
    looks = 0;
    query();
    EXPECT_GT(looks, 10U);
    const std::size_t all = looks;
    for (most = 0; most < all; most += 7) {
      looks = 0;
      EXPECT_THROW(query(), Stopped);
    }
  }
}

TEST(Stop, AFlagThatAsksIsHeededWheneverItIsAskedFor) {
  const std::vector<BoxF> boxes = test::randomBoxes(3000, 97, 2.5F);
  for (const Strategy strategy : {Strategy::Bvh, Strategy::Exhaustive}) {
    OverlapOptions options;
    options.strategy = strategy;
    const std::vector<Pair> expected = overlaps(boxes, options);
    std::size_t asked = 0;
    std::size_t answersNo = 0;
    const auto ask = [&] { return asked++ >= answersNo; };
    const StopFlag stop(ask);
    options.stop = &stop;
    OverlapSearch search(options);
    for (bool isStopped = true; isStopped; answersNo += test::kIsSanitized && answersNo >= 16 ? 5 : 1) {
      asked = 0;
      try {
        ASSERT_EQ(test::toVector(search.find(boxes)), expected) << answersNo;
        isStopped = false;
        EXPECT_LE(asked, answersNo);
      } catch (const Stopped&) {
        EXPECT_EQ(asked, answersNo + 1);
      }
    }
    EXPECT_GT(answersNo, 10U) << "looks";
  }
}

TEST(Stop, WhereMemoryGrowsAndPairsAreComparedLeavesAStepToTheNext) {
  const std::vector<BoxF> boxes = boxesAtOnePlace(4000);
  World world;
  static_cast<void>(world.add(BoxView(boxes)));
  std::size_t asked = 0;
  std::size_t answersNo = 0;
  const auto ask = [&] { return asked++ == answersNo; };
  const StopFlag asking(ask);
  WorldOptions options;
  options.stop = &asking;
  World stopped(options);
  static_cast<void>(stopped.add(BoxView(boxes)));
  const auto expected = test::toVector(world.step().began);
  ASSERT_EQ(expected.size(), 4000U * 3999U / 2U);
  for (answersNo = 1;; answersNo = (test::kIsSanitized ? answersNo * 3 : answersNo * 3 / 2) + 1) {
    asked = 0;
    try {
      ASSERT_EQ(test::toVector(stopped.step().began), expected);
      break;
    } catch (const Stopped&) {
      ASSERT_TRUE(stopped.result().pairs.empty());
    }
  }
  EXPECT_GT(answersNo, 100U);
}

TEST(Stop, OfWhatIsReceivedComesBeforeMany) {
  const std::vector<BoxF> boxes = boxesAtOnePlace(3000);
  StopFlag stop;
  std::size_t calls = 0;
  OverlapOptions options;
  options.stop = &stop;
  options.filter.accept = [&](std::uint32_t, std::uint32_t) {
    ++calls;
    stop.set();
    return true;
  };
  EXPECT_THROW(static_cast<void>(overlaps(boxes, options)), Stopped);
  EXPECT_LT(calls, 10'000U);  // of 4.5 million
}

TEST(Stop, OfAFewBoxesIsHeededWhereTheirPairsAreTested) {
  const std::vector<BoxF> boxes = boxesAtOnePlace(384);
  StopFlag stop;
  std::size_t calls = 0;
  OverlapOptions options;
  options.strategy = Strategy::Exhaustive;
  options.stop = &stop;
  options.filter.accept = [&](std::uint32_t, std::uint32_t) {
    if (++calls == 10) stop.set();
    return true;
  };
  EXPECT_THROW(static_cast<void>(overlaps(boxes, options)), Stopped);
  EXPECT_LT(calls, 2'000U);  // of 73,536
  options.filter.accept = {};
  options.distance = 0.1;
  for (const std::size_t size : {8U, 128U, 129U, 384U}) {
    EXPECT_THROW(static_cast<void>(overlaps(std::span(boxes).first(size), options)), Stopped) << size;
  }
}

}  // namespace
}  // namespace allpairs
