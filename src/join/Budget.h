// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "RecordType.h"

namespace allpairs::join {

/// How much of everything is in memory at once. Steps follow one another, so each may take all there is.
struct Budget {
  std::size_t workers = 1;
  std::size_t cellBoxes = 0;  ///< Boxes that a worker searches at once, of one set or of both together.
  std::size_t fairBoxes = 0;  ///< If not 0, boxes of each part of a cell that has more than cellBoxes and is cut again.
  std::size_t leastCells = 1;   ///< Cells that space is cut into at least, however few boxes a region leaves.
  std::size_t bufferPairs = 0;  ///< Pairs that a worker gathers before it writes them.
  std::size_t bufferBytes = 0;  ///< All cells' buffers while boxes are distributed.
  std::size_t sampleBoxes = 0;  ///< Boxes in a sample.
  std::size_t mergeBytes = 0;   ///< Pairs that are put in order at once, with all that this takes.

  /// Of `memory` bytes, for `workers` threads.
  [[nodiscard]] static Budget of(std::uint64_t memory, std::size_t workers, const RecordType& record,
                                 std::size_t pairSize) {
    constexpr std::uint64_t kProgram = std::uint64_t{32} << 20;
    constexpr std::uint64_t kMostSample = std::uint64_t{1} << 20;
    constexpr std::size_t kSearch = 56;   // bytes per box that a search takes at most, and what a cell adds
    constexpr std::size_t kSample = 160;  // likewise of a sample in double, with what cutting and counting take
    constexpr std::size_t kSamples = 3;   // where to cut, and what is counted as it is and thinned
    constexpr std::uint64_t kMostBoxes = std::uint64_t{1} << 31;  // a search numbers them in 32 bits
    constexpr std::uint64_t kMostPairs = std::uint64_t{1} << 24;  // larger runs are not merged faster
    constexpr std::uint64_t kBatch = std::uint64_t{4} << 20;      // what a worker has besides
    const std::uint64_t all = memory - kProgram;
    const std::uint64_t each = all / workers - kBatch;
    Budget budget;
    budget.workers = workers;
    budget.cellBoxes =
        static_cast<std::size_t>(std::min(each * 6 / 10 / (record.size() + kSearch + record.valuesSize()), kMostBoxes));
    budget.bufferPairs =
        static_cast<std::size_t>(std::min(each * 4 / 10 / (2 * pairSize), kMostPairs));  // as found, and by range
    budget.bufferBytes = static_cast<std::size_t>(all / 2);
    budget.sampleBoxes =
        static_cast<std::size_t>(std::min(all / 2 / (kSample + kSamples * record.valuesSize()), kMostSample));
    budget.mergeBytes = static_cast<std::size_t>(all * 9 / 10);
    return budget;
  }
};

}  // namespace allpairs::join
