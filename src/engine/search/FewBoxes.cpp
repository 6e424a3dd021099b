// SPDX-License-Identifier: MIT
#include "search/FewBoxes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <span>
#include <utility>

#include "allpairs/StopFlag.h"
#include "allpairs/Worlds.h"
#include "input/BoxRuns.h"
#include "input/Parts.h"
#include "input/Readers.h"
#include "kernels/Kernels.h"
#include "search/PairSink.h"
#include "search/PairTest.h"

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

/// Whether a loop may test the pairs: an instruction set that is asked for has to be there, and is used.
bool canBeTested(const Sets& sets, const OverlapOptions& options) noexcept {
  return pairsOf(sets) <= kTestedPairs && options.instructionSet.empty();
}

/// The pairs that overlap, whatever the options but the instruction set and the stop flag say.
template <class T>
void findPlain(const Sets& sets, const OverlapOptions& options, Order order, TakePairs take) {
  const Kernels* const kernels = canBeTested(sets, options) ? nullptr : &chooseKernels(options.instructionSet);
  if (pairsOf(sets) == 0) return;
  checkStop(options.stop);
  if (kernels == nullptr) {
    testPlain<T>(sets, order, take);
  } else {
    findByKernel<T>(sets, kernels->plain<T>(), order, take);
  }
}

void findPlain(const Sets& sets, const OverlapOptions& options, Order order, TakePairs take) {
  sets.first.isFloat64() ? findPlain<double>(sets, options, order, take) : findPlain<float>(sets, options, order, take);
}

/// A box that can be one of a pair.
struct Candidate {
  Box box;
  double margin;
  std::uint32_t id;
};

/// Those of a set: no others are empty or outside the region.
std::span<const Candidate> readCandidates(const BoxView& boxes, const OverlapOptions& options, Candidate* candidates) {
  std::size_t size = 0;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    const Candidate candidate{boxes[i], boxes.margin(i), i};
    if (!isEmpty(candidate.box) && reachesRegion(candidate.box, candidate.margin, options)) {
      candidates[size++] = candidate;
    }
  }
  return {candidates, size};
}

/// The test of overlap(), without branches that a processor mispredicts.
bool touch(const Box& a, const Box& b, double d) noexcept {
  bool isApart = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    isApart |= static_cast<bool>(static_cast<int>(a.min[axis] > b.max[axis] + d) |
                                 static_cast<int>(b.min[axis] > a.max[axis] + d));
  }
  return !isApart;
}

/// A plain loop over so few pairs, with all options.
void testChecked(const Sets& sets, const OverlapOptions& options, Order order, TakePairs take) {
  if (pairsOf(sets) == 0) return;
  checkStop(options.stop);
  // Candidates themselves would be set to 0 first.
  alignas(Candidate) std::array<std::byte, (kTestedPairs + 1) * sizeof(Candidate)> bytes;
  auto* const candidates = reinterpret_cast<Candidate*>(bytes.data());
  const std::span<const Candidate> first = readCandidates(sets.first, options, candidates);
  const std::span<const Candidate> second =
      sets.one ? first : readCandidates(sets.second, options, candidates + first.size());
  const bool bySecond = order == Order::BySecond;
  PairsOnStack<kTestedPairs> pairs;
  std::size_t found = 0;
  const auto test = [&](const Candidate& a, const Candidate& b) {
    pairs.data()[found] = {a.id, b.id};
    found += static_cast<std::size_t>(touch(a.box, b.box, options.distance + a.margin + b.margin));
  };
  const std::span<const Candidate> rows = bySecond ? second : first;
  const std::span<const Candidate> columns = bySecond ? first : second;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::size_t begin = sets.one && !bySecond ? row + 1 : 0;
    const std::size_t end = sets.one && bySecond ? row : columns.size();
    for (std::size_t column = begin; column < end; ++column) {
      bySecond ? test(columns[column], rows[row]) : test(rows[row], columns[column]);
    }
  }
  take({pairs.data(), PairTest::of(sets, options).select({pairs.data(), found})});
}

/// Whether half the distance and the margins can be added to the bounds in double so that they hold all that the exact
/// test compares: nothing is subtracted, and no sum of them overflows.
bool canBeWidened(const BoxView& boxes, double distance) noexcept {
  constexpr double kMost = 1e300;
  return distance >= 0.0 && distance <= kMost && boxes.leastMargin() >= 0.0 && boxes.greatestMargin() <= kMost;
}

/// Room for rows of a word of boxes.
using WordRows = std::array<double, 6 * kWordBoxes>;

/// Copies the boxes in double, as rows that are wider than the exact test has them if they are compared with a distance
/// or margins. An empty box may become one that is not.
BoxView copyWide(const BoxView& boxes, double distance, WordRows& rows) {
  /// More than all sums here and in the exact test are rounded by.
  constexpr double kSlack = 0x1p-48;
  const bool isWider = distance != 0.0 || boxes.hasMargins();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box box = boxes[i];
    const double margin = 0.5 * distance + boxes.margin(i);
    const auto reach = [&](double bound) {
      if (!isWider) return 0.0;
      const double size = std::min(std::abs(bound), std::numeric_limits<double>::max());
      return margin + kSlack * size + kSlack * margin + std::numeric_limits<double>::min();
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      rows[6 * i + axis] = box.min[axis] - reach(box.min[axis]);
      rows[6 * i + axis + 3] = box.max[axis] + reach(box.max[axis]);
    }
  }
  return BoxView::fromRows({rows.data(), 6 * boxes.size()});
}

/// One bit for each of a word of boxes, set if it is outside the region.
std::uint64_t outsideOf(const BoxView& boxes, const OverlapOptions& options) noexcept {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; options.region && i < boxes.size(); ++i) {
    bits |= std::uint64_t{!reachesRegion(boxes[i], boxes.margin(i), options)} << i;
  }
  return bits;
}

bool widens(const Sets& sets, const OverlapOptions& options) noexcept {
  return options.distance != 0.0 || sets.first.hasMargins() || sets.second.hasMargins();
}

bool lieInRuns(const Sets& sets) noexcept { return sets.one ? isRun(sets.first) : areRuns(sets.first, sets.second); }

/// Whether bounds are compared as they lie in memory.
bool areInPlace(const Sets& sets, const OverlapOptions& options) noexcept {
  return !widens(sets, options) && lieInRuns(sets);
}

/// Whether findChecked() takes the sets. Boxes of float32 that need copies are read into lanes in less time.
bool canBeChecked(const Sets& sets, const OverlapOptions& options) noexcept {
  if (std::max(sets.first.size(), sets.second.size()) > kWordBoxes) return false;
  if (areInPlace(sets, options)) return true;
  return (sets.first.isFloat64() || sets.second.isFloat64()) && canBeWidened(sets.first, options.distance) &&
         canBeWidened(sets.second, options.distance);
}

/// Finds the boxes of at most a word in each set that may overlap as if only bounds mattered, and asks of each such
/// pair what else does.
void findChecked(const Sets& sets, const OverlapOptions& options, Order order, TakePairs take) {
  PairTest test = PairTest::of(sets, options);
  test.requireExactTest(widens(sets, options));
  const std::uint64_t outsideFirst = outsideOf(sets.first, options);
  const std::uint64_t outsideSecond = sets.one ? outsideFirst : outsideOf(sets.second, options);
  PairsOnStack<kPartSize + kVectorSlack> kept;
  const auto check = [&](std::span<const Pair> pairs) {
    std::size_t size = 0;
    for (const Pair pair : pairs) {
      const std::uint64_t outside = outsideFirst >> pair.first | outsideSecond >> pair.second;
      kept.data()[size] = pair;
      size += static_cast<std::size_t>((outside & 1U) == 0 && test.keeps(pair));
    }
    take({kept.data(), size});
  };
  if (areInPlace(sets, options)) return findPlain(sets, options, order, check);
  WordRows firstRows;
  WordRows secondRows;
  const BoxView first = copyWide(sets.first, options.distance, firstRows);
  if (sets.one) return findPlain(Sets(first), options, order, check);
  const BoxView second = copyWide(sets.second, options.distance, secondRows);
  findPlain({first, second}, options, order, check);
}

OverlapStatistics findInTiles(const Sets& sets, const OverlapOptions& options, Order order, TakePairs take) {
  checkStop(options.stop);
  const Kernels& kernels = chooseKernels(options.instructionSet);
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
  OverlapStatistics statistics;
  statistics.boxTests = pairsOf(sets);
  const auto taken = [&](std::span<const Pair> pairs) {
    if (statistics.pairs != 0) checkStop(options.stop);  // Between parts.
    statistics.pairs += pairs.size();
    checkLimit(options.maxPairs, statistics.pairs);
    if (!pairs.empty()) take(pairs);
  };
  if (onlyBoundsMatter(sets, options) && lieInRuns(sets)) {
    findPlain(sets, options, order, taken);
    return statistics;
  }
  checkOptions(sets, options);
  const bool areTested = canBeTested(sets, options);
  if (!areTested && !canBeChecked(sets, options)) return findInTiles(sets, options, order, take);
  areTested ? testChecked(sets, options, order, taken) : findChecked(sets, options, order, taken);
  return statistics;
}

OverlapStatistics countFew(const Sets& sets, const OverlapOptions& options) {
  const auto ignore = [](std::span<const Pair>) {};
  return findFew(sets, options, options.order, ignore);
}

}  // namespace allpairs::engine
