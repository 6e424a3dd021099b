// SPDX-License-Identifier: MIT
// Runs a scene of SOFA and, after each step, hands its models to several broad phases in turn: prints how long each of
// them takes a step, in processor time of the calling thread and in elapsed time, and whether all give the same list.
#include <ctime>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <utility>

#include "SceneRun.h"

namespace {

using allpairs::tools::BroadPhase;
using allpairs::tools::SceneRun;
using Models = sofa::type::vector<sofa::core::CollisionModel*>;

double now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

/// A broad phase and the microseconds of its steps.
struct Entry {
  std::string name;
  BroadPhase* phase = nullptr;
  std::vector<double> processor;
  std::vector<double> elapsed;
  bool sameList = true;
};

void detect(Entry& entry, const Models& models) {
  const double processorBefore = now(CLOCK_THREAD_CPUTIME_ID);
  const double before = now(CLOCK_MONOTONIC);
  entry.phase->beginBroadPhase();
  entry.phase->addCollisionModels(models);
  entry.phase->endBroadPhase();
  entry.elapsed.push_back(now(CLOCK_MONOTONIC) - before);
  entry.processor.push_back(now(CLOCK_THREAD_CPUTIME_ID) - processorBefore);
}

/// Each in its turn comes first after the step, when the models have left the caches.
void detectAll(std::vector<Entry>& entries, const Models& models, std::size_t turn) {
  for (std::size_t i = 0; i < entries.size(); ++i) detect(entries[(i + turn) % entries.size()], models);
  const auto& expected = entries.front().phase->getCollisionModelPairs();
  for (Entry& entry : entries) entry.sameList = entry.sameList && entry.phase->getCollisionModelPairs() == expected;
}

std::pair<double, double> minimumAndMedian(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2]};
}

void print(const std::vector<Entry>& entries, std::size_t models) {
  std::printf("%zu models, %zu pairs, microseconds a step\n", models,
              entries.front().phase->getCollisionModelPairs().size());
  std::printf("%-32s %12s %12s %12s %12s  %s\n", "", "cpu min", "cpu median", "elapsed min", "elapsed med", "list");
  for (const Entry& entry : entries) {
    const auto [cpuMin, cpuMedian] = minimumAndMedian(entry.processor);
    const auto [min, median] = minimumAndMedian(entry.elapsed);
    std::printf("%-32s %12.1f %12.1f %12.1f %12.1f  %s\n", entry.name.c_str(), cpuMin, cpuMedian, min, median,
                entry.sameList ? "same" : "DIFFERS");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto settings = allpairs::tools::readSettings(argc, argv);
    SceneRun run(settings);
    std::vector<Entry> entries;
    for (const std::string& name : settings.broadPhases) {
      entries.push_back({name, &run.make(name), {}, {}, true});
      entries.back().phase->setIntersectionMethod(run.intersectionMethod());
    }
    if (entries.empty()) throw std::runtime_error("which --broad-phase?");
    for (int step = 0; step < settings.steps; ++step) {
      run.step();
      detectAll(entries, run.activeRoots(), static_cast<std::size_t>(step));
    }
    print(entries, run.activeRoots().size());
    return 0;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "time-broad-phases: %s\n", problem.what());
    return 2;
  }
}
