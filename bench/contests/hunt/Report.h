// SPDX-License-Identifier: MIT
#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "Match.h"

namespace allpairs::bench {

/// All that was measured in a hunt.
class Report {
 public:
  /// Bad input: throws FileError if the file can't be written; without a name, none is written.
  explicit Report(const std::string& path);

  void add(const MatchResult& result);

  [[nodiscard]] std::size_t scenes() const noexcept { return m_results.size(); }
  [[nodiscard]] std::size_t mistakes() const noexcept { return m_mistakes; }
  [[nodiscard]] double worstRatio() const noexcept { return m_worst; }

  /// The worst scenes, and the summary.
  void print() const;

 private:
  void write(const MatchResult& result);
  void printMistakes(const MatchResult& result);

  std::string m_path;
  std::ofstream m_file;
  std::vector<MatchResult> m_results;
  std::size_t m_mistakes = 0;
  double m_worst = std::numeric_limits<double>::infinity();
};

/// The times of all contenders on one scene.
void printInDetail(const MatchResult& result);

}  // namespace allpairs::bench
