// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "Hits.h"
#include "Kernels.h"
#include "Memory.h"
#include "PairTest.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// More pairs than the search has set itself as a limit. Not an error: the search catches it.
struct Overfull {};

/// How hits become pairs, the same for all tasks of a search.
struct PairRules {
  const Kernels* kernels = nullptr;
  const PairTest* test = nullptr;
  PairSide side = PairSide::RowFirst;
  std::uint64_t maxPairs = 0;

  /// Room for this many pairs is made at first: address space, of which only what is used takes memory.
  std::size_t likelyPairs = 0;

  /// Whether more pairs than that are the caller's to hear of; otherwise they are an Overfull for the search itself.
  bool limitIsCallers = true;
  bool countOnly = false;

  /// Rows are numbered from here; more than 0 only where a part of a set is searched.
  std::uint32_t firstRow = 0;

  /// Keeps pairs with first < second only: where part of a set meets the whole of it.
  bool ascendingOnly = false;
};

/// Throws LimitExceeded or Overfull where there are more pairs than the rules allow.
void checkLimit(const PairRules& rules, std::uint64_t count);

/// Receives the hits of a task, turns them into pairs, tests what is left to test, and keeps or counts them.
class PairReceiver {
 public:
  /// Starts anew: nothing received, memory kept. The rules must outlive the search.
  void start(const PairRules& rules);

  /// Where kernels put their hits.
  [[nodiscard]] Hits& hits() noexcept { return m_hits; }

  /// Takes what the kernels have left in the buffer of hits. To be called when they are done.
  void finish() { receive(m_hits); }

  [[nodiscard]] const Buffer<Pair>& pairs() const noexcept { return m_pairs; }
  [[nodiscard]] Buffer<Pair>& pairs() noexcept { return m_pairs; }
  [[nodiscard]] std::size_t size() const noexcept { return m_size; }
  [[nodiscard]] std::uint64_t count() const noexcept { return m_count + m_hits.count; }
  [[nodiscard]] std::uint64_t exactTests() const noexcept { return m_exactTests; }

  /// Forgets the first pairs that it holds, so that others may take their place; they stay counted.
  void drop(std::size_t count) noexcept {
    std::copy(m_pairs.data() + count, m_pairs.data() + m_size, m_pairs.data());
    m_size -= count;
  }

  /// Has a function called whenever pairs have been added; it may drop them.
  void whenAdded(void (*added)(void* context, PairReceiver& receiver), void* context);

 private:
  [[nodiscard]] bool isSelective() const noexcept;
  RoomForPairs roomFor(Hits& hits, std::size_t most);
  void take(std::size_t count);
  void receive(Hits& hits);
  void selectTested(std::size_t begin, std::size_t end);

  const PairRules* m_rules = nullptr;
  Hits m_hits;
  Buffer<std::uint32_t> m_memory;
  Buffer<Pair> m_pairs;
  std::size_t m_size = 0;
  std::uint64_t m_count = 0;
  std::uint64_t m_exactTests = 0;
  void (*m_added)(void* context, PairReceiver& receiver) = nullptr;
  void* m_context = nullptr;
};

}  // namespace allpairs::engine
