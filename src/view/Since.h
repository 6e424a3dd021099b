// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Clash.h"

namespace allpairs::view {

/// A row of an earlier report.
struct EarlierClash {
  std::string guid;
  std::string first;
  std::string second;
};

/// What has become of an earlier report's rows.
struct Since {
  std::string name;                      ///< What the earlier report is called.
  std::size_t added = 0;                 ///< How many rows it did not have.
  std::size_t persisting = 0;            ///< How many it had.
  std::vector<EarlierClash> resolved{};  ///< Those that are none any more.
};

/// Whether a text begins as a report's clashes.csv does.
[[nodiscard]] bool isReportCsv(std::string_view text);

/// The rows of a report's clashes.csv, each once.
///
/// Bad input: a text that no report has written throws Error.
[[nodiscard]] std::vector<EarlierClash> readReportCsv(std::string_view text);

/// Compares rows with those of an earlier report, by their GUIDs, and notes in each whether it is new.
[[nodiscard]] Since compareWith(const std::vector<EarlierClash>& earlier, std::string name, std::span<Clash> clashes);

/// "2 new, 3 persisting, 1 resolved".
[[nodiscard]] std::string countText(const Since& since);

}  // namespace allpairs::view
