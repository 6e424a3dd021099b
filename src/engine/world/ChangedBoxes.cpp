// SPDX-License-Identifier: MIT
#include "world/ChangedBoxes.h"

#include <algorithm>
#include <bit>

namespace allpairs::engine {

void ChangedBoxes::gather(std::span<const BoxId> changed, KeptHierarchy& from, const Kernels& kernels,
                          Executor& executor) {
  const LevelStack& source = from.levels();
  const std::size_t words = (source.places() + 63) / 64;
  if (m_marked.size() < words) m_marked.resize(words + words / 4, 0);
  std::size_t count = 0;
  for (const BoxId id : changed) {
    const std::uint32_t place = from.placeOf(id);
    if (place == KeptHierarchy::kNowhere) continue;
    m_marked[place / 64] |= std::uint64_t{1} << (place % 64);
    ++count;
  }
  m_levels.reset(std::max(m_levels.capacity(), count + count / 4));
  m_levels.resize(count);
  std::size_t next = 0;
  for (std::size_t word = 0; word < words; ++word) {
    for (std::uint64_t bits = std::exchange(m_marked[word], 0); bits != 0; bits &= bits - 1) {
      const std::size_t place = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      m_levels.block(next / kFanOut).set(next % kFanOut, source.block(place / kFanOut).get(place % kFanOut));
      m_levels.id(next++) = source.id(place);
    }
  }
  m_levels.boundAll(kernels, executor);
}

}  // namespace allpairs::engine
