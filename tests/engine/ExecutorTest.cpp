// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Boxes.h"
#include "support/ChangingExecutor.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

/// Runs tasks last to first and claims many threads, so that a result that depends on either shows.
class BackwardExecutor final : public Executor {
 public:
  [[nodiscard]] std::size_t concurrency() const noexcept override { return 7; }
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = count; i-- > 0;) task(i);
  }
};

/// Claims two threads and counts what it is asked to run.
class CountingExecutor final : public Executor {
 public:
  [[nodiscard]] std::size_t concurrency() const noexcept override { return 2; }
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    ++runs;
    for (std::size_t i = 0; i < count; ++i) task(i);
  }

  std::size_t runs = 0;
};

/// oneTBB's limit on its workers is one for the whole process, and of several the least.
TEST(Executor, KeepsItsThreadsBesideASmallerOne) {
  const std::size_t cores = parallel::TbbExecutor().concurrency();
  const std::size_t threads = cores + 4;
  parallel::TbbExecutor large(threads);
  const parallel::TbbExecutor small(cores + 1);
  std::atomic<std::size_t> arrived = 0;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  large.run(threads, [&](std::size_t) {
    ++arrived;
    while (arrived < threads && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  });
  EXPECT_LT(std::chrono::steady_clock::now(), deadline) << "the tasks waited for more threads than there are";
}

TEST(Executor, GivesTheSameBytesForAnyNumberOfThreads) {
  const std::vector<BoxF> boxes = test::randomBoxes(test::kIsSanitized ? 20000 : 60000, 31);
  constexpr std::size_t kExhaustive = test::kIsSanitized ? 4000 : 8000;
  parallel::TbbExecutor two(2);
  parallel::TbbExecutor eight(8);
  BackwardExecutor backward;
  for (const Strategy strategy : {Strategy::Exhaustive, Strategy::Bvh}) {
    const std::span<const BoxF> part(boxes.data(), strategy == Strategy::Exhaustive ? kExhaustive : boxes.size());
    for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
      OverlapOptions options;
      options.strategy = strategy;
      options.order = order;
      const std::vector<Pair> serial = overlaps(part, options);
      for (Executor* executor : std::initializer_list<Executor*>{&two, &eight, &backward}) {
        options.executor = executor;
        ASSERT_EQ(overlaps(part, options), serial);
        ASSERT_EQ(countOverlaps(part, options), serial.size());
      }
    }
  }
}

TEST(Executor, MayHaveMoreOrFewerThreadsEachTimeItIsAsked) {
  const std::vector<BoxF> boxes = test::randomBoxes(test::kIsSanitized ? 10000 : 20000, 39);
  const std::vector<BoxF> dense = test::randomBoxes(test::kIsSanitized ? 800 : 1400, 40, 30.0F);
  OverlapOptions options;
  for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
    for (std::size_t first = 0; first < test::ChangingExecutor::kAnswers.size(); ++first) {
      test::ChangingExecutor executor(first);
      OverlapSearch kept;
      for (const std::vector<BoxF>* part : {&boxes, &dense, &boxes}) {
        options.order = order;
        options.executor = nullptr;
        const std::vector<Pair> serial = overlaps(*part, options);
        options.executor = &executor;
        ASSERT_EQ(overlaps(*part, options), serial);
        ASSERT_EQ(countOverlaps(*part, options), serial.size());
        kept.setOptions(options);
        ASSERT_TRUE(std::ranges::equal(kept.find(*part), serial));
        ASSERT_EQ(neighbors(*part, NeighborRows::Half, options).indices.size(), serial.size());
        std::size_t streamed = 0;
        streamOverlaps(
            *part, [&](Span<const Pair> batch) { streamed += batch.size(); }, options);
        ASSERT_EQ(streamed, serial.size());
      }
    }
  }
}

TEST(Executor, GivesTheSameBytesWhereFewBoxesTakeOneThread) {
  const std::vector<BoxF> boxes = test::randomBoxes(4097, 37);
  for (std::size_t threads = 2; threads <= 8; threads += test::kIsSanitized ? 3 : 1) {
    parallel::TbbExecutor executor(threads);
    OverlapSearch kept;
    for (const std::size_t size : {900U, 2047U, 2048U, 2049U, 4095U, 4097U, 2048U}) {
      const std::span<const BoxF> part(boxes.data(), size);
      for (const Order order : {Order::ByFirst, Order::BySecond, Order::Unordered}) {
        OverlapOptions options;
        options.strategy = Strategy::Bvh;
        options.order = order;
        const std::vector<Pair> serial = overlaps(part, options);
        const Neighbors rows = neighbors(part, NeighborRows::Full, options);
        options.executor = &executor;
        ASSERT_EQ(overlaps(part, options), serial);
        ASSERT_EQ(countOverlaps(part, options), serial.size());
        kept.setOptions(options);
        ASSERT_TRUE(std::ranges::equal(kept.find(part), serial));
        ASSERT_EQ(neighbors(part, NeighborRows::Full, options).indices, rows.indices);
      }
    }
  }
}

TEST(Executor, SearchesFewBoxesOnTheCallingThreadUnlessTheyAreFiltered) {
  const std::vector<BoxF> boxes = test::randomBoxes(2049, 38);
  CountingExecutor counting;
  OverlapOptions options;
  options.strategy = Strategy::Bvh;
  options.executor = &counting;
  const std::span<const BoxF> all(boxes);
  static_cast<void>(overlaps(all.first(2048), options));
  EXPECT_EQ(counting.runs, 0U);
  static_cast<void>(overlaps(all.first(1024), all.subspan(1024, 1024), options));
  EXPECT_EQ(counting.runs, 0U);
  static_cast<void>(overlaps(all, options));
  EXPECT_GT(counting.runs, 0U);
  counting.runs = 0;
  options.filter.accept = [](std::uint32_t, std::uint32_t) { return true; };
  static_cast<void>(overlaps(all.first(2048), options));
  EXPECT_GT(counting.runs, 0U);
}

TEST(Executor, GivesTheSameBytesBetweenTwoSets) {
  const std::vector<BoxF> first = test::randomBoxes(30000, 32);
  const std::vector<BoxF> second = test::randomBoxes(20000, 33);
  parallel::TbbExecutor eight(8);
  OverlapOptions options;
  const std::vector<Pair> serial = overlaps(first, second, options);
  options.executor = &eight;
  EXPECT_EQ(overlaps(first, second, options), serial);
}

TEST(Executor, PassesOnWhatAFilterThrows) {
  const std::vector<BoxF> boxes = test::randomBoxes(30000, 34);
  parallel::TbbExecutor four(4);
  OverlapOptions options;
  options.executor = &four;
  options.filter.accept = [](std::uint32_t first, std::uint32_t) -> bool {
    if (first == 12345) throw std::runtime_error("stop");
    return true;
  };
  OverlapSearch search(options);
  EXPECT_THROW(static_cast<void>(search.find(boxes)), std::runtime_error);
  options.filter.accept = nullptr;
  search.setOptions(options);
  EXPECT_EQ(search.find(boxes).size(), overlaps(boxes).size());
}

TEST(Executor, ALimitHoldsForAllThreadsTogether) {
  const std::vector<BoxF> boxes = test::randomBoxes(60000, 36);
  BackwardExecutor seven;
  parallel::TbbExecutor eight(8);
  OverlapOptions options;
  const std::size_t pairs = overlaps(boxes, options).size();
  for (Executor* executor : std::initializer_list<Executor*>{&seven, &eight}) {
    options.executor = executor;
    options.maxPairs = pairs - 1;
    EXPECT_THROW(static_cast<void>(overlaps(boxes, options)), LimitExceeded);
    options.maxPairs = pairs;
    EXPECT_EQ(overlaps(boxes, options).size(), pairs);
  }
}

TEST(TbbExecutor, RunsEachTaskOnce) {
  parallel::TbbExecutor executor(4);
  std::vector<std::atomic<int>> runs(1000);
  executor.run(runs.size(), [&](std::size_t i) { ++runs[i]; });
  for (const std::atomic<int>& count : runs) EXPECT_EQ(count.load(), 1);
  executor.run(0, [](std::size_t) { FAIL() << "there is no task"; });
}

/// It may hold a lock for which the other task waits.
TEST(TbbExecutor, AThreadThatWaitsForTasksBeginsNoneOfAnotherCall) {
  parallel::TbbExecutor executor(4);
  static thread_local bool isWithin = false;
  std::atomic<int> begunWithin = 0;
  executor.run(200, [&](std::size_t) {
    if (isWithin) ++begunWithin;
    isWithin = true;
    executor.run(8, [](std::size_t) { std::this_thread::sleep_for(std::chrono::microseconds(100)); });
    isWithin = false;
  });
  EXPECT_EQ(begunWithin.load(), 0);
}

/// As where it holds a lock for which they wait.
TEST(TbbExecutor, AThreadFromOutsideNeedsNoneOfThoseThatWaitForIt) {
  constexpr auto kPatience = std::chrono::seconds(30);  // a deadlock otherwise
  parallel::TbbExecutor executor(2);
  std::atomic<int> waiting = 0;
  std::atomic<bool> isDone = false;
  std::thread outside([&] {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (waiting < 2 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    executor.run(4, [](std::size_t) {});
    isDone = true;
  });
  std::atomic<int> given = 0;
  executor.run(2, [&](std::size_t) {
    ++waiting;
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (!isDone && std::chrono::steady_clock::now() < end) std::this_thread::yield();
    if (isDone) ++given;
  });
  EXPECT_EQ(given.load(), 2);
  outside.join();
}

TEST(World, QueriesOfOneWorldFromTasksAndFromOutsideNeverWaitForEachOther) {
  parallel::TbbExecutor executor(4);
  WorldOptions options;
  options.executor = &executor;
  const std::vector<Box> boxes = test::toDouble(test::randomBoxes(20000, 5));
  World world(options);
  const std::vector<BoxId> ids = world.add(boxes);
  std::size_t expected = 0;
  for (std::size_t i = 0; i < 32; ++i) expected += world.findOverlapping(boxes[i]).size();
  for (int round = 0; round < 20; ++round) {
    world.move(ids, boxes);
    std::vector<Box> moved = boxes;
    moved[0].max[0] += 1e-9;  // so that the hierarchies have to be updated
    world.move(ids, moved);
    world.move(ids, boxes);
    std::atomic<std::size_t> found = 0;
    std::atomic<std::size_t> foundOutside = 0;
    const auto ask = [&](std::size_t i, std::atomic<std::size_t>& sum) {
      sum += world.findOverlapping(boxes[i]).size();
    };
    std::thread outside([&] {
      for (std::size_t i = 0; i < 32; ++i) ask(i, foundOutside);
    });
    executor.run(32, [&](std::size_t i) { ask(i, found); });
    outside.join();
    EXPECT_EQ(found.load(), expected);
    EXPECT_EQ(foundOutside.load(), expected);
  }
}

TEST(TbbExecutor, HasTheThreadsItWasAskedFor) {
  EXPECT_EQ(parallel::TbbExecutor(3).concurrency(), 3U);
  EXPECT_GE(parallel::TbbExecutor().concurrency(), 1U);
}

TEST(Overlaps, TwoObjectsInTwoThreadsNeverMeet) {
  const std::vector<BoxF> boxes = test::randomBoxes(20000, 35);
  const std::vector<Pair> expected = overlaps(boxes);
  std::vector<std::vector<Pair>> results(4);
  {
    std::vector<std::jthread> threads;
    for (std::vector<Pair>& result : results) threads.emplace_back([&] { result = overlaps(boxes); });
  }
  for (const std::vector<Pair>& result : results) EXPECT_EQ(result, expected);
}

}  // namespace
}  // namespace allpairs
