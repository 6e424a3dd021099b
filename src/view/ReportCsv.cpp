// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "Report.h"
#include "Text.h"

namespace allpairs::view {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

/// A name as a cell that no spreadsheet takes for a formula: an apostrophe before it says that it is text.
std::string cellOf(const std::string& name) {
  const std::string text = validUtf8(name);
  return quoted(looksLikeFormula(text) ? "'" + text : text);
}

std::string csvMeasuresOf(const Clash& clash) {
  if (clash.exact == nullptr)
    return fmt::format("{},{},{},{}", clash.overlap[0], clash.overlap[1], clash.overlap[2], clash.volume);
  const ExactPair& pair = *clash.exact;
  if (pair.state == ExactState::NotExamined) return fmt::format("{},,,,,,,,,", stateName(pair.state));
  const auto [x, y, z] = allpairs::placeOf(pair);
  return fmt::format("{},{},{},{},{},{},{},{},{},{}", stateName(pair.state),
                     pair.depth ? fmt::to_string(*pair.depth) : "", pair.distance, x, y, z, pair.normal[0],
                     pair.normal[1], pair.normal[2], pair.contactCount);
}

std::string idCellsOf(const ViewScene& scene, std::uint32_t model) {
  if (scene.ids.empty()) return {};
  return ',' + cellOf(scene.kinds[model]) + ',' + cellOf(scene.ids[model]);
}

std::string placeCellsOf(const ViewScene& scene, std::uint32_t model) {
  if (scene.files.empty()) return {};
  return ',' + cellOf(scene.fileNames[scene.files[model]]) + ',' + cellOf(scene.paths[model]);
}

std::string placeCellsOf(const ViewScene& scene, const EarlierClash& clash) {
  if (scene.files.empty()) return {};
  return fmt::format(",{},{},{},{}", cellOf(clash.places[0].file), cellOf(clash.places[0].path),
                     cellOf(clash.places[1].file), cellOf(clash.places[1].path));
}

/// A pair of a row.
void writeCsvLine(const ViewScene& scene, const Clash& row, const Clash& pair, scene::ByteSink sink) {
  const std::string since = row.since ? ',' + std::string(changeName(*row.since)) : "";
  sink(fmt::format("{},{},{},{}{}{}{},{}{}{}\n", row.number, cellOf(scene.name(pair.first)),
                   cellOf(scene.name(pair.second)), csvMeasuresOf(pair), idCellsOf(scene, pair.first),
                   idCellsOf(scene, pair.second), since, row.guid, placeCellsOf(scene, pair.first),
                   placeCellsOf(scene, pair.second)));
}

bool isAscii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

bool isAscii(const EarlierClash& clash) {
  return isAscii(clash.first) && isAscii(clash.second) &&
         std::all_of(clash.places.begin(), clash.places.end(),
                     [](const EarlierPlace& place) { return isAscii(place.file) && isAscii(place.path); });
}

/// Whether all that the table may say of models is, those of rows that are gone included.
bool isAscii(const Report& report) {
  const ViewScene& scene = report.scene;
  const auto areAscii = [](const auto& all) {
    return std::all_of(all.begin(), all.end(), [](const auto& one) { return isAscii(one); });
  };
  return areAscii(scene.names) && areAscii(scene.paths) && areAscii(scene.fileNames) && areAscii(scene.kinds) &&
         areAscii(scene.ids) && (report.since == nullptr || areAscii(report.since->gone));
}

}  // namespace

void writeReportCsv(const Report& report, scene::ByteSink sink) {
  constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";  // without it some spreadsheets take another character set
  const ViewScene& scene = report.scene;
  if (!isAscii(report)) sink(kUtf8Mark);
  sink(scene.isExact ? "number,first,second,state,depth,distance,x,y,z,normal_x,normal_y,normal_z,contacts"
                     : "number,first,second,overlap_x,overlap_y,overlap_z,volume");
  if (!scene.ids.empty()) sink(",first_type,first_id,second_type,second_id");
  sink(report.since == nullptr ? ",guid" : ",since,guid");
  sink(scene.files.empty() ? "\n" : ",first_file,first_path,second_file,second_path\n");
  for (const Clash& clash : report.clashes) {
    writeCsvLine(scene, clash, clash, sink);
    for (const Clash& pair : clash.inside) writeCsvLine(scene, clash, pair, sink);
  }
  if (report.since == nullptr) return;
  const std::size_t left = (scene.isExact ? 10U : 4U) + (scene.ids.empty() ? 0U : 4U);
  for (const EarlierClash& clash : report.since->gone) {
    sink(fmt::format(",{},{},{}resolved,{}{}\n", cellOf(clash.first), cellOf(clash.second), std::string(left, ','),
                     clash.guid, placeCellsOf(scene, clash)));
  }
}

}  // namespace allpairs::view
