// SPDX-License-Identifier: MIT
// What detect writes of shapes, whole, of a pair in each state.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/Table.h"
#include "detect/Exact.h"

namespace allpairs::test {
namespace {

/// A pair in each state, the least serious first, and their names.
struct OfEachState {
  std::vector<std::string> names;
  std::vector<Pair> pairs;
  app::ExactReport report;
  scene::ResultView result;

  OfEachState() {
    for (std::uint32_t i = 0; i < kExactStates; ++i) {
      names.push_back(i == 1 ? "a long name" : "n" + std::to_string(i));
      pairs.push_back({i, (i + 1) % static_cast<std::uint32_t>(kExactStates)});
      ExactPair pair;
      pair.state = static_cast<ExactState>(kExactStates - 1 - i);
      pair.distance = isContact(pair.state) ? 0.0 : 0.125;
      pair.pointOnFirst = {1e6, 2, 2e-6};
      pair.pointOnSecond = {1e6, 4, 2e-6};
      pair.normal = {0, 1, 0};
      if (isClash(pair.state)) pair.depth = 0.5;
      report.pairs.push_back(pair);
    }
    at(ExactState::Duplicate).depth.reset();
    at(ExactState::Undecided).isFirstOpen = true;
    at(ExactState::Touching).contactBox = {{1, 2, 3}, {3, 4, 5}};
    at(ExactState::Touching).contactPoints = {{1, 2, 3}, {3, 4, 5}};
    at(ExactState::Touching).contactCount = 7;
    report.seconds = 0.25;
    result.modelCount = names.size();
    result.model = [this](std::size_t i) { return scene::ModelRecord{.name = names[i], .type = "T"}; };
    result.pairs = pairs;
  }

  OfEachState(const OfEachState&) = delete;
  OfEachState& operator=(const OfEachState&) = delete;

  ExactPair& at(ExactState state) { return report.pairs[kExactStates - 1 - static_cast<std::size_t>(state)]; }

  /// The lines of the pairs in a table.
  [[nodiscard]] std::string lines(const app::TableNotes& notes = {.method = "m", .simulated = 8}) const {
    std::string text;
    writeExactTable(result, report, notes, [&text](std::string_view part) { text += part; });
    const std::size_t begin = text.find("pairs ");
    return text.substr(begin, text.find("tests ") - begin);
  }
};

const std::string kCounts =
    "pairs    8 by their boxes; by their shapes 3 clashes (1 duplicate, 1 contained), 1 touching, 1 undecided, "
    "1 within the clearance, 1 not examined, 1 apart\n\n";

TEST(ExactOutput, TheTableHasAFindingForEachStateTheWorstFirst) {
  OfEachState of;
  EXPECT_EQ(of.lines(), kCounts +
                            "  duplicate    n7            n0            the same shape at (1000000, 3, 2e-06)\n"
                            "  contained    n6            n7            0.5 deep at (1000000, 4, 2e-06); the second is "
                            "in the first\n"
                            "  clash        n5            n6            0.5 deep at (1000000, 3, 2e-06)\n"
                            "  touching     n4            n5            at (2, 3, 4)\n"
                            "  undecided    n3            n4            0.125 between (1000000, 2, 2e-06) and "
                            "(1000000, 4, 2e-06); one may lie in the other: the first is not closed\n"
                            "  clearance    n2            n3            0.125 between (1000000, 2, 2e-06) and "
                            "(1000000, 4, 2e-06)\n"
                            "  not-examined a long name   n2\n"
                            "  apart        n0            a long name   0.125 between (1000000, 2, 2e-06) and "
                            "(1000000, 4, 2e-06)\n\n");
  of.report.pairs = {of.at(ExactState::Clash), of.at(ExactState::Clash), of.at(ExactState::Clash),
                     of.at(ExactState::Contained)};
  of.pairs.resize(4);
  of.result.pairs = of.pairs;
  for (ExactPair& pair : of.report.pairs) pair.depth.reset();
  of.report.pairs[0].isFirstOpen = true;
  of.report.pairs[1].isSecondOpen = true;
  of.report.pairs[2].isFirstOpen = of.report.pairs[2].isSecondOpen = true;
  of.report.pairs[3].depth = 0.5;
  of.report.pairs[3].isFirstInner = true;
  of.report.pairs[3].pointOnFirst = {1e6, 2, 1e-7};
  EXPECT_EQ(
      of.lines(),
      "pairs    4 by their boxes; by their shapes 4 clashes (1 contained)\n\n"
      "  contained    n3            n4            0.5 deep at (1000000, 2, 0); the first is in the "
      "second\n"
      "  clash        n0            a long name   at (1000000, 3, 2e-06), of unknown depth: the first is not closed\n"
      "  clash        a long name   n2            at (1000000, 3, 2e-06), of unknown depth: the second is not closed\n"
      "  clash        n2            n3            at (1000000, 3, 2e-06), of unknown depth: neither is closed\n\n");
}

TEST(ExactOutput, CsvHasALineForEachState) {
  const OfEachState of;
  std::string text;
  writeExactCsv(of.result, of.report, [&text](std::string_view part) { text += part; });
  EXPECT_EQ(text,
            "first,second,state,distance,depth,x1,y1,z1,x2,y2,z2,nx,ny,nz,contacts\n"
            "n0,a long name,apart,0.125,,1000000,2,2e-06,1000000,4,2e-06,0,1,0,0\n"
            "a long name,n2,not-examined,,,,,,,,,,,,\n"
            "n2,n3,clearance,0.125,,1000000,2,2e-06,1000000,4,2e-06,0,1,0,0\n"
            "n3,n4,undecided,0.125,,1000000,2,2e-06,1000000,4,2e-06,0,1,0,0\n"
            "n4,n5,touching,0,,1000000,2,2e-06,1000000,4,2e-06,0,1,0,7\n"
            "n5,n6,clash,0,0.5,1000000,2,2e-06,1000000,4,2e-06,0,1,0,0\n"
            "n6,n7,contained,0,0.5,1000000,2,2e-06,1000000,4,2e-06,0,1,0,0\n"
            "n7,n0,duplicate,0,,1000000,2,2e-06,1000000,4,2e-06,0,1,0,0\n");
}

TEST(ExactOutput, JsonHasAnObjectForEachStateBeforeAllElse) {
  const OfEachState of;
  std::string text;
  writeExactJson(of.result, of.report, [&text](std::string_view part) { text += part; });
  std::string others;
  scene::writeJson(of.result, [&others](std::string_view part) { others += part; });
  const auto line = [](const std::string& state, const std::string& numbers, const std::string& contacts) {
    return "  {\"state\": \"" + state + "\", " + numbers +
           ", \"points\": [[1000000, 2, 2e-06], [1000000, 4, 2e-06]], \"normal\": [0, 1, 0], " + contacts;
  };
  const std::string apart = "\"distance\": 0.125, \"depth\": null";
  const std::string deep = "\"distance\": 0, \"depth\": 0.5";
  const std::string none =
      "\"contactCount\": 0, \"contactPoints\": [], \"contactBox\": null, \"open\": [false, false]}";
  const std::string open = "\"contactCount\": 0, \"contactPoints\": [], \"contactBox\": null, \"open\": [true, false]}";
  EXPECT_EQ(text, "{\"exact\": [\n" + line("apart", apart, none) + ",\n  {\"state\": \"not-examined\"},\n" +
                      line("clearance", apart, none) + ",\n" + line("undecided", apart, open) + ",\n" +
                      line("touching", "\"distance\": 0, \"depth\": null",
                           "\"contactCount\": 7, \"contactPoints\": [[1, 2, 3], [3, 4, 5]], \"contactBox\": "
                           "[[1, 2, 3], [3, 4, 5]], \"open\": [false, false]}") +
                      ",\n" + line("clash", deep, none) + ",\n" + line("contained", "\"inner\": 1, " + deep, none) +
                      ",\n" + line("duplicate", "\"distance\": 0, \"depth\": null", none) +
                      "],\n\"exactStatistics\": {\"clashes\": 3, \"duplicate\": 1, \"contained\": 1, \"clash\": 1, "
                      "\"touching\": 1, \"undecided\": 1, \"clearance\": 1, \"notExamined\": 1, \"apart\": 1, "
                      "\"falseShare\": 0.2857142857142857, \"exactSeconds\": 0.25},\n" +
                      others.substr(1));
}

}  // namespace
}  // namespace allpairs::test
