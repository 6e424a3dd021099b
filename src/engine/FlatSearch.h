// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "Lanes.h"

namespace allpairs::engine {

/// Which columns each row is tested against.
enum class Columns : std::uint8_t {
  All,        ///< Two sets.
  Following,  ///< One set, each pair at its smaller index.
  Preceding,  ///< One set, each pair at its larger index.
};

/// Every row against its columns, row after row: the exhaustive search, or a part of it.
struct FlatSearch {
  LaneList rows;
  LaneList columns;
  std::size_t rowBegin = 0;
  std::size_t rowEnd = 0;
  Columns tested = Columns::All;
};

}  // namespace allpairs::engine
