// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "allpairs/FunctionRef.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"
#include "allpairs/StopFlag.h"
#include "kernels/Hits.h"
#include "kernels/Kernels.h"
#include "memory/Memory.h"
#include "order/PairBuckets.h"
#include "search/PairTest.h"

namespace allpairs::engine {

inline void add(OverlapStatistics& sum, const OverlapStatistics& part) noexcept {
  sum.pairs += part.pairs;
  sum.boxTests += part.boxTests;
  sum.groupTests += part.groupTests;
  sum.exactTests += part.exactTests;
}

/// Pairs that memory is reserved for in advance: those of a scene as most are, and no more than a million.
[[nodiscard]] inline std::size_t likelyPairsOf(std::size_t boxes) noexcept {
  return std::min(kLikelyPairs * boxes, std::size_t{1} << 20);
}

/// How hits become pairs, the same for all workers of a search.
struct SinkOptions {
  PairTest test;
  const Kernels* kernels = nullptr;
  PairSide side = PairSide::RowFirst;

  /// The offset of hits within a page, in ids: beyond the offset of the bounds of some hundred boxes. A processor that
  /// loads from the offset in another page at which it has just stored waits for the store (4K aliasing; few_benchmark).
  static constexpr std::size_t kHitOffset = 640;

  /// Hits that are buffered, and how far apart their arrays are, in ids, which is at least kVectorSlack more. Two arrays
  /// of so many stay in the first-level cache beside what the kernels read (allpairs bench uniform -n 100000).
  std::size_t hitCapacity = 2048;
  std::size_t hitStride = 3072;

  std::uint64_t maxPairs = std::numeric_limits<std::uint64_t>::max();

  /// Space for this many pairs is reserved initially: address space, of which only the used part takes memory.
  std::size_t likelyPairs = 0;

  bool countOnly = false;

  /// If set, runs throw Stopped soon after this is set.
  const StopFlag* stop = nullptr;

  /// Receives the pairs of a worker, which it may change, whenever there are new ones; returns how many of them, from
  /// the first, the sink drops. Without it the sink keeps all pairs.
  std::optional<FunctionRef<std::size_t(std::span<Pair> pairs, std::size_t worker)>> emit = std::nullopt;
};

/// Throws LimitExceeded if there are more pairs than the caller allows.
void checkLimit(std::uint64_t maxPairs, std::uint64_t count);

/// Receives the hits of a worker, converts them to pairs, applies the exact test and the filters, and keeps, counts or
/// emits them.
class PairSink {
 public:
  explicit PairSink(std::pmr::memory_resource* memory) : m_memory(memory), m_pairs(memory) {}

  /// Clears the sink and keeps its memory. The options must outlive the search.
  void start(const SinkOptions& options, std::size_t worker);

  /// Where kernels put their hits.
  [[nodiscard]] Hits& hits() noexcept { return m_hits; }

  /// Takes the remaining hits from the buffer. Call it when the kernels are done.
  void finish() { receive(m_hits); }

  [[nodiscard]] Buffer<Pair>& pairs() noexcept { return m_pairs; }

  /// The memory that hits are received in, free between a search and the start() of the next; at least for so many
  /// numbers.
  [[nodiscard]] std::span<std::uint32_t> idleMemory(std::size_t size) {
    m_memory.require(size);
    return {m_memory.data(), m_memory.capacity()};
  }
  [[nodiscard]] std::size_t size() const noexcept { return m_size; }

  /// Those of all hits so far; the pairs include emitted ones.
  [[nodiscard]] OverlapStatistics statistics() const noexcept {
    return {m_count + m_hits.count, m_hits.boxTests, m_hits.groupTests, m_exactTests};
  }

 private:
  void makeRoom(std::size_t size);
  Pair* roomFor(Hits& hits, std::size_t most);
  void take(std::size_t count);
  void receive(Hits& hits);
  void emit();

  const SinkOptions* m_options = nullptr;
  std::size_t m_worker = 0;
  Hits m_hits;
  Buffer<std::uint32_t> m_memory;
  Buffer<Pair> m_pairs;
  std::size_t m_size = 0;
  std::uint64_t m_count = 0;
  std::uint64_t m_exactTests = 0;
};

}  // namespace allpairs::engine
