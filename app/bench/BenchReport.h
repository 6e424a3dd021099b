// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "Provenance.h"
#include "Sampling.h"
#include "allpairs/Overlaps.h"

namespace allpairs::app {

/// What `allpairs bench` found, and on what.
struct BenchRecord {
  std::string input;
  std::size_t boxes = 0;
  std::string order;  ///< "ordered", "unordered" or "count".
  std::string strategy;
  std::size_t threads = 1;
  std::string instructionSet{};
  std::uint64_t pairs = 0;
  std::string hash{};  ///< Empty where pairs were only counted.
  OverlapStatistics work{};
  measure::Summary oneShot{};
  measure::Summary warm{};
  measure::Provenance provenance{};
};

/// For people: one fact on a line.
[[nodiscard]] std::string benchTable(const BenchRecord& record);

/// One JSON object and a new line.
[[nodiscard]] std::string benchJson(const BenchRecord& record);

}  // namespace allpairs::app
