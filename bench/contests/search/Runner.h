// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "Plan.h"
#include "Results.h"

namespace allpairs::bench {

/// What the user chose.
struct RunOptions {
  Plan plan;
  std::vector<std::string> peers;       ///< Only these; all if empty.
  std::vector<std::size_t> threads{1};  ///< For the thread cells.
  std::string instructionSet;           ///< Empty means the best.
  std::uint64_t seed = 1;
};

/// Carries a plan out: prints a table for each cell as it is done, and keeps the records.
class Runner {
 public:
  Runner(RunOptions options, Results& results);

  /// How many contenders gave pairs that differ from ours.
  [[nodiscard]] std::size_t run();

 private:
  void runCell(const Cell& cell);
  void runThreads(const Cell& cell);
  void runKernel(const Cell& cell);
  [[nodiscard]] std::vector<Contender> ownContenders() const;
  [[nodiscard]] OverlapOptions optionsFor(Order order) const;
  [[nodiscard]] std::vector<float> boxesOf(const Cell& cell, std::size_t set = 0) const;
  [[nodiscard]] BoxSets setsOf(const Cell& cell) const;
  [[nodiscard]] bool isWanted(const Peer& peer) const;
  [[nodiscard]] const Setting* settingFor(const Peer& peer, const Cell& cell);
  void keep(const Cell& cell, const std::vector<Contender>& contenders);

  RunOptions m_options;
  Results& m_results;
  std::vector<Peer> m_peers;
  std::map<std::pair<std::string, std::string>, const Setting*> m_settings;  // By peer, and scene with its size.
  std::size_t m_mistakes = 0;
};

}  // namespace allpairs::bench
