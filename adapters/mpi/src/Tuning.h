// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "allpairs/partition/Partition.h"

namespace allpairs::mpi {

/// How a search is cut into parts. Tests set less, so that everything is cut.
struct Tuning {
  std::size_t boxesPerCell = partition::kBoxesPerCell;
  std::size_t samplePerCell = 64;  ///< Boxes that say where to cut.
  std::size_t leastSample = std::size_t{1} << 16;
  std::uint64_t leastCrowded = partition::kLeastCrowded;
  std::size_t wideAtOnce = std::size_t{1} << 20;  ///< Boxes that all ranks receive together.
  std::size_t pieceWords = std::size_t{1} << 27;  ///< 8 bytes each: 1 GiB.
};

}  // namespace allpairs::mpi
