// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "bvh/CurveKey.h"
#include "bvh/RadixSort.h"
#include "input/BoxReader.h"
#include "memory/Memory.h"

namespace allpairs::engine {

/// A buffer of consecutive keys.
struct KeyRun {
  CurveKey* end = nullptr;
  std::uint32_t allKeys = 0;  ///< Every bit that is set in a key.
  bool exact = true;          ///< Whether the lanes of all boxes are exactly the boxes.

  /// The number of low bits in which the keys with their indices can differ.
  [[nodiscard]] unsigned usedBits() const noexcept;
};

/// Writes the keys of boxes with their ids; may skip boxes that can overlap nothing.
void writeKeys(const BoxReader& reader, const CurveGrid& grid, const BoxList& boxes, bool emptyToo, KeyRun& run);

/// Orders sorted boxes that share a cell of the grid again, on a finer grid: otherwise their blocks would be as wide as
/// the cell. `spare` has room for as many boxes and is overwritten; `cells` is reusable memory.
///
/// Threads: dense cells in parallel over the executor; the order does not depend on it.
void sortDenseCells(std::span<CurveKey> boxes, CurveKey* spare, const BoxReader& reader, Executor& executor,
                    std::pmr::vector<std::span<CurveKey>>& cells);

/// Sorts boxes, given by their indices without keys, along the curve on a grid of their own. `spare` has room for as many
/// boxes and is overwritten.
void sortAlongCurve(std::span<CurveKey> boxes, CurveKey* spare, const BoxReader& reader);

/// Sorts boxes along a space-filling curve, by key and then by index, and the boxes of a dense cell again, so that
/// boxes that are near each other and similar in size and shape become neighbours in the order.
///
/// Cost:    8 bytes per box, and 8 more of `spare` memory during the sort.
/// Threads: parallel over the executor; the order does not depend on it.
class HilbertSort {
 public:
  explicit HilbertSort(std::pmr::memory_resource* memory)
      : m_chunks(memory), m_radix(memory), m_denseCells(memory), m_boxes(memory) {}

  /// The boxes that may overlap something, in order. `spare` holds at least as many values as the reader has boxes, and
  /// is overwritten.
  std::span<const CurveKey> sort(const BoxReader& reader, std::span<CurveKey> spare, Executor& executor);

  /// Whether the lanes of all boxes are exactly the boxes.
  [[nodiscard]] bool exact() const noexcept { return m_exact; }

  /// Boxes from this position on belong to a class of larger ones.
  [[nodiscard]] std::size_t firstLarge() const noexcept { return m_firstLarge; }

 private:
  std::size_t readKeys(const BoxReader& reader, CurveKey* keyed, Executor& executor);

  std::pmr::vector<KeyRun> m_chunks;
  unsigned m_classShift = 0;  ///< Where the class of a keyed box begins.
  RadixSort m_radix;
  std::pmr::vector<std::span<CurveKey>> m_denseCells;
  bool m_exact = true;
  std::size_t m_firstLarge = 0;
  Buffer<CurveKey> m_boxes;
};

}  // namespace allpairs::engine
