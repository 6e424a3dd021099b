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

/// Compares the few with parts of the many.
template <class T>
class PartSearch {
 public:
  PartSearch(const BoxRun<T>& many, bool manySecond, const OverlapOptions& options,
             FunctionRef<void(std::span<const Pair>)> take)
      : m_many(many), m_manySecond(manySecond), m_options(options), m_kernels(chooseKernels(options)), m_take(take) {}

  /// All pairs of some of the many, from `begin` on, with some of the few, which are numbered from `firstFew` on; ordered by the
  /// many.
  void run(std::size_t begin, std::span<const Row<T>> few, std::uint32_t firstFew) {
    if (begin % kPartSize == 0) checkStop(m_options.stop);
    const BoxRun<T> part = m_many.part(begin, kAtOnce);
    m_statistics.boxTests += part.size * few.size();
    TouchedBoxes touched;
    touched.size = part.size;
    touched.first = static_cast<std::uint32_t>(begin);
    touched.firstOther = firstFew;
    for (const Row<T>& box : few) {
      if (isEmptyRow(box)) {
        m_words[touched.others].fill(0);
      } else {
        m_kernels.plain<T>().touchBoxes(part, box, m_words[touched.others].data());
      }
      touched.words[touched.others] = m_words[touched.others].data();
      ++touched.others;
    }
    give(m_kernels.writeTouching(touched, !m_manySecond, m_pairs.data()));
  }

  [[nodiscard]] const OverlapStatistics& statistics() const noexcept { return m_statistics; }

 private:
  /// Passes on the pairs of a part.
  void give(std::size_t pairs) {
    if (pairs == 0) return;
    m_statistics.pairs += pairs;
    checkLimit({.maxPairs = m_options.maxPairs}, m_statistics.pairs);
    m_take({m_pairs.data(), pairs});
  }

  const BoxRun<T> m_many;
  const bool m_manySecond;
  const OverlapOptions& m_options;
  const Kernels& m_kernels;
  FunctionRef<void(std::span<const Pair>)> m_take;
  OverlapStatistics m_statistics;
  std::array<std::array<std::uint64_t, kAtOnce / kWordBoxes>, kMostOthers> m_words;
  PairsOnStack<kAtOnce * kMostOthers + kVectorSlack> m_pairs;
};

bool isFewSecond(const Sets& sets) { return sets.second.size() < sets.first.size(); }

/// Whether pairs come in the order of the few. Unordered ones come by first box, as from the search of any two sets with so few:
/// the result does not depend on which of the two searches it was.
bool areByFew(const Sets& sets, Order order) { return (order == Order::BySecond) == isFewSecond(sets); }

template <class T>
OverlapStatistics find(const Sets& sets, const OverlapOptions& options, Order order,
                       FunctionRef<void(std::span<const Pair>)> take) {
  const bool fewSecond = isFewSecond(sets);
  const BoxRun<T> run = runOf<T>(fewSecond ? sets.second : sets.first);
  std::array<Row<T>, kMostOthers> few;
  for (std::size_t i = 0; i < run.size; ++i) few[i] = rowOf(run, i);
  const BoxRun<T> many = runOf<T>(fewSecond ? sets.first : sets.second);
  PartSearch<T> search(many, !fewSecond, options, take);
  const std::span<const Row<T>> all(few.data(), run.size);
  const std::size_t together = areByFew(sets, order) ? 1 : all.size();
  for (std::size_t i = 0; i < all.size(); i += together) {
    for (std::size_t begin = 0; begin < many.size; begin += kAtOnce) {
      search.run(begin, all.subspan(i, together), static_cast<std::uint32_t>(i));
    }
  }
  return search.statistics();
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
