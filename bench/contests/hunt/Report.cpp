// SPDX-License-Identifier: MIT
#include "Report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <map>

#include "Samples.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::bench {

namespace {

using Ratio = double (MatchResult::*)() const;

struct Column {
  const char* name;
  const char* title;
  Ratio ratio;
};

constexpr Column kUnordered{"find()", "a kept object's find(), unordered", &MatchResult::unorderedRatio};
constexpr Column kOrdered{"overlaps()", "overlaps(), ordered, in a vector", &MatchResult::orderedRatio};

std::string timeText(double ns) {
  char text[32];
  if (ns < 1e3) {
    std::snprintf(text, sizeof text, "%.0f ns", ns);
  } else if (ns < 1e6) {
    std::snprintf(text, sizeof text, "%.3g us", ns / 1e3);
  } else {
    std::snprintf(text, sizeof text, "%.3g ms", ns / 1e6);
  }
  return text;
}

void printHeading() {
  std::printf("%9s %8s %10s %8s %10s  %-15s %9s %9s %9s  %s\n", "unordered", "ordered", "seed", "boxes", "pairs/box",
              "best", "it takes", "find()", "overlaps()", "scene");
}

void printLine(const MatchResult& result) {
  const Entry* const best = result.best();
  if (best == nullptr) return;
  std::printf("%9.2f %8.2f %10llu %8zu %10.3g  %-15s %9s %9s %9s  %s\n", result.unorderedRatio(), result.orderedRatio(),
              static_cast<unsigned long long>(result.family.seed), result.family.boxes(),
              result.pairs / static_cast<double>(result.family.boxes()), best->name.c_str(), timeText(best->ns).c_str(),
              timeText(result.entries[1].ns).c_str(), timeText(result.entries[0].ns).c_str(),
              describe(result.family).c_str());
}

/// Scenes by the number of their boxes.
struct SizeClass {
  const char* title;
  std::size_t least;
  std::size_t most;

  [[nodiscard]] bool holds(const MatchResult& result) const {
    return result.family.boxes() >= least && result.family.boxes() <= most;
  }
};

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();
constexpr std::array<SizeClass, 2> kWorstOf{{{"up to 63 boxes", 0, 63}, {"64 boxes or more", 64, kAny}}};
constexpr std::array<SizeClass, 5> kSharesOf{{{"all", 0, kAny},
                                              {"up to 16 boxes", 0, 16},
                                              {"17 to 63", 17, 63},
                                              {"64 to 999", 64, 999},
                                              {"1,000 or more", 1000, kAny}}};

void printWorst(const std::vector<MatchResult>& results, const Column& column, const SizeClass& sizes) {
  constexpr std::size_t kWorst = 10;
  std::vector<const MatchResult*> sorted;
  for (const MatchResult& result : results) {
    if (sizes.holds(result)) sorted.push_back(&result);
  }
  std::sort(sorted.begin(), sorted.end(),
            [&](const MatchResult* a, const MatchResult* b) { return (a->*column.ratio)() < (b->*column.ratio)(); });
  std::printf("\nThe worst of %s for %s: the best contender's time divided by ours.\n\n", sizes.title, column.title);
  printHeading();
  for (std::size_t i = 0; i < std::min(kWorst, sorted.size()); ++i) printLine(*sorted[i]);
}

/// Ratios of which infinite ones are those of contenders that were left out.
void printShares(const char* name, std::vector<double> ratios) {
  if (ratios.empty()) return;
  const auto share = [&](auto&& holds) {
    return 100.0 * static_cast<double>(std::count_if(ratios.begin(), ratios.end(), holds)) /
           static_cast<double>(ratios.size());
  };
  const double below1 = share([](double ratio) { return ratio < 1.0; });
  const double above3 = share([](double ratio) { return ratio > 3.0; });
  std::printf("%-34s %7zu %9.1f %% %9.1f %% %9.2f %9.2f\n", name, ratios.size(), below1, above3,
              *std::min_element(ratios.begin(), ratios.end()), measure::median(ratios));
}

void printShares(const std::vector<MatchResult>& results, const Column& column) {
  for (const SizeClass& sizes : kSharesOf) {
    std::vector<double> ratios;
    for (const MatchResult& result : results) {
      if (sizes.holds(result)) ratios.push_back((result.*column.ratio)());
    }
    printShares((std::string(column.name) + ", " + sizes.title).c_str(), ratios);
  }
}

void printByContender(const std::vector<MatchResult>& results) {
  std::map<std::string, std::vector<double>> ratios;
  for (const MatchResult& result : results) {
    for (std::size_t i = 2; i < result.entries.size(); ++i) {
      const Entry& entry = result.entries[i];
      const double ratio = entry.ns / result.entries[1].ns;
      ratios[entry.name].push_back(entry.leftOut ? std::max(ratio, 8.0) : ratio);
    }
  }
  for (const auto& [name, of] : ratios) printShares(("find() beside " + name).c_str(), of);
}

void printSummary(const std::vector<MatchResult>& results) {
  std::size_t measured = 0;
  std::size_t leftOut = 0;
  for (const MatchResult& result : results) {
    for (std::size_t i = 2; i < result.entries.size(); ++i) ++(result.entries[i].leftOut ? leftOut : measured);
  }
  std::printf(
      "\n%zu scenes; contenders were measured %zu times, and left out %zu times, since fewer boxes told that they "
      "would take eight times as long as find() or longer.\n\n",
      results.size(), measured, leftOut);
  std::printf("%-34s %7s %11s %11s %9s %9s\n", "best contender's time by that of", "scenes", "below 1", "above 3",
              "least", "median");
  printShares(results, kUnordered);
  printShares(results, kOrdered);
  printByContender(results);
}

}  // namespace

Report::Report(const std::string& path) : m_path(path) {
  if (path.empty()) return;
  m_file.open(path);
  m_file << "seed,boxes,first,second,pairs,scene,contender,setting,ns,left_out,times_find,times_overlaps\n";
  if (!m_file) throw FileError(path, "can't be written");
}

void Report::add(const MatchResult& result) {
  m_results.push_back(result);
  m_worst = std::min(m_worst, result.unorderedRatio());
  printMistakes(result);
  if (m_file.is_open()) write(result);
}

void Report::write(const MatchResult& result) {
  const SceneFamily& family = result.family;
  for (const Entry& entry : result.entries) {
    m_file << family.seed << ',' << family.boxes() << ',' << family.first << ',' << family.second << ',' << result.pairs
           << ",\"" << describe(family) << "\",\"" << entry.name << "\",\"" << entry.setting << "\"," << entry.ns << ','
           << (entry.leftOut ? "yes" : "no") << ',' << entry.ns / result.entries[1].ns << ','
           << entry.ns / result.entries[0].ns << '\n';
  }
  m_file.flush();
  if (!m_file) throw FileError(m_path, "can't be written");
}

void Report::printMistakes(const MatchResult& result) {
  for (const Entry& entry : result.entries) {
    if (entry.mistake.empty()) continue;
    ++m_mistakes;
    std::printf("MISTAKE of %s, %s, seed %llu: %s\n", entry.name.c_str(), entry.setting.c_str(),
                static_cast<unsigned long long>(result.family.seed), entry.mistake.c_str());
    std::fflush(stdout);
  }
}

void Report::print() const {
  if (m_results.empty()) return;
  for (const Column& column : {kUnordered, kOrdered}) {
    for (const SizeClass& sizes : kWorstOf) printWorst(m_results, column, sizes);
  }
  printSummary(m_results);
}

void printInDetail(const MatchResult& result) {
  std::printf("Seed %llu: %zu boxes, %.3g pairs a box; %s.\n\n", static_cast<unsigned long long>(result.family.seed),
              result.family.boxes(), result.pairs / static_cast<double>(result.family.boxes()),
              describe(result.family).c_str());
  std::printf("%-16s %-32s %10s %10s %12s\n", "", "setting", "median", "by find()", "by overlaps()");
  for (const Entry& entry : result.entries) {
    std::printf("%-16s %-32s %10s %10.2f %12.2f%s%s%s\n", entry.name.c_str(), entry.setting.c_str(),
                timeText(entry.ns).c_str(), entry.ns / result.entries[1].ns, entry.ns / result.entries[0].ns,
                entry.leftOut ? "  estimated, left out" : "", entry.mistake.empty() ? "" : "  ", entry.mistake.c_str());
  }
}

}  // namespace allpairs::bench
