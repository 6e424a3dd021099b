// SPDX-License-Identifier: MIT
#include "search/FewBoxes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "allpairs/StopFlag.h"
#include "input/BoxRuns.h"
#include "input/Parts.h"
#include "kernels/Kernels.h"
#include "search/PairSink.h"

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

std::span<const std::uint64_t> wordsOf(const Words& words, std::size_t boxes) {
  return std::span(words).first((boxes + kWordBoxes - 1) / kWordBoxes);
}

/// Copying a box that is not left out takes as long as so many tests of a box as it lies in memory (few_benchmark).
constexpr std::size_t kTestsOfCopy = 32;

/// The boxes of a part of the many that may touch the few: copied, unless they are many.
template <class T>
class NearBoxes {
 public:
  /// Those that touch the common bounds of so many.
  void choose(const BoxRun<T>& part, const Row<T>& bounds, std::size_t others, const Kernels& kernels) {
    m_size = 0;
    m_areFew = false;
    if (m_skipped != 0) return static_cast<void>(--m_skipped);
    m_skipped = kMostOthers;  // After one that was looked at in vain.
    if (countSamples(part, bounds) * kTestsOfCopy > kFanOut * (others - 1)) return;
    Words near;
    kernels.plain<T>().touchBoxes(part, bounds, near.data());
    const auto words = wordsOf(near, part.size);
    std::size_t touching = 0;
    for (const std::uint64_t bits : words) touching += static_cast<std::size_t>(std::popcount(bits));
    m_areFew = touching * kTestsOfCopy <= part.size * (others - 1);
    if (!m_areFew) return;
    m_skipped = 0;
    forEachBit(words, [&](std::size_t place) {
      m_places[m_size] = static_cast<std::uint16_t>(place);
      m_rows[m_size++] = rowOf(part, place);
    });
  }

  /// Which boxes of the part touch a box.
  void touch(const BoxRun<T>& part, const Row<T>& box, const Kernels& kernels, Words& words) const {
    if (!m_areFew) return kernels.plain<T>().touchBoxes(part, box, words.data());
    words.fill(0);
    if (m_size == 0) return;  // Most often: no limits are prepared.
    Words touching;
    const T* const rows = m_rows[0].data();
    kernels.plain<T>().touchBoxes({rows, rows + 3, 6, m_size}, box, touching.data());
    forEachBit(wordsOf(touching, m_size), [&](std::size_t i) {
      words[m_places[i] / kWordBoxes] |= std::uint64_t{1} << (m_places[i] % kWordBoxes);
    });
  }

 private:
  /// How many of some of the boxes touch the bounds.
  static std::size_t countSamples(const BoxRun<T>& part, const Row<T>& bounds) {
    const BoxRun<T> common{bounds.data(), bounds.data() + 3, 6, 1};
    std::size_t touching = 0;
    for (std::size_t i = 0; i < kFanOut; ++i) touching += areHit(part, i * part.size / kFanOut, common, 0) ? 1U : 0U;
    return touching;
  }

  std::size_t m_skipped = 0;  ///< So many parts are not looked at.
  bool m_areFew = false;
  std::size_t m_size = 0;
  static constexpr std::size_t kMost = kAtOnce * (kMostOthers - 1) / kTestsOfCopy;
  std::array<Row<T>, kMost> m_rows;
  std::array<std::uint16_t, kMost> m_places;
};

/// The bounds of all boxes that are not empty; an empty box if there are none.
template <class T>
Row<T> boundsOf(std::span<const Row<T>> boxes) {
  const T end = std::numeric_limits<T>::infinity();
  Row<T> bounds{end, end, end, -end, -end, -end};
  for (const Row<T>& box : boxes) {
    if (isEmptyRow(box)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds[axis] = std::min(bounds[axis], box[axis]);
      bounds[axis + 3] = std::max(bounds[axis + 3], box[axis + 3]);
    }
  }
  return bounds;
}

/// Which boxes of a part of the many touch each of the few; the words of each of these are written to memory that
/// outlives the result.
template <class T>
TouchedBoxes touchEach(const BoxRun<T>& part, const NearBoxes<T>& near, std::span<const Row<T>> few,
                       const Kernels& kernels, Words* words) {
  TouchedBoxes touched;
  touched.size = part.size;
  for (const Row<T>& box : few) {
    Words& to = words[touched.others];
    if (isEmptyRow(box)) {
      to.fill(0);
    } else {
      near.touch(part, box, kernels, to);
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
  const Kernels& kernels = chooseKernels(options.instructionSet);
  const bool fewSecond = isFewSecond(sets);
  const BoxRun<T> run = runOf<T>(fewSecond ? sets.second : sets.first);
  const BoxRun<T> many = runOf<T>(fewSecond ? sets.first : sets.second);
  std::array<Row<T>, kMostOthers> few;
  for (std::size_t i = 0; i < run.size; ++i) few[i] = rowOf(run, i);
  std::array<Words, kMostOthers> words;
  PairsOnStack<kAtOnce * kMostOthers + kVectorSlack> pairs;
  OverlapStatistics statistics;
  const std::size_t together = areByFew(sets, order) ? 1 : run.size;
  // The bounds of two would spare one pass at most.
  const Row<T> bounds = boundsOf<T>({few.data(), together > 2 ? together : 0});
  const bool mayLeaveOut = !isEmptyRow(bounds);
  NearBoxes<T> near;
  for (std::size_t i = 0; i < run.size; i += together) {
    for (std::size_t begin = 0; begin < many.size; begin += kAtOnce) {
      if (begin % kPartSize == 0) checkStop(options.stop);
      const BoxRun<T> part = many.part(begin, kAtOnce);
      statistics.boxTests += part.size * together;
      if (mayLeaveOut) near.choose(part, bounds, together, kernels);
      TouchedBoxes touched = touchEach<T>(part, near, {few.data() + i, together}, kernels, words.data());
      touched.first = static_cast<std::uint32_t>(begin);
      touched.firstOther = static_cast<std::uint32_t>(i);
      const std::size_t found = kernels.writeTouching(touched, fewSecond, pairs.data());
      if (found == 0) continue;
      statistics.pairs += found;
      checkLimit(options.maxPairs, statistics.pairs);
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
  return areRuns(sets.first, sets.second);
}

OverlapStatistics findFewBesideMany(const Sets& sets, const OverlapOptions& options, Order order,
                                    FunctionRef<void(std::span<const Pair>)> take) {
  return sets.first.isFloat64() ? find<double>(sets, options, order, take) : find<float>(sets, options, order, take);
}

}  // namespace allpairs::engine
