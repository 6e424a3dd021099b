// SPDX-License-Identifier: MIT
#include "world/ChangedBoxes.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace allpairs::engine {

void ChangedBoxes::gather(std::span<const BoxId> changed, DynamicBvh& from, const Kernels& kernels,
                          Executor& executor) {
  const BvhLevels& source = from.levels();
  const std::size_t words = (source.places() + 63) / 64;
  // Marks left by a call that threw.
  if (std::exchange(m_marking, true)) std::fill(m_marked.begin(), m_marked.end(), std::uint64_t{0});
  if (m_marked.size() < words) m_marked.resize(words + words / 4, 0);
  std::size_t count = 0;
  for (const BoxId id : changed) {
    const std::uint32_t place = from.placeOf(id);
    if (place == DynamicBvh::kNowhere) continue;
    m_marked[place / 64] |= std::uint64_t{1} << (place % 64);
    ++count;
  }
  m_levels.reset(std::max(m_levels.capacity(), kFanOut * (count + count / 4)));
  m_levels.resize(0);
  std::size_t next = 0;
  std::size_t sourceBlock = source.places();
  for (std::size_t word = 0; word < words; ++word) {
    for (std::uint64_t bits = std::exchange(m_marked[word], 0); bits != 0; bits &= bits - 1) {
      const std::size_t place = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      if (place / kFanOut != std::exchange(sourceBlock, place / kFanOut)) {
        next = m_levels.blockCount() * kFanOut;
        m_levels.resize(next + kFanOut);
      }
      m_levels.block(next / kFanOut).set(next % kFanOut, source.block(place / kFanOut).get(place % kFanOut));
      m_levels.id(next++) = source.id(place);
    }
  }
  m_marking = false;
  m_size = count;
  m_levels.boundAll(kernels, executor);
}

}  // namespace allpairs::engine
