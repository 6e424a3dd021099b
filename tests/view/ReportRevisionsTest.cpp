// SPDX-License-Identifier: MIT
// Reports of assemblies that were changed in between: what stayed keeps its GUIDs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ReportFiles.h"
#include "app/Expect.h"
#include "support/NestedGltf.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// Something of each row of a report, by the places of its two parts, whatever they are called.
using ByPlaces = std::map<std::pair<int, int>, std::string>;

/// Reports revisions of one file.
class Revisions {
 public:
  /// Reports one, and returns its GUIDs.
  ByPlaces report(const std::vector<Part>& parts, const Names& options = {}) {
    const std::string input = m_folder.write("car.gltf", nestedGltf(parts));
    Names words{"report", input, "--boxes", "-o", out()};
    words.insert(words.end(), options.begin(), options.end());
    expectSuccess(runProgram(words));
    m_places.clear();
    const auto result = nlohmann::json::parse(runProgram({"detect", input, "--format", "json"}).out);
    for (const auto& model : result["models"]) {
      m_places[model["name"]] = static_cast<int>(std::lround(100.0 * model["box"][0][0].get<double>()));
    }
    return column("guid");
  }

  /// Of the last report.
  [[nodiscard]] ByPlaces column(const std::string& name) const {
    ByPlaces cells;
    for (const auto& row : rowsOf(out())) {
      if (!row.at("number").empty())
        cells[std::minmax(m_places.at(row.at("first")), m_places.at(row.at("second")))] = row.at(name);
    }
    return cells;
  }

  [[nodiscard]] fs::path out() const { return m_folder.path() / "out"; }
  [[nodiscard]] const TempFolder& folder() const { return m_folder; }

 private:
  TempFolder m_folder;
  std::map<std::string, int> m_places;
};

/// Those of the pairs that another report has too.
ByPlaces commonOf(const ByPlaces& cells, const ByPlaces& other) {
  ByPlaces common;
  for (const auto& [places, cell] : cells) {
    if (other.contains(places)) common.emplace(places, cell);
  }
  return common;
}

/// The values of a column, each once.
std::set<std::string> valuesOf(const ByPlaces& cells) {
  std::set<std::string> values;
  for (const auto& [places, cell] : cells) values.insert(cell);
  return values;
}

const Part kLeft{"left door", 0, {{"bolt", 1}, {"panel", 2}}};
const Part kRight{"right door", 0, {{"bolt", 3}}};

TEST(ReportRevisions, APartThatComesInBeforeLeavesTheGuidsOfOthers) {
  Revisions revisions;
  const ByPlaces before = revisions.report({{"car", 0, {kLeft, kRight}}});
  ASSERT_EQ(before.size(), 3U);
  const ByPlaces after =
      revisions.report({{"car", 0, {{"bonnet", 0, {{"bolt", 4}}}, kLeft, kRight}}}, {"--since", revisions.out()});
  EXPECT_EQ(after.size(), 6U);
  EXPECT_EQ(commonOf(after, before), before);
  EXPECT_EQ(revisions.column("since"), (ByPlaces{{{1, 2}, "persisting"},
                                                 {{1, 3}, "persisting"},
                                                 {{1, 4}, "new"},
                                                 {{2, 3}, "persisting"},
                                                 {{2, 4}, "new"},
                                                 {{3, 4}, "new"}}));
}

TEST(ReportRevisions, ASecondPartOfANameAndOneThatGoesLeaveTheGuidsOfOthers) {
  Revisions revisions;
  const ByPlaces one = revisions.report({{"car", 0, {kLeft}}});
  ASSERT_EQ(one.size(), 1U);
  const ByPlaces two = revisions.report({{"car", 0, {kRight, kLeft}}});
  EXPECT_EQ(commonOf(two, one), one) << "a bolt, and then a bolt of the left door";
  EXPECT_EQ(revisions.report({{"car", 0, {kLeft}}}), one);
}

TEST(ReportRevisions, ASecondAssemblyOfANameLeavesTheGuidsOfTheFirst) {
  Revisions revisions;
  const ByPlaces before = revisions.report({{"car", 0, {kLeft, kRight, {"left door", 0, {{"bolt", 5}}}}}});
  const Part left{"left door", 0, {{"bolt", 6}, {"bolt", 1}, {"panel", 2}}};  // where numbers shift
  const ByPlaces after = revisions.report({{"car", 0, {left, kRight, {"left door", 0, {{"bolt", 5}}}}}});
  for (const auto& pair : {std::pair(2, 3), std::pair(2, 5), std::pair(3, 5)})
    EXPECT_EQ(after.at(pair), before.at(pair)) << pair.first << ' ' << pair.second;
  EXPECT_NE(after.at({1, 2}), before.at({1, 2})) << "two of one name in one node cannot be told apart";
}

TEST(ReportRevisions, APartThatIsMovedIsKnownByItsName) {
  Revisions revisions;
  const ByPlaces before = revisions.report({{"car", 0, {kLeft, kRight}}});
  // The panel is in a node of its own, and both doors are in another: the panel's name is still one.
  const Part left{"left door", 0, {{"bolt", 1}, {"skin", 0, {{"panel", 2}}}}};
  const std::vector<Part> moved{{"car", 0, {{"doors", 0, {left, kRight}}}}};
  EXPECT_NE(revisions.report(moved).at({1, 2}), before.at({1, 2}));
  static_cast<void>(revisions.report({{"car", 0, {kLeft, kRight}}}));
  EXPECT_EQ(revisions.report(moved, {"--since", revisions.out(), "--fail-on", "new"}), before);
  EXPECT_EQ(valuesOf(revisions.column("since")), (std::set<std::string>{"persisting"}));
  // The next one knows these by their places, and what is called otherwise now has the GUID that it had.
  std::vector<Part> more = moved;
  more[0].children.push_back({"panel", 7});
  const ByPlaces after = revisions.report(more, {"--since", revisions.out()});
  EXPECT_EQ(commonOf(after, before), before);
  EXPECT_EQ(revisions.column("since").at({1, 7}), "new");
}

TEST(ReportRevisions, TheTableSaysWhereModelsAre) {
  Revisions revisions;
  static_cast<void>(revisions.report({{"car", 0, {kLeft, kRight}}}));
  EXPECT_EQ(revisions.column("first").at({2, 3}), "right door/bolt");
  EXPECT_EQ(revisions.column("first_path").at({2, 3}), "car/right door/bolt");
  EXPECT_EQ(revisions.column("second").at({2, 3}), "panel");
  EXPECT_EQ(revisions.column("second_path").at({2, 3}), "car/left door/panel");
  EXPECT_EQ(revisions.column("first_file").at({2, 3}), "car.gltf");
  EXPECT_EQ(revisions.column("second_file").at({2, 3}), "car.gltf");
  const std::string boxes = revisions.folder().write("boxes.csv", "0,0,0,1,1,1\n0,0,0,1,1,1\n");
  expectSuccess(runProgram({"report", boxes, "-o", revisions.out()}));
  EXPECT_FALSE(rowsOf(revisions.out()).at(0).contains("first_file")) << "boxes are of no file";
}

/// Tables of versions before this one have neither places nor the same GUIDs of parts in nodes.
TEST(ReportRevisions, AnEarlierTableWithoutPlacesIsComparedByNames) {
  Revisions revisions;
  const std::string guid = "00000000-0000-8000-8000-00000000000";
  std::string table = "number,first,second,state,guid\n";
  int number = 0;
  for (const char* names : {"panel,bolt", "horn,bolt", "horn,bolt", "gone,bolt"}) {  // of two that are alike none is it
    const std::string text = std::to_string(++number);
    table += text + ',' + names + ",clash," + guid + text + '\n';
  }
  const ByPlaces guids =
      revisions.report({{"car", 0, {kLeft, {"horn", 8}}}}, {"--since", revisions.folder().write("old.csv", table)});
  EXPECT_EQ(guids.at({1, 2}), guid + "1");
  EXPECT_EQ(revisions.column("since"), (ByPlaces{{{1, 2}, "persisting"}, {{1, 8}, "new"}, {{2, 8}, "new"}}));
  EXPECT_EQ(rowsOf(revisions.out()).back().at("since"), "resolved");
  EXPECT_EQ(rowsOf(revisions.out()).back().at("guid"), guid + "4");
}

TEST(ReportRevisions, AnEarlierTableWithSomeColumnsOfPlacesIsComparedByNames) {
  const TempFolder folder;
  const std::string input = folder.write("parts.csv", "0,0,0,1,1,1\n0,0,0,2,2,2\n");
  for (const std::string column : {"first_path", "first_file", "second_path", "second_file"}) {
    const std::string table =
        "number,first,second,guid," + column + "\n1,no. 0,no. 1,01234567-89ab-4cde-8f01-23456789abcd,somewhere\n";
    expectSuccess(runProgram({"report", input, "--boxes", "-o", folder.path() / ("of " + column), "--since",
                              folder.write(column + ".csv", table)}));
  }
}

}  // namespace
}  // namespace allpairs::test
