// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "Clash.h"
#include "allpairs/collision/ExactPair.h"

namespace allpairs::view {

/// Where a model of an earlier report was.
struct EarlierPlace {
  std::string file{};  ///< Empty where the report says nothing of it.
  std::string path{};
};

/// A row of an earlier report.
struct EarlierClash {
  std::string guid;
  std::string first;
  std::string second;
  std::optional<ExactState> state{};  ///< Of its worst pair, where shapes were tested.
  std::optional<double> depth{};      ///< Of that pair.
  std::array<EarlierPlace, 2> places{};
  std::optional<std::array<double, 3>> point{};  ///< Where that pair meets, or is nearest.
};

/// What has become of an earlier report's rows.
struct Since {
  std::string name;                  ///< What the earlier report is called.
  std::size_t added = 0;             ///< How many rows are new.
  std::size_t persisting = 0;        ///< How many it had.
  std::size_t resolved = 0;          ///< How many were clashes, or no longer are rows.
  std::vector<EarlierClash> gone{};  ///< Those that are no rows any more.
};

/// Whether a text begins as a report's clashes.csv does.
[[nodiscard]] bool isReportCsv(std::string_view text);

/// The rows of a report's clashes.csv, each once.
///
/// Bad input: a text that no report has written throws Error.
[[nodiscard]] std::vector<EarlierClash> readReportCsv(std::string_view text);

/// Compares rows with those of an earlier report, by their GUIDs and states, and notes in each what has become of it.
/// Rows whose GUIDs only one of the two has, such as of parts that are in another assembly now, are the same where
/// both their models have the same places, or else meet at the same point and have the same places but for the first
/// folders of their files, or else have the same names, and no other such row has; they keep the earlier GUID.
/// A new row whose GUID an earlier one has kept that way gets another.
[[nodiscard]] Since compareWith(const std::vector<EarlierClash>& earlier, std::string name, const ViewScene& scene,
                                std::span<Clash> clashes);

/// The word for it: new, persisting, resolved.
[[nodiscard]] std::string_view changeName(Change change);

/// "2 new, 3 persisting, 1 resolved".
[[nodiscard]] std::string countText(const Since& since);

}  // namespace allpairs::view
