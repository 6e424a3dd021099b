// SPDX-License-Identifier: MIT
#include "CurveOrder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "BlockReader.h"
#include "CurveGrid.h"
#include "RadixRun.h"

namespace allpairs::engine {
namespace {

/// A first pass into so many buckets leaves runs of a few thousand boxes, or what fits the second-level cache up to some
/// hundred million boxes.
unsigned topDigitBits(std::size_t boxes) {
  constexpr unsigned kRunBits = 12;
  return std::clamp(static_cast<unsigned>(std::bit_width(boxes)), kRunBits + 4, kRunBits + 11) - kRunBits;
}

/// Sets up to this size are sorted as one run: there and back they fill a second-level cache. Threads share smaller ones.
constexpr std::size_t kMostInOneRun = std::size_t{1} << 17;
constexpr std::size_t kMostForOneThread = std::size_t{1} << 14;

/// Buckets that a task sorts, one after the other.
constexpr std::size_t kBucketsPerTask = 2;

/// A chunk smaller than this is not worth a task.
constexpr std::size_t kMinChunk = std::size_t{1} << 13;

/// Blocks whose keys are computed together.
constexpr std::size_t kBlocksAtOnce = 4;

/// Gathers boxes into a block and writes their keys when it is full.
class KeyWriter {
 public:
  KeyWriter(const Kernels& kernels, const CurveGrid& grid, KeyedBox* out)
      : m_kernels(kernels), m_grid(grid), m_begin(out), m_out(out) {
    for (std::size_t lane = 0; lane < kFanOut; ++lane) m_block.set(lane, kEverythingLanes);
  }

  void take(std::size_t index, const LaneBox& box) {
    m_block.set(m_fill, box);
    m_index[m_fill] = static_cast<std::uint32_t>(index);
    if (++m_fill == kFanOut) write();
  }

  /// Takes whole groups of blocks from `begin` on as long as there are any before `end`; returns where they stop.
  std::size_t takeBlocks(const BlockReader& reader, std::size_t begin, std::size_t end, bool& exact) {
    std::array<LaneBlock, kBlocksAtOnce> blocks;
    std::array<std::uint32_t, kBlocksAtOnce * kFanOut> keys;
    std::array<std::uint32_t, kBlocksAtOnce> empty;
    for (; begin + keys.size() <= end; begin += keys.size()) {
      for (std::size_t b = 0; b < kBlocksAtOnce; ++b) {
        const RowBlockResult read = reader.readRun(begin + b * kFanOut, blocks[b]);
        exact &= read.exact;
        empty[b] = read.emptyLanes;
      }
      m_kernels.curveKeys(blocks, m_grid, keys.data());
      for (std::size_t i = 0; i < keys.size(); ++i) {
        m_allKeys |= keys[i];
        *m_out = (std::uint64_t{keys[i]} << kIndexBits) | (begin + i);
        m_out += 1U - ((empty[i / kFanOut] >> (i % kFanOut)) & 1U);
      }
    }
    return begin;
  }

  /// Writes what is left; returns how many there were in all.
  std::size_t finish() {
    if (m_fill != 0) write();
    return static_cast<std::size_t>(m_out - m_begin);
  }

  /// Every bit that is set in a key so far.
  [[nodiscard]] KeyedBox allKeys() const noexcept { return std::uint64_t{m_allKeys} << kIndexBits; }

 private:
  void write() {
    std::array<std::uint32_t, kFanOut> keys;
    m_kernels.curveKeys({&m_block, 1}, m_grid, keys.data());
    for (std::size_t i = 0; i < m_fill; ++i) {
      m_allKeys |= keys[i];
      *m_out++ = (std::uint64_t{keys[i]} << kIndexBits) | m_index[i];
    }
    m_fill = 0;
  }

  const Kernels& m_kernels;
  const CurveGrid& m_grid;
  KeyedBox* m_begin;
  KeyedBox* m_out;
  LaneBlock m_block;
  std::array<std::uint32_t, kFanOut> m_index{};
  std::size_t m_fill = 0;
  std::uint32_t m_allKeys = 0;
};

/// Boxes of one key that are worth an order of their own: blocks of them would be as wide as their cell.
constexpr std::size_t kCrowd = 64;

/// A grid within a cell within a cell: cells get narrower by some hundred times each time.
constexpr unsigned kMostGrids = 4;

std::uint64_t keyOf(KeyedBox box) { return box >> kIndexBits; }

/// Calls take(boxes) for runs of about kCrowd or more boxes with the same key, of sorted boxes.
template <class Take>
void forEachCrowd(std::span<KeyedBox> boxes, Take&& take) {
  for (std::size_t i = 0; i + kCrowd <= boxes.size();) {
    const std::uint64_t key = keyOf(boxes[i]);
    if (keyOf(boxes[i + kCrowd - 1]) != key) {
      i += kCrowd / 2;
      continue;
    }
    std::size_t begin = i;
    while (begin > 0 && keyOf(boxes[begin - 1]) == key) --begin;
    const auto isSame = [&](KeyedBox box) { return keyOf(box) == key; };
    const auto rest = boxes.subspan(i);
    const auto end = static_cast<std::size_t>(std::partition_point(rest.begin(), rest.end(), isSame) - boxes.begin());
    take(boxes.subspan(begin, end - begin));
    i = end;
  }
}

/// Orders boxes that share a cell by a grid of their own, and again those that share a cell of that one.
// Each call goes one grid deeper, of kMostGrids.
// NOLINTNEXTLINE(misc-no-recursion)
void orderCrowd(std::span<KeyedBox> crowd, KeyedBox* spare, const LaneReader& reader, const Kernels& kernels,
                unsigned grids) {
  const CurveGrid grid = CurveGrid::fit(reader, crowd);
  KeyWriter writer(kernels, grid, spare);
  reader.withLanes([&](const auto& lanesOf) {
    LaneBox lanes;
    for (const KeyedBox box : crowd) {
      static_cast<void>(lanesOf(indexOf(box), lanes));
      writer.take(indexOf(box), lanes);
    }
  });
  writer.finish();
  const unsigned bits = std::max(kIndexBits, static_cast<unsigned>(std::bit_width(writer.allKeys())));
  sortRun(spare, crowd.data(), crowd.size(), bits, kIndexBits);
  if (grids == kMostGrids || keyOf(crowd.front()) == keyOf(crowd.back())) return;
  KeyedBox* const begin = crowd.data();
  forEachCrowd(crowd, [&](std::span<KeyedBox> inner) {
    orderCrowd(inner, spare + (inner.data() - begin), reader, kernels, grids + 1);
  });
}

}  // namespace

void CrowdOrder::refine(std::span<KeyedBox> boxes, KeyedBox* spare, const LaneReader& reader, const Kernels& kernels,
                        Executor& executor) {
  m_crowds.clear();
  forEachCrowd(boxes, [&](std::span<KeyedBox> crowd) { m_crowds.push_back(crowd); });
  if (m_crowds.empty()) return;
  executor.run(m_crowds.size(), [&](std::size_t i) {
    const std::span<KeyedBox> crowd = m_crowds[i];
    orderCrowd(crowd, spare + (crowd.data() - boxes.data()), reader, kernels, 1);
  });
}

std::size_t CurveOrder::cut(std::size_t size, Executor& executor) {
  const std::size_t most = executor.concurrency() == 1 ? 1 : 8 * executor.concurrency();
  m_chunkCount = std::clamp<std::size_t>(std::min(most, size / kMinChunk), 1, 256);
  if (m_chunks.size() < m_chunkCount) m_chunks.resize(m_chunkCount);
  for (std::size_t i = 0; i < m_chunkCount; ++i) {
    m_chunks[i].begin = size * i / m_chunkCount;
    m_chunks[i].end = size * (i + 1) / m_chunkCount;
  }
  return m_chunkCount;
}

OrderedBoxes CurveOrder::readKeys(const LaneReader& reader, const Kernels& kernels, KeyedBox* keyed,
                                  Executor& executor) {
  const CurveGrid grid = CurveGrid::fit(reader);
  m_classShift = kIndexBits + grid.classShift();
  const BlockReader blocks(reader, kernels);
  executor.run(cut(reader.size(), executor), [&](std::size_t c) {
    Chunk& chunk = m_chunks[c];
    KeyWriter writer(kernels, grid, keyed + chunk.begin);
    chunk.exact = true;
    const std::size_t begin =
        blocks.isUsable() ? writer.takeBlocks(blocks, chunk.begin, chunk.end, chunk.exact) : chunk.begin;
    chunk.exact &= reader.read(
        begin, chunk.end, [&](std::size_t i, const LaneBox& box) { writer.take(i, box); }, [](std::size_t) {});
    chunk.used = writer.finish();
    chunk.allKeys = writer.allKeys();
  });
  OrderedBoxes result;
  std::size_t used = 0;
  for (std::size_t c = 0; c < m_chunkCount; ++c) {
    const Chunk& chunk = m_chunks[c];
    result.exact &= chunk.exact;
    if (used != chunk.begin) std::copy_n(keyed + chunk.begin, chunk.used, keyed + used);
    used += chunk.used;
  }
  result.boxes = {keyed, used};
  return result;
}

/// How many of the low bits of a number can differ.
unsigned CurveOrder::usedBits() const {
  KeyedBox all = 0;
  for (std::size_t c = 0; c < m_chunkCount; ++c) all |= m_chunks[c].allKeys;
  return std::max(kIndexBits, static_cast<unsigned>(std::bit_width(all)));
}

/// The first pass over a large set, in parallel, and then its buckets.
void CurveOrder::sortTop(KeyedBox* from, KeyedBox* to, std::size_t size, unsigned bits, Executor& executor) {
  const unsigned shift = std::max(kIndexBits, bits - std::min(bits, topDigitBits(size)));
  const std::size_t buckets = std::size_t{1} << (bits - shift);
  executor.run(cut(size, executor), [&](std::size_t c) {
    Chunk& chunk = m_chunks[c];
    chunk.places.assign(buckets, 0);
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) ++chunk.places[from[i] >> shift];
  });
  std::uint32_t place = 0;
  m_bucketEnds.assign(buckets + 1, 0);
  for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
    for (std::size_t c = 0; c < m_chunkCount; ++c) {
      place += std::exchange(m_chunks[c].places[bucket], place);
    }
    m_bucketEnds[bucket + 1] = place;
  }
  executor.run(m_chunkCount, [&](std::size_t c) {
    Chunk& chunk = m_chunks[c];
    for (std::size_t i = chunk.begin; i < chunk.end; ++i) to[chunk.places[from[i] >> shift]++] = from[i];
  });
  const std::size_t tasks = executor.concurrency() == 1 ? 1 : std::max<std::size_t>(1, buckets / kBucketsPerTask);
  executor.run(tasks, [&](std::size_t task) {
    for (std::size_t b = buckets * task / tasks; b < buckets * (task + 1) / tasks; ++b) {
      const std::size_t begin = m_bucketEnds[b];
      const std::size_t length = m_bucketEnds[b + 1] - begin;
      sortRun(to + begin, from + begin, length, shift, kIndexBits);
    }
  });
}

OrderedBoxes CurveOrder::sort(const LaneReader& reader, std::span<KeyedBox> spare, const Kernels& kernels,
                              Executor& executor) {
  m_boxes.require(reader.size());
  KeyedBox* boxes = m_boxes.data();
  const bool large = reader.size() > (executor.concurrency() == 1 ? kMostInOneRun : kMostForOneThread);
  // The result must end in our own memory: two moves of a large set bring it home, one of a small set does.
  OrderedBoxes result = readKeys(reader, kernels, large ? boxes : spare.data(), executor);
  const unsigned bits = usedBits();
  if (large) {
    sortTop(boxes, spare.data(), result.boxes.size(), bits, executor);
  } else {
    sortRun(spare.data(), boxes, result.boxes.size(), bits, kIndexBits);
  }
  result.boxes = {boxes, result.boxes.size()};
  const auto isUsual = [this](KeyedBox box) { return box >> m_classShift == 0; };
  result.firstLarge = static_cast<std::size_t>(std::partition_point(result.boxes.begin(), result.boxes.end(), isUsual) -
                                               result.boxes.begin());
  m_crowds.refine({boxes, result.boxes.size()}, spare.data(), reader, kernels, executor);
  return result;
}

}  // namespace allpairs::engine
