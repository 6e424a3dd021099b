// SPDX-License-Identifier: MIT
#include "bvh/BvhLevels.h"

#include <algorithm>

#include "input/Parts.h"

namespace allpairs::engine {

void BvhLevels::reset(std::size_t capacity) {
  m_capacity = capacity;
  m_ids.require(blockCountFor(capacity) * kFanOut);
  std::array<std::size_t, kMaxLevels> begin{};
  std::size_t blocks = 0;
  std::size_t depth = 0;
  for (std::size_t size = capacity; size > 0; ++depth) {
    begin[depth] = blocks;
    blocks += blockCountFor(size);
    size = size <= kFanOut ? 0 : blockCountFor(size);
  }
  m_blocks.require(blocks);
  for (std::size_t level = 0; level < depth; ++level) m_levels[level] = m_blocks.data() + begin[level];
  m_clean.fill(0);
  m_places = 0;
  m_view = {};
  m_view.ids = m_ids.data();
  m_boundedDepth = 0;
}

/// Sets the size of all levels; clean(level, blocks) empties what has to be of each.
template <class Clean>
void BvhLevels::setPlaces(std::size_t places, const Clean& clean) {
  m_places = places;
  m_view.depth = 0;
  for (std::size_t size = places; size > 0;) {
    const std::size_t level = m_view.depth++;
    const std::size_t blocks = blockCountFor(size);
    m_view.level[level] = {m_levels[level], size};
    clean(level, blocks);
    size = blocks == 1 ? 0 : blocks;
  }
}

void BvhLevels::resize(std::size_t places) {
  const std::size_t before = m_clean[0] * kFanOut;
  setPlaces(places, [this](std::size_t level, std::size_t blocks) {
    for (std::size_t& clean = m_clean[level]; clean < blocks; ++clean) m_levels[level][clean].clear();
  });
  for (std::size_t place = before; place < m_clean[0] * kFanOut; ++place) m_ids[place] = 0;
}

void BvhLevels::resizeUnwritten(std::size_t places) {
  setPlaces(places, [this](std::size_t level, std::size_t blocks) {
    m_levels[level][blocks - 1].clear();
    m_clean[level] = blocks;
  });
  for (std::size_t place = places; place < blockCount() * kFanOut; ++place) m_ids[place] = 0;
}

void BvhLevels::boundAll(const Kernels& kernels, Executor& executor) {
  m_boundedDepth = m_view.depth;
  std::size_t count = blockCount();
  for (std::size_t level = 0; level + 1 < m_view.depth; ++level) {
    const LaneBlock* blocks = m_levels[level];
    LaneBlock* parents = m_levels[level + 1];
    runInParts(count, kPartSize / kFanOut, executor,
               [&](std::size_t begin, std::size_t end) { kernels.boundBlocks(blocks, begin, end, parents); });
    count = blockCountFor(count);
  }
}

void BvhLevels::boundSome(std::span<std::uint32_t> blocks, const Kernels& kernels, Executor& executor) {
  // A new level bounds nothing yet, not even unchanged blocks.
  if (m_boundedDepth != m_view.depth) {
    boundAll(kernels, executor);
    return;
  }
  std::size_t count = blocks.size();
  for (std::size_t level = 0; level + 1 < m_view.depth; ++level) {
    std::size_t parents = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t b = blocks[i];
      kernels.boundBlocks(m_levels[level], b, std::size_t{b} + 1, m_levels[level + 1]);
      const auto parent = static_cast<std::uint32_t>(b / kFanOut);
      if (parents == 0 || blocks[parents - 1] != parent) blocks[parents++] = parent;
    }
    count = parents;
  }
}

}  // namespace allpairs::engine
