// SPDX-License-Identifier: MIT
// What searches leave behind in a process: nothing, whatever threads they ran in and however those ended.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "support/Boxes.h"
#include "support/FailingAllocation.h"
#include "support/ProcessMemory.h"
#include "support/Sanitizers.h"

namespace allpairs {
namespace {

constexpr std::size_t kThreads = 10000;

/// A few MiB are what the C library's arenas differ by. A kilobyte for each thread would be 10.
constexpr double kSlack = 6;

/// How much the process holds after so many threads, each of which has done that once, beyond what it held after a few.
template <class Work>
double growthOverThreads(const Work& work) {
  for (std::size_t i = 0; i < 100; ++i) std::thread(work).join();
  const double before = test::residentMegabytes();
  for (std::size_t i = 0; i < kThreads; ++i) std::thread(work).join();
  return test::residentMegabytes() - before;
}

class Threads : public ::testing::Test {
 protected:
  void SetUp() override {
    if (test::kIsSanitized) GTEST_SKIP() << "a sanitizer holds memory of its own for threads";
  }

  const std::vector<BoxF> boxes = test::randomBoxes(400, 61);
};

TEST_F(Threads, ThatSearchOnceLeaveNothing) {
  EXPECT_LT(growthOverThreads([&] { static_cast<void>(overlaps(boxes)); }), kSlack);
}

TEST_F(Threads, ThatEndWithASearchOfTheirOwnLeaveNothing) {
  const auto work = [&] {
    thread_local std::unique_ptr<OverlapSearch> search;
    search = std::make_unique<OverlapSearch>();
    static_cast<void>(search->find(boxes));
  };
  EXPECT_LT(growthOverThreads(work), kSlack);
}

TEST_F(Threads, ThatEndWithAWorldOfTheirOwnLeaveNothing) {
  const auto work = [&] {
    thread_local std::unique_ptr<World> world;
    world = std::make_unique<World>();
    static_cast<void>(world->add(boxes));
    static_cast<void>(world->step());
  };
  EXPECT_LT(growthOverThreads(work), kSlack);
}

TEST(Process, HoldsNothingOfMillionsOfBoxesThatAreGone) {
  if (test::kIsSanitized) GTEST_SKIP() << "a sanitizer holds freed memory";
  static_cast<void>(overlaps(test::lent(test::randomBoxes(100000, 62))));
  const double before = test::residentMegabytes();
  {
    const std::vector<BoxF> boxes = test::randomBoxes(4000000, 62);
    OverlapSearch search;
    EXPECT_GT(search.find(boxes).size(), 1000000U);
    EXPECT_GT(test::residentMegabytes() - before, 150);
  }
  EXPECT_LT(test::residentMegabytes() - before, 4);
}

TEST(Process, AChildThatIsForkedDuringSearchesOfOtherThreadsSearches) {
  if (test::kIsSanitized) GTEST_SKIP() << "the allocator of a sanitizer does not survive a fork among threads";
  const std::vector<BoxF> boxes = test::randomBoxes(3000, 63);
  const std::vector<Pair> wanted = overlaps(boxes);
  std::atomic<bool> ends = false;
  std::vector<std::thread> others;
  for (int i = 0; i < 3; ++i) {
    others.emplace_back([&] {
      while (!ends) static_cast<void>(overlaps(boxes));
    });
  }
  for (int i = 0; i < 50; ++i) {
    const pid_t child = fork();
    if (child == 0) _exit(overlaps(boxes) == wanted ? 0 : 1);
    int status = -1;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
  }
  ends = true;
  for (std::thread& other : others) other.join();
}

TEST(Process, TheFirstSearchOfAThreadThatIsOutOfMemoryThrows) {
  const std::vector<BoxF> boxes = test::randomBoxes(1000, 64);
  const std::vector<Pair> wanted = overlaps(boxes);
  std::thread([] {}).join();  // The C library keeps what the first thread of a process needs.
  const auto scene = [&](test::Fault& fault) {
    std::vector<Pair> found;
    bool passed = false;
    std::thread([&] { passed = fault.during([&] { found = overlaps(boxes); }); }).join();
    if (passed) {
      EXPECT_EQ(found, wanted);
    }
  };
  test::failEachAllocation(scene);
}

/// Made before anything that the engine makes once, and so destroyed after that.
struct LastOfAll {
  ~LastOfAll() {
    if (overlaps(test::lent(test::randomBoxes(1000, 65))).size() < 1000) _exit(3);
    _exit(0);  // Not seen by the parent unless the line above has returned.
  }
};

TEST(Process, ADestructorOfAStaticObjectMaySearch) {
  const pid_t child = fork();
  if (child == 0) {
    static const LastOfAll last;
    static_cast<void>(overlaps(test::lent(test::randomBoxes(1000, 65))));
    std::exit(4);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

}  // namespace
}  // namespace allpairs
