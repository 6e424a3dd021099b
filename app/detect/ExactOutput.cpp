// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

#include "cli/Text.h"
#include "detect/Exact.h"

namespace allpairs::app {
namespace {

using collision::Vec3;

std::string pointText(const Vec3& p) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", p[0], p[1], p[2]); }

Vec3 middle(const Vec3& a, const Vec3& b) { return {(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0, (a[2] + b[2]) / 2.0}; }

/// What a line of the table says behind the names.
std::string finding(const ExactPair& pair) {
  if (pair.state == ExactState::NotExamined) return {};
  if (pair.state == ExactState::Apart) {
    return fmt::format("{:.6g} between {} and {}", pair.distance, pointText(pair.pointOnFirst),
                       pointText(pair.pointOnSecond));
  }
  const bool isDeep = pair.depth.value_or(0.0) > 0.0;
  const bool isArea = !isDeep && !isEmpty(pair.contactBox);
  const std::string place = pointText(isArea ? middle(pair.contactBox.min, pair.contactBox.max)
                                             : middle(pair.pointOnFirst, pair.pointOnSecond));
  return (isDeep ? fmt::format("{:.6g} deep at ", *pair.depth) : std::string("at ")) + place;
}

/// The deepest contacts first, then those that only touch, then the others from near to far.
std::vector<std::size_t> byWeight(std::span<const ExactPair> pairs) {
  const auto key = [&pairs](std::size_t i) {
    const ExactPair& pair = pairs[i];
    const int rank = isContact(pair.state) ? 0 : (pair.state == ExactState::Apart ? 1 : 2);
    return std::tuple(rank, -pair.depth.value_or(0.0), pair.distance);
  };
  std::vector<std::size_t> order(pairs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&key](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

std::pair<std::string, std::string> namesOf(const scene::ResultView& result, std::size_t i) {
  const Pair& pair = result.pairs[i];
  return {result.model(pair.first).name, result.model(pair.second).name};
}

std::string pairLines(const scene::ResultView& result, const ExactReport& report) {
  std::vector<std::size_t> order = byWeight(report.pairs);
  const std::size_t left = order.size() - std::min(order.size(), kPairsShown);
  order.resize(order.size() - left);
  std::size_t firstWidth = 0;
  std::size_t secondWidth = 0;
  for (const std::size_t i : order) {
    const auto [first, second] = namesOf(result, i);
    firstWidth = std::max(firstWidth, std::min(printable(first).size(), kNameWidth));
    secondWidth = std::max(secondWidth, std::min(printable(second).size(), kNameWidth));
  }
  std::string text;
  for (const std::size_t i : order) {
    const auto [first, second] = namesOf(result, i);
    std::string line = fmt::format("  {:<12} {:<{}}   {:<{}}   {}", stateName(report.pairs[i].state), printable(first),
                                   firstWidth, printable(second), secondWidth, finding(report.pairs[i]));
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  text += moreLine(left);
  return text.empty() ? text : text + '\n';
}

std::string countLine(const ExactCounts& counts, std::size_t candidates) {
  std::string text = fmt::format("pairs    {} by their boxes; by their shapes {} in contact, {} apart",
                                 grouped(candidates), grouped(counts.inContact()), grouped(counts.apart));
  if (counts.apart != 0) text += fmt::format(" ({:.1f} %)", 100.0 * counts.falseShare());
  if (counts.notExamined != 0) text += fmt::format(", {} not examined", grouped(counts.notExamined));
  return text + "\n\n";
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
  return fmt::format(R"({{"state": "{}", "distance": {}, "depth": {}, "points": [{}, {}], "normal": {}, {}}})",
                     stateName(pair.state), pair.distance, pair.depth ? fmt::format("{}", *pair.depth) : "null",
                     vectorText(pair.pointOnFirst), vectorText(pair.pointOnSecond), vectorText(pair.normal),
                     contactsText(pair));
}

std::string statisticsText(const ExactReport& report) {
  const ExactCounts counts = countStates(report.pairs);
  return fmt::format(R"({{"apart": {}, "touching": {}, "overlapping": {}, "contained": {}, "notExamined": {}, )"
                     R"("falseShare": {}, "exactSeconds": {}}})",
                     counts.apart, counts.touching, counts.overlapping, counts.contained, counts.notExamined,
                     counts.falseShare(), report.seconds);
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
  text += countLine(countStates(report.pairs), report.pairs.size());
  text += pairLines(result, report);
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
