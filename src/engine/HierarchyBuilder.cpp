// SPDX-License-Identifier: MIT
#include "HierarchyBuilder.h"

#include <algorithm>
#include <array>

namespace allpairs::engine {
namespace {

/// Blocks that one task gathers or bounds.
constexpr std::size_t kBlocksPerTask = 1024;

/// How many boxes ahead the gather asks for memory.
constexpr std::size_t kPrefetchDistance = 32;

std::size_t ceilDivide(std::size_t a, std::size_t b) { return (a + b - 1) / b; }

/// Blocks of all levels over `size` boxes, and room for the levels that deepen() may add.
std::size_t blocksFor(std::size_t size) {
  std::size_t total = kMaxLevels;
  for (std::size_t blocks = ceilDivide(size, kFanOut);; blocks = ceilDivide(blocks, kFanOut)) {
    total += blocks;
    if (blocks <= 1) return total;
  }
}

LaneBox boundsOf(const Level& level, std::size_t block) {
  LaneBox result = level.blocks[block].get(0);
  for (std::size_t lane = 1; lane < level.fill(block); ++lane) {
    const LaneBox box = level.blocks[block].get(lane);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.bound[axis] = std::min(result.bound[axis], box.bound[axis]);
      result.bound[axis + 3] = std::max(result.bound[axis + 3], box.bound[axis + 3]);
    }
  }
  return result;
}

void padBlock(LaneBlock& block, std::size_t fill) {
  for (std::size_t lane = fill; lane < kFanOut; ++lane) block.set(lane, kNeverLanes);
}

}  // namespace

void HierarchyBuilder::build(const LaneReader& reader, const Kernels& kernels, Executor& executor) {
  m_blocks.require(std::max(blocksFor(reader.size()), ceilDivide(reader.size() * sizeof(KeyedBox), sizeof(LaneBlock))));
  // The blocks are not written before the order is known: until then they are the second buffer of the sort.
  auto* spare = reinterpret_cast<KeyedBox*>(m_blocks.data());
  const OrderedBoxes order = m_order.sort(reader, {spare, reader.size()}, kernels, executor);
  m_exact = order.exact;
  m_firstLarge = order.firstLarge;
  m_hierarchy = {};
  if (order.boxes.empty()) return;
  gather(reader, kernels, order.boxes, executor);
  bound(kernels, executor);
}

void HierarchyBuilder::gatherBlocks(const BlockReader& reader, std::span<const KeyedBox> order, std::size_t begin,
                                    std::size_t end) {
  std::array<std::int32_t, kFanOut> offsets;
  for (std::size_t b = begin; b < end; ++b) {
    for (std::size_t lane = 0; lane < kFanOut; ++lane) {
      const std::uint32_t index = indexOf(order[b * kFanOut + lane]);
      reader.prefetch(indexOf(order[std::min(b * kFanOut + lane + kPrefetchDistance, order.size() - 1)]));
      m_ids[b * kFanOut + lane] = index;
      offsets[lane] = static_cast<std::int32_t>(6 * index);
    }
    static_cast<void>(reader.readAt(offsets, m_blocks[b]));
  }
}

void HierarchyBuilder::gatherBoxes(const LaneReader& reader, std::span<const KeyedBox> order, std::size_t begin,
                                   std::size_t end) {
  reader.withLanes([&](const auto& lanesOf) {
    LaneBox lanes;
    for (std::size_t i = begin; i < end; ++i) {
      reader.prefetch(indexOf(order[std::min(i + kPrefetchDistance, order.size() - 1)]));
      static_cast<void>(lanesOf(indexOf(order[i]), lanes));
      m_blocks[i / kFanOut].set(i % kFanOut, lanes);
      m_ids[i] = indexOf(order[i]);
    }
  });
}

void HierarchyBuilder::gather(const LaneReader& reader, const Kernels& kernels, std::span<const KeyedBox> order,
                              Executor& executor) {
  const std::size_t size = order.size();
  const std::size_t blocks = ceilDivide(size, kFanOut);
  const BlockReader blockReader(reader, kernels);
  m_ids.require(blocks * kFanOut);
  executor.run(ceilDivide(blocks, kBlocksPerTask), [&](std::size_t task) {
    std::size_t begin = task * kBlocksPerTask * kFanOut;
    const std::size_t end = std::min(size, begin + kBlocksPerTask * kFanOut);
    if (blockReader.isUsable()) {
      gatherBlocks(blockReader, order, begin / kFanOut, end / kFanOut);
      begin = std::max(begin, end / kFanOut * kFanOut);
    }
    gatherBoxes(reader, order, begin, end);
  });
  for (std::size_t i = size; i < blocks * kFanOut; ++i) m_ids[i] = 0;
  m_hierarchy.level[0] = {m_blocks.data(), size};
  m_hierarchy.depth = 1;
  m_hierarchy.ids = m_ids.data();
  padBlock(m_blocks[blocks - 1], m_hierarchy.level[0].fill(blocks - 1));
}

void HierarchyBuilder::bound(const Kernels& kernels, Executor& executor) {
  LaneBlock* blocks = m_blocks.data();
  std::size_t count = m_hierarchy.level[0].blockCount();
  m_usedBlocks = count;
  while (count > 1) {
    LaneBlock* parents = blocks + count;
    executor.run(ceilDivide(count, kBlocksPerTask), [&](std::size_t task) {
      kernels.boundBlocks(blocks, task * kBlocksPerTask, std::min(count, (task + 1) * kBlocksPerTask), parents);
    });
    // Padding changes no bound: its minima are +infinity, its maxima -infinity.
    Level& level = m_hierarchy.level[m_hierarchy.depth++];
    level = {parents, count};
    count = level.blockCount();
    padBlock(parents[count - 1], level.fill(count - 1));
    m_usedBlocks += count;
    blocks = parents;
  }
}

std::span<Pair> HierarchyBuilder::takeMemory() noexcept {
  m_hierarchy = {};
  return {reinterpret_cast<Pair*>(m_blocks.data()), m_blocks.capacity() * sizeof(LaneBlock) / sizeof(Pair)};
}

void HierarchyBuilder::deepen(std::size_t depth) {
  if (m_hierarchy.depth == 0) return;
  while (m_hierarchy.depth < depth) {
    const Level& below = m_hierarchy.level[m_hierarchy.depth - 1];
    LaneBlock& parent = m_blocks[m_usedBlocks++];
    parent.set(0, boundsOf(below, 0));
    padBlock(parent, 1);
    m_hierarchy.level[m_hierarchy.depth++] = {&parent, 1};
  }
}

}  // namespace allpairs::engine
