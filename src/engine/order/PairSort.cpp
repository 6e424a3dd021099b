// SPDX-License-Identifier: MIT
#include "order/PairSort.h"

#include <algorithm>
#include <bit>

namespace allpairs::engine {
namespace {

/// Pairs that a task converts to numbers, or back.
constexpr std::size_t kPairsPerTask = std::size_t{1} << 16;

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

/// Calls convert(begin, end) for parts of all pairs.
template <class Convert>
void inParts(std::size_t size, Executor& executor, const Convert& convert) {
  executor.run((size + kPairsPerTask - 1) / kPairsPerTask,
               [&](std::size_t task) { convert(task * kPairsPerTask, std::min(size, (task + 1) * kPairsPerTask)); });
}

template <bool kBySecond>
void sortBy(std::span<Pair> pairs, Pair* spare, std::size_t keys, std::size_t others, RadixSort& radix,
            Executor& executor) {
  static_assert(sizeof(Pair) == sizeof(std::uint64_t));
  const auto otherBits = static_cast<unsigned>(std::bit_width(others - 1));
  const auto bits = otherBits + static_cast<unsigned>(std::bit_width(keys - 1));
  inParts(pairs.size(), executor, [=](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) spare[i] = std::bit_cast<Pair>(numberOf<kBySecond>(pairs[i], otherBits));
  });
  radix.sort(reinterpret_cast<std::uint64_t*>(spare), reinterpret_cast<std::uint64_t*>(pairs.data()), pairs.size(), 0,
             bits, executor);
  inParts(pairs.size(), executor, [=](std::size_t begin, std::size_t end) {
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
