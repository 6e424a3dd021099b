// SPDX-License-Identifier: MIT
#include "search/FewBesideMany.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "allpairs/StopFlag.h"
#include "input/BoxRuns.h"
#include "input/Parts.h"
#include "kernels/Kernels.h"
#include "search/PairSink.h"
#include "search/PairsOnStack.h"

namespace allpairs::engine {
namespace {

/// Each of the few takes a pass over the many, or a test of all that touch their bounds: up to so many take less time than reading
/// the many for the search of any two sets (few_benchmark).
constexpr std::size_t kMostFew = 4;

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

/// The bounds of all rows that are not empty; empty if there are none.
template <class T>
Row<T> boundsOf(std::span<const Row<T>> rows) {
  constexpr T kInfinity = std::numeric_limits<T>::infinity();
  Row<T> bounds{kInfinity, kInfinity, kInfinity, -kInfinity, -kInfinity, -kInfinity};
  for (const Row<T>& row : rows) {
    if (isEmptyRow(row)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds[axis] = std::min(bounds[axis], row[axis]);
      bounds[axis + 3] = std::max(bounds[axis + 3], row[axis + 3]);
    }
  }
  return bounds;
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
    checkStop(m_options.stop);
    const Row<T> bounds = boundsOf(few);
    if (isEmptyRow(bounds)) return;
    const BoxRun<T> part = m_many.part(begin, kPartSize);
    const std::size_t touching = touchingBoxes(part, bounds);
    m_statistics.boxTests += part.size + touching * few.size();
    for (std::size_t i = 0; i < touching; ++i) {
      const Row<T> row = rowOf(part, m_touching[i]);
      const auto many = static_cast<std::uint32_t>(begin + m_touching[i]);
      for (std::uint32_t j = 0; j < few.size(); ++j) {
        // Written whether they overlap or not, which is not guessed right often enough.
        m_pairs.data()[m_found] = m_manySecond ? Pair{firstFew + j, many} : Pair{many, firstFew + j};
        m_found += static_cast<std::size_t>(areHit(row.data(), few[j].data()));
      }
      if (m_found + kMostFew > kRoom) give();
    }
    give();
  }

  [[nodiscard]] const OverlapStatistics& statistics() const noexcept { return m_statistics; }

 private:
  static constexpr std::size_t kRoom = 1024;

  std::size_t touchingBoxes(const BoxRun<T>& part, const Row<T>& bounds) {
    if constexpr (std::is_same_v<T, float>) {
      return m_kernels.touchingBoxes32(part, bounds, m_touching.data());
    } else {
      return m_kernels.touchingBoxes64(part, bounds, m_touching.data());
    }
  }

  /// Passes on the pairs that were found since the last time.
  void give() {
    if (m_found == 0) return;
    m_statistics.pairs += m_found;
    checkLimit({.maxPairs = m_options.maxPairs}, m_statistics.pairs);
    m_take({m_pairs.data(), std::exchange(m_found, 0)});
  }

  const BoxRun<T> m_many;
  const bool m_manySecond;
  const OverlapOptions& m_options;
  const Kernels& m_kernels;
  FunctionRef<void(std::span<const Pair>)> m_take;
  OverlapStatistics m_statistics;
  std::size_t m_found = 0;
  std::array<std::uint32_t, kPartSize> m_touching;
  PairsOnStack<kRoom> m_pairs;
};

bool isFewSecond(const Sets& sets) { return sets.second.size() < sets.first.size(); }

/// Whether pairs come in the order of the few.
bool areByFew(const Sets& sets, Order order) {
  return order != Order::Unordered && (order == Order::BySecond) == isFewSecond(sets);
}

template <class T>
OverlapStatistics find(const Sets& sets, const OverlapOptions& options, Order order,
                       FunctionRef<void(std::span<const Pair>)> take) {
  const bool fewSecond = isFewSecond(sets);
  const BoxRun<T> run = runOf<T>(fewSecond ? sets.second : sets.first);
  std::array<Row<T>, kMostFew> few;
  for (std::size_t i = 0; i < run.size; ++i) few[i] = rowOf(run, i);
  const BoxRun<T> many = runOf<T>(fewSecond ? sets.first : sets.second);
  PartSearch<T> search(many, !fewSecond, options, take);
  const auto runOne = [&](std::size_t begin, std::uint32_t i) { search.run(begin, {&few[i], 1}, i); };
  const auto ofFew = static_cast<std::uint32_t>(run.size);
  if (areByFew(sets, order)) {
    for (std::uint32_t i = 0; i < ofFew; ++i) {
      for (std::size_t begin = 0; begin < many.size; begin += kPartSize) runOne(begin, i);
    }
  } else if (order == Order::Unordered) {
    for (std::size_t begin = 0; begin < many.size; begin += kPartSize) {
      for (std::uint32_t i = 0; i < ofFew; ++i) runOne(begin, i);
    }
  } else {
    for (std::size_t begin = 0; begin < many.size; begin += kPartSize) search.run(begin, {few.data(), run.size}, 0);
  }
  return search.statistics();
}

}  // namespace

bool areFewBesideMany(const Sets& sets, const OverlapOptions& options) {
  if (sets.one) return false;
  const std::size_t few = std::min(sets.first.size(), sets.second.size());
  const std::size_t many = std::max(sets.first.size(), sets.second.size());
  if (few > kMostFew || many <= kWordBoxes) return false;
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
