// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
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

/// Sorts boxes along a space-filling curve, by key and then by index, and the boxes of a dense cell again, so that
/// boxes that are near each other and similar in size and shape become neighbours in the order.
///
/// Cost:    8 bytes per box, and 8 more of `spare` memory during the sort.
/// Threads: parallel over the executor; the order does not depend on it.
class HilbertSort {
 public:
  explicit HilbertSort(std::pmr::memory_resource* memory)
      : m_chunks(memory), m_radix(memory), m_denseCells(memory), m_boxes(memory) {}

  /// The boxes of the reader in order; those that can overlap nothing only on demand. `spare` holds at least as many
  /// values as the reader has boxes, and is overwritten.
  std::span<const CurveKey> sort(const BoxReader& reader, std::span<CurveKey> spare, Executor& executor,
                                 bool emptyToo = false);

  /// Whether the lanes of all boxes are exactly the boxes.
  [[nodiscard]] bool exact() const noexcept { return m_exact; }

  /// Boxes from this position on belong to a class of larger ones.
  [[nodiscard]] std::size_t firstLarge() const noexcept { return m_firstLarge; }

 private:
  /// Consecutive keys of some boxes.
  struct KeyRun {
    CurveKey* end = nullptr;
    std::uint32_t allKeys = 0;  ///< Every bit that is set in a key.
    bool exact = true;          ///< Whether the lanes of all boxes are exactly the boxes.

    /// The number of low bits in which the keys with their indices can differ.
    [[nodiscard]] unsigned usedBits() const noexcept {
      return kIndexBits + static_cast<unsigned>(std::bit_width(allKeys));
    }
  };

  std::size_t readKeys(const BoxReader& reader, CurveKey* keyed, bool emptyToo, Executor& executor);
  static void writeKeys(const BoxReader& reader, const CurveGrid& grid, const BoxList& boxes, bool emptyToo,
                        KeyRun& run);
  static void sortDenseCell(std::span<CurveKey> cell, CurveKey* spare, const BoxReader& reader, unsigned grids);

  std::pmr::vector<KeyRun> m_chunks;
  unsigned m_classShift = 0;  ///< Where the class of a keyed box begins.
  RadixSort m_radix;
  std::pmr::vector<std::span<CurveKey>> m_denseCells;
  bool m_exact = true;
  std::size_t m_firstLarge = 0;
  Buffer<CurveKey> m_boxes;
};

}  // namespace allpairs::engine
