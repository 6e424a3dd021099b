// SPDX-License-Identifier: MIT
#include "bvh/BvhBuilder.h"

#include <algorithm>

#include "input/Parts.h"

namespace allpairs::engine {

void BvhBuilder::build(const BoxReader& reader, Executor& executor) {
  m_levels.reset(reader.size());
  // The blocks are not written before the order is known: until then they are the second buffer of the sort.
  const std::span<const CurveKey> order = m_order.sort(reader, m_levels.memory<CurveKey>(), executor);
  m_levels.resizeUnwritten(order.size());
  gather(reader, order, executor);
  m_levels.boundAll(reader.kernels(), executor);
}

void BvhBuilder::gather(const BoxReader& reader, std::span<const CurveKey> order, Executor& executor) {
  runInParts(m_levels.blockCount(), kPartSize / kFanOut, executor, [&](std::size_t firstBlock, std::size_t endBlock) {
    for (std::size_t b = firstBlock; b < endBlock; ++b) {
      const std::size_t begin = b * kFanOut;
      const std::size_t size = std::min(kFanOut, order.size() - begin);
      for (std::size_t i = begin; i < begin + size; ++i) {
        reader.prefetch(indexOf(order[std::min(i + kPrefetchBoxes, order.size() - 1)]));
        m_levels.id(i) = indexOf(order[i]);
      }
      static_cast<void>(reader.read({&m_levels.id(begin), 0, size}, m_levels.block(b)));
      for (std::size_t i = begin; i < begin + size; ++i) m_levels.id(i) = reader.idOf(m_levels.id(i));
    }
  });
}

}  // namespace allpairs::engine
