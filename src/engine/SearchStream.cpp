// SPDX-License-Identifier: MIT
// Searches that hand their pairs over as they go, in bounded memory.
#include <algorithm>
#include <limits>

#include "Search.h"

namespace allpairs::engine {
namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// Boxes of a range when an ordered stream starts, and at most.
constexpr std::size_t kFirstRange = std::size_t{1} << 15;
constexpr std::size_t kLastRange = std::size_t{1} << 20;

/// Pairs of a range that are held at a time, at most, unless a single box has more partners.
constexpr std::uint64_t kRangePairs = std::uint64_t{1} << 22;

void handOver(std::span<const Pair> pairs, std::size_t batchSize, PairVisitor visitor) {
  for (std::size_t begin = 0; begin < pairs.size(); begin += batchSize) {
    visitor(pairs.subspan(begin, std::min(batchSize, pairs.size() - begin)));
  }
}

/// Hands over full batches as they come; the rest waits for the next pairs.
struct Batcher {
  std::size_t batchSize;
  PairVisitor visitor;

  void take(PairReceiver& receiver) const {
    if (receiver.size() < batchSize) return;
    const std::size_t full = receiver.size() / batchSize * batchSize;
    handOver({receiver.pairs().data(), full}, batchSize, visitor);
    receiver.drop(full);
  }
};

}  // namespace

void Search::stream(const Sets& sets, const OverlapOptions& options, PairVisitor visitor) {
  begin(sets, options);
  OverlapOptions unlimited = options;
  unlimited.maxPairs = kNoLimit;
  if (options.order != Order::Unordered && !choose(sets, options).flat) {
    streamInRanges(sets, unlimited, visitor);
    return;
  }
  PairTest test(sets.first, sets.second, options, sets.one);
  Plan all = plan(sets, unlimited, test);
  all.rules.likelyPairs = 0;  // handed on before there are many
  streamAll(all, options.batchSize, visitor);
}

void Search::streamAll(const Plan& plan, std::size_t batchSize, PairVisitor visitor) {
  startWorkers(1, plan);
  Worker& worker = *m_workers[0];
  Batcher batcher{batchSize, visitor};
  worker.receiver.whenAdded(
      [](void* context, PairReceiver& receiver) { static_cast<Batcher*>(context)->take(receiver); }, &batcher);
  runPart(plan, 0, plan.units, worker);
  worker.receiver.finish();
  handOver({worker.receiver.pairs().data(), worker.receiver.size()}, batchSize, visitor);
  collect();
}

/// The boxes that the pairs are ordered by, range by range, each against all of the other side.
void Search::streamInRanges(const Sets& sets, const OverlapOptions& options, PairVisitor visitor) {
  const bool bySecond = options.order == Order::BySecond;
  const BoxSet& rows = bySecond ? sets.second : sets.first;
  m_secondHierarchy.build(LaneReader(bySecond ? sets.first : sets.second, options), *m_kernels, *m_executor);
  OverlapStatistics total;
  std::size_t length = kFirstRange;
  for (std::size_t begin = 0; begin < rows.size();) {
    const std::size_t end = std::min(rows.size(), begin + length);
    if (!findRange(sets, options, begin, end)) {
      length = (end - begin + 1) / 2;
      continue;
    }
    handOver(m_pairs, options.batchSize, visitor);
    total.pairs += m_statistics.pairs;
    total.boxTests += m_statistics.boxTests;
    total.groupTests += m_statistics.groupTests;
    total.exactTests += m_statistics.exactTests;
    begin = end;
    length = std::min(2 * length, kLastRange);
  }
  m_statistics = total;
}

bool Search::findRange(const Sets& sets, const OverlapOptions& options, std::size_t begin, std::size_t end) {
  const bool bySecond = options.order == Order::BySecond;
  const BoxSet range = (bySecond ? sets.second : sets.first).slice(begin, end);
  PairTest test(sets.first, sets.second, options, sets.one);
  m_firstHierarchy.build(LaneReader(range, options), *m_kernels, *m_executor);
  m_firstHierarchy.deepen(m_secondHierarchy.hierarchy().depth);
  m_secondHierarchy.deepen(m_firstHierarchy.hierarchy().depth);
  test.requireExactTest(!m_firstHierarchy.exact() || !m_secondHierarchy.exact());
  Plan plan;
  plan.blocked = true;
  plan.withItself = false;
  plan.rules = {m_kernels, &test};
  plan.rules.side = bySecond ? PairSide::RowSecond : PairSide::RowFirst;
  plan.rules.maxPairs = end - begin == 1 ? kNoLimit : kRangePairs;
  plan.rules.limitIsCallers = false;
  plan.rules.firstRow = static_cast<std::uint32_t>(begin);
  plan.rules.ascendingOnly = sets.one;
  const bool nothing = m_firstHierarchy.hierarchy().depth == 0 || m_secondHierarchy.hierarchy().depth == 0;
  plan.units = nothing ? 0 : m_firstHierarchy.hierarchy().level[0].blockCount();
  m_statistics = {};
  try {
    runAll(plan);
  } catch (const Overfull&) {
    return false;  // More than may be held at a time: the caller halves the range.
  }
  join(plan);
  sortPairs(sets, options.order);
  return true;
}

}  // namespace allpairs::engine
