// SPDX-License-Identifier: MIT
#include "order/PairSort.h"

#include <algorithm>
#include <bit>

#include "input/Parts.h"

namespace allpairs::engine {
namespace {

/// The index that orders first, above the other one.
template <bool kBySecond>
std::uint64_t numberOf(Pair pair, unsigned otherBits) {
  if constexpr (kBySecond) return std::uint64_t{pair.second} << otherBits | pair.first;
  return std::uint64_t{pair.first} << otherBits | pair.second;
}

template <bool kBySecond>
Pair pairOf(std::uint64_t number, unsigned otherBits) {
  const auto key = static_cast<std::uint32_t>(number >> otherBits);
  const auto other = static_cast<std::uint32_t>(number & ((std::uint64_t{1} << otherBits) - 1));
  return kBySecond ? Pair{other, key} : Pair{key, other};
}

template <bool kBySecond>
void sortBy(std::span<Pair> pairs, Pair* spare, std::size_t keys, std::size_t others, RadixSort& radix,
            Executor& executor) {
  static_assert(sizeof(Pair) == sizeof(std::uint64_t));
  const auto otherBits = static_cast<unsigned>(std::bit_width(others - 1));
  const auto bits = otherBits + static_cast<unsigned>(std::bit_width(keys - 1));
  runInParts(pairs.size(), kPartSize, executor, [=](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) spare[i] = std::bit_cast<Pair>(numberOf<kBySecond>(pairs[i], otherBits));
  });
  radix.sort(reinterpret_cast<std::uint64_t*>(spare), reinterpret_cast<std::uint64_t*>(pairs.data()), pairs.size(), 0,
             bits, executor);
  runInParts(pairs.size(), kPartSize, executor, [=](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      pairs[i] = pairOf<kBySecond>(std::bit_cast<std::uint64_t>(pairs[i]), otherBits);
  });
}

}  // namespace

void PairSort::sort(std::span<Pair> pairs, const Task& task, Executor& executor) {
  if (pairs.size() < 2 || task.order == Order::Unordered) return;
  Pair* spare = task.spare.data();
  if (task.spare.size() < pairs.size()) {
    m_own.require(pairs.size());
    spare = m_own.data();
  }
  if (task.order == Order::ByFirst) {
    sortBy<false>(pairs, spare, task.firsts, task.seconds, m_radix, executor);
  } else {
    sortBy<true>(pairs, spare, task.seconds, task.firsts, m_radix, executor);
  }
}

}  // namespace allpairs::engine
