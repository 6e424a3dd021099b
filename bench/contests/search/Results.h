// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "Contest.h"
#include "Plan.h"
#include "Provenance.h"

namespace allpairs::bench {

/// Writes one line of a CSV file for each outcome, at once, so that what was measured is kept if a run is cut short.
///
/// The columns are named in the first line; docs/benchmarks.md says what they hold.
class Results {
 public:
  /// Bad input: throws FileError if the file can't be written.
  explicit Results(const std::filesystem::path& path, std::string instructionSet);

  void add(const Cell& cell, const std::vector<Contender>& contenders, const std::vector<Outcome>& outcomes);

 private:
  std::filesystem::path m_path;
  std::ofstream m_file;
  measure::Provenance m_provenance;
  std::string m_instructionSet;
};

/// The scene as reports call it: its name, and "-sorted" if it is.
[[nodiscard]] std::string sceneName(const Cell& cell);

}  // namespace allpairs::bench
