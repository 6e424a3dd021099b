// SPDX-License-Identifier: MIT
#include "search/PairSink.h"

#include <algorithm>
#include <string>

#include "allpairs/Error.h"
#include "search/CallExecutor.h"

namespace allpairs::engine {

void checkLimit(std::uint64_t maxPairs, std::uint64_t count) {
  if (count <= maxPairs) return;
  throw LimitExceeded(count, "more than " + std::to_string(maxPairs) + (maxPairs == 1 ? " pair" : " pairs") +
                                 ", the limit that was set; " + std::to_string(count) + " had been found");
}

void PairSink::start(const SinkOptions& options, std::size_t worker) {
  m_options = &options;
  m_worker = worker;
  const bool doubts = options.test.leavesDoubts();
  m_memory.require(SinkOptions::kHitOffset + (doubts ? 3 : 2) * options.hitStride);
  m_hits = {};
  m_hits.row = m_memory.data() + SinkOptions::kHitOffset;
  m_hits.partner = m_hits.row + options.hitStride;
  if (doubts) m_hits.doubt = m_hits.partner + options.hitStride;
  if (doubts) m_hits.slack = options.test.slack();
  m_hits.capacity = options.hitCapacity;
  m_hits.countOnly = options.countOnly && !options.test.needed();
  m_hits.receiver = this;
  m_hits.flush = [](void* self, Hits& hits) { static_cast<PairSink*>(self)->receive(hits); };
  if (!options.test.needed() && !options.countOnly && options.side != PairSide::SmallerFirst) {
    m_hits.rowSecond = options.side == PairSide::RowSecond;
    m_hits.takePairs = [](void* self, std::size_t count) { static_cast<PairSink*>(self)->take(count); };
    m_hits.roomForPairs = [](void* self, Hits& hits, std::size_t most) {
      return static_cast<PairSink*>(self)->roomFor(hits, most);
    };
  }
  m_size = 0;
  m_count = 0;
  m_exactTests = 0;
  // Then it never grows.
  if (options.emit) m_pairs.grow(options.hitCapacity + kVectorSlack);
}

void PairSink::makeRoom(std::size_t size) {
  m_pairs.grow(std::max(m_options->likelyPairs, size), [this] { checkStop(m_options->stop); });
}

Pair* PairSink::roomFor(Hits& hits, std::size_t most) {
  receive(hits);
  makeRoom(m_size + most + kVectorSlack);
  // Streaming stores gather pairs that have been taken already: not where they are given away at once.
  hits.pairsBefore = m_options->emit ? 0 : m_size;
  return m_pairs.data() + m_size;
}

/// Takes so many pairs that have been written behind the others.
void PairSink::take(std::size_t count) {
  if (!m_options->countOnly) m_size += count;
  m_count += count;
  checkLimit(m_options->maxPairs, m_count);
  checkStop(m_options->stop);
  if (m_options->emit) emit();
}

void PairSink::receive(Hits& hits) {
  if (hits.size == 0) return;
  makeRoom(m_size + hits.size + kVectorSlack);
  const std::span<Pair> pairs(m_pairs.data() + m_size, hits.size);
  m_options->kernels->writePairs(hits, m_options->side, pairs.data());
  m_exactTests += m_options->test.exactTestsOf(hits);
  const std::size_t kept = m_options->test.select(pairs, &hits);
  hits.size = 0;
  hits.doubts = 0;
  take(kept);
}

void PairSink::emit() {
  const std::size_t taken = (*m_options->emit)({m_pairs.data(), m_size}, m_worker);
  if (taken == 0) return;
  std::copy(m_pairs.data() + taken, m_pairs.data() + m_size, m_pairs.data());
  m_size -= taken;
}

}  // namespace allpairs::engine
