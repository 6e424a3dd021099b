// SPDX-License-Identifier: MIT
// Searches that pass pairs to a visitor as they find them, in bounded memory.
#include <algorithm>
#include <numeric>
#include <utility>

#include "allpairs/Error.h"
#include "search/FewBoxes.h"
#include "search/Search.h"

namespace allpairs::engine {
namespace {

/// The initial and the maximum number of boxes in a range of an ordered stream: the first pairs come soon, and memory
/// is bounded. A range of several boxes holds at most kLikelyPairs * kLastRange pairs, 32 MiB.
constexpr std::size_t kFirstRange = std::size_t{1} << 15;
constexpr std::size_t kLastRange = std::size_t{1} << 20;

}  // namespace

void Search::stream(const Sets& sets, const OverlapOptions& options, PairVisitor visitor, std::size_t batchSize) {
  if (batchSize == 0) throw InvalidArgument("a batch size of 0 pairs");
  std::uint64_t given = 0;
  const auto give = [&](std::span<const Pair> pairs) {
    // If what follows throws, there has been no search.
    const OverlapStatistics statistics = std::exchange(m_statistics, {});
    for (std::size_t begin = 0; begin < pairs.size(); begin += batchSize) {
      const std::span<const Pair> batch = pairs.subspan(begin, std::min(batchSize, pairs.size() - begin));
      if (given != 0) checkStop(options.stop);
      given += batch.size();
      checkLimit(options.maxPairs, given);
      visitor(batch);
    }
    m_statistics = statistics;
  };
  if (pairsOf(sets) <= kMostFew * kMostFew && areFew(sets, options)) {
    if (options.maxPairs >= pairsOf(sets)) {
      give(findAmongFew(sets, options, options.order));
    } else {
      OverlapOptions unlimited = options;
      unlimited.maxPairs = OverlapOptions().maxPairs;  // the batches are counted
      give(findAmongFew(sets, unlimited, options.order));
    }
    m_pairs = {};
    return;
  }
  begin(sets, options);
  if (options.order != Order::Unordered) {
    std::size_t likelyPairs = 0;
    const Sets& read = m_fewValues.of(sets, options, *m_executor);
    const Readers readers = Readers::of(read, options, *m_kernels);
    if (!choosesFlat(readers, options, likelyPairs)) {
      streamInRanges(read, options, readers, give);
      return;
    }
  }
  // Full batches are passed on at once; the rest waits for the next pairs.
  const auto giveFull = [&](std::span<Pair> pairs, std::size_t) {
    const std::size_t full = pairs.size() / batchSize * batchSize;
    give(pairs.first(full));
    return full;
  };
  Plan plan = planOf(sets, options, options.order);
  plan.sink.likelyPairs = 0;                       // passed on before there are many
  plan.sink.maxPairs = OverlapOptions().maxPairs;  // the batches are counted
  plan.sink.emit.emplace(giveFull);
  m_executor = &m_callExecutor.over(nullptr, options.stop);  // The visitor is called on the calling thread.
  run(plan);
  give({m_runner.sink(0).pairs().data(), m_runner.sink(0).size()});
}

/// Searches the boxes that pairs are ordered by, range by range, each range against all boxes of the other side.
void Search::streamInRanges(const Sets& sets, const OverlapOptions& options, const Readers& readers,
                            FunctionRef<void(std::span<const Pair>)> give) {
  const BoxReader& rows = readers.rows(options.order);
  m_second.build(readers.columns(options.order), *m_executor);
  OverlapStatistics total;
  std::size_t length = kFirstRange;
  for (std::size_t begin = 0; begin < rows.size();) {
    const std::size_t end = std::min(rows.size(), begin + length);
    m_range.require(end - begin);
    std::iota(m_range.data(), m_range.data() + (end - begin), static_cast<std::uint32_t>(begin));
    BoxReader range = rows;
    range.restrictTo({m_range.data(), end - begin});
    if (!findRange(sets, options, range)) {
      length = (end - begin + 1) / 2;
      continue;
    }
    give(m_pairs);
    add(total, std::exchange(m_statistics, {}));
    begin = end;
    length = std::min(2 * length, kLastRange);
  }
  m_statistics = total;
}

bool Search::findRange(const Sets& sets, const OverlapOptions& options, const BoxReader& range) {
  m_first.build(range, *m_executor);
  Plan plan{sets, options.order, {PairTest::of(sets, options), m_kernels}};
  joinBoth(false, plan);
  plan.sink.test.requireExactTestInDoubt(!m_first.exact() || !m_second.exact(), range);
  if (sets.one) plan.sink.test.requireAscending();
  plan.sink.side = options.order == Order::BySecond ? PairSide::RowSecond : PairSide::RowFirst;
  plan.sink.stop = options.stop;
  if (range.size() > 1) plan.sink.maxPairs = kLikelyPairs * kLastRange;
  m_statistics = {};
  try {
    run(plan);
  } catch (const LimitExceeded&) {
    // The caller halves a range of too many pairs; any other limit is one that the filter throws.
    if (m_runner.totals().pairs > plan.sink.maxPairs) return false;
    throw;
  }
  concatenate(nullptr);
  sortPairs(plan);
  return true;
}

}  // namespace allpairs::engine
