// SPDX-License-Identifier: MIT
#include "search/FewBoxes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <utility>

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

/// Up to so many pairs of boxes a plain loop over them takes less time than arranging boxes for vectors
/// (docs/decisions/0009, few_benchmark).
constexpr std::size_t kTestedPairs = 40;

/// Room for the hits that are buffered, more than those of one box and so few that they fit on the stack, and for what
/// a vector writes behind them.
constexpr std::size_t kHitStride = 2 * LaneTile::kCapacity + kVectorSlack;

/// What a sink of them allocates: three arrays of hits, and the pairs.
constexpr std::size_t kSinkBytes =
    sizeof(std::uint32_t) * (SinkOptions::kHitOffset + 3 * kHitStride) + sizeof(Pair) * kHitStride;

using TakePairs = FunctionRef<void(std::span<const Pair>)>;

/// Tests the pairs one after the other; returns the number of hits.
template <class T>
std::size_t testAmong(const BoxRun<T>& boxes, bool bySecond, Pair* pairs) {
  std::size_t found = 0;
  for (std::uint32_t i = 0; i < boxes.size; ++i) {
    for (std::uint32_t j = bySecond ? 0 : i + 1; j < (bySecond ? i : boxes.size); ++j) {
      pairs[found] = bySecond ? Pair{j, i} : Pair{i, j};
      found += static_cast<std::size_t>(areHit(boxes, i, boxes, j));
    }
  }
  return found;
}

template <class T>
std::size_t testBetween(const BetweenRun<T>& run, Pair* pairs) {
  std::size_t found = 0;
  for (std::uint32_t i = 0; i < run.rows.size; ++i) {
    for (std::uint32_t j = 0; j < run.columns.size; ++j) {
      pairs[found] = run.sink.bySecond ? Pair{j, i} : Pair{i, j};
      found += static_cast<std::size_t>(areHit(run.rows, i, run.columns, j));
    }
  }
  return found;
}

/// The search of two sets by the index that pairs are ordered by. All boxes against a single one are in its order too
/// if that is the row, which takes fewer tests of a vector.
template <class T>
BetweenRun<T> betweenRun(const Sets& sets, Order order) {
  BetweenRun<T> run{runOf<T>(sets.first), runOf<T>(sets.second), {}};
  run.sink.bySecond = run.columns.size == 1 || (order == Order::BySecond && run.rows.size != 1);
  if (run.sink.bySecond) std::swap(run.rows, run.columns);
  return run;
}

/// The search of one set as a world.
template <class T>
WorldsRun<T> worldRun(const Sets& sets, Order order, const Worlds& world, std::uint64_t& pairEnd) {
  WorldsRun<T> run;
  run.boxes = runOf<T>(sets.first);
  run.worlds = &world;
  run.end = 1;
  run.sink.bySecond = order == Order::BySecond;
  run.hadMany = true;
  run.pairEnd = &pairEnd;
  return run;
}

/// Calls take with the pairs that a search finds, part by part.
template <class Run>
void runPlain(Run& run, void (*search)(Run& run), TakePairs take) {
  static_assert(WorldSink::pairsOf(kWordBoxes) <= kPartSize && kMostFew <= kMostInWorld);
  PairsOnStack<kPartSize + kVectorSlack> pairs;
  run.sink.pairs = pairs.data();
  run.sink.capacity = kPartSize + kVectorSlack;
  run.sink.emit = &take;
  search(run);
  take({pairs.data(), run.sink.size});
}

template <class T>
void findByKernel(const Sets& sets, const PlainKernels<T>& kernels, Order order, TakePairs take) {
  if (!sets.one) {
    BetweenRun<T> run = betweenRun<T>(sets, order);
    return runPlain(run, kernels.searchBetween, take);
  }
  const std::array<std::uint64_t, 2> begin{0, sets.first.size()};
  const Worlds world(sets.first, begin);
  std::uint64_t pairEnd = 0;
  WorldsRun<T> run = worldRun<T>(sets, order, world, pairEnd);
  runPlain(run, kernels.searchWorlds, take);
}

/// A plain loop over so few pairs.
template <class T>
void testPlain(const Sets& sets, Order order, TakePairs take) {
  PairsOnStack<kTestedPairs> pairs;
  const std::size_t found = sets.one ? testAmong(runOf<T>(sets.first), order == Order::BySecond, pairs.data())
                                     : testBetween(betweenRun<T>(sets, order), pairs.data());
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
  const bool isTested = statistics.boxTests <= kTestedPairs && options.instructionSet.empty();
  const Kernels* const kernels = isTested ? nullptr : &chooseKernels(options);
  if (statistics.boxTests == 0) return statistics;
  checkStop(options.stop);
  if (kernels == nullptr) {
    testPlain<T>(sets, order, taken);
  } else {
    findByKernel<T>(sets, kernels->plain<T>(), order, taken);
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
  test.requireExactTestInDoubt(!exact, readers.first);
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
  const bool isPlain =
      sets.one && options.order != Order::Unordered && onlyBoundsMatter(sets, options) && isRun(sets.first);
  const std::size_t most = isPlain ? kernels->plainBoxes : kernels->flatBoxes;
  return sets.first.size() * sets.second.size() <= most * most;
}

OverlapStatistics findFew(const Sets& sets, const OverlapOptions& options, Order order,
                          FunctionRef<void(std::span<const Pair>)> take) {
  if (areFewBesideMany(sets, options)) return findFewBesideMany(sets, options, order, take);
  const bool isPlain =
      onlyBoundsMatter(sets, options) && (sets.one ? isRun(sets.first) : areRuns(sets.first, sets.second));
  if (!isPlain) return findInTiles(sets, options, order, take);
  return sets.first.isFloat64() ? findPlain<double>(sets, options, order, take)
                                : findPlain<float>(sets, options, order, take);
}

OverlapStatistics countFew(const Sets& sets, const OverlapOptions& options) {
  const auto ignore = [](std::span<const Pair>) {};
  return findFew(sets, options, options.order, ignore);
}

}  // namespace allpairs::engine
