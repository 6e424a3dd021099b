// SPDX-License-Identifier: MIT
#include "bvh/HilbertSort.h"

#include <algorithm>
#include <array>

#include "bvh/CurveKey.h"
#include "bvh/RadixSort.h"
#include "input/Parts.h"

namespace allpairs::engine {
namespace {

/// Blocks whose keys are computed together: the steps for one block depend on each other, those for several do not.
constexpr std::size_t kBoxesAtOnce = 4 * kFanOut;

/// The number of boxes with equal keys from which on they are ordered again: blocks of them would be as wide as the
/// cell.
constexpr std::size_t kDenseCell = 64;

/// The maximum nesting of grids: each makes cells some hundred times narrower.
constexpr unsigned kMostGrids = 4;

std::uint64_t cellOf(CurveKey box) { return box >> kIndexBits; }

/// Calls take(boxes) for runs of about kDenseCell or more boxes in the same cell, of sorted boxes.
template <class Take>
void forEachDenseCell(std::span<CurveKey> boxes, Take&& take) {
  for (std::size_t i = 0; i + kDenseCell <= boxes.size();) {
    const std::uint64_t cell = cellOf(boxes[i]);
    if (cellOf(boxes[i + kDenseCell - 1]) != cell) {
      i += kDenseCell / 2;
      continue;
    }
    std::size_t begin = i;
    while (begin > 0 && cellOf(boxes[begin - 1]) == cell) --begin;
    const auto isSame = [&](CurveKey box) { return cellOf(box) == cell; };
    const auto rest = boxes.subspan(i);
    const auto end = static_cast<std::size_t>(std::partition_point(rest.begin(), rest.end(), isSame) - boxes.begin());
    take(boxes.subspan(begin, end - begin));
    i = end;
  }
}

}  // namespace

/// Writes the keys of boxes with their indices.
void HilbertSort::writeKeys(const BoxReader& reader, const CurveGrid& grid, const BoxList& boxes, bool emptyToo,
                            KeyRun& run) {
  std::array<LaneBlock, kBoxesAtOnce / kFanOut> blocks{};
  std::array<std::uint32_t, kBoxesAtOnce> keys;
  for (std::size_t i = 0; i < boxes.size; i += keys.size()) {
    const BoxList some = boxes.part(i, keys.size());
    std::uint64_t skipped = 0;
    std::size_t used = 0;
    for (; used * kFanOut < some.size; ++used) {
      const BlockRead read = reader.read(some.part(used * kFanOut, kFanOut), blocks[used]);
      run.exact &= read.exact;
      if (!emptyToo) skipped |= std::uint64_t{read.emptyLanes} << (used * kFanOut);
    }
    reader.kernels().curveKeys({blocks.data(), used}, grid, keys.data());
    for (std::size_t k = 0; k < some.size; ++k) {
      run.allKeys |= keys[k];
      *run.end = (std::uint64_t{keys[k]} << kIndexBits) | some[k];
      run.end += 1U - (skipped >> k & 1U);
    }
  }
}

/// Orders boxes that share a cell by a grid of their own, and again those that share a cell of that one.
// Each call goes one grid deeper, of kMostGrids.
// NOLINTNEXTLINE(misc-no-recursion)
void HilbertSort::sortDenseCell(std::span<CurveKey> cell, CurveKey* spare, const BoxReader& reader, unsigned grids) {
  const CurveGrid grid = fitCurveGrid(reader, cell);
  KeyRun run{spare};
  std::array<std::uint32_t, kBoxesAtOnce> ids;
  for (std::size_t i = 0; i < cell.size(); i += ids.size()) {
    const std::size_t size = std::min(ids.size(), cell.size() - i);
    for (std::size_t k = 0; k < size; ++k) ids[k] = indexOf(cell[i + k]);
    writeKeys(reader, grid, {ids.data(), 0, size}, true, run);
  }
  const CurveKey* sorted = radixSort(spare, cell.data(), cell.size(), kIndexBits, run.usedBits());
  if (sorted != cell.data()) std::copy_n(sorted, cell.size(), cell.data());
  if (grids == kMostGrids || cellOf(cell.front()) == cellOf(cell.back())) return;
  CurveKey* const begin = cell.data();
  forEachDenseCell(cell, [&](std::span<CurveKey> inner) {
    sortDenseCell(inner, spare + (inner.data() - begin), reader, grids + 1);
  });
}

/// Writes the keys; returns their number.
std::size_t HilbertSort::readKeys(const BoxReader& reader, CurveKey* keyed, bool emptyToo, Executor& executor) {
  const CurveGrid grid = fitCurveGrid(reader);
  m_classShift = kIndexBits + grid.classShift();
  const std::size_t chunks = chunksFor(reader.size(), executor);
  const auto beginOf = [&](std::size_t c) { return reader.size() * c / chunks; };
  m_chunks.resize(chunks);
  executor.run(chunks, [&](std::size_t c) {
    m_chunks[c] = {keyed + beginOf(c)};
    writeKeys(reader, grid, {nullptr, beginOf(c), beginOf(c + 1) - beginOf(c)}, emptyToo, m_chunks[c]);
  });
  m_exact = std::all_of(m_chunks.begin(), m_chunks.end(), [](const KeyRun& chunk) { return chunk.exact; });
  const auto endOf = [&](std::size_t c) { return static_cast<std::size_t>(m_chunks[c].end - keyed); };
  return closeGaps(keyed, chunks, beginOf, endOf);
}

std::span<const CurveKey> HilbertSort::sort(const BoxReader& reader, std::span<CurveKey> spare, Executor& executor,
                                            bool emptyToo) {
  m_boxes.require(reader.size());
  const std::span<CurveKey> boxes(m_boxes.data(), readKeys(reader, spare.data(), emptyToo, executor));
  unsigned bits = kIndexBits;
  for (const KeyRun& chunk : m_chunks) bits = std::max(bits, chunk.usedBits());
  m_radix.sort(spare.data(), boxes.data(), boxes.size(), kIndexBits, bits, executor);
  const auto isUsual = [this](CurveKey box) { return box >> m_classShift == 0; };
  m_firstLarge = static_cast<std::size_t>(std::partition_point(boxes.begin(), boxes.end(), isUsual) - boxes.begin());
  // Else the blocks of a dense cell would be as wide as it.
  m_denseCells.clear();
  forEachDenseCell(boxes, [&](std::span<CurveKey> cell) { m_denseCells.push_back(cell); });
  executor.run(m_denseCells.size(), [&](std::size_t i) {
    const std::span<CurveKey> cell = m_denseCells[i];
    sortDenseCell(cell, spare.data() + (cell.data() - boxes.data()), reader, 1);
  });
  return boxes;
}

}  // namespace allpairs::engine
