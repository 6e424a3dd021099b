// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cli/Terminal.h"
#include "cli/Text.h"
#include "detect/Exact.h"

namespace allpairs::app {
namespace {

using collision::Vec3;

std::string pointText(const Vec3& p) {
  constexpr double kNothing = 1e-12;  // beside the largest
  const double largest = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  const auto text = [&](double x) { return coordinateText(std::abs(x) <= kNothing * largest ? 0.0 : x); };
  return fmt::format("({}, {}, {})", text(p[0]), text(p[1]), text(p[2]));
}

/// Which of the two is an open surface, so that something is not known.
std::string openText(const ExactPair& pair) {
  if (pair.isFirstOpen && pair.isSecondOpen) return "neither is closed";
  return pair.isFirstOpen ? "the first is not closed" : "the second is not closed";
}

std::string gapText(const ExactPair& pair) {
  return fmt::format("{:.6g} between {} and {}", pair.distance, pointText(pair.pointOnFirst),
                     pointText(pair.pointOnSecond));
}

/// What a line of the table says behind the names.
std::string finding(const ExactPair& pair) {
  std::string place = "at " + pointText(placeOf(pair));
  switch (pair.state) {
    case ExactState::NotExamined:
      return {};
    case ExactState::Apart:
    case ExactState::WithinClearance:
      return gapText(pair);
    case ExactState::Undecided:
      return gapText(pair) + "; one may lie in the other: " + openText(pair);
    case ExactState::Duplicate:
      return "the same shape " + place;
    case ExactState::Touching:
      return place;
    default:
      break;
  }
  if (!pair.depth) return place + ", of unknown depth: " + openText(pair);
  std::string deep = fmt::format("{:.6g} deep {}", *pair.depth, place);
  if (pair.state == ExactState::Contained) {
    deep += pair.isFirstInner ? "; the first is in the second" : "; the second is in the first";
  }
  return deep;
}

std::pair<std::string, std::string> namesOf(const scene::ResultView& result, std::size_t i) {
  const Pair& pair = result.pairs[i];
  return {result.model(pair.first).name, result.model(pair.second).name};
}

/// The colour of a state on a terminal: red what is to be repaired, yellow what touches or is too near.
std::string coloured(const std::string& text, ExactState state, bool isColoured) {
  const bool isToNote =
      state == ExactState::Touching || state == ExactState::WithinClearance || state == ExactState::Undecided;
  if (!isColoured || (!isClash(state) && !isToNote)) return text;
  return (isToNote ? "\033[33m" : "\033[1;31m") + text + "\033[0m";
}

struct PairLine {
  ExactState state{};
  std::string first;
  std::string second;
  std::string finding;
};

/// The first pairs of a table, the worst first.
std::vector<PairLine> worstLines(const scene::ResultView& result, const ExactReport& report) {
  std::vector<std::size_t> order = worstFirst(report.pairs);
  order.resize(std::min(order.size(), kPairsShown));
  std::vector<PairLine> lines;
  for (const std::size_t i : order) {
    const auto [first, second] = namesOf(result, i);
    lines.push_back({report.pairs[i].state, printable(first), printable(second), finding(report.pairs[i])});
  }
  return lines;
}

std::string pairLines(const scene::ResultView& result, const ExactReport& report, const TableNotes& notes) {
  constexpr std::size_t kStateWidth = 12;
  constexpr std::size_t kAround = kStateWidth + 9;  // the state, and the blanks before and between four columns
  const std::vector<PairLine> lines = worstLines(result, report);
  std::size_t firstWidth = 0;
  std::size_t secondWidth = 0;
  std::size_t findingWidth = 0;
  for (const PairLine& line : lines) {
    firstWidth = std::max(firstWidth, std::min(columnsOf(line.first), kNameWidth));
    secondWidth = std::max(secondWidth, std::min(columnsOf(line.second), kNameWidth));
    findingWidth = std::max(findingWidth, columnsOf(line.finding));
  }
  const std::size_t most = mostOfName(notes, kAround + findingWidth);
  firstWidth = std::min(firstWidth, most);
  secondWidth = std::min(secondWidth, most);
  std::string text;
  for (const PairLine& pair : lines) {
    const std::string state = padded(std::string(stateName(pair.state)), kStateWidth);
    std::string line = "  " + coloured(state, pair.state, notes.isColoured) + ' ' +
                       padded(elided(pair.first, most), firstWidth) + "   " +
                       padded(elided(pair.second, most), secondWidth) + "   " + pair.finding;
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  text += moreLine(report.pairs.size() - lines.size());
  return text.empty() ? text : text + '\n';
}

std::string countLine(const ExactCounts& counts) {
  return fmt::format("pairs    {} by their boxes; by their shapes {}\n\n", grouped(counts.candidates()),
                     countText(counts));
}

std::string vectorText(const Vec3& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); }

std::string contactsText(const ExactPair& pair) {
  std::string text = fmt::format(R"("contactCount": {}, "contactPoints": [)", pair.contactCount);
  for (std::size_t i = 0; i < pair.contactPoints.size(); ++i) {
    text += (i == 0 ? "" : ", ") + vectorText(pair.contactPoints[i]);
  }
  text += "], \"contactBox\": ";
  if (isEmpty(pair.contactBox)) return text + "null";
  return text + fmt::format("[{}, {}]", vectorText(pair.contactBox.min), vectorText(pair.contactBox.max));
}

std::string jsonOf(const ExactPair& pair) {
  if (pair.state == ExactState::NotExamined) return R"({"state": "not-examined"})";
  const char* const inner = pair.isFirstInner ? R"("inner": 0, )" : R"("inner": 1, )";
  return fmt::format(
      R"({{"state": "{}", {}"distance": {}, "depth": {}, "points": [{}, {}], "normal": {}, {}, "open": [{}, {}]}})",
      stateName(pair.state), pair.state == ExactState::Contained ? inner : "", pair.distance,
      pair.depth ? fmt::format("{}", *pair.depth) : "null", vectorText(pair.pointOnFirst),
      vectorText(pair.pointOnSecond), vectorText(pair.normal), contactsText(pair), pair.isFirstOpen, pair.isSecondOpen);
}

std::string statisticsText(const ExactReport& report) {
  const ExactCounts counts = countStates(report.pairs);
  std::string text = fmt::format(R"({{"clashes": {})", counts.clashes());
  for (std::size_t i = 0; i < kExactStates; ++i) {
    const auto state = static_cast<ExactState>(i);
    const std::string_view name = state == ExactState::NotExamined ? "notExamined" : stateName(state);
    text += fmt::format(R"(, "{}": {})", name, counts.of(state));
  }
  return text + fmt::format(R"(, "falseShare": {}, "exactSeconds": {}}})", counts.falseShare(), report.seconds);
}

std::string csvLine(const ExactPair& pair) {
  if (pair.state == ExactState::NotExamined) return "not-examined,,,,,,,,,,,,";
  const Vec3& a = pair.pointOnFirst;
  const Vec3& b = pair.pointOnSecond;
  const Vec3& n = pair.normal;
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", stateName(pair.state), pair.distance,
                     pair.depth ? fmt::format("{}", *pair.depth) : "", a[0], a[1], a[2], b[0], b[1], b[2], n[0], n[1],
                     n[2], pair.contactCount);
}

}  // namespace

void writeExactTable(const scene::ResultView& result, const ExactReport& report, const TableNotes& notes,
                     scene::ByteSink sink) {
  std::string text = tableHead(result, notes);
  text += countLine(countStates(report.pairs));
  text += pairLines(result, report, notes);
  text += tableFoot(result, report.seconds);
  sink(text);
}

void writeExactCsv(const scene::ResultView& result, const ExactReport& report, scene::ByteSink sink) {
  sink("first,second,state,distance,depth,x1,y1,z1,x2,y2,z2,nx,ny,nz,contacts\n");
  for (std::size_t i = 0; i < report.pairs.size(); ++i) {
    const auto [first, second] = namesOf(result, i);
    sink(scene::csvField(first) + ',' + scene::csvField(second) + ',' + csvLine(report.pairs[i]) + '\n');
  }
}

void writeExactNpy(const scene::ResultView& result, const ExactReport& report, BoxPairOrder order,
                   scene::ByteSink sink) {
  std::vector<Pair> kept;
  for (std::size_t i = 0; i < report.pairs.size(); ++i) {
    if (report.pairs[i].state != ExactState::Apart) kept.push_back(result.pairs[i]);
  }
  if (order == BoxPairOrder::FirstBelowSecond) {
    for (Pair& pair : kept) std::swap(pair.first, pair.second);
    std::sort(kept.begin(), kept.end());
  }
  scene::ResultView found = result;
  found.pairs = kept;
  scene::writeNpy(found, sink);
}

void writeExactJson(const scene::ResultView& result, const ExactReport& report, scene::ByteSink sink) {
  sink("{\"exact\": [");
  for (std::size_t i = 0; i < report.pairs.size(); ++i) sink((i == 0 ? "\n  " : ",\n  ") + jsonOf(report.pairs[i]));
  sink("],\n\"exactStatistics\": " + statisticsText(report) + ",\n");
  bool isOpen = false;  // the object is open already, so the brace that opens it there is left out
  scene::writeJson(result, [&](std::string_view bytes) {
    if (!isOpen && !bytes.empty()) bytes.remove_prefix(1);
    isOpen = true;
    sink(bytes);
  });
}

}  // namespace allpairs::app
