// SPDX-License-Identifier: MIT
#include "world/LevelStack.h"

#include <algorithm>

namespace allpairs::engine {
namespace {

/// Blocks that one task bounds.
constexpr std::size_t kBlocksPerBoundTask = 1024;

std::size_t blocksFor(std::size_t size) { return (size + kFanOut - 1) / kFanOut; }

void emptyBlock(LaneBlock& block) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    block.bound[axis].fill(kNever);
    block.bound[axis + 3].fill(-kNever);
  }
}

}  // namespace

void LevelStack::reset(std::size_t capacity) {
  m_capacity = capacity;
  m_ids.require(blocksFor(capacity) * kFanOut);
  std::size_t blocks = blocksFor(capacity);
  for (std::size_t level = 0; level < kMaxLevels; ++level) {
    if (m_levels[level].capacity() < blocks) m_levels[level].require(blocks);
    blocks = blocksFor(blocks);
  }
  m_clean.fill(0);
  m_places = 0;
  m_depth = 0;
  m_boundedDepth = 0;
}

void LevelStack::resize(std::size_t places) {
  const std::size_t before = m_clean[0] * kFanOut;
  m_places = places;
  m_depth = 0;
  for (std::size_t blocks = blocksFor(places); blocks > 0; blocks = blocks == 1 ? 0 : blocksFor(blocks)) {
    std::size_t& clean = m_clean[m_depth];
    for (; clean < blocks; ++clean) emptyBlock(m_levels[m_depth][clean]);
    ++m_depth;
  }
  for (std::size_t place = before; place < m_clean[0] * kFanOut; ++place) m_ids[place] = 0;
}

std::size_t LevelStack::sizeOf(std::size_t level) const noexcept {
  std::size_t size = m_places;
  for (std::size_t k = 0; k < level; ++k) size = blocksFor(size);
  return size;
}

void LevelStack::boundAll(const Kernels& kernels, Executor& executor) {
  m_boundedDepth = m_depth;
  std::size_t count = blockCount();
  for (std::size_t level = 0; level + 1 < m_depth; ++level) {
    const LaneBlock* blocks = m_levels[level].data();
    LaneBlock* parents = m_levels[level + 1].data();
    executor.run((count + kBlocksPerBoundTask - 1) / kBlocksPerBoundTask, [&](std::size_t task) {
      kernels.boundBlocks(blocks, task * kBlocksPerBoundTask, std::min(count, (task + 1) * kBlocksPerBoundTask),
                          parents);
    });
    count = blocksFor(count);
  }
}

void LevelStack::boundSome(std::span<std::uint32_t> blocks, const Kernels& kernels, Executor& executor) {
  // A level that has just come bounds nothing yet, not even what hasn't changed.
  if (m_boundedDepth != m_depth) {
    boundAll(kernels, executor);
    return;
  }
  std::size_t count = blocks.size();
  for (std::size_t level = 0; level + 1 < m_depth; ++level) {
    std::size_t parents = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t b = blocks[i];
      kernels.boundBlocks(m_levels[level].data(), b, std::size_t{b} + 1, m_levels[level + 1].data());
      const auto parent = static_cast<std::uint32_t>(b / kFanOut);
      if (parents == 0 || blocks[parents - 1] != parent) blocks[parents++] = parent;
    }
    count = parents;
  }
}

LaneBox LevelStack::boundsOf(const LaneBlock& block) const noexcept {
  LaneBox result = block.get(0);
  for (std::size_t lane = 1; lane < kFanOut; ++lane) {
    const LaneBox box = block.get(lane);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.bound[axis] = std::min(result.bound[axis], box.bound[axis]);
      result.bound[axis + 3] = std::max(result.bound[axis + 3], box.bound[axis + 3]);
    }
  }
  return result;
}

Hierarchy LevelStack::hierarchy(std::size_t depth) {
  Hierarchy result;
  result.ids = m_ids.data();
  if (m_depth == 0) return result;
  for (; result.depth < m_depth; ++result.depth) {
    result.level[result.depth] = {m_levels[result.depth].data(), sizeOf(result.depth)};
  }
  for (; result.depth < depth; ++result.depth) {
    LaneBlock& top = m_tops[result.depth];
    emptyBlock(top);
    top.set(0, boundsOf(result.level[result.depth - 1].blocks[0]));
    result.level[result.depth] = {&top, 1};
  }
  return result;
}

}  // namespace allpairs::engine
