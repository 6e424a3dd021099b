// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "Clash.h"
#include "Since.h"
#include "allpairs/scene/WriteResult.h"

namespace allpairs::view {

/// Where a clash's picture lies in the folder of a report: pictures/0001.png.
[[nodiscard]] std::string pictureName(std::size_t number);

/// Something to know about a report: when it was made, of what, how.
struct ReportFact {
  std::string name;
  std::string text;
};

/// What a report is of.
struct Report {
  const ViewScene& scene;
  std::span<const Clash> clashes;
  std::size_t pictured = 0;      ///< How many, from the first one, have pictures beside the page.
  const Since* since = nullptr;  ///< What has become of an earlier report, if there is one.
  std::vector<ReportFact> facts{};
  /// Why there is no page, view.html, beside it that shows clashes in 3D; empty: there is one.
  std::string withoutPage{};
};

/// A length's unit as a word: 0.001 metres are "millimetres"; "units of 0.7 m" where no word is known.
[[nodiscard]] std::string unitText(double metres);

/// Writes the page of a report.
void writeReportPage(const Report& report, scene::ByteSink sink);

/// Writes a line for each pair, those of a row with its number and GUID: number, names, overlap per axis, volume and
/// GUID (RFC 4180), and where models are of files, the file of each and where it is in there.
///
/// Where models have a GlobalId, four columns more: the class and the GlobalId of each. With an earlier report one
/// more, "since": new, persisting or resolved; those that are resolved come last and have no number.
void writeReportCsv(const Report& report, scene::ByteSink sink);

}  // namespace allpairs::view
