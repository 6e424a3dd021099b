// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "input/BoxReader.h"
#include "memory/Memory.h"

namespace allpairs::engine {

/// Leaves out the boxes of two sets that are outside the other set's bounds. Where two sets meet in a small part of
/// space, that is most of them, and reading a box once takes a tenth of the time of ordering it. Of a set much larger
/// than the other it also leaves out the boxes that no box of the other is near (docs/decisions/0022).
///
/// Cost: two passes over the smaller set, and one or two over each set of which a sample is mostly outside; 4 bytes per
///       box of such a set, and up to 256 KB.
class BoxCull {
 public:
  explicit BoxCull(std::pmr::memory_resource* memory)
      : m_largeIds(memory), m_smallIds(memory), m_marks(memory), m_ends(memory) {}

  /// Restricts the readers to boxes that may overlap one of the other's.
  void apply(BoxReader& first, BoxReader& second, Executor& executor);

 private:
  using Ids = Buffer<std::uint32_t>;

  /// The bounds are those of the other set.
  void restrictToBounds(BoxReader& reader, const BoxReader& other, const LaneBox& bounds, Ids& ids, Executor& executor);
  void restrictToCells(BoxReader& reader, const BoxReader& other, const LaneBox& bounds, Ids& ids, Executor& executor);
  bool mark(const BoxReader& reader, MarkedCells& cells);
  template <class T>
  void keepTouching(BoxReader& reader, const BoxReader& other, Ids& ids, Executor& executor);
  template <class Near>
  void keepNear(BoxReader& reader, const Near& isNear, Ids& ids, Executor& executor);
  template <class Choose>
  void keep(BoxReader& reader, Ids& ids, Executor& executor, const Choose& choose);

  Ids m_largeIds;
  Ids m_smallIds;
  Buffer<std::uint32_t> m_marks;         ///< A bit for each cell.
  std::pmr::vector<std::size_t> m_ends;  ///< Of the chosen boxes of each part.
};

}  // namespace allpairs::engine
