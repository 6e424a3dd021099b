// SPDX-License-Identifier: MIT
#include "Runner.h"

#include <algorithm>
#include <cstdio>

#include "allpairs/Overlaps.h"
#include "allpairs/generate/BoxScenes.h"
#include "allpairs/parallel/TbbExecutor.h"

namespace allpairs::bench {

namespace {

constexpr std::size_t kTrialBoxes = 100000;  // Settings of peers are chosen on no more boxes than this.

void printHeading(const Cell& cell, const Outcome& outcome) {
  std::printf("\n%s, %zu boxes", sceneName(cell).c_str(), cell.boxes);
  if (!outcome.hash.empty()) {
    std::printf(", %llu pairs, hash %s", static_cast<unsigned long long>(outcome.pairs), outcome.hash.c_str());
  }
  std::printf("\n");
  std::printf("  %-20s %3s %12s %12s %12s %12s %5s %8s  %s\n", "", "T", "median ms", "cpu ms", "min ms", "max ms",
              "runs", "ratio", "setting");
}

void printLine(const Contender& contender, const Outcome& outcome, double reference) {
  const measure::Summary& t = outcome.times;
  std::printf("  %-20s %3zu %12.4f %12.4f %12.4f %12.4f %5zu %8.2f  %s%s%s\n", contender.name.c_str(),
              contender.threads, t.medianMs, t.medianCpuMs, t.minMs, t.maxMs, t.repetitions, t.medianCpuMs / reference,
              contender.setting.c_str(), outcome.mistake.empty() ? "" : "  WRONG: ", outcome.mistake.c_str());
}

void printTable(const Cell& cell, const std::vector<Contender>& contenders, const std::vector<Outcome>& outcomes) {
  printHeading(cell, outcomes.front());
  for (std::size_t k = 0; k < contenders.size(); ++k) {
    printLine(contenders[k], outcomes[k], outcomes.front().times.medianCpuMs);
  }
  std::fflush(stdout);
}

}  // namespace

Runner::Runner(RunOptions options, Results& results)
    : m_options(std::move(options)), m_results(results), m_peers(packagedPeers()) {}

std::size_t Runner::run() {
  for (const Cell& cell : m_options.plan.cells) runCell(cell);
  m_peers.clear();  // While it lives, Embree holds the threads of the whole process to those that it was given.
  for (const Cell& cell : m_options.plan.threadCells) runThreads(cell);
  for (const Cell& cell : m_options.plan.kernelCells) runKernel(cell);
  return m_mistakes;
}

void Runner::runCell(const Cell& cell) {
  std::vector<Contender> contenders = ownContenders();
  for (const Peer& peer : m_peers) {
    const Setting* const setting = isWanted(peer) ? settingFor(peer, cell) : nullptr;
    if (setting == nullptr || cell.boxes > setting->mostBoxes) continue;
    contenders.push_back({.name = peer.name, .setting = setting->name, .make = setting->make});
  }
  keep(cell, contenders);
}

void Runner::runThreads(const Cell& cell) {
  std::vector<std::unique_ptr<parallel::TbbExecutor>> executors;
  std::vector<Contender> contenders;
  for (const std::size_t threads : m_options.threads) {
    executors.push_back(std::make_unique<parallel::TbbExecutor>(threads));
    OverlapOptions options = optionsFor(Order::Unordered);
    if (threads > 1) options.executor = executors.back().get();
    contenders.push_back(
        {.name = "allpairs", .setting = "unordered", .threads = threads, .make = freshSearches(options)});
  }
  keep(cell, contenders);
}

void Runner::runKernel(const Cell& cell) {
  std::vector<Contender> contenders;
  for (const std::string_view instructionSet : instructionSets()) {
    OverlapOptions options;
    options.strategy = Strategy::Exhaustive;
    options.instructionSet = instructionSet;
    contenders.push_back({.name = "allpairs count",
                          .setting = std::string(instructionSet),
                          .make = countingSearches(options),
                          .givesPairs = false});
  }
  keep(cell, contenders);
}

std::vector<Contender> Runner::ownContenders() const {
  const OverlapOptions ordered = optionsFor(Order::ByFirst);
  const OverlapOptions unordered = optionsFor(Order::Unordered);
  return {{.name = "allpairs", .setting = "unordered", .make = freshSearches(unordered)},
          {.name = "allpairs ordered", .setting = "ordered", .make = freshSearches(ordered)},
          {.name = "allpairs vector", .setting = "ordered, a vector", .make = vectorSearches(ordered)},
          {.name = "allpairs warm", .setting = "unordered, memory kept", .make = warmSearches(unordered)},
          {.name = "allpairs count", .setting = "count", .make = countingSearches(unordered), .givesPairs = false}};
}

OverlapOptions Runner::optionsFor(Order order) const {
  OverlapOptions options;
  options.order = order;
  options.instructionSet = m_options.instructionSet;
  return options;
}

std::vector<float> Runner::boxesOf(const Cell& cell, std::size_t set) const {
  return generate::makeBoxes(
      {.scene = cell.scene, .count = cell.boxes, .seed = m_options.seed + set, .sorted = cell.sorted});
}

/// So many that no processor remembers their branches.
BoxSets Runner::setsOf(const Cell& cell) const {
  constexpr std::size_t kBoxes = 40000;
  constexpr std::size_t kManyBoxes = 1000000;
  const std::size_t fewest = cell.boxes > kManyBoxes ? 1 : 3;
  BoxSets sets(std::max(fewest, kBoxes / std::max<std::size_t>(cell.boxes, 100)));
  for (std::size_t i = 0; i < sets.size(); ++i) sets[i] = boxesOf(cell, i);
  return sets;
}

bool Runner::isWanted(const Peer& peer) const {
  const auto& only = m_options.peers;
  return only.empty() || std::find(only.begin(), only.end(), peer.name) != only.end();
}

const Setting* Runner::settingFor(const Peer& peer, const Cell& cell) {
  Cell trial = cell;
  trial.boxes = std::min(trial.boxes, kTrialBoxes);
  const auto [entry, isNew] = m_settings.try_emplace({peer.name, sceneName(trial) + std::to_string(trial.boxes)});
  if (isNew) entry->second = fastestSetting(peer, boxesOf(trial));
  return entry->second;
}

void Runner::keep(const Cell& cell, const std::vector<Contender>& contenders) {
  const std::vector<Outcome> outcomes = contest(contenders, setsOf(cell), m_options.plan.effort);
  printTable(cell, contenders, outcomes);
  m_results.add(cell, contenders, outcomes);
  m_mistakes += static_cast<std::size_t>(
      std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) { return !o.mistake.empty(); }));
}

}  // namespace allpairs::bench
