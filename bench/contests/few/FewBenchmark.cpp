// SPDX-License-Identifier: MIT
// Calls on few boxes, each on other boxes than the one before, since a processor learns the branches of a scene that it
// sees again. First the calls that a user makes, in turns with a double loop; then overlaps() with what options there
// are; then, for each instruction set, the exhaustive search divided by the hierarchy, which says where Automatic should
// change from one to the other.
//
//   few_benchmark [--seconds S]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <random>
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

/// The boxes of a search, as rows: of one set, or of two.
template <class T>
struct Scene {
  std::vector<T> first;
  std::vector<T> second;
};

/// How many boxes; none in the second set means one set. With a share each of the second set overlaps about as many of
/// the first.
struct Counts {
  std::size_t first;
  std::size_t second = 0;
  double share = 0.0;
};

template <class T>
std::vector<T> makeRows(std::size_t boxes, std::size_t seed) {
  if (boxes == 0) return {};
  const std::vector<float> rows = generate::makeBoxes({.scene = "uniform", .count = boxes, .seed = seed});
  return {rows.begin(), rows.end()};
}

/// Makes the boxes of the second set cubes that fill a share of the space of the first one, anywhere in it.
template <class T>
void fillShare(Scene<T>& scene, double share, std::size_t seed) {
  std::mt19937 generator(static_cast<unsigned>(seed));
  std::uniform_real_distribution<double> place(0.0, 1.0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    auto from = static_cast<double>(scene.first[axis]);
    double to = from;
    for (std::size_t i = axis; i < scene.first.size(); i += 3) {
      from = std::min(from, static_cast<double>(scene.first[i]));
      to = std::max(to, static_cast<double>(scene.first[i]));
    }
    const double side = std::cbrt(share) * (to - from);
    for (std::size_t i = axis; i < scene.second.size(); i += 6) {
      const double min = from + place(generator) * (to - from - side);
      scene.second[i] = static_cast<T>(min);
      scene.second[i + 3] = static_cast<T>(min + side);
    }
  }
}

template <class T>
std::vector<Scene<T>> makeScenes(Counts counts) {
  const std::size_t boxes = counts.first + counts.second;
  std::vector<Scene<T>> scenes(std::max<std::size_t>(40, kBoxes / boxes));
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    scenes[i] = {makeRows<T>(counts.first, 1000 * boxes + i), makeRows<T>(counts.second, 1000 * boxes + i + 500000)};
    if (counts.share != 0.0) fillShare(scenes[i], counts.share, i);
  }
  return scenes;
}

template <class T>
bool overlap(const T* a, const T* b) {
  return a[0] <= b[3] && b[0] <= a[3] && a[1] <= b[4] && b[1] <= a[4] && a[2] <= b[5] && b[2] <= a[5];
}

/// The double loop that a user would write.
template <class T>
std::vector<Pair> loop(const Scene<T>& scene) {
  std::vector<Pair> pairs;
  const std::vector<T>& columns = scene.second.empty() ? scene.first : scene.second;
  const std::size_t count = columns.size() / 6;
  for (std::size_t i = 0; i < scene.first.size() / 6; ++i) {
    for (std::size_t j = scene.second.empty() ? i + 1 : 0; j < count; ++j) {
      if (overlap(&scene.first[6 * i], &columns[6 * j])) {
        pairs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
      }
    }
  }
  return pairs;
}

/// A way of searching a scene; returns the number of pairs.
template <class T>
struct Contender {
  std::string name;
  std::function<std::size_t(const Scene<T>&)> search;
  double leastNs = std::numeric_limits<double>::infinity();
};

/// The library's call with views of one set or of two.
template <class T, class Call>
std::size_t pairsOf(const Scene<T>& scene, const Call& call) {
  if (scene.second.empty()) return call(BoxView::fromRows(scene.first)).size();
  return call(BoxView::fromRows(scene.first), BoxView::fromRows(scene.second)).size();
}

template <class T>
Contender<T> found(const std::string& name, OverlapSearch& search) {
  return {name, [&search](const Scene<T>& scene) {
            return pairsOf(scene, [&](const auto&... views) { return search.find(views...); });
          }};
}

/// Lets all contenders search all scenes in turns, and keeps the least time of a search of each.
template <class T>
void compete(std::span<Contender<T>> contenders, const std::vector<Scene<T>>& scenes, double seconds) {
  const measure::Stopwatch total;
  for (int round = 0; round < 3 || total.elapsed().wallMs < 1000.0 * seconds; ++round) {
    std::size_t expected = 0;
    for (Contender<T>& contender : contenders) {
      std::size_t pairs = 0;
      const measure::Stopwatch watch;
      for (const Scene<T>& scene : scenes) pairs += contender.search(scene);
      const double ns = 1e6 * watch.elapsed().cpuMs / static_cast<double>(scenes.size());
      contender.leastNs = std::min(contender.leastNs, ns);
      if (&contender == contenders.data()) expected = pairs;
      if (pairs != expected) throw std::runtime_error(contender.name + " found another number of pairs");
    }
  }
}

template <class T>
void compareCalls(std::span<const Counts> all, double seconds) {
  std::printf("\nfloat%zu:\n\n", 8 * sizeof(T));
  std::printf(
      "| boxes | double loop | overlaps() | find(), ordered | find(), unordered |\n|---:|---:|---:|---:|---:|\n");
  OverlapSearch ordered;
  OverlapSearch unordered({.order = Order::Unordered});
  for (const Counts& counts : all) {
    std::array<Contender<T>, 4> contenders{
        Contender<T>{"the double loop", [](const Scene<T>& scene) { return loop(scene).size(); }},
        Contender<T>{"overlaps()",
                     [](const Scene<T>& scene) {
                       return pairsOf(scene, [](const auto&... views) { return overlaps(views...); });
                     }},
        found<T>("find(), ordered", ordered), found<T>("find(), unordered", unordered)};
    compete<T>(contenders, makeScenes<T>(counts), seconds);
    std::printf("| %zu", counts.first);
    if (counts.second != 0) std::printf(" x %zu", counts.second);
    if (counts.share != 0.0) std::printf(", a share of %g", counts.share);
    for (const Contender<T>& contender : contenders) std::printf(" | %.0f", contender.leastNs);
    std::printf(" |\n");
  }
}

void compareAllCalls(double seconds) {
  constexpr std::array<Counts, 22> kOneSet{{{2},  {3},  {4},  {6},   {8},   {9},   {12},  {16},  {17},  {24},  {32},
                                            {48}, {64}, {96}, {128}, {129}, {192}, {256}, {257}, {384}, {385}, {512}}};
  constexpr std::array<Counts, 24> kTwoSets{{{1, 1},    {1, 2},    {2, 2},    {3, 3},    {1, 8},     {8, 1},
                                             {4, 4},    {3, 20},   {8, 8},    {1, 60},   {60, 1},    {16, 16},
                                             {31, 32},  {64, 64},  {1, 500},  {500, 1},  {4, 2000},  {2000, 4},
                                             {8, 2000}, {2000, 8}, {9, 2000}, {2000, 9}, {2, 20000}, {20000, 2}}};
  constexpr std::array<Counts, 9> kShares{{{1000, 4, 0.001},
                                           {1000, 4, 0.7},
                                           {20000, 2, 0.3},
                                           {20000, 4, 0.7},
                                           {20000, 8, 0.001},
                                           {20000, 8, 0.3},
                                           {200000, 4, 0.3},
                                           {200000, 8, 0.001},
                                           {200000, 8, 0.7}}};
  std::printf("Nanoseconds per search of uniform boxes, the least of all rounds; views of the boxes included.\n");
  compareCalls<float>(kOneSet, seconds);
  compareCalls<double>(kOneSet, seconds);
  compareCalls<float>(kTwoSets, seconds);
  compareCalls<double>(kTwoSets, seconds);
  compareCalls<float>(kShares, seconds);
  compareCalls<double>(kShares, seconds);
}

/// Options of each kind, for a set of boxes.
struct FewOptions {
  explicit FewOptions(std::size_t boxes) : margins(boxes, 0.001) {
    for (std::uint32_t i = 0; i < boxes; ++i) groups.push_back(1 + i / 2);
    distance.distance = 0.001;
    grouped.filter.first.groups = groups;
    asked.filter.accept = [](std::uint32_t i, std::uint32_t j) { return i / 2 != j / 2; };
    inRegion.region = Box{{0, 0, 0}, {0.5, 1, 1}};
  }

  std::vector<double> margins;
  std::vector<std::uint32_t> groups;
  OverlapOptions distance;
  OverlapOptions grouped;
  OverlapOptions asked;
  OverlapOptions inRegion;
};

template <class T>
void compareOptions(double seconds) {
  constexpr std::array<std::size_t, 12> kSizes{2, 4, 8, 9, 10, 12, 16, 24, 32, 48, 64, 96};
  std::printf("\noverlaps() with options, float%zu:\n\n", 8 * sizeof(T));
  std::printf(
      "| boxes | none | distance | margins | groups | predicate | region |\n|---:|---:|---:|---:|---:|---:|---:|\n");
  for (const std::size_t boxes : kSizes) {
    const FewOptions options(boxes);
    const auto with = [](const OverlapOptions& given) {
      return [&given](const Scene<T>& scene) { return overlaps(BoxView::fromRows(scene.first), given).size(); };
    };
    const OverlapOptions none;
    const auto withMargins = [&](const Scene<T>& scene) {
      BoxView view = BoxView::fromRows(scene.first);
      view.setMargins(options.margins);
      return overlaps(view).size();
    };
    std::array<Contender<T>, 6> contenders{Contender<T>{"none", with(none)},
                                           Contender<T>{"distance", with(options.distance)},
                                           Contender<T>{"margins", withMargins},
                                           Contender<T>{"groups", with(options.grouped)},
                                           Contender<T>{"predicate", with(options.asked)},
                                           Contender<T>{"region", with(options.inRegion)}};
    const std::vector<Scene<T>> scenes = makeScenes<T>({boxes});
    for (Contender<T>& contender : contenders) compete<T>({&contender, 1}, scenes, seconds / 6);
    std::printf("| %zu", boxes);
    for (const Contender<T>& contender : contenders) std::printf(" | %.0f", contender.leastNs);
    std::printf(" |\n");
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
        std::array<Contender<float>, 2> contenders{found<float>("exhaustive", exhaustive),
                                                   found<float>("hierarchy", hierarchy)};
        compete<float>(contenders, makeScenes<float>({boxes}), seconds);
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
    compareAllCalls(seconds);
    compareOptions<float>(seconds);
    compareOptions<double>(seconds);
    compareStrategies(seconds);
    return 0;
  });
}
