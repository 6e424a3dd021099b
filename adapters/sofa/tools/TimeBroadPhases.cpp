// SPDX-License-Identifier: MIT
// Runs a scene of SOFA with several broad phases in the place of its own, each first in its turn: prints how long each
// of them takes a step, in processor time of the calling thread and in elapsed time, and whether all give the same
// lists; ends with 1 if they do not.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <utility>

#include "Contest.h"

namespace {

using allpairs::tools::Contest;
using allpairs::tools::Contestant;
using allpairs::tools::SceneRun;

/// All broad phases of the scene, which are contests, with the contestants entered.
std::vector<Contest*> enterAll(SceneRun& run, const std::vector<std::string>& names) {
  std::vector<Contest*> contests;
  for (allpairs::tools::BroadPhase* phase : run.broadPhases()) contests.push_back(dynamic_cast<Contest*>(phase));
  if (contests.empty()) throw std::runtime_error("the scene has no broad phase");
  for (Contest* contest : contests) {
    for (const std::string& name : names) contest->enter(name, run.make(name));
  }
  return contests;
}

std::pair<double, double> minimumAndMedian(std::vector<double> values) {
  if (values.empty()) return {0.0, 0.0};
  std::sort(values.begin(), values.end());
  return {values.front(), values[values.size() / 2]};
}

void print(const Contestant& contestant) {
  const auto [cpuMin, cpuMedian] = minimumAndMedian(contestant.processor);
  const auto [min, median] = minimumAndMedian(contestant.elapsed);
  std::printf("%-32s %5zu %12.1f %12.1f %12.1f %12.1f  %s\n", contestant.name.c_str(), contestant.elapsed.size(),
              cpuMin, cpuMedian, min, median, contestant.sameLists ? "same" : "DIFFERS");
}

void print(const Contest& contest) {
  std::printf("%s: %zu models, %zu pairs, microseconds a step\n", contest.getPathName().c_str(), contest.models(),
              contest.pairs());
  std::printf("%-32s %5s %12s %12s %12s %12s  %s\n", "", "steps", "cpu min", "cpu median", "elapsed min", "elapsed med",
              "lists");
  for (const Contestant& contestant : contest.contestants()) print(contestant);
}

bool haveSameLists(const Contest* contest) {
  const auto& contestants = contest->contestants();
  return std::all_of(contestants.begin(), contestants.end(), [](const Contestant& c) { return c.sameLists; });
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto settings = allpairs::tools::readSettings(argc, argv);
    if (settings.broadPhases.empty()) throw std::runtime_error("which --broad-phase?");
    Contest::enterInFactory();
    SceneRun run(settings, "Contest");
    const std::vector<Contest*> contests = enterAll(run, settings.broadPhases);
    for (int step = 0; step < settings.steps; ++step) run.step();
    for (const Contest* contest : contests) print(*contest);
    return std::all_of(contests.begin(), contests.end(), haveSameLists) ? 0 : 1;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "time-broad-phases: %s\n", problem.what());
    return 2;
  }
}
