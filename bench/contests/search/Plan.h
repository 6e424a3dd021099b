// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "Contest.h"

namespace allpairs::bench {

/// Boxes on which all contenders are measured.
struct Cell {
  std::string scene;
  std::size_t boxes = 0;
  bool sorted = false;
  std::string part = "contest";  ///< Or "threads", "kernel": see Plan.
};

/// What a run of the benchmarks measures, and how thoroughly.
struct Plan {
  std::vector<Cell> cells;
  std::vector<Cell> threadCells;  ///< On these, ours alone, by number of threads.
  std::vector<Cell> kernelCells;  ///< On these, our exhaustive kernel alone, counting, by instruction set.
  measure::Effort effort;
};

/// A few scenes of up to 10,000 boxes: under a minute.
[[nodiscard]] Plan quickPlan();

/// Every scene from 100 to a million boxes, and at 100,000 spatially sorted too: about a quarter of an hour.
[[nodiscard]] Plan fullPlan();

}  // namespace allpairs::bench
