// SPDX-License-Identifier: MIT
// What order costs: the calls that a user makes, ordered, not ordered and as rows of neighbors, in turns, on equal
// cubes at random places that are others for each repetition. Medians of processor time.
//
//   dense_benchmark [--instruction-set NAME] [--most-pairs N] [--axes N]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "RunMain.h"
#include "Stopwatch.h"
#include "allpairs/Overlaps.h"

namespace {

using namespace allpairs;

/// What is compared: boxes of each set, pairs of each box, one set or two, and along how many axes boxes differ.
struct Kind {
  std::size_t boxes;
  double pairs;
  bool one;
  std::size_t axes;
};

struct Scene {
  std::vector<BoxF> first;
  std::vector<BoxF> second;
  bool one = true;
};

std::vector<BoxF> makeCubes(const Kind& kind, std::mt19937_64& random) {
  const double share = (kind.one ? 2.0 : 1.0) * kind.pairs / static_cast<double>(kind.boxes);
  const double side = 0.5 * std::pow(share, 1.0 / static_cast<double>(kind.axes));
  std::uniform_real_distribution<float> place(0.0F, 1.0F);
  std::vector<BoxF> cubes(kind.boxes);
  for (BoxF& cube : cubes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cube.min[axis] = axis < kind.axes ? place(random) : 0.0F;
      cube.max[axis] = cube.min[axis] + static_cast<float>(side);
    }
  }
  return cubes;
}

/// So many boxes in each set with so many pairs each, fewer where cubes reach beyond the unit cube.
Scene makeScene(const Kind& kind, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  return {makeCubes(kind, random), kind.one ? std::vector<BoxF>() : makeCubes(kind, random), kind.one};
}

struct Call {
  std::function<std::size_t(const Scene&)> search;
  std::vector<double> ms = {};

  double median() {
    std::sort(ms.begin(), ms.end());
    return ms[ms.size() / 2];
  }
};

/// Those of the unordered calls, and of each of the others what it takes beside the unordered one before it.
void printTimes(std::span<Call> calls) {
  double base = 0.0;
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const double ms = calls[i].median();
    const bool isUnordered = i == 0 || i == 4;
    if (isUnordered) base = ms;
    isUnordered ? std::printf(" %.2f |", ms) : std::printf(" %.2f (%.2f) |", ms, ms / base);
  }
  std::printf("\n");
  std::fflush(stdout);
}

void compare(const Kind& kind, const std::string& instructionSet) {
  constexpr std::uint64_t kRepetitions = 7;
  const OverlapOptions inOrder{.instructionSet = instructionSet};
  const OverlapOptions inAnyOrder{.order = Order::Unordered, .instructionSet = instructionSet};
  OverlapSearch ordered(inOrder);
  OverlapSearch unordered(inAnyOrder);
  const auto reused = [](OverlapSearch& search) {
    return [&search](const Scene& s) {
      return s.one ? search.find(s.first).size() : search.find(s.first, s.second).size();
    };
  };
  const auto rows = [](OverlapSearch& search, NeighborRows rowKind) {
    return [&search, rowKind](const Scene& s) {
      if (!s.one) return search.findNeighbors(s.first, s.second).indices.size();
      return search.findNeighbors(s.first, rowKind).indices.size() / (rowKind == NeighborRows::Full ? 2 : 1);
    };
  };
  const auto anew = [](const OverlapOptions& options) {
    return [&options](const Scene& s) {
      return s.one ? overlaps(s.first, options).size() : overlaps(s.first, s.second, options).size();
    };
  };
  const auto rowsAnew = [](const OverlapOptions& options) {
    return [&options](const Scene& s) {
      return s.one ? neighbors(s.first, NeighborRows::Half, options).indices.size()
                   : neighbors(s.first, s.second, options).indices.size();
    };
  };
  OverlapSearch half(inOrder);
  OverlapSearch full(inOrder);
  std::array<Call, 7> calls{Call{reused(unordered)},
                            Call{reused(ordered)},
                            Call{rows(half, NeighborRows::Half)},
                            Call{rows(full, NeighborRows::Full)},
                            Call{anew(inAnyOrder)},
                            Call{anew(inOrder)},
                            Call{rowsAnew(inOrder)}};
  std::size_t found = 0;
  for (std::uint64_t repetition = 0; repetition <= kRepetitions; ++repetition) {
    const Scene scene = makeScene(kind, 1000 * kind.boxes + repetition);
    for (Call& call : calls) {
      const measure::Stopwatch watch;
      const std::size_t size = call.search(scene);
      const double ms = watch.elapsed().cpuMs;
      if (repetition != 0) call.ms.push_back(ms);  // The first gets memory.
      if (&call != calls.data() && size != found) throw std::runtime_error("two calls found other numbers of pairs");
      found = size;
    }
  }
  std::printf("| %s | %zu | %.1f |", kind.one ? "one" : "two", kind.boxes,
              static_cast<double>(found) / static_cast<double>(kind.boxes));
  printTimes(calls);
}

}  // namespace

int main(int argc, char** argv) {
  std::string instructionSet;
  double mostPairs = 3e7;
  std::size_t axes = 3;
  CLI::App app("Compares ordered and unordered searches of boxes with many pairs each.");
  app.add_option("--instruction-set", instructionSet, "Default: the processor's best");
  app.add_option("--most-pairs", mostPairs, "In a scene; others are left out")->capture_default_str();
  app.add_option("--axes", axes, "Along which boxes differ: 1, on a line; 2, in a plane; 3")
      ->capture_default_str()
      ->check(CLI::Range(1, 3));
  return allpairs::bench::runMain(app, argc, argv, [&] {
    std::printf(
        "Milliseconds; in brackets divided by the unordered call. Between two sets there is one kind of rows.\n\n");
    std::printf(
        "| sets | boxes | pairs a box | find(), unordered | find() | findNeighbors(), half | full | overlaps(), "
        "unordered | "
        "overlaps() | neighbors(), half |\n");
    std::printf("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const bool one : {true, false}) {
      for (const std::size_t boxes : {std::size_t{10000}, std::size_t{100000}, std::size_t{1000000}}) {
        for (const double pairs : {2.0, 4.0, 8.0, 16.0, 30.0, 100.0}) {
          if (pairs * static_cast<double>(boxes) <= mostPairs) compare({boxes, pairs, one, axes}, instructionSet);
        }
      }
    }
    return 0;
  });
}
