// SPDX-License-Identifier: MIT
#include "search/FewBoxes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>

#include "allpairs/StopFlag.h"
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

/// Up to so many pairs of boxes, a plain loop over them takes less time than arranging boxes for vectors
/// (docs/decisions/0009, few_benchmark).
constexpr std::size_t kTestedPairs = 24;

/// Room for the hits that are buffered, more than those of one box and so few that they fit on the stack, and for what
/// a vector writes behind them.
constexpr std::size_t kHitStride = 2 * LaneTile::kCapacity + kVectorSlack;

/// What a sink of them allocates: three arrays of hits, and the pairs.
constexpr std::size_t kSinkBytes =
    sizeof(std::uint32_t) * (SinkOptions::kHitOffset + 3 * kHitStride) + sizeof(Pair) * kHitStride;

/// All pairs, by row; returns their number.
template <class T>
std::size_t testAll(PlainSearch<T>& search, Pair* pairs) {
  std::size_t found = 0;
  for (std::uint32_t i = 0; i < search.rowCount; ++i) {
    const std::uint32_t begin = search.tested == Columns::Following ? i + 1 : 0;
    const std::size_t end = search.tested == Columns::Preceding ? i : search.columnCount;
    for (std::uint32_t j = begin; j < end; ++j) {
      pairs[found] = search.rowSecond ? Pair{j, i} : Pair{i, j};
      found += static_cast<std::size_t>(areHit(search.rows + 6 * std::size_t{i}, search.columns + 6 * std::size_t{j}));
    }
  }
  search.rowBegin = search.rowCount;
  return found;
}

/// Whether boxes are compared as they are: only their bounds matter, which are rows.
bool arePlain(const Sets& sets, const OverlapOptions& options) {
  return onlyBoundsMatter(sets, options) && ((areRows<float>(sets.first) && areRows<float>(sets.second)) ||
                                             (areRows<double>(sets.first) && areRows<double>(sets.second)));
}

/// The search of two sets of rows, or of one twice, by the index that pairs are ordered by. All boxes against a single
/// one are in its order too if that is the row, which takes fewer tests of a vector.
template <class T>
PlainSearch<T> plainSearch(const Sets& sets, Order order) {
  const T* const first = cornersOf<T>(sets.first).min.data;
  const T* const second = cornersOf<T>(sets.second).min.data;
  const std::size_t firstSize = sets.first.size();
  const std::size_t secondSize = sets.second.size();
  const bool bySecond = order == Order::BySecond;
  if (sets.one) {
    const Columns tested = bySecond ? Columns::Preceding : Columns::Following;
    return {first, first, firstSize, firstSize, tested, bySecond};
  }
  if (secondSize == 1 || (bySecond && firstSize != 1))
    return {second, first, secondSize, firstSize, Columns::All, true};
  return {first, second, firstSize, secondSize, Columns::All, false};
}

/// Finds the pairs of the rows that are left, or of some of them if there are many; without kernels, tests one pair
/// after the other.
template <class T>
std::size_t searchSome(PlainSearch<T>& search, const Kernels* kernels, Pair* pairs) {
  return kernels == nullptr ? testAll(search, pairs) : kernels->plain<T>().searchFew(search, pairs);
}

template <class T>
OverlapStatistics findPlain(const Sets& sets, const OverlapOptions& options, Order order,
                            FunctionRef<void(std::span<const Pair>)> take) {
  static_assert(kPartSize >= kMostFew && kPartSize >= kTestedPairs);
  PairsOnStack<kPartSize + kVectorSlack> pairs;
  PlainSearch<T> search = plainSearch<T>(sets, order);
  search.room = kPartSize;
  const std::size_t most = pairsOf(sets);
  // An instruction set that is asked for has to be there, and is used.
  const bool isTested = most <= kTestedPairs && options.instructionSet.empty();
  const Kernels* const kernels = isTested ? nullptr : &chooseKernels(options);
  OverlapStatistics statistics;
  statistics.boxTests = most;
  while (most != 0 && search.rowBegin < search.rowCount) {
    checkStop(options.stop);
    const std::size_t found = searchSome(search, kernels, pairs.data());
    statistics.pairs += found;
    checkLimit(options.maxPairs, statistics.pairs);
    if (found != 0) take({pairs.data(), found});
  }
  return statistics;
}

OverlapStatistics findInTiles(const Sets& sets, const OverlapOptions& options, Order order,
                              FunctionRef<void(std::span<const Pair>)> take) {
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
  return sets.first.size() * sets.second.size() <= kernels->flatBoxes * kernels->flatBoxes;
}

OverlapStatistics findFew(const Sets& sets, const OverlapOptions& options, Order order,
                          FunctionRef<void(std::span<const Pair>)> take) {
  if (areFewBesideMany(sets, options)) return findFewBesideMany(sets, options, order, take);
  if (!arePlain(sets, options)) return findInTiles(sets, options, order, take);
  return sets.first.isFloat64() ? findPlain<double>(sets, options, order, take)
                                : findPlain<float>(sets, options, order, take);
}

}  // namespace allpairs::engine
