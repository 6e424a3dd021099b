// SPDX-License-Identifier: MIT
#include "world/ChangedBoxes.h"

#include <algorithm>
#include <utility>

namespace allpairs::engine {

/// Copies a box; those of a block of the source are copied one after the other.
void ChangedBoxes::append(const BvhView& source, std::size_t place) {
  if (place / kFanOut != std::exchange(m_sourceBlock, place / kFanOut)) {
    m_next = m_levels.blockCount() * kFanOut;
    m_levels.resize(m_next + kFanOut);
  }
  const LaneBox box = source.level[0].blocks[place / kFanOut].get(place % kFanOut);
  m_levels.block(m_next / kFanOut).set(m_next % kFanOut, box);
  m_levels.id(m_next++) = source.ids[place];
}

void ChangedBoxes::gather(std::span<const BoxId> changed, const WorldForest& forest, const DynamicBvh& from,
                          Executor& executor) {
  m_size = 0;
  if (from.size() == 0) return;
  const BvhView& source = from.view();
  const std::size_t words = (from.places() + 63) / 64;
  if (m_marked.capacity() < words) m_marked.reserve(words + words / 4);
  m_marked.assign(words, 0);
  for (const BoxId id : changed) {
    const std::uint32_t place = forest.placeIn(from, id);
    if (place == BoxHome::kNowhere) continue;
    m_marked[place / 64] |= std::uint64_t{1} << (place % 64);
    ++m_size;
  }
  // At most a block for each box, and no more blocks than they come from.
  const std::size_t most = std::min(kFanOut * (m_size + m_size / 4), from.capacity());
  m_levels.reset(std::max(m_levels.capacity(), most));
  m_levels.resize(0);
  m_sourceBlock = static_cast<std::size_t>(-1);
  forEachBit(m_marked, [&](std::size_t place) { append(source, place); });
  m_levels.boundAll(*m_kernels, executor);
}

}  // namespace allpairs::engine
