// SPDX-License-Identifier: MIT
#include "order/PairSort.h"

#include <algorithm>
#include <bit>

#include "input/Parts.h"

namespace allpairs::engine {
namespace {

template <bool kBySecond>
void sortBy(std::span<Pair> pairs, Pair* spare, const PairOrder& order, RadixSort& radix, Executor& executor) {
  static_assert(sizeof(Pair) == sizeof(std::uint64_t));
  const unsigned otherBits = order.otherBits;
  runInParts(pairs.size(), kPartSize, executor, [=](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      spare[i] = std::bit_cast<Pair>(packed<kBySecond, std::uint64_t>(pairs[i], otherBits));
  });
  radix.sort(reinterpret_cast<std::uint64_t*>(spare), reinterpret_cast<std::uint64_t*>(pairs.data()), pairs.size(), 0,
             otherBits + order.allKeyBits, executor);
  runInParts(pairs.size(), kPartSize, executor, [=](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      pairs[i] = unpacked<kBySecond>(std::bit_cast<std::uint64_t>(pairs[i]), otherBits);
  });
}

}  // namespace

void PairSort::sort(std::span<Pair> pairs, const PairOrder& order, std::span<Pair> spare, Executor& executor) {
  if (pairs.size() < 2) return;
  if (spare.size() < pairs.size()) m_own.require(pairs.size());
  Pair* const other = spare.size() < pairs.size() ? m_own.data() : spare.data();
  order.bySecond ? sortBy<true>(pairs, other, order, m_radix, executor)
                 : sortBy<false>(pairs, other, order, m_radix, executor);
}

}  // namespace allpairs::engine
