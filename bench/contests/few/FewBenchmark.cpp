// SPDX-License-Identifier: MIT
// Calls on few boxes, each on other boxes than the one before, since a processor learns the branches of a scene that it sees
// again. First the calls that a user makes, in turns with a double loop; then, for each instruction set, the exhaustive
// search divided by the hierarchy, which says where Automatic should change from one to the other.
//
//   few_benchmark [--seconds S]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "RunMain.h"
#include "Stopwatch.h"
#include "allpairs/Overlaps.h"
#include "allpairs/generate/BoxScenes.h"

namespace {

using namespace allpairs;

/// Boxes of all sets of a measurement together: more than branch predictors remember.
constexpr std::size_t kBoxes = 40000;

using Rows = std::vector<float>;

std::vector<Rows> makeSets(std::size_t boxes) {
  std::vector<Rows> sets(std::max<std::size_t>(40, kBoxes / boxes));
  for (std::size_t i = 0; i < sets.size(); ++i) {
    sets[i] = generate::makeBoxes({.scene = "uniform", .count = boxes, .seed = 1000 * boxes + i});
  }
  return sets;
}

/// The double loop that a user would write.
std::vector<Pair> loop(std::span<const float> rows) {
  std::vector<Pair> pairs;
  const std::size_t count = rows.size() / 6;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = i + 1; j < count; ++j) {
      const float* const a = &rows[6 * i];
      const float* const b = &rows[6 * j];
      if (a[0] <= b[3] && b[0] <= a[3] && a[1] <= b[4] && b[1] <= a[4] && a[2] <= b[5] && b[2] <= a[5]) {
        pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
      }
    }
  }
  return pairs;
}

/// A way of searching one set; returns the number of pairs.
struct Contender {
  std::string name;
  std::function<std::size_t(const BoxView&, const Rows&)> search;
  double leastNs = std::numeric_limits<double>::infinity();
};

/// Lets all contenders search all sets in turns, and keeps the least time of a search of each.
void compete(std::span<Contender> contenders, const std::vector<Rows>& sets, double seconds) {
  const measure::Stopwatch total;
  for (int round = 0; round < 3 || total.elapsed().wallMs < 1000.0 * seconds; ++round) {
    std::size_t expected = 0;
    for (Contender& contender : contenders) {
      std::size_t pairs = 0;
      const measure::Stopwatch watch;
      for (const Rows& rows : sets) pairs += contender.search(BoxView::fromRows(rows), rows);
      const double ns = 1e6 * watch.elapsed().cpuMs / static_cast<double>(sets.size());
      contender.leastNs = std::min(contender.leastNs, ns);
      if (&contender == contenders.data()) expected = pairs;
      if (pairs != expected) throw std::runtime_error(contender.name + " found another number of pairs");
    }
  }
}

void compareCalls(double seconds) {
  constexpr std::array<std::size_t, 22> kCounts{2,  3,  4,  6,   8,   9,   12,  16,  17,  24,  32,
                                                48, 64, 96, 128, 129, 192, 256, 257, 384, 385, 512};
  std::printf("Nanoseconds per search of uniform boxes, the least of all rounds; views of the boxes included.\n\n");
  std::printf(
      "| boxes | double loop | overlaps() | find(), ordered | find(), unordered |\n|---:|---:|---:|---:|---:|\n");
  OverlapSearch ordered;
  OverlapSearch unordered({.order = Order::Unordered});
  for (const std::size_t boxes : kCounts) {
    std::array<Contender, 4> contenders{
        Contender{"the double loop", [](const BoxView&, const Rows& rows) { return loop(rows).size(); }},
        Contender{"overlaps()", [](const BoxView& view, const Rows&) { return overlaps(view).size(); }},
        Contender{"find(), ordered", [&](const BoxView& view, const Rows&) { return ordered.find(view).size(); }},
        Contender{"find(), unordered", [&](const BoxView& view, const Rows&) { return unordered.find(view).size(); }}};
    compete(contenders, makeSets(boxes), seconds);
    std::printf("| %zu | %.0f | %.0f | %.0f | %.0f |\n", boxes, contenders[0].leastNs, contenders[1].leastNs,
                contenders[2].leastNs, contenders[3].leastNs);
  }
}

void compareStrategies(double seconds) {
  constexpr std::array<std::size_t, 9> kSizes{48, 64, 96, 128, 192, 256, 320, 384, 448};
  std::printf("\nExhaustive search divided by hierarchy, reused objects.\n\n| instruction set, order |");
  for (const std::size_t boxes : kSizes) std::printf(" %zu |", boxes);
  std::printf("\n|---|");
  for (std::size_t i = 0; i < kSizes.size(); ++i) std::printf("---:|");
  for (const std::string_view instructionSet : instructionSets()) {
    for (const Order order : {Order::ByFirst, Order::Unordered}) {
      std::printf("\n| %.*s, %s |", static_cast<int>(instructionSet.size()), instructionSet.data(),
                  order == Order::ByFirst ? "ordered" : "unordered");
      OverlapOptions options{.order = order, .instructionSet = instructionSet};
      options.strategy = Strategy::Exhaustive;
      OverlapSearch exhaustive(options);
      options.strategy = Strategy::Bvh;
      OverlapSearch hierarchy(options);
      for (const std::size_t boxes : kSizes) {
        std::array<Contender, 2> contenders{
            Contender{"exhaustive", [&](const BoxView& view, const Rows&) { return exhaustive.find(view).size(); }},
            Contender{"hierarchy", [&](const BoxView& view, const Rows&) { return hierarchy.find(view).size(); }}};
        compete(contenders, makeSets(boxes), seconds);
        std::printf(" %.2f |", contenders[0].leastNs / contenders[1].leastNs);
      }
    }
  }
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  double seconds = 0.2;
  CLI::App app("Compares calls on few boxes.");
  app.add_option("--seconds", seconds, "For each number of boxes")->capture_default_str();
  return allpairs::bench::runMain(app, argc, argv, [&] {
    compareCalls(seconds);
    compareStrategies(seconds);
    return 0;
  });
}
