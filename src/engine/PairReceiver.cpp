// SPDX-License-Identifier: MIT
#include "PairReceiver.h"

#include <algorithm>
#include <string>

#include "allpairs/Error.h"

namespace allpairs::engine {
namespace {

/// Two arrays of this many ids stay in the first-level cache beside what the kernels read.
constexpr std::size_t kHitCapacity = 2048;

/// Where they begin within a page, in ids: behind where the bounds of some hundred boxes lie in theirs. A processor that
/// loads from the same place in another page as it has just stored to waits for the store.
constexpr std::size_t kHitOffset = 640;
constexpr std::size_t kHitStride = 3072;
static_assert(kHitStride >= kHitCapacity + Hits::kSlack);

}  // namespace

void checkLimit(const PairRules& rules, std::uint64_t count) {
  if (rules.countOnly || count <= rules.maxPairs) return;
  if (!rules.limitIsCallers) throw Overfull();
  throw LimitExceeded(count, "more than " + std::to_string(rules.maxPairs) + " pairs, the limit that was set; " +
                                 std::to_string(count) + " had been found");
}

void PairReceiver::start(const PairRules& rules) {
  m_rules = &rules;
  m_memory.require(kHitOffset + 2 * kHitStride);
  m_hits = {};
  m_hits.row = m_memory.data() + kHitOffset;
  m_hits.partner = m_hits.row + kHitStride;
  m_hits.capacity = kHitCapacity;
  m_hits.countOnly = rules.countOnly && !rules.test->needed() && !rules.ascendingOnly;
  m_hits.receiver = this;
  m_hits.flush = [](void* self, Hits& hits) { static_cast<PairReceiver*>(self)->receive(hits); };
  if (!isSelective() && !rules.countOnly && rules.side != PairSide::SmallerFirst) {
    m_hits.rowSecond = rules.side == PairSide::RowSecond;
    m_hits.takePairs = [](void* self, std::size_t count) { static_cast<PairReceiver*>(self)->take(count); };
    m_hits.roomForPairs = [](void* self, Hits& hits, std::size_t most) {
      return static_cast<PairReceiver*>(self)->roomFor(hits, most);
    };
  }
  m_size = 0;
  m_count = 0;
  m_exactTests = 0;
  m_added = nullptr;
}

void PairReceiver::whenAdded(void (*added)(void* context, PairReceiver& receiver), void* context) {
  m_added = added;
  m_context = context;
  m_hits.roomForPairs = nullptr;
}

bool PairReceiver::isSelective() const noexcept {
  return m_rules->firstRow != 0 || m_rules->ascendingOnly || m_rules->test->needed();
}

RoomForPairs PairReceiver::roomFor(Hits& hits, std::size_t most) {
  receive(hits);
  m_pairs.grow(std::max(m_rules->likelyPairs, m_size + most + Hits::kSlack));
  return {m_pairs.data() + m_size, m_size};
}

void PairReceiver::take(std::size_t count) {
  m_size += count;
  m_count += count;
  checkLimit(*m_rules, m_count);
}

void PairReceiver::receive(Hits& hits) {
  if (hits.size == 0) return;
  const std::size_t begin = m_size;
  m_pairs.grow(std::max(m_rules->likelyPairs, begin + hits.size + Hits::kSlack));
  m_rules->kernels->writePairs(hits, m_rules->side, m_pairs.data() + begin);
  m_size += hits.size;
  hits.size = 0;
  if (isSelective()) selectTested(begin, m_size);
  m_count += m_size - begin;
  if (m_rules->countOnly) m_size = begin;
  checkLimit(*m_rules, m_count);
  if (m_added != nullptr) m_added(m_context, *this);
}

void PairReceiver::selectTested(std::size_t begin, std::size_t end) {
  std::size_t kept = begin;
  for (std::size_t i = begin; i < end; ++i) {
    Pair pair = m_pairs[i];
    (m_rules->side == PairSide::RowSecond ? pair.second : pair.first) += m_rules->firstRow;
    if (m_rules->ascendingOnly && pair.first >= pair.second) continue;
    if (m_rules->test->needed() && !m_rules->test->keeps(pair)) continue;
    m_pairs[kept++] = pair;
  }
  if (m_rules->test->exactTestNeeded()) m_exactTests += end - begin;
  m_size = kept;
}

}  // namespace allpairs::engine
