// SPDX-License-Identifier: MIT
// How evenly a join splits, by counting tests: without a clock, and with more threads than a test machine has.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include "allpairs/generate/BoxScenes.h"
#include "bvh/BvhBuilder.h"
#include "input/Options.h"
#include "search/TaskCut.h"

namespace allpairs::engine {
namespace {

constexpr std::size_t kBoxes = 100000;

/// Tests that each task of a join of a scene with itself does; of one task if threads is 1.
std::vector<std::uint64_t> workOfTasks(const std::string& scene, std::size_t threads) {
  const std::vector<float> rows = generate::makeBoxes({.scene = scene, .count = kBoxes});
  const BoxView boxes = BoxView::fromRows(std::span<const float>(rows));
  const OverlapOptions options;
  SerialExecutor serial;
  BvhBuilder builder(defaultMemory());
  const Kernels& kernels = chooseKernels(options.instructionSet);
  builder.build(BoxReader(boxes, options, kernels), serial);
  const BvhView view = builder.levels().view();
  const std::size_t leaves = view.level[0].blockCount();
  const TaskCut cut = TaskCut::ofLeaves(leaves, builder.firstLarge() / kFanOut, threads);
  JoinScratch scratch(defaultMemory());
  std::vector<std::uint64_t> work;
  for (std::size_t task = 0; task < cut.tasks(); ++task) {
    Hits hits;
    hits.countOnly = true;
    kernels.join({&view, &view, true, cut.begin(task), cut.begin(task + 1), &scratch}, hits);
    work.push_back(hits.boxTests + hits.groupTests);
  }
  return work;
}

/// When the last of the threads is done if each takes the next task when it is free.
std::uint64_t finishOf(const std::vector<std::uint64_t>& work, std::size_t threads) {
  std::vector<std::uint64_t> busy(threads, 0);
  for (const std::uint64_t task : work) *std::min_element(busy.begin(), busy.end()) += task;
  return *std::max_element(busy.begin(), busy.end());
}

struct Scene {
  const char* name;
  std::uint64_t percentBusy;
};

void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

class Split : public testing::TestWithParam<Scene> {};

TEST_P(Split, KeepsSixtyFourThreadsBusyForMostOfTheTime) {
  constexpr std::size_t kThreads = 64;
  const std::vector<std::uint64_t> work = workOfTasks(GetParam().name, kThreads);
  const std::uint64_t whole = workOfTasks(GetParam().name, 1).front();
  const std::uint64_t sum = std::accumulate(work.begin(), work.end(), std::uint64_t{0});
  const std::uint64_t finish = finishOf(work, kThreads);
  RecordProperty("tasks", static_cast<int>(work.size()));
  RecordProperty("percent_more_work", static_cast<int>(100 * (sum - whole) / whole));
  RecordProperty("percent_busy", static_cast<int>(100 * sum / (finish * kThreads)));
  EXPECT_LT(sum, whole + whole / 8) << "each task goes down from the root again";
  EXPECT_GT(100 * sum, finish * kThreads * GetParam().percentBusy) << "a thread waits while others work";
}

// On a surface a block of 16 may lie on both sides of a gap in the curve. It then has a thousand times the partners of
// others, and nobody can share it.
INSTANTIATE_TEST_SUITE_P(Scenes, Split,
                         testing::Values(Scene{"uniform", 85}, Scene{"clusters", 75}, Scene{"power-law", 85},
                                         Scene{"city", 85}, Scene{"mesh", 45}));

}  // namespace
}  // namespace allpairs::engine
