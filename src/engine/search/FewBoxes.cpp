// SPDX-License-Identifier: MIT
#include "search/FewBoxes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>

#include "allpairs/StopFlag.h"
#include "allpairs/Worlds.h"
#include "input/BoxRuns.h"
#include "input/Parts.h"
#include "input/Readers.h"
#include "kernels/Kernels.h"
#include "search/FewBesideMany.h"
#include "search/PairSink.h"
#include "search/PairTest.h"
#include "search/PairsOnStack.h"

namespace allpairs::engine {
namespace {

/// Up to so many pairs of two sets, and twice as many of one, a plain loop over them takes less time than arranging
/// boxes for vectors (docs/decisions/0009, few_benchmark).
constexpr std::size_t kTestedPairs = 24;

/// Room for the hits that are buffered, more than those of one box and so few that they fit on the stack, and for what
/// a vector writes behind them.
constexpr std::size_t kHitStride = 2 * LaneTile::kCapacity + kVectorSlack;

/// What a sink of them allocates: three arrays of hits, and the pairs.
constexpr std::size_t kSinkBytes =
    sizeof(std::uint32_t) * (SinkOptions::kHitOffset + 3 * kHitStride) + sizeof(Pair) * kHitStride;

using TakePairs = FunctionRef<void(std::span<const Pair>)>;

/// Whether boxes lie in memory one after the other, of two sets as rows of six.
template <class T>
bool arePlain(const Sets& sets) {
  return sets.one ? areRun<T>(sets.first) : areRows<T>(sets.first) && areRows<T>(sets.second);
}

/// Tests the pairs one after the other; returns the number of hits.
template <class T>
std::size_t testAll(const BoxRun<T>& boxes, bool bySecond, Pair* pairs) {
  std::size_t found = 0;
  for (std::uint32_t i = 0; i < boxes.size; ++i) {
    for (std::uint32_t j = bySecond ? 0 : i + 1; j < (bySecond ? i : boxes.size); ++j) {
      pairs[found] = bySecond ? Pair{j, i} : Pair{i, j};
      const BoxRun<T> a = boxes.part(i, 1);
      const BoxRun<T> b = boxes.part(j, 1);
      found += static_cast<std::size_t>(areHit(a.min, a.max, b.min, b.max));
    }
  }
  return found;
}

template <class T>
std::size_t testAll(const PlainSearch<T>& search, Pair* pairs) {
  std::size_t found = 0;
  for (std::uint32_t i = 0; i < search.rowCount; ++i) {
    for (std::uint32_t j = 0; j < search.columnCount; ++j) {
      pairs[found] = search.rowSecond ? Pair{j, i} : Pair{i, j};
      found += static_cast<std::size_t>(areHit(search.rows + 6 * std::size_t{i}, search.columns + 6 * std::size_t{j}));
    }
  }
  return found;
}

/// The search of two sets of rows, by the index that pairs are ordered by. All boxes against a single one are in its
/// order too if that is the row, which takes fewer tests of a vector.
template <class T>
PlainSearch<T> plainSearch(const Sets& sets, Order order) {
  const T* const first = cornersOf<T>(sets.first).min.data;
  const T* const second = cornersOf<T>(sets.second).min.data;
  const std::size_t firstSize = sets.first.size();
  const std::size_t secondSize = sets.second.size();
  if (secondSize == 1 || (order == Order::BySecond && firstSize != 1))
    return {second, first, secondSize, firstSize, true};
  return {first, second, firstSize, secondSize, false};
}

/// Calls take with the pairs of one set, which are those of a world, part by part.
template <class T>
void findAmong(const Sets& sets, const Kernels& kernels, Order order, TakePairs take) {
  static_assert(WorldSink::pairsOf(kWordBoxes) <= kPartSize && kMostFew <= kMostInWorld);
  PairsOnStack<kPartSize + kVectorSlack> pairs;
  const std::array<std::uint64_t, 2> begin{0, sets.first.size()};
  const Worlds world(sets.first, begin);
  std::uint64_t pairEnd = 0;
  WorldsRun<T> run;
  run.boxes = runOf<T>(sets.first);
  run.worlds = &world;
  run.end = 1;
  run.sink = {pairs.data(), kPartSize + kVectorSlack};
  run.sink.bySecond = order == Order::BySecond;
  run.sink.emit = &take;
  run.hadMany = true;
  run.pairEnd = &pairEnd;
  kernels.plain<T>().searchWorlds(run);
  take({pairs.data(), run.sink.size});
}

template <class T>
void findBetween(const Sets& sets, const Kernels& kernels, Order order, TakePairs take) {
  static_assert(kPartSize >= kMostFew);
  PairsOnStack<kPartSize + kVectorSlack> pairs;
  PlainSearch<T> search = plainSearch<T>(sets, order);
  search.room = kPartSize;
  while (search.rowBegin < search.rowCount) take({pairs.data(), kernels.plain<T>().searchFew(search, pairs.data())});
}

template <class T>
void testPlain(const Sets& sets, Order order, TakePairs take) {
  PairsOnStack<2 * kTestedPairs> pairs;
  const bool bySecond = order == Order::BySecond;
  const std::size_t found = sets.one ? testAll(runOf<T>(sets.first), bySecond, pairs.data())
                                     : testAll(plainSearch<T>(sets, order), pairs.data());
  take({pairs.data(), found});
}

template <class T>
OverlapStatistics findPlain(const Sets& sets, const OverlapOptions& options, Order order, TakePairs take) {
  OverlapStatistics statistics;
  statistics.boxTests = pairsOf(sets);
  const auto taken = [&](std::span<const Pair> pairs) {
    if (statistics.pairs != 0) checkStop(options.stop);  // Between parts.
    statistics.pairs += pairs.size();
    checkLimit(options.maxPairs, statistics.pairs);
    if (!pairs.empty()) take(pairs);
  };
  // An instruction set that is asked for has to be there, and is used.
  const bool isTested = statistics.boxTests <= (sets.one ? 2 : 1) * kTestedPairs && options.instructionSet.empty();
  const Kernels* const kernels = isTested ? nullptr : &chooseKernels(options);
  if (statistics.boxTests == 0) return statistics;
  checkStop(options.stop);
  if (kernels == nullptr) {
    testPlain<T>(sets, order, taken);
  } else {
    sets.one ? findAmong<T>(sets, *kernels, order, taken) : findBetween<T>(sets, *kernels, order, taken);
  }
  return statistics;
}

OverlapStatistics findInTiles(const Sets& sets, const OverlapOptions& options, Order order, TakePairs take) {
  checkOptions(sets, options);
  checkStop(options.stop);
  const Kernels& kernels = chooseKernels(options);
  PairTest test = PairTest::of(sets, options);
  const Readers readers = Readers::of(sets, options, kernels);
  LaneTile columns;
  LaneTile rows;
  FlatSearch search;
  search.columns.tiles = &columns;
  search.rows.tiles = &rows;
  const bool exact = readers.readAll(order, search);
  test.requireExactTestInDoubt(!exact, readers.first.origin());
  const auto emit = [&](std::span<const Pair> pairs, std::size_t) {
    take(pairs);
    return pairs.size();
  };
  SinkOptions sinkOptions{test, &kernels, order == Order::BySecond ? PairSide::RowSecond : PairSide::RowFirst};
  sinkOptions.hitCapacity = kHitStride - kVectorSlack;
  sinkOptions.hitStride = kHitStride;
  sinkOptions.maxPairs = options.maxPairs;
  sinkOptions.stop = options.stop;
  sinkOptions.emit.emplace(emit);
  alignas(64) std::array<std::byte, kSinkBytes + 64> bytes;
  std::pmr::monotonic_buffer_resource memory(bytes.data(), bytes.size(), std::pmr::null_memory_resource());
  PairSink sink(&memory);
  sink.start(sinkOptions, 0);
  sink.hits().roomForPairs = nullptr;  // Rows are too short to be written one by one.
  kernels.searchFlat(search, sink.hits());
  sink.finish();
  return sink.statistics();
}

}  // namespace

std::size_t pairsOf(const Sets& sets) noexcept {
  const std::size_t size = sets.first.size();
  return sets.one ? WorldSink::pairsOf(size) : size * sets.second.size();
}

bool areFew(const Sets& sets, const OverlapOptions& options) {
  const std::size_t size = std::max(sets.first.size(), sets.second.size());
  if (areFewBesideMany(sets, options)) return true;
  if (options.strategy == Strategy::Bvh || size > kMostFew) return false;
  if (size <= kWordBoxes) return true;  // With any instruction set.
  const Kernels* const kernels = findKernels(options.instructionSet);
  if (kernels == nullptr || options.strategy == Strategy::Exhaustive) return true;
  // Where no order is asked for, the list does not depend on how boxes lie in memory.
  const bool isPlain = sets.one && options.order != Order::Unordered && onlyBoundsMatter(sets, options) &&
                       (arePlain<float>(sets) || arePlain<double>(sets));
  const std::size_t most = isPlain ? kernels->plainBoxes : kernels->flatBoxes;
  return sets.first.size() * sets.second.size() <= most * most;
}

OverlapStatistics findFew(const Sets& sets, const OverlapOptions& options, Order order,
                          FunctionRef<void(std::span<const Pair>)> take) {
  if (areFewBesideMany(sets, options)) return findFewBesideMany(sets, options, order, take);
  const bool isPlain = onlyBoundsMatter(sets, options);
  if (isPlain && arePlain<float>(sets)) return findPlain<float>(sets, options, order, take);
  if (isPlain && arePlain<double>(sets)) return findPlain<double>(sets, options, order, take);
  return findInTiles(sets, options, order, take);
}

}  // namespace allpairs::engine
