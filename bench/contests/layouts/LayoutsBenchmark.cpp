// SPDX-License-Identifier: MIT
// What layouts of boxes in memory and options cost: overlaps() of the same equal cubes at random places as rows of six,
// as two arrays of corners, as padded corners and as columns, and of the rows with a distance, margins and a region. In
// turns, on other boxes for each repetition. Medians of processor time.
//
//   layouts_benchmark [--instruction-set NAME] [--most-boxes N]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "RunMain.h"
#include "Samples.h"
#include "Stopwatch.h"
#include "allpairs/Overlaps.h"

namespace {

using namespace allpairs;

/// The same cubes in four layouts, 2.5 pairs each.
template <class T>
struct Cubes {
  Cubes(std::size_t boxes, std::uint64_t seed)
      : size(boxes), side(0.5 * std::cbrt(5.0 / static_cast<double>(boxes))), margins(boxes) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(0.0, 1.0);
    rows.resize(6 * size);
    padded.resize(8 * size);
    columns.resize(6 * size);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) put(i, axis, place(random));
      margins[i] = 0.02 * side * place(random);
    }
  }

  void put(std::size_t i, std::size_t axis, double at) {
    const auto lo = static_cast<T>(at);
    const auto hi = static_cast<T>(at + side);
    rows[6 * i + axis] = padded[8 * i + axis] = columns[axis * size + i] = lo;
    rows[6 * i + axis + 3] = padded[8 * i + axis + 4] = columns[(axis + 3) * size + i] = hi;
    min.push_back(lo);
    max.push_back(hi);
  }

  std::size_t size;
  double side;
  std::vector<T> rows, min, max, padded, columns;
  std::vector<double> margins;
};

template <class T>
struct Call {
  const char* name = "";
  std::function<std::size_t(const Cubes<T>&, OverlapOptions)> search;
  bool widens = false;
  std::vector<double> ms{};
};

template <class T>
std::array<Call<T>, 7> makeCalls() {
  using C = const Cubes<T>&;
  const auto n = [](C cubes) { return static_cast<std::ptrdiff_t>(cubes.size); };
  return {
      Call<T>{"rows", [](C c, const OverlapOptions& o) { return overlaps(BoxView::fromRows(c.rows), o).size(); }},
      {"corners", [](C c, const OverlapOptions& o) { return overlaps(BoxView::fromCorners(c.min, c.max), o).size(); }},
      {"padded",
       [](C c, const OverlapOptions& o) {
         const CornerView<T> min{c.padded.data(), 8, 1};
         return overlaps(BoxView::fromStrided(c.size, min, {c.padded.data() + 4, 8, 1}), o).size();
       }},
      {"columns",
       [n](C c, const OverlapOptions& o) {
         const CornerView<T> min{c.columns.data(), 1, n(c)};
         return overlaps(BoxView::fromStrided(c.size, min, {c.columns.data() + 3 * n(c), 1, n(c)}), o).size();
       }},
      {"distance",
       [](C c, OverlapOptions o) {
         o.distance = 0.02 * c.side;
         return overlaps(BoxView::fromRows(c.rows), o).size();
       },
       true},
      {"margins",
       [](C c, const OverlapOptions& o) {
         BoxView boxes = BoxView::fromRows(c.rows);
         boxes.setMargins(c.margins);
         return overlaps(boxes, o).size();
       },
       true},
      {"region", [](C c, OverlapOptions o) {
         o.region = Box{{-1, -1, -1}, {2, 2, 2}};
         return overlaps(BoxView::fromRows(c.rows), o).size();
       }}};
}

template <class T>
void compare(std::size_t boxes, const OverlapOptions& options) {
  std::array<Call<T>, 7> calls = makeCalls<T>();
  const std::size_t repetitions = std::clamp<std::size_t>(3'000'000 / boxes, 7, 300);
  for (std::size_t repetition = 0; repetition <= repetitions; ++repetition) {
    const Cubes<T> cubes(boxes, 1000 * boxes + repetition);
    std::array<std::size_t, 7> found{};
    for (std::size_t k = 0; k < calls.size(); ++k) {
      const std::size_t turn = (k + repetition) % calls.size();  // Each is now and then the first to read these boxes.
      const measure::Stopwatch watch;
      found[turn] = calls[turn].search(cubes, options);
      if (repetition != 0) calls[turn].ms.push_back(watch.elapsed().cpuMs);  // The first gets memory.
    }
    for (std::size_t k = 0; k < calls.size(); ++k) {
      if (calls[k].widens ? found[k] >= found[0] : found[k] == found[0]) continue;
      throw std::runtime_error(std::string(calls[k].name) + ": other pairs");
    }
  }
  std::printf("| %s | %zu |", sizeof(T) == 4 ? "float32" : "float64", boxes);
  const double base = measure::median(calls[0].ms);
  for (const Call<T>& call : calls)
    std::printf(" %.3f (%.2f) |", measure::median(call.ms), measure::median(call.ms) / base);
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  OverlapOptions options;
  std::string instructionSet;
  std::size_t mostBoxes = 1'000'000;
  CLI::App app("Compares layouts of boxes in memory, and what a distance, margins and a region cost.");
  app.add_option("--instruction-set", instructionSet, "Default: the processor's best");
  app.add_option("--most-boxes", mostBoxes, "In a scene")->capture_default_str();
  return allpairs::bench::runMain(app, argc, argv, [&] {
    options.instructionSet = instructionSet;
    std::printf("Milliseconds of overlaps(), ordered; in brackets divided by those of rows.\n\n");
    std::printf("| type | boxes | rows | corners | padded | columns | distance | margins | region |\n");
    std::printf("|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const std::size_t boxes : {100U, 1000U, 10'000U, 100'000U, 1'000'000U}) {
      if (boxes > mostBoxes) continue;
      compare<float>(boxes, options);
      compare<double>(boxes, options);
    }
    return 0;
  });
}
