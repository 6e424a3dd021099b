// SPDX-License-Identifier: MIT
// allpairs_bench: Allpairs and its peers on the same boxes, in turn, their pairs compared.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <thread>

#include "Runner.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/generate/BoxScenes.h"

namespace {

using namespace allpairs;

/// The command line as it was given.
struct Arguments {
  bool quick = false;
  std::vector<std::string> scenes;
  std::vector<std::string> parts;
  std::size_t mostBoxes = std::numeric_limits<std::size_t>::max();
  double secondsEach = 0.0;
  std::string output = "benchmarks.csv";
  bench::RunOptions run;
};

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const generate::BoxScene& scene : generate::boxScenes()) names.emplace_back(scene.name);
  return names;
}

std::vector<std::string> peerNames() {
  std::vector<std::string> names{"none"};
  for (const bench::Peer& peer : bench::packagedPeers()) names.push_back(peer.name);
  return names;
}

void declare(CLI::App& app, Arguments& a) {
  app.add_flag("--quick", a.quick, "A few scenes of up to 10,000 boxes: under a minute");
  app.add_option("--part", a.parts, "Only these parts (repeatable)")
      ->check(CLI::IsMember({"contest", "threads", "kernel"}));
  app.add_option("--scene", a.scenes, "Only these scenes (repeatable)")->check(CLI::IsMember(sceneNames()));
  app.add_option("--most-boxes", a.mostBoxes, "Leave out scenes of more boxes than this");
  app.add_option("--peer", a.run.peers, "Only these peers, by name (repeatable); 'none' for ours alone")
      ->check(CLI::IsMember(peerNames()));
  app.add_option("--threads", a.run.threads, "Numbers of threads for the scaling part")->delimiter(',');
  app.add_option("--instruction-set", a.run.instructionSet, "Run ours with this instruction set");
  app.add_option("--seconds", a.secondsEach, "Time for each contender on each scene");
  app.add_option("--seed", a.run.seed, "Seed of the scenes");
  app.add_option("-o,--output", a.output, "Where the records go, as CSV")->capture_default_str();
}

void keepOnly(std::vector<bench::Cell>& cells, const char* part, const Arguments& a) {
  if (!a.parts.empty() && std::find(a.parts.begin(), a.parts.end(), part) == a.parts.end()) cells.clear();
  std::erase_if(cells, [&](const bench::Cell& cell) {
    const bool named = a.scenes.empty() || std::find(a.scenes.begin(), a.scenes.end(), cell.scene) != a.scenes.end();
    return !named || cell.boxes > a.mostBoxes;
  });
}

void choosePlan(Arguments& a) {
  a.run.plan = a.quick ? bench::quickPlan() : bench::fullPlan();
  if (a.secondsEach > 0.0) a.run.plan.effort.seconds = a.secondsEach;
  keepOnly(a.run.plan.cells, "contest", a);
  keepOnly(a.run.plan.threadCells, "threads", a);
  keepOnly(a.run.plan.kernelCells, "kernel", a);
  const bench::Plan& plan = a.run.plan;
  if (plan.cells.empty() && plan.threadCells.empty() && plan.kernelCells.empty()) {
    throw InvalidArgument("no scene of these parts, names and numbers of boxes is measured");
  }
}

/// 1, 2, 4, ... and as many as the machine has.
std::vector<std::size_t> allThreadCounts() {
  std::vector<std::size_t> counts;
  const std::size_t most = std::max(1U, std::thread::hardware_concurrency());
  for (std::size_t threads = 1; threads < most; threads *= 2) counts.push_back(threads);
  counts.push_back(most);
  return counts;
}

int runBenchmarks(Arguments& a) {
  choosePlan(a);
  const std::string_view best = instructionSets().front();
  bench::Results results(a.output, a.run.instructionSet.empty() ? std::string(best) : a.run.instructionSet);
  const std::size_t mistakes = bench::Runner(a.run, results).run();
  if (mistakes != 0) std::fprintf(stderr, "allpairs_bench: %zu results differ from ours\n", mistakes);
  return mistakes == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures Allpairs and its peers on the same boxes, in turn, and compares their pairs.");
  Arguments arguments;
  arguments.run.threads = allThreadCounts();
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    return runBenchmarks(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "allpairs_bench: %s\n", error.what());
    return 3;
  }
}
