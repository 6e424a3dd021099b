// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "Kernels.h"
#include "KeyedBox.h"
#include "LaneReader.h"
#include "Memory.h"
#include "allpairs/Executor.h"

namespace allpairs::engine {

/// Boxes in an order in which those that are near each other in space, and alike in size and shape, follow each other.
struct OrderedBoxes {
  std::span<const KeyedBox> boxes;  ///< Those that may overlap something.
  bool exact = true;                ///< Whether their lanes are exactly the boxes.
  std::size_t firstLarge = 0;       ///< Boxes from this place on are of a class of larger ones.
};

/// Orders boxes that share a cell of a curve's grid again, on a grid of their own: blocks of them would be as wide as the cell.
class CrowdOrder {
 public:
  /// Boxes in the order of their keys; `spare` holds as many, and its contents are lost.
  /// Threads: crowds in parallel over the executor; the order does not depend on it.
  void refine(std::span<KeyedBox> boxes, KeyedBox* spare, const LaneReader& reader, const Kernels& kernels,
              Executor& executor);

 private:
  std::vector<std::span<KeyedBox>> m_crowds;
};

/// Sorts boxes along a space-filling curve, by key and then by index, and crowds in a cell among themselves.
///
/// A radix sort. A set that fits no cache, or that several threads share, is first cut into runs by the highest bits.
/// Cost:    8 bytes a box, and 8 more of `spare` memory while it sorts.
/// Threads: parallel over the executor; the order does not depend on it.
class CurveOrder {
 public:
  /// `spare` holds at least as many values as the reader has boxes; its contents are lost.
  OrderedBoxes sort(const LaneReader& reader, std::span<KeyedBox> spare, const Kernels& kernels, Executor& executor);

 private:
  struct Chunk {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::size_t used = 0;
    bool exact = true;
    KeyedBox allKeys = 0;               ///< Every bit that is set in a key.
    std::vector<std::uint32_t> places;  ///< By bucket: where its next box goes.
  };

  std::size_t cut(std::size_t size, Executor& executor);
  OrderedBoxes readKeys(const LaneReader& reader, const Kernels& kernels, KeyedBox* keyed, Executor& executor);
  void sortTop(KeyedBox* from, KeyedBox* to, std::size_t size, unsigned bits, Executor& executor);
  [[nodiscard]] unsigned usedBits() const;

  std::vector<Chunk> m_chunks;
  std::size_t m_chunkCount = 0;
  unsigned m_classShift = 0;  ///< Where the class of a keyed box begins.
  std::vector<std::uint32_t> m_bucketEnds;
  CrowdOrder m_crowds;
  Buffer<KeyedBox> m_boxes;
};

}  // namespace allpairs::engine
