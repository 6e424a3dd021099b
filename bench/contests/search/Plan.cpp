// SPDX-License-Identifier: MIT
#include "Plan.h"

#include "allpairs/generate/BoxScenes.h"

namespace allpairs::bench {

namespace {

constexpr std::string_view kDense = "all-overlap";  // n^2/2 pairs, so its sizes are its own.

void addSizes(std::vector<Cell>& cells, std::string_view scene, std::initializer_list<std::size_t> sizes) {
  for (const std::size_t boxes : sizes) cells.push_back({std::string(scene), boxes});
}

std::vector<Cell> cellsOfPart(std::string_view part, std::vector<Cell> cells) {
  for (Cell& cell : cells) cell.part = part;
  return cells;
}

}  // namespace

Plan quickPlan() {
  Plan plan;
  plan.effort = {.seconds = 0.05, .shortestSampleMs = 0.5, .fewestSamples = 3, .mostSamples = 30};
  for (const generate::BoxScene& scene : generate::boxScenes()) {
    if (scene.name == "uniform")
      addSizes(plan.cells, scene.name, {100, 217, 1000, 10000});
    else if (scene.name == kDense)
      addSizes(plan.cells, scene.name, {500});
    else
      addSizes(plan.cells, scene.name, {1000, 10000});
  }
  plan.threadCells = cellsOfPart("threads", {{"uniform", 100000}});
  plan.kernelCells = cellsOfPart("kernel", {{"uniform", 2000}});
  return plan;
}

Plan fullPlan() {
  Plan plan;
  plan.effort = {.seconds = 1.0, .shortestSampleMs = 1.0, .fewestSamples = 3, .mostSamples = 200};
  for (const generate::BoxScene& scene : generate::boxScenes()) {
    if (scene.name == "uniform")
      addSizes(plan.cells, scene.name, {100, 217, 1000, 10000, 100000, 1000000});
    else if (scene.name == kDense)
      addSizes(plan.cells, scene.name, {100, 500, 2000, 5000});
    else if (scene.name == "needles")
      addSizes(plan.cells, scene.name, {100, 1000, 10000, 50000, 100000, 1000000});
    else
      addSizes(plan.cells, scene.name, {100, 1000, 10000, 100000, 1000000});
  }
  for (const generate::BoxScene& scene : generate::boxScenes()) {
    if (scene.name != kDense) plan.cells.push_back({std::string(scene.name), 100000, true});
  }
  plan.threadCells =
      cellsOfPart("threads", {{"uniform", 100000}, {"uniform", 1000000}, {"uniform", 10000000}, {"needles", 1000000}});
  plan.kernelCells = cellsOfPart("kernel", {{"uniform", 500}, {"uniform", 2000}, {"uniform", 20000}});
  return plan;
}

}  // namespace allpairs::bench
