// SPDX-License-Identifier: MIT
// Filters, visitors and tasks that throw, or call back: at every call of them.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "CompareStep.h"
#include "WorldOracle.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "support/Boxes.h"
#include "support/PoolExecutor.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

/// What a callback of a test throws.
struct Thrown : std::runtime_error {
  Thrown() : std::runtime_error("thrown by a callback") {}
};

/// Throws at one of the calls of it; afterwards it no longer does.
class Thrower {
 public:
  void throwAt(std::uint64_t call) {
    m_at = call;
    m_calls = 0;
  }
  void call() {
    if (++m_calls == m_at) throw Thrown();
  }
  [[nodiscard]] bool hasThrown() const { return m_at != 0 && m_calls >= m_at; }

 private:
  std::atomic<std::uint64_t> m_calls{0};
  std::uint64_t m_at = 0;
};

/// Throws before, within or after a task.
class ThrowingExecutor final : public Executor {
 public:
  explicit ThrowingExecutor(Thrower& thrower) : m_thrower(thrower) {}
  [[nodiscard]] std::size_t concurrency() const noexcept override { return 3; }
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = 0; i < count; ++i) {
      m_thrower.call();
      task(i);
    }
    m_thrower.call();
  }

 private:
  Thrower& m_thrower;
};

/// Runs `attempt` with a callback that throws at its first call, its second and so on, until it is called no more; each
/// time `check` must find all as if nothing had been.
void throwAtEachCall(Thrower& thrower, const std::function<void()>& attempt, const std::function<void()>& check) {
  for (std::uint64_t call = 1;; ++call) {
    thrower.throwAt(call);
    try {
      attempt();
    } catch (const Thrown&) {
      ASSERT_TRUE(thrower.hasThrown());
    }
    const bool thrown = thrower.hasThrown();
    thrower.throwAt(0);
    check();
    if (::testing::Test::HasFailure()) return;
    if (!thrown) {
      ASSERT_GT(call, 3U) << "there are hardly any calls";
      return;
    }
  }
}

class CallbackOfSearch : public ::testing::TestWithParam<Strategy> {
 protected:
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(60, 81, 2.0F));
  std::vector<Pair> wanted = overlaps(boxes);
  OverlapOptions options;
  CallbackOfSearch() { options.strategy = GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(OfEachStrategy, CallbackOfSearch, ::testing::Values(Strategy::Exhaustive, Strategy::Bvh));

TEST_P(CallbackOfSearch, AFilterThatThrowsLeavesTheSearchUsable) {
  Thrower thrower;
  options.filter.accept = [&](std::uint32_t, std::uint32_t) {
    thrower.call();
    return true;
  };
  OverlapSearch search(options);
  const auto check = [&] { ASSERT_EQ(test::toVector(search.find(boxes)), wanted); };
  throwAtEachCall(
      thrower, [&] { static_cast<void>(search.find(boxes)); }, check);
  throwAtEachCall(
      thrower, [&] { static_cast<void>(search.find(boxes, boxes)); }, check);
  throwAtEachCall(
      thrower, [&] { static_cast<void>(search.count(boxes)); }, check);
}

TEST_P(CallbackOfSearch, AVisitorThatThrowsLeavesTheSearchUsable) {
  Thrower thrower;
  OverlapSearch search(options);
  const auto attempt = [&] {
    search.stream(
        boxes, [&](std::span<const Pair>) { thrower.call(); }, 3);
  };
  throwAtEachCall(thrower, attempt, [&] {
    std::vector<Pair> found;
    search.stream(boxes, [&](std::span<const Pair> pairs) { found.insert(found.end(), pairs.begin(), pairs.end()); });
    ASSERT_EQ(found, wanted);
  });
}

TEST_P(CallbackOfSearch, AnExecutorThatThrowsLeavesTheSearchUsable) {
  Thrower thrower;
  ThrowingExecutor executor(thrower);
  const std::vector<Box> more = test::toDouble(test::randomBoxes(2100, 82));
  const std::vector<Pair> wantedOfMore = overlaps(more);
  options.executor = &executor;
  OverlapSearch search(options);
  throwAtEachCall(
      thrower, [&] { static_cast<void>(search.find(more)); },
      [&] { ASSERT_EQ(test::toVector(search.find(more)), wantedOfMore); });
}

TEST_P(CallbackOfSearch, OnManyThreadsAFilterThatThrowsLeavesTheSearchUsable) {
  Thrower thrower;
  test::PoolExecutor threads(3);
  options.executor = &threads;
  options.filter.accept = [&](std::uint32_t, std::uint32_t) {
    thrower.call();
    return true;
  };
  OverlapSearch search(options);
  throwAtEachCall(
      thrower, [&] { static_cast<void>(search.find(boxes)); },
      [&] { ASSERT_EQ(test::toVector(search.find(boxes)), wanted); });
}

/// Runs a callback's own call and says whether it was refused.
bool isRefused(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidArgument& error) {
    return std::string(error.what()).find("is called by its own filter, visitor, stop or task") != std::string::npos;
  }
  return false;
}

TEST_P(CallbackOfSearch, ASearchThatItsCallbackStartsAgainRefuses) {
  OverlapSearch* self = nullptr;
  std::size_t refused = 0;
  const auto callBack = [&] {
    refused += isRefused([&] { static_cast<void>(self->find(boxes)); }) ? 1U : 0U;
    refused += isRefused([&] { static_cast<void>(self->find(boxes, boxes)); }) ? 1U : 0U;
    refused += isRefused([&] { static_cast<void>(self->count(boxes)); }) ? 1U : 0U;
    refused += isRefused([&] { static_cast<void>(self->count(boxes, boxes)); }) ? 1U : 0U;
    refused += isRefused([&] { self->stream(boxes, [](std::span<const Pair>) {}); }) ? 1U : 0U;
    refused += isRefused([&] { self->stream(boxes, boxes, [](std::span<const Pair>) {}); }) ? 1U : 0U;
    refused += isRefused([&] { self->setOptions({}); }) ? 1U : 0U;
    EXPECT_EQ(self->options().strategy, GetParam());
  };
  options.filter.accept = [&](std::uint32_t, std::uint32_t) {
    callBack();
    return true;
  };
  OverlapSearch search(options);
  self = &search;
  EXPECT_EQ(test::toVector(search.find(boxes)), wanted);
  EXPECT_EQ(refused, 7 * wanted.size());
  OverlapSearch streamed;
  self = &streamed;
  refused = 0;
  options.filter.accept = nullptr;
  streamed.setOptions(options);
  std::size_t calls = 0;
  streamed.stream(boxes, [&](std::span<const Pair>) {
    ++calls;
    callBack();
  });
  EXPECT_EQ(refused, 7 * calls);
  EXPECT_EQ(test::toVector(streamed.find(boxes)), wanted);
}

TEST_P(CallbackOfSearch, OtherSearchesMayBeMadeByACallback) {
  OverlapSearch other;
  World world;
  options.filter.accept = [&](std::uint32_t a, std::uint32_t b) {
    EXPECT_EQ(overlaps(boxes), wanted);
    EXPECT_EQ(test::toVector(other.find(boxes)), wanted);
    world.add(boxes[a]);
    world.add(boxes[b]);
    EXPECT_GE(world.step().pairs.size(), 1U);
    return true;
  };
  EXPECT_EQ(overlaps(boxes, options), wanted);
}

/// A world of boxes some of which have moved, and the pairs that it must find.
class CallbackOfWorld : public ::testing::Test {
 protected:
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(60, 83, 2.0F));
  std::vector<Box> moved = test::toDouble(test::randomBoxes(60, 84, 2.0F));
  World world;
  test::WorldOracle oracle;
  std::vector<BoxId> ids;

  void start(const WorldOptions& options) {
    world = World(options);
    ids = world.add(boxes);
    for (const BoxId id : ids) oracle.boxes[id] = {boxes[id], {}};
  }

  void moveSome(std::size_t count) {
    std::swap(boxes, moved);
    world.move(std::span<const BoxId>(ids).first(count), BoxView(boxes).slice(0, count));
    for (std::size_t i = 0; i < count; ++i) oracle.boxes[ids[i]].box = boxes[i];
  }

  void compareStep() { test::compareStep(world, oracle); }

  /// After each step that threw, the next one tells what has changed since the last that returned.
  void throwInEachStep(Thrower& thrower) {
    for (const std::size_t count : {std::size_t{60}, std::size_t{8}}) {
      const auto attempt = [&] {
        moveSome(count);
        static_cast<void>(world.step());
        oracle.step();
      };
      throwAtEachCall(thrower, attempt, [&] {
        compareStep();
        moveSome(5);
        compareStep();
      });
    }
  }
};

TEST_F(CallbackOfWorld, AnAcceptThatThrowsLeavesTheWorldUsable) {
  Thrower thrower;
  WorldOptions options;
  options.accept = [&](BoxId, BoxId) {
    thrower.call();
    return true;
  };
  start(options);
  throwInEachStep(thrower);
}

TEST_F(CallbackOfWorld, OnManyThreadsAnAcceptThatThrowsLeavesTheWorldUsable) {
  Thrower thrower;
  test::PoolExecutor threads(3);
  WorldOptions options;
  options.executor = &threads;
  options.accept = [&](BoxId, BoxId) {
    thrower.call();
    return true;
  };
  start(options);
  throwInEachStep(thrower);
}

TEST_F(CallbackOfWorld, AnExecutorThatThrowsLeavesTheWorldUsable) {
  Thrower thrower;
  ThrowingExecutor executor(thrower);
  WorldOptions options;
  options.executor = &executor;
  start(options);
  throwInEachStep(thrower);
}

TEST_F(CallbackOfWorld, AWorldThatItsAcceptCallsRefuses) {
  std::size_t refused = 0;
  std::size_t calls = 0;
  const Box box = test::cube(0, 0, 0);
  const BoxId one = 0;
  const std::span<const BoxId> some(&one, 1);
  const std::vector<std::function<void()>> each{
      [&] { world.reserve(1000); },
      [&] { world.add(box); },
      [&] { static_cast<void>(world.add(boxes)); },
      [&] { world.move(0, box); },
      [&] { world.move(some, BoxView(std::span<const Box>(&box, 1))); },
      [&] { world.moveSwept(some, std::span<const Box>(&box, 1), std::span<const Box>(&box, 1)); },
      [&] { world.moveSwept(some, std::span<const Box>(&box, 1), std::vector<double>(3), 1.0); },
      [&] { world.remove(0); },
      [&] { world.clear(); },
      [&] { world.setProperties(0, {}); },
      [&] { world.invalidate(some); },
      [&] { world.shrink(); },
      [&] { static_cast<void>(world.step()); }};
  const std::vector<std::function<void()>> queries{[&] { static_cast<void>(world.findOverlapping(box)); },
                                                   [&] { static_cast<void>(world.findOverlapping(boxes)); },
                                                   [&] { static_cast<void>(world.findFirst(Ray{})); },
                                                   [&] {
                                                     static_cast<void>(world.findFirst(BoxSweep{box, {}, 1.0}));
                                                   },
                                                   [&] { static_cast<void>(world.findAll(Ray{})); },
                                                   [&] {
                                                     static_cast<void>(world.findAll(BoxSweep{box, {}, 1.0}));
                                                   },
                                                   [&] {
                                                     static_cast<void>(world.findNearest({0, 0, 0}, 1));
                                                   }};
  WorldOptions options;
  std::size_t pairs = 0;
  options.accept = [&](BoxId a, BoxId b) {
    if (test::kIsSanitized && ++pairs % 4 != 0) return true;  // a thousand pairs, and a dozen errors each
    ++calls;
    for (const auto& call : each) refused += isRefused(call) ? 1U : 0U;
    for (const auto& query : queries) EXPECT_FALSE(isRefused(query));
    EXPECT_EQ(world.box(a), oracle.boxes[a].box);
    EXPECT_TRUE(world.contains(b));
    EXPECT_EQ(world.size(), oracle.boxes.size());
    EXPECT_EQ(test::toVector(world.result().pairs), oracle.pairs);
    return true;
  };
  start(options);
  compareStep();
  moveSome(60);
  compareStep();
  moveSome(6);
  compareStep();
  EXPECT_GT(calls, 50U);
  EXPECT_EQ(refused, calls * each.size());
  EXPECT_EQ(test::toVector(world.findBetween(world)).size(), 60 + 2 * oracle.pairs.size());
}

/// Runs tasks on this thread, and calls something else after each of them.
class CallingExecutor final : public Executor {
 public:
  explicit CallingExecutor(const std::function<void()>& call) : m_call(call) {}
  [[nodiscard]] std::size_t concurrency() const noexcept override { return 2; }
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = 0; i < count; ++i) {
      task(i);
      m_call();
    }
  }

 private:
  const std::function<void()>& m_call;
};

/// A world that is called by a task of its executor, by its stop, or by its stop in a task.
class CalledBack : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<Box> boxes = test::toDouble(test::randomBoxes(20000, 85));
  World world;
  std::vector<BoxId> ids;
  bool isOn = false;
  std::atomic<std::size_t> refused = 0;
  std::atomic<std::size_t> refusedLists = 0;
  std::atomic<std::uint64_t> sum = 0;

  std::function<void()> call = [this] { callOnce(); };
  CallingExecutor calling{call};
  test::PoolExecutor threads{3};
  std::function<bool()> ask = [this] {
    callOnce();
    return false;
  };
  StopFlag stop{ask};

  CalledBack() {
    WorldOptions options;
    if (GetParam() == "Task") options.executor = &calling;
    if (GetParam() == "StopInATask") options.executor = &threads;
    if (GetParam() != "Task") options.stop = &stop;
    world = World(options);
    ids = world.add(boxes);
  }

  /// Not again by the callbacks of the calls that it makes.
  void callOnce() {
    thread_local bool isCalling = false;
    if (!isOn || std::exchange(isCalling, true)) return;
    if (isRefused([&] { static_cast<void>(world.findFirst(Ray{})); })) {
      ++refused;
      EXPECT_TRUE(isRefused([&] { world.move(0, boxes[0]); }));
    }
    const auto readLists = [&] {
      for (const Pair& pair : world.result(0U).pairs) sum += pair.second;
    };
    if (isRefused(readLists)) ++refusedLists;
    EXPECT_EQ(world.box(1), boxes[1]);
    EXPECT_TRUE(world.contains(2));
    isCalling = false;
  }
};

INSTANTIATE_TEST_SUITE_P(By, CalledBack, ::testing::Values("Task", "Stop", "StopInATask"),
                         [](const auto& given) { return given.param; });

TEST_P(CalledBack, AStepRefusesAQueryUntilItHasUpdatedTheHierarchies) {
  isOn = true;
  static_cast<void>(world.step());
  EXPECT_GT(refused, 0U);
  isOn = false;
  World other;
  static_cast<void>(other.add(boxes));
  static_cast<void>(other.step());
  const std::vector<Box> moved = test::toDouble(test::randomBoxes(20000, 86));
  for (World* each : {&world, &other}) each->move(ids, moved);
  boxes = moved;
  isOn = true;
  refused = 0;
  test::compareLists(world.step(), other.step());
  EXPECT_GT(refused, 0U);
  for (World* each : {&world, &other}) each->move(ids[0], moved[1]);
  boxes[0] = moved[1];
  test::compareLists(world.step(), other.step());
  EXPECT_GT(refusedLists, 0U);
}

TEST_P(CalledBack, AQueryThatUpdatesTheHierarchiesRefusesAnother) {
  isOn = true;
  const std::vector<BoxId> found = world.findOverlapping(boxes[7]);
  isOn = false;
  EXPECT_GT(refused, 0U);
  EXPECT_EQ(found, world.findOverlapping(boxes[7]));
  EXPECT_EQ(world.step().pairs.size(), countOverlaps(boxes));
}

TEST_F(CallbackOfWorld, AnotherWorldMayBeUsedByAccept) {
  World other;
  WorldOptions options;
  options.accept = [&](BoxId a, BoxId) {
    other.add(boxes[a]);
    static_cast<void>(other.step());
    return !other.findNearest({0, 0, 0}, 1).empty();
  };
  start(options);
  compareStep();
}

TEST(MovedFrom, OverlapsIsAsNew) {
  OverlapOptions options;
  options.distance = 100.0;
  OverlapSearch first(options);
  const std::vector<Box> boxes{test::cube(0, 0, 0), test::cube(0.5, 0, 0), test::cube(9, 0, 0)};
  EXPECT_EQ(first.find(boxes).size(), 3U);
  OverlapSearch second(std::move(first));
  EXPECT_EQ(second.find(boxes).size(), 3U);
  // NOLINTBEGIN(bugprone-use-after-move): what is tested
  EXPECT_EQ(first.options().distance, 0.0);
  EXPECT_EQ(first.statistics().pairs, 0U);
  EXPECT_EQ(first.find(boxes).size(), 1U);
  first = std::move(second);
  EXPECT_EQ(second.count(boxes), 1U);
  OverlapSearch third(std::move(second));
  second.setOptions(options);
  EXPECT_EQ(second.count(boxes), 3U);
  // NOLINTEND(bugprone-use-after-move)
}

TEST(MovedFrom, AWorldIsAsNew) {
  World first;
  const BoxId id = first.add(test::cube(0, 0, 0));
  static_cast<void>(first.step());
  const auto expectNew = [](World& world) {
    EXPECT_EQ(world.size(), 0U);
    EXPECT_EQ(world.idBound(), 0U);
    EXPECT_FALSE(world.contains(0));
    EXPECT_EQ(world.options().distance, 0.0);
    EXPECT_EQ(world.statistics().rebuilds, 0U);
    EXPECT_TRUE(world.result().pairs.empty());
    EXPECT_THROW(static_cast<void>(world.box(0)), InvalidBox);
    EXPECT_THROW(static_cast<void>(world.properties(0)), InvalidBox);
  };
  // NOLINTBEGIN(bugprone-use-after-move): what is tested
  World second(std::move(first));
  EXPECT_TRUE(second.contains(id));
  expectNew(first);
  EXPECT_TRUE(first.step().pairs.empty());
  World third(std::move(first));
  EXPECT_TRUE(first.findNearest({0, 0, 0}, 1).empty());
  World fourth(std::move(first));
  expectNew(first);
  first.clear();
  EXPECT_EQ(first.add(test::cube(0, 0, 0)), 0U);
  World fifth(std::move(first));
  EXPECT_EQ(second.findBetween(first).size(), 0U);
  EXPECT_EQ(second.findBetween(fifth).size(), 1U);
  // NOLINTEND(bugprone-use-after-move)
}

}  // namespace
}  // namespace allpairs
