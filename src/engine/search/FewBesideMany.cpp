// SPDX-License-Identifier: MIT
#include "search/FewBesideMany.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "allpairs/StopFlag.h"
#include "input/BoxRuns.h"
#include "input/Parts.h"
#include "kernels/Kernels.h"
#include "search/PairSink.h"
#include "search/PairsOnStack.h"

namespace allpairs::engine {
namespace {

/// Of the many at once: which of them touch is kept on the stack, for each of the few, and so are all their pairs.
constexpr std::size_t kAtOnce = 1024;
static_assert(kPartSize % kAtOnce == 0);

/// From so many boxes on, several threads share the passes of the search of any two sets.
constexpr std::size_t kManyForThreads = std::size_t{1} << 16;

template <class T>
using Row = std::array<T, 6>;

template <class T>
Row<T> rowOf(const BoxRun<T>& run, std::size_t i) {
  Row<T> row;
  std::copy_n(run.min + i * run.stride, 3, row.begin());
  std::copy_n(run.max + i * run.stride, 3, row.begin() + 3);
  return row;
}

template <class T>
bool isEmptyRow(const Row<T>& row) {
  return row[0] > row[3] || row[1] > row[4] || row[2] > row[5];
}

/// Which boxes of a run touch a box, as bits.
using Words = std::array<std::uint64_t, kAtOnce / kWordBoxes>;

/// Which boxes of a part of the many touch each of the few; the words of each of these are written to memory that
/// outlives the result.
template <class T>
TouchedBoxes touchEach(const BoxRun<T>& part, std::span<const Row<T>> few, const Kernels& kernels, Words* words) {
  TouchedBoxes touched;
  touched.size = part.size;
  for (const Row<T>& box : few) {
    Words& to = words[touched.others];
    if (isEmptyRow(box)) {
      to.fill(0);
    } else {
      kernels.plain<T>().touchBoxes(part, box, to.data());
    }
    touched.words[touched.others++] = to.data();
  }
  return touched;
}

bool isFewSecond(const Sets& sets) { return sets.second.size() < sets.first.size(); }

/// Whether pairs come in the order of the few. Unordered ones come by first box, as from the search of any two sets
/// with so few: the result does not depend on which of the two searches it was.
bool areByFew(const Sets& sets, Order order) { return (order == Order::BySecond) == isFewSecond(sets); }

/// Compares the few with parts of the many: all of them, or one after the other where pairs come in their order.
template <class T>
OverlapStatistics find(const Sets& sets, const OverlapOptions& options, Order order,
                       FunctionRef<void(std::span<const Pair>)> take) {
  const Kernels& kernels = chooseKernels(options);
  const bool fewSecond = isFewSecond(sets);
  const BoxRun<T> run = runOf<T>(fewSecond ? sets.second : sets.first);
  const BoxRun<T> many = runOf<T>(fewSecond ? sets.first : sets.second);
  std::array<Row<T>, kMostOthers> few;
  for (std::size_t i = 0; i < run.size; ++i) few[i] = rowOf(run, i);
  std::array<Words, kMostOthers> words;
  PairsOnStack<kAtOnce * kMostOthers + kVectorSlack> pairs;
  OverlapStatistics statistics;
  const std::size_t together = areByFew(sets, order) ? 1 : run.size;
  for (std::size_t i = 0; i < run.size; i += together) {
    for (std::size_t begin = 0; begin < many.size; begin += kAtOnce) {
      if (begin % kPartSize == 0) checkStop(options.stop);
      const BoxRun<T> part = many.part(begin, kAtOnce);
      statistics.boxTests += part.size * together;
      TouchedBoxes touched = touchEach<T>(part, {few.data() + i, together}, kernels, words.data());
      touched.first = static_cast<std::uint32_t>(begin);
      touched.firstOther = static_cast<std::uint32_t>(i);
      const std::size_t found = kernels.writeTouching(touched, fewSecond, pairs.data());
      if (found == 0) continue;
      statistics.pairs += found;
      checkLimit({.maxPairs = options.maxPairs}, statistics.pairs);
      take({pairs.data(), found});
    }
  }
  return statistics;
}

}  // namespace

bool areFewBesideMany(const Sets& sets, const OverlapOptions& options) {
  if (sets.one) return false;
  const std::size_t few = std::min(sets.first.size(), sets.second.size());
  const std::size_t many = std::max(sets.first.size(), sets.second.size());
  if (few > kMostOthers || many <= kWordBoxes) return false;
  if (options.strategy != Strategy::Automatic || !onlyBoundsMatter(sets, options)) return false;
  if (many >= kManyForThreads && options.executor != nullptr) return false;
  const auto areRuns = [](const BoxView& a, const BoxView& b) {
    return a.isFloat64() ? areRun<double>(a) && areRun<double>(b) : areRun<float>(a) && areRun<float>(b);
  };
  return areRuns(sets.first, sets.second);
}

OverlapStatistics findFewBesideMany(const Sets& sets, const OverlapOptions& options, Order order,
                                    FunctionRef<void(std::span<const Pair>)> take) {
  return sets.first.isFloat64() ? find<double>(sets, options, order, take) : find<float>(sets, options, order, take);
}

}  // namespace allpairs::engine
