// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "LaneReader.h"
#include "Memory.h"
#include "allpairs/Executor.h"

namespace allpairs::engine {

/// A box by its index, with the key that places it in the order.
struct KeyedBox {
  std::uint32_t key;
  std::uint32_t index;
};

/// Boxes in an order in which those that are near each other in space, and alike in size and shape, follow each other.
struct OrderedBoxes {
  std::span<const KeyedBox> boxes;  ///< Those that may overlap something.
  bool exact = true;                ///< Whether their lanes are exactly the boxes.
};

/// Sorts boxes along a space-filling curve.
///
/// Cost:    a constant number of passes over the boxes; 8 bytes a box, and 8 more of `spare` memory while it sorts.
/// Threads: parallel over the executor; the order does not depend on it.
class CurveOrder {
 public:
  /// `spare` holds at least as many values as the reader has boxes; its contents are lost.
  OrderedBoxes sort(const LaneReader& reader, std::span<KeyedBox> spare, Executor& executor);

 private:
  struct Chunk {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t used = 0;  ///< Where its first box goes, then how many it has.
    bool exact = true;
    std::vector<std::uint32_t> offsets;  ///< By digit: where its next box goes.
  };

  void cut(std::size_t size, std::size_t pieces);

  std::vector<Chunk> m_chunks;
  Buffer<KeyedBox> m_boxes;
};

}  // namespace allpairs::engine
