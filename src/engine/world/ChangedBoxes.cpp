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
  // Marks left by a call that threw.
  if (std::exchange(m_marking, true)) std::fill(m_marked.begin(), m_marked.end(), std::uint64_t{0});
  if (m_marked.size() < words) m_marked.resize(words + words / 4, 0);
  for (const BoxId id : changed) {
    const std::uint32_t place = forest.placeIn(from, id);
    if (place == BoxHome::kNowhere) continue;
    m_marked[place / 64] |= std::uint64_t{1} << (place % 64);
    ++m_size;
  }
  m_levels.reset(std::max(m_levels.capacity(), kFanOut * (m_size + m_size / 4)));
  m_levels.resize(0);
  m_sourceBlock = static_cast<std::size_t>(-1);
  for (std::size_t word = 0; word < words; ++word) {
    forEachBit(std::exchange(m_marked[word], 0), [&](std::size_t bit) { append(source, word * 64 + bit); });
  }
  m_marking = false;
  m_levels.boundAll(*m_kernels, executor);
}

}  // namespace allpairs::engine
