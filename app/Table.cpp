// SPDX-License-Identifier: MIT
#include "Table.h"

#include <fmt/format.h>

#include <algorithm>

namespace allpairs::app {
namespace {

constexpr std::size_t kPairsShown = 40;   // a screenful
constexpr std::size_t kNameWidth = 48;    // wider names push the second column aside rather than every line

std::string duration(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.1f} us", seconds * 1e6);
  if (seconds < 1.0) return fmt::format("{:.1f} ms", seconds * 1e3);
  return fmt::format("{:.2f} s", seconds);
}

std::string pairLines(const scene::ResultView& result) {
  const std::size_t shown = std::min(result.pairs.size(), kPairsShown);
  std::vector<std::pair<std::string, std::string>> names;
  std::size_t width = 0;
  for (const Pair& pair : result.pairs.first(shown)) {
    names.emplace_back(result.model(result.swapped ? pair.second : pair.first).name,
                       result.model(result.swapped ? pair.first : pair.second).name);
    width = std::max(width, std::min(names.back().first.size(), kNameWidth));
  }
  std::string text;
  for (const auto& [first, second] : names) text += fmt::format("  {:<{}}   {}\n", first, width, second);
  if (shown < result.pairs.size()) {
    text += fmt::format("  ... and {} more; --format csv or json gives all\n", grouped(result.pairs.size() - shown));
  }
  return text.empty() ? text : text + '\n';
}

std::string testLines(const scene::DetectionStatistics& statistics) {
  std::string text = fmt::format("tests    {} made; the double loop makes {}\n",
                                 grouped(statistics.boxTests + statistics.groupTests), grouped(statistics.doubleLoopTests));
  if (statistics.verified) text += "verify   the exhaustive strategy gives the same pairs in the same order\n";
  return text;
}

}  // namespace

std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t position = digits.size(); position > 3;) {
    position -= 3;
    digits.insert(position, 1, ',');
  }
  return digits;
}

std::string counted(std::uint64_t count, const std::string& noun, const std::string& plural) {
  if (count != 1 && !plural.empty()) return fmt::format("{} {}", grouped(count), plural);
  return fmt::format("{} {}{}", grouped(count), noun, count == 1 ? "" : "s");
}

std::string boxText(const Box& box) {
  if (isEmpty(box)) return "empty";
  return fmt::format("[{:.6g}, {:.6g}, {:.6g}] to [{:.6g}, {:.6g}, {:.6g}]", box.min[0], box.min[1], box.min[2],
                     box.max[0], box.max[1], box.max[2]);
}

void writeTable(const scene::ResultView& result, const TableNotes& notes, scene::ByteSink sink) {
  const scene::DetectionStatistics& statistics = result.statistics;
  std::string text = fmt::format("models   {}, of which {} simulated\n", grouped(result.modelCount),
                                 notes.simulated == 1 ? "1 is" : grouped(notes.simulated) + " are");
  text += fmt::format("method   {}\n", notes.method);
  if (notes.remarks != 0) {
    text += fmt::format("ignored  {}; 'allpairs info' lists them\n", counted(notes.remarks, "part", "parts"));
  }
  text += fmt::format("pairs    {}\n\n", grouped(result.pairs.size()));
  text += pairLines(result) + testLines(statistics);
  text += fmt::format("time     {} to read, {} to detect on {}\n", duration(statistics.readSeconds),
                      duration(statistics.detectSeconds), counted(statistics.threads, "thread"));
  sink(text);
}

}  // namespace allpairs::app
