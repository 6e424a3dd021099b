// SPDX-License-Identifier: MIT
#include "cli/Table.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "cli/Terminal.h"
#include "cli/Text.h"

namespace allpairs::app {
namespace {

std::string duration(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.1f} us", seconds * 1e6);
  if (seconds < 1.0) return fmt::format("{:.1f} ms", seconds * 1e3);
  return fmt::format("{:.2f} s", seconds);
}

std::string pairLines(const scene::ResultView& result, const TableNotes& notes) {
  const std::size_t shown = std::min(result.pairs.size(), kPairsShown);
  std::vector<std::pair<std::string, std::string>> names;
  std::size_t width = 0;
  for (const Pair& pair : result.pairs.first(shown)) {
    names.emplace_back(printable(result.model(result.swapped ? pair.second : pair.first).name),
                       printable(result.model(result.swapped ? pair.first : pair.second).name));
    width = std::max(width, std::min(columnsOf(names.back().first), kNameWidth));
  }
  constexpr std::size_t kAround = 5;  // the blanks before and between two names
  const std::size_t most = mostOfName(notes, kAround);
  width = std::min(width, most);
  std::string text;
  for (const auto& [first, second] : names)
    text += "  " + padded(elided(first, most), width) + "   " + elided(second, most) + '\n';
  text += moreLine(result.pairs.size() - shown);
  return text.empty() ? text : text + '\n';
}

std::string testLines(const scene::DetectionStatistics& statistics) {
  std::string text = fmt::format("tests    {} of boxes", grouped(statistics.testsMade));
  if (statistics.candidates != 0) text += fmt::format(", {} of flags and groups", grouped(statistics.candidates));
  text += fmt::format("; the double loop makes {}\n", grouped(statistics.testsOfAllPairs));
  if (statistics.verified) text += kVerifiedLine;
  return text;
}

}  // namespace

std::string moreLine(std::size_t left) {
  if (left == 0) return {};
  return fmt::format("  ... and {} more; --format csv or json gives all\n", grouped(left));
}

std::size_t mostOfName(const TableNotes& notes, std::size_t others) {
  if (!notes.width) return std::numeric_limits<std::size_t>::max();
  return std::max(kLeastName, (*notes.width - std::min(*notes.width, others)) / 2);
}

std::string tableHead(const scene::ResultView& result, const TableNotes& notes) {
  std::string text = fmt::format("models   {}", grouped(result.modelCount));
  if (notes.simulated != result.modelCount) {
    text += fmt::format(", of which {} simulated", notes.simulated == 1 ? "1 is" : grouped(notes.simulated) + " are");
  }
  text += '\n';
  text += fmt::format("method   {}\n", notes.method);
  if (notes.remarkCount != 0) {
    text += fmt::format("ignored  {}; 'allpairs info{}' lists them\n",
                        counted(notes.remarkCount, "part of the input", "parts of the input"),
                        notes.isPartial ? " --partial" : "");
  }
  return text;
}

std::string tableFoot(const scene::ResultView& result, std::optional<double> exactSeconds) {
  const scene::DetectionStatistics& statistics = result.statistics;
  const std::string exact = exactSeconds ? ", " + duration(*exactSeconds) + " to look at shapes" : "";
  return testLines(statistics) + fmt::format("time     {} to read, {} to detect on {}{}\n",
                                             duration(statistics.readSeconds), duration(statistics.detectSeconds),
                                             counted(statistics.threads, "thread"), exact);
}

void writeTable(const scene::ResultView& result, const TableNotes& notes, scene::ByteSink sink) {
  const std::string count = fmt::format("pairs    {}\n\n", grouped(result.pairs.size()));
  sink(tableHead(result, notes) + count + pairLines(result, notes) + tableFoot(result));
}

}  // namespace allpairs::app
