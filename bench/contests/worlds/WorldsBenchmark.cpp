// SPDX-License-Identifier: MIT
// Many small worlds, such as the copies of a simulation: from their boxes in float32 to the lists of all worlds, on one
// thread, in processor time. One call for all worlds, in turns with a loop of calls of an OverlapSearch that is kept,
// and with one call for the worlds side by side in space, whose pairs are then divided. Worlds differ, since a
// processor learns the branches of a scene that it sees again; each round has other worlds too.
//
// Then worlds whose boxes all move a little in every step, or of which one is reset: a World whose boxes have world
// numbers, in turns with the one-shot search of the same boxes, and with a World without numbers that holds the worlds
// side by side.
//
// Last, worlds that meet a static set of boxes that they share, in turns with one search of two sets, of the same
// boxes.
//
//   worlds_benchmark [--rounds R] [--instruction-set NAME]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "RunMain.h"
#include "Stopwatch.h"
#include "allpairs/World.h"
#include "allpairs/Worlds.h"
#include "allpairs/generate/BoxScenes.h"

namespace {

using namespace allpairs;

/// Scenes of worlds that rounds take in turn.
constexpr std::size_t kScenes = 3;

/// Worlds of equal size, and the same ones side by side along x.
struct Scene {
  std::size_t worlds;
  std::size_t boxes;
  std::vector<float> rows;
  std::vector<float> apart;
  std::vector<double> precise;

  Scene(std::size_t worldCount, std::size_t boxCount, std::uint64_t seed) : worlds(worldCount), boxes(boxCount) {
    for (std::size_t k = 0; k < worlds; ++k) {
      const std::vector<float> world =
          generate::makeBoxes({.scene = "uniform", .count = boxes, .seed = seed + 1000 * boxes + k});
      rows.insert(rows.end(), world.begin(), world.end());
    }
    precise.assign(rows.begin(), rows.end());
    placeApart();
  }

  [[nodiscard]] BoxView world(std::size_t k) const {
    return BoxView::fromRows(std::span(rows).subspan(6 * boxes * k, 6 * boxes));
  }
  [[nodiscard]] BoxView preciseWorld(std::size_t k) const {
    return BoxView::fromRows(std::span(precise).subspan(6 * boxes * k, 6 * boxes));
  }

 private:
  /// In a grid, so that no coordinate is much larger than others.
  void placeApart() {
    apart = rows;
    float extent = 0.0F;
    for (const float bound : rows) extent = std::max(extent, std::abs(bound));
    std::size_t side = 1;
    while (side * side * side < worlds) ++side;
    for (std::size_t i = 0; i < apart.size(); ++i) {
      const std::size_t k = i / (6 * boxes);
      const std::array<std::size_t, 3> place{k % side, k / side % side, k / side / side};
      apart[i] += 3.0F * extent * static_cast<float>(place[i % 3]);
    }
  }
};

/// A way of searching all worlds; returns the number of pairs.
struct Contender {
  std::string name;
  std::function<std::size_t(const Scene&)> search;
  std::vector<double> ms;
};

double medianOf(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

class Contest {
 public:
  explicit Contest(const std::string& instructionSet)
      : m_name(instructionSet), m_kept(options()), m_aside(options()), m_search(options()) {}

  std::vector<Contender> contenders() {
    return {{"loop of kept calls",
             [this](const Scene& scene) { return loop(scene, [&](std::size_t k) { return scene.world(k); }); },
             {}},
            {"side by side", [this](const Scene& scene) { return sideBySide(scene); }, {}},
            {"WorldsSearch, kept",
             [this](const Scene& scene) {
               return m_search.find(Worlds::ofEqualSize(BoxView::fromRows(std::span(scene.rows)), scene.worlds))
                   .pairs.size();
             },
             {}},
            {"overlapsInWorlds()",
             [this](const Scene& scene) {
               const BoxView boxes = BoxView::fromRows(std::span(scene.rows));
               return overlapsInWorlds(Worlds::ofEqualSize(boxes, scene.worlds), options()).pairs.size();
             },
             {}},
            {"float64: loop",
             [this](const Scene& scene) { return loop(scene, [&](std::size_t k) { return scene.preciseWorld(k); }); },
             {}},
            {"float64: kept",
             [this](const Scene& scene) {
               return m_search.find(Worlds::ofEqualSize(BoxView::fromRows(std::span(scene.precise)), scene.worlds))
                   .pairs.size();
             },
             {}}};
  }

 private:
  [[nodiscard]] OverlapOptions options() const {
    OverlapOptions options;
    options.instructionSet = m_name;
    return options;
  }

  /// Calls worldOf(k) for each world's boxes.
  template <class WorldOf>
  std::size_t loop(const Scene& scene, const WorldOf& worldOf) {
    m_pairs.clear();
    m_begin.clear();
    for (std::size_t k = 0; k < scene.worlds; ++k) {
      m_begin.push_back(m_pairs.size());
      const std::span<const Pair> found = m_kept.find(worldOf(k));
      m_pairs.insert(m_pairs.end(), found.begin(), found.end());
    }
    return m_pairs.size();
  }

  std::size_t sideBySide(const Scene& scene) {
    m_pairs.clear();
    m_begin.assign(1, 0);
    for (const Pair pair : m_aside.find(BoxView::fromRows(std::span(scene.apart)))) {
      const std::size_t k = pair.first / scene.boxes;
      while (m_begin.size() <= k) m_begin.push_back(m_pairs.size());
      const auto first = static_cast<std::uint32_t>(k * scene.boxes);
      m_pairs.push_back({pair.first - first, pair.second - first});
    }
    return m_pairs.size();
  }

  std::string m_name;
  OverlapSearch m_kept;
  OverlapSearch m_aside;
  WorldsSearch m_search;
  std::vector<Pair> m_pairs;
  std::vector<std::uint64_t> m_begin;
};

void compare(std::size_t worlds, std::size_t boxes, std::size_t rounds, const std::string& instructionSet) {
  std::vector<Scene> scenes;
  for (std::size_t i = 0; i < kScenes; ++i) scenes.emplace_back(worlds, boxes, 100000 * i);
  Contest contest(instructionSet);
  std::vector<Contender> contenders = contest.contenders();
  for (std::size_t round = 0; round < rounds; ++round) {
    const Scene& scene = scenes[round % kScenes];
    std::size_t expected = 0;
    for (Contender& contender : contenders) {
      const measure::Stopwatch watch;
      const std::size_t pairs = contender.search(scene);
      contender.ms.push_back(watch.elapsed().cpuMs);
      if (&contender == contenders.data()) expected = pairs;
      // Side by side, bounds are rounded: boxes that barely touch may not, or the other way round.
      const std::size_t tolerated = contender.name == "side by side" ? 10 + expected / 1000 : 0;
      const std::size_t difference = pairs < expected ? expected - pairs : pairs - expected;
      if (difference > tolerated) throw std::runtime_error(contender.name + " found another number of pairs");
    }
  }
  std::printf("| %zu of %zu |", worlds, boxes);
  for (const Contender& contender : contenders) std::printf(" %.2f |", medianOf(contender.ms));
  const double best = std::min(medianOf(contenders[0].ms), medianOf(contenders[1].ms));
  const double own = medianOf(contenders[2].ms);
  std::printf(" %.0f | %.1f |\n", 1e6 * own / static_cast<double>(worlds), best / own);
}

/// Rows of which each box is moved along each axis, there and back, by up to a tenth of its side from step to step.
std::vector<float> swung(std::vector<float> rows, std::size_t step) {
  const std::vector<float> old = rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t box = i / 6;
    const float side = old[6 * box + i % 3 + 3] - old[6 * box + i % 3];
    const auto phase = static_cast<float>(box) + 2.0F * static_cast<float>(i % 3);
    rows[i] += 0.14F * side * std::sin(0.7F * static_cast<float>(step) + phase);
  }
  return rows;
}

/// A World with the boxes of a scene.
class MovingWorld {
 public:
  MovingWorld(const Scene& scene, std::span<const float> rows, bool isNumbered, const std::string& instructionSet)
      : m_world(options(instructionSet)), m_ids(rows.size() / 6) {
    std::vector<BoxProperties> properties(m_ids.size());
    for (std::size_t i = 0; i < m_ids.size() && isNumbered; ++i) {
      properties[i].world = static_cast<std::uint32_t>(i / scene.boxes);
    }
    m_world.add(BoxView::fromRows(rows), properties, m_ids);
    static_cast<void>(m_world.step());
  }

  /// Moves as many boxes as there are rows, from one on, and makes a step; returns the number of pairs.
  std::size_t step(std::span<const float> rows, std::size_t first = 0) {
    m_world.move(std::span(m_ids).subspan(first, rows.size() / 6), BoxView::fromRows(rows));
    return m_world.step().pairs.size();
  }

 private:
  static WorldOptions options(const std::string& instructionSet) {
    WorldOptions options;
    options.instructionSet = instructionSet;
    return options;
  }

  World m_world;
  std::vector<BoxId> m_ids;
};

void compareMoving(std::size_t worlds, std::size_t boxes, std::size_t rounds, const std::string& instructionSet) {
  const Scene scene(worlds, boxes, 7);
  OverlapOptions options;
  options.instructionSet = instructionSet;
  WorldsSearch oneShot(options);
  MovingWorld numbered(scene, scene.rows, true, instructionSet);
  MovingWorld aside(scene, scene.apart, false, instructionSet);
  std::array<std::vector<double>, 4> ms;
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::vector<float> rows = swung(scene.rows, round);
    const std::vector<float> apart = swung(scene.apart, round);
    const auto time = [&](std::size_t i, const auto& work) {
      const measure::Stopwatch watch;
      const std::size_t pairs = work();
      ms[i].push_back(watch.elapsed().cpuMs);
      return pairs;
    };
    const std::size_t expected = time(
        0, [&] { return oneShot.find(Worlds::ofEqualSize(BoxView::fromRows(std::span(rows)), worlds)).pairs.size(); });
    const std::size_t found = time(1, [&] { return numbered.step(rows); });
    if (found != expected) throw std::runtime_error("the World found another number of pairs");
    time(2, [&] { return aside.step(apart); });
    const std::size_t world = 7 * round % worlds;
    const std::vector<float> reset = swung(scene.rows, round + 5);
    time(3, [&] { return numbered.step(std::span(reset).subspan(6 * boxes * world, 6 * boxes), boxes * world); });
  }
  std::printf("| %zu of %zu |", worlds, boxes);
  for (const std::vector<double>& values : ms) std::printf(" %.2f |", medianOf(values));
  std::printf(" %.2f |\n", medianOf(ms[1]) / medianOf(ms[0]));
}

/// Boxes of all worlds as small as if they were one set, so that each meets about two of the shared ones.
void compareShared(std::size_t worlds, std::size_t boxes, std::size_t rounds, const std::string& instructionSet) {
  constexpr std::size_t kShared = 10000;
  OverlapOptions options;
  options.instructionSet = instructionSet;
  OverlapSearch sets(options);
  WorldsSearch search(options);
  const std::vector<float> shared = generate::makeBoxes({.scene = "uniform", .count = kShared, .seed = 1});
  std::vector<std::vector<float>> scenes;
  for (std::size_t i = 0; i < kScenes; ++i) {
    scenes.push_back(generate::makeBoxes({.scene = "uniform", .count = worlds * boxes, .seed = 2 + i}));
  }
  std::array<std::vector<double>, 2> ms;
  for (std::size_t round = 0; round < rounds; ++round) {
    const std::vector<float>& rows = scenes[round % kScenes];
    const measure::Stopwatch ofSets;
    const std::size_t expected = sets.find(BoxView::fromRows(rows), BoxView::fromRows(shared)).size();
    ms[0].push_back(ofSets.elapsed().cpuMs);
    const measure::Stopwatch ofWorlds;
    const Worlds all = Worlds::ofEqualSize(BoxView::fromRows(rows), worlds);
    const std::size_t found = search.find(all, BoxView::fromRows(shared)).pairs.size();
    ms[1].push_back(ofWorlds.elapsed().cpuMs);
    if (found != expected) throw std::runtime_error("the worlds have another number of pairs with the shared boxes");
  }
  std::printf("| %zu of %zu, %zu shared | %.2f | %.2f | %.2f |\n", worlds, boxes, kShared, medianOf(ms[0]),
              medianOf(ms[1]), medianOf(ms[1]) / medianOf(ms[0]));
}

}  // namespace

int main(int argc, char** argv) {
  std::size_t rounds = 31;
  std::string instructionSet;
  CLI::App app("Compares ways of searching many small worlds.");
  app.add_option("--rounds", rounds, "Of each number of worlds")->capture_default_str();
  app.add_option("--instruction-set", instructionSet, "Instead of the best one");
  return allpairs::bench::runMain(app, argc, argv, [&] {
    std::printf("Milliseconds of processor time for all worlds, medians; uniform boxes.\n\n| worlds |");
    for (const Contender& contender : Contest(instructionSet).contenders())
      std::printf(" %s |", contender.name.c_str());
    std::printf(" ns a world | times faster |\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    compare(32768, 5, rounds, instructionSet);
    compare(8192, 20, rounds, instructionSet);
    compare(4096, 64, rounds, instructionSet);
    compare(1024, 200, rounds, instructionSet);
    compare(256, 400, rounds, instructionSet);
    std::printf(
        "\nWorlds that move, the same measure.\n\n| worlds | one-shot, kept | World, all move | World side by side |"
        " World, one reset | all move to one-shot |\n|---|---:|---:|---:|---:|---:|\n");
    for (const auto& [worlds, boxes] :
         {std::pair<std::size_t, std::size_t>{32768, 5}, {8192, 20}, {4096, 64}, {1024, 200}, {64, 4000}}) {
      compareMoving(worlds, boxes, rounds, instructionSet);
    }
    std::printf(
        "\nBoxes that all worlds share, the same measure.\n\n| worlds | search of two sets | WorldsSearch | ratio |\n"
        "|---|---:|---:|---:|\n");
    compareShared(4096, 30, rounds, instructionSet);
    return 0;
  });
}
