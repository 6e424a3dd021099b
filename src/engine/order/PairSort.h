// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/Neighbors.h"
#include "allpairs/Pair.h"
#include "bvh/RadixSort.h"
#include "kernels/Kernels.h"
#include "memory/Memory.h"
#include "order/PairBuckets.h"

namespace allpairs::engine {

/// Compares pairs in an order.
[[nodiscard]] inline std::uint64_t keyOf(Pair pair, Order order) noexcept {
  const std::uint64_t byFirst = (std::uint64_t{pair.first} << 32U) | pair.second;
  return order == Order::BySecond ? std::rotl(byFirst, 32) : byFirst;
}

/// Puts pairs in order, by (first, second) or (second, first), either as several workers find them or as one list.
///
/// As they are found, each worker puts them into buckets, and then each bucket is put in order into its place in the
/// result. If they are counted, each pair goes to where those of its other index are, and from there to its key's row.
/// Else, if no key has many, each pair goes to its key's row, and then to where its rank in the row says. Where they do
/// not fit into the scratch memory, or a key has many, they are radix sorted in the memory of the result.
///
/// Threads: parallel over the executor; the result is the same for any.
class PairSort {
 public:
  explicit PairSort(std::pmr::memory_resource* memory)
      : m_ofWorkers(memory), m_places(memory), m_spare(memory), m_radix(memory) {}

  /// Starts without pairs, of an order that packs(); memory is kept.
  void start(const PairOrder& order, std::size_t workers, const Kernels& kernels);

  /// Where a worker adds the pairs that it finds.
  [[nodiscard]] PairBuckets& ofWorker(std::size_t worker) noexcept { return m_ofWorkers[worker]; }

  /// Ends the adding; returns the number of pairs.
  std::size_t finish();

  /// Writes the pairs in order. `memory.withScratch(size, use)` calls use(scratch) with memory for so many numbers at
  /// least, that no other task has meanwhile.
  template <class Memory>
  void sort(std::span<Pair> to, Executor& executor, Memory& memory) const {
    executor.run(m_order.buckets, [&](std::size_t bucket) {
      memory.withScratch(scratchToSort(bucket), [&](std::span<std::uint32_t> scratch) { sort(bucket, to, scratch); });
    });
  }

  /// Writes the other index of each pair, in the same order, and where those of each key begin.
  template <class Memory>
  void list(const NeighborsMemory& to, Executor& executor, Memory& memory) const {
    to.offsets.back() = m_places.back();
    executor.run(m_order.buckets, [&](std::size_t bucket) {
      memory.withScratch(scratchToList(bucket), [&](std::span<std::uint32_t> scratch) { list(bucket, to, scratch); });
    });
  }

  /// Puts a list in order: radix sorts the pairs as numbers of 64 bits, in about five passes over all. `spare` may be
  /// overwritten: if the pairs fit there, the sort allocates no memory.
  void sortList(std::span<Pair> pairs, const PairOrder& order, std::span<Pair> spare, Executor& executor);

 private:
  [[nodiscard]] std::size_t scratchToSort(std::size_t bucket) const noexcept;
  [[nodiscard]] std::size_t scratchToList(std::size_t bucket) const noexcept;
  void sort(std::size_t bucket, std::span<Pair> to, std::span<std::uint32_t> scratch) const noexcept;
  void list(std::size_t bucket, const NeighborsMemory& to, std::span<std::uint32_t> scratch) const noexcept;

  PairOrder m_order;
  const Kernels* m_kernels = nullptr;
  std::pmr::vector<PairBuckets> m_ofWorkers;
  std::pmr::vector<std::size_t> m_places;  ///< By bucket: how many pairs precede it; one more at the end.
  Buffer<Pair> m_spare;                    ///< Of a list.
  RadixSort m_radix;
};

}  // namespace allpairs::engine
