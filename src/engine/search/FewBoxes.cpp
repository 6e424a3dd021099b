// SPDX-License-Identifier: MIT
#include "search/FewBoxes.h"

#include <algorithm>
#include <array>

#include "input/Readers.h"
#include "kernels/Kernels.h"
#include "search/PairSink.h"
#include "search/PairTest.h"

namespace allpairs::engine {
namespace {

/// Up to this many boxes of one set, a plain loop over them takes less time than arranging them for vectors
/// (docs/decisions/0009, few_benchmark).
constexpr std::size_t kPlainBoxes = 8;

/// Hits that are buffered: a few times those of one box.
constexpr std::size_t kHits = 4 * FewTile::kCapacity;

/// Turns hits into pairs, and passes on those that the test keeps.
class Receiver {
 public:
  Receiver(const Kernels& kernels, PairSide side, const PairTest& test, std::uint64_t maxPairs,
           FunctionRef<void(std::span<const Pair>)> take)
      : m_kernels(kernels), m_side(side), m_test(test), m_maxPairs(maxPairs), m_take(take) {
    m_hits.row = m_rows.data();
    m_hits.partner = m_partners.data();
    if (test.leavesDoubts()) m_hits.doubt = m_doubts.data();
    m_hits.slack = test.slack();
    m_hits.capacity = kHits;
    m_hits.receiver = this;
    m_hits.flush = [](void* self, Hits&) { static_cast<Receiver*>(self)->flush(); };
  }

  [[nodiscard]] Hits& hits() noexcept { return m_hits; }

  OverlapStatistics finish() {
    flush();
    m_statistics.boxTests = m_hits.boxTests;
    return m_statistics;
  }

 private:
  void flush() {
    if (m_hits.size == 0) return;
    m_kernels.writePairs(m_hits, m_side, m_pairs.data());
    const std::span<Pair> pairs(m_pairs.data(), m_hits.size);
    m_statistics.exactTests += m_test.exactTestsOf(m_hits);
    const std::size_t kept = m_test.select(pairs, m_hits);
    m_hits.size = 0;
    m_hits.doubts = 0;
    m_statistics.pairs += kept;
    checkLimit({.maxPairs = m_maxPairs}, m_statistics.pairs);
    m_take({m_pairs.data(), kept});
  }

  const Kernels& m_kernels;
  PairSide m_side;
  const PairTest& m_test;
  std::uint64_t m_maxPairs;
  FunctionRef<void(std::span<const Pair>)> m_take;
  OverlapStatistics m_statistics;
  Hits m_hits;
  alignas(64) std::array<std::uint32_t, kHits + kVectorSlack> m_rows;
  alignas(64) std::array<std::uint32_t, kHits + kVectorSlack> m_partners;
  std::array<std::uint32_t, kHits + kVectorSlack> m_doubts;
  alignas(64) std::array<Pair, kHits + kVectorSlack> m_pairs;
};

/// Reads all boxes; returns whether their lanes are exactly the boxes.
bool readFew(const BoxReader& reader, FewTile& tile) {
  bool exact = true;
  const BoxList all{nullptr, 0, reader.size()};
  for (std::size_t begin = 0; begin < all.size; begin += kFanOut) {
    exact &= reader.read(all.part(begin, kFanOut), tile, begin);
  }
  return exact;
}

/// All pairs of rows of six, in order; returns their number.
template <class T>
std::size_t testAll(const T* rows, std::size_t size, bool bySecond, Pair* pairs) {
  const auto isHit = [rows](std::size_t i, std::size_t j) {
    const T* const a = rows + 6 * i;
    const T* const b = rows + 6 * j;
    return (a[0] <= b[3]) & (b[0] <= a[3]) & (a[1] <= b[4]) & (b[1] <= a[4]) & (a[2] <= b[5]) & (b[2] <= a[5]);
  };
  std::array<std::uint32_t, kPlainBoxes> used;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const T* const a = rows + 6 * i;
    used[count] = static_cast<std::uint32_t>(i);
    count += static_cast<std::size_t>((a[0] <= a[3]) & (a[1] <= a[4]) & (a[2] <= a[5]));
  }
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = bySecond ? 0 : i + 1; j < (bySecond ? i : count); ++j) {
      pairs[found] = bySecond ? Pair{used[j], used[i]} : Pair{used[i], used[j]};
      found += static_cast<std::size_t>(isHit(used[i], used[j]));
    }
  }
  return found;
}

/// Whether testAll() takes these boxes: only their bounds matter, which are rows, and no option can be invalid.
bool arePlain(const Sets& sets, const OverlapOptions& options) {
  const BoxView& boxes = sets.first;
  return sets.one && boxes.size() <= kPlainBoxes && options.distance == 0.0 && !options.region &&
         isEmpty(options.filter.first) && isEmpty(options.filter.second) && !options.filter.accept &&
         options.instructionSet.empty() && !boxes.hasMargins() &&
         (boxes.isFloat64() ? boxes.float64().isPacked() : boxes.float32().isPacked());
}

OverlapStatistics findPlain(const BoxView& boxes, const OverlapOptions& options, Order order,
                            FunctionRef<void(std::span<const Pair>)> take) {
  std::array<Pair, kPlainBoxes * kPlainBoxes / 2> pairs;
  const bool bySecond = order == Order::BySecond;
  OverlapStatistics statistics;
  statistics.pairs = boxes.isFloat64() ? testAll(boxes.float64().min.data, boxes.size(), bySecond, pairs.data())
                                       : testAll(boxes.float32().min.data, boxes.size(), bySecond, pairs.data());
  statistics.boxTests = boxes.size() * (boxes.size() - (boxes.empty() ? 0 : 1)) / 2;
  checkLimit({.maxPairs = options.maxPairs}, statistics.pairs);
  if (statistics.pairs != 0) take({pairs.data(), statistics.pairs});
  return statistics;
}

OverlapStatistics findInTiles(const Sets& sets, const OverlapOptions& options, Order order,
                              FunctionRef<void(std::span<const Pair>)> take) {
  checkOptions(sets, options);
  const Kernels& kernels = chooseKernels(options);
  PairTest test = PairTest::of(sets, options);
  const bool bySecond = order == Order::BySecond;
  const Readers readers = Readers::of(sets, options, kernels);
  const BoxReader& rowSet = bySecond ? readers.second : readers.first;
  const BoxReader& columnSet = bySecond ? readers.first : readers.second;
  FewTile columns;
  FewTile rows;
  FewSearch search{&columns, &columns, rowSet.size(), columnSet.size(),
                   bySecond ? Columns::Preceding : Columns::Following};
  bool exact = readFew(columnSet, columns);
  if (!sets.one) {
    exact &= readFew(rowSet, rows);
    search.rows = &rows;
    search.tested = Columns::All;
  }
  test.requireExactTestInDoubt(!exact, readers.first.origin());
  Receiver receiver(kernels, bySecond ? PairSide::RowSecond : PairSide::RowFirst, test, options.maxPairs, take);
  kernels.searchFew(search, receiver.hits());
  return receiver.finish();
}

}  // namespace

bool areFew(const Sets& sets, const OverlapOptions& options) {
  const std::size_t size = std::max(sets.first.size(), sets.second.size());
  if (size > FewTile::kCapacity || options.strategy == Strategy::Bvh) return false;
  const Kernels* const kernels = findKernels(options.instructionSet);
  return kernels == nullptr || options.strategy == Strategy::Exhaustive || size <= kernels->flatBoxes(options.order);
}

OverlapStatistics findFew(const Sets& sets, const OverlapOptions& options, Order order,
                          FunctionRef<void(std::span<const Pair>)> take) {
  return arePlain(sets, options) ? findPlain(sets.first, options, order, take)
                                 : findInTiles(sets, options, order, take);
}

}  // namespace allpairs::engine
