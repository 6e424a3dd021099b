// SPDX-License-Identifier: MIT
#include "search/PairLists.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "bvh/RadixSort.h"
#include "input/Parts.h"
#include "memory/Platform.h"

namespace allpairs::engine {
namespace {

/// Where a list begins: its worker above the place.
constexpr unsigned kPlaceBits = 48;

template <bool kBySecond>
void expandRow(std::uint32_t row, std::span<const std::uint32_t> list, Pair* to) noexcept {
  for (std::size_t i = 0; i < list.size(); ++i) to[i] = kBySecond ? Pair{list[i], row} : Pair{row, list[i]};
}

}  // namespace

void PairLists::start(std::size_t rows, std::size_t columns, std::size_t workers, std::size_t likely) {
  m_rows = rows;
  m_begin.require(rows);
  m_length.require(rows);
  std::fill_n(m_length.data(), rows, 0U);
  while (m_partners.size() < workers) m_partners.emplace_back(m_ofWorkers.get_allocator().resource());
  m_ofWorkers.assign(workers, {});
  if (isAmple(m_ofWorkers.get_allocator().resource(), rows)) likely = std::max(likely, 64 * rows);
  for (std::size_t w = 0; w < workers; ++w) {
    NeighborLists& lists = m_ofWorkers[w];
    m_partners[w].require(likely / workers);
    lists.partners = m_partners[w].data();
    lists.capacity = m_partners[w].capacity();
    lists.begin = m_begin.data();
    lists.length = m_length.data();
    lists.base = std::uint64_t{w} << kPlaceBits;
    lists.idBits = static_cast<unsigned>(std::bit_width(columns - 1));
    lists.sort = &radixSort<std::uint64_t>;
  }
}

void PairLists::select(Columns kept, PairSide side, const SinkOptions& options) {
  const PairTest& test = options.test;
  m_options = &options;
  m_side = kept == Columns::Others ? PairSide::SmallerFirst : side;
  m_timesListed = kept == Columns::Others ? 2 : 1;
  for (NeighborLists& lists : m_ofWorkers) {
    lists.kept = kept;
    lists.slack = test.slack();
    if (test.exactTestNeeded()) {
      lists.tested = test.leavesDoubts() ? NeighborLists::Tested::InDoubt : NeighborLists::Tested::All;
    }
    lists.receiver = this;
    lists.filtered = test.isFiltered();
    lists.select = [](NeighborLists& of, std::uint32_t row, std::span<std::uint32_t> partners, bool areDoubtful) {
      return static_cast<const PairLists*>(of.receiver)->select(of, row, partners, areDoubtful);
    };
    lists.findApart = [](NeighborLists& of, const Pair* pairs, std::size_t size, std::uint32_t* apart) {
      return static_cast<const PairLists*>(of.receiver)->findApart(of, {pairs, size}, apart);
    };
    lists.grow = [](NeighborLists& of, std::size_t more) { static_cast<PairLists*>(of.receiver)->grow(of, more); };
  }
}

Pair PairLists::pairOf(std::uint32_t row, std::uint32_t partner) const noexcept {
  const bool isRowFirst = m_side == PairSide::SmallerFirst ? row < partner : m_side == PairSide::RowFirst;
  return isRowFirst ? Pair{row, partner} : Pair{partner, row};
}

std::size_t PairLists::select(NeighborLists& lists, std::uint32_t row, std::span<std::uint32_t> partners,
                              bool areDoubtful) const {
  checkStop(m_options->stop);
  const PairTest& test = m_options->test;
  const auto dropIf = [&](const auto& isDropped) {
    const auto end = std::remove_if(partners.begin(), partners.end(), isDropped);
    partners = partners.first(static_cast<std::size_t>(end - partners.begin()));
  };
  if (areDoubtful) {
    lists.exactTests += partners.size();
    dropIf([&](std::uint32_t partner) { return !test.touches(pairOf(row, partner)); });
  }
  if (lists.filtered) dropIf([&](std::uint32_t partner) { return !test.allows(pairOf(row, partner)); });
  return partners.size();
}

std::size_t PairLists::findApart(NeighborLists& lists, std::span<const Pair> pairs, std::uint32_t* apart) const {
  checkStop(m_options->stop);
  lists.exactTests += pairs.size();
  std::size_t size = 0;
  m_options->test.forEachApart(
      pairs.size(), [&](std::size_t i) { return pairOf(pairs[i].first, pairs[i].second); },
      [&](std::size_t i) { apart[size++] = static_cast<std::uint32_t>(i); });
  return size;
}

/// Provides more memory for the lists of a worker; keeps what is there.
void PairLists::grow(NeighborLists& lists, std::size_t more) {
  checkLimit(m_options->maxPairs, lists.size / m_timesListed);
  const auto look = [this] { checkStop(m_options->stop); };
  look();
  Buffer<std::uint32_t>& partners = m_partners[lists.base >> kPlaceBits];
  partners.grow(lists.size + more, look);
  lists.partners = partners.data();
  lists.capacity = partners.capacity();
}

std::size_t PairLists::size() const noexcept {
  std::size_t size = 0;
  for (const NeighborLists& lists : m_ofWorkers) size += lists.size;
  return size;
}

/// Calls use(row, list, before) for each row, of which the lists before it have so many partners.
template <class Use>
void PairLists::forEachList(Executor& executor, const Use& use) {
  m_places.clear();
  std::size_t place = 0;
  const std::size_t longest = kWorkBetweenLooks * m_rows / std::max<std::size_t>(1, size());
  const std::size_t partSize = std::clamp<std::size_t>(longest, 1, kPartSize);
  for (std::size_t begin = 0; begin < m_rows; begin += partSize) {
    m_places.push_back(place);
    const std::uint32_t* const length = m_length.data();
    place = std::accumulate(length + begin, length + std::min(m_rows, begin + partSize), place);
  }
  runInParts(m_rows, partSize, executor, [&](std::size_t begin, std::size_t end) {
    std::size_t before = m_places[begin / partSize];
    const auto listOf = [this](std::size_t row) -> std::span<const std::uint32_t> {
      if (m_length[row] == 0) return {};
      const std::uint64_t first = m_begin[row];
      const std::uint32_t* const partners = m_ofWorkers[first >> kPlaceBits].partners;
      return {partners + (first & ((std::uint64_t{1} << kPlaceBits) - 1)), m_length[row]};
    };
    for (std::size_t row = begin; row < end; ++row) {
      if (row + kPrefetchDistance < end) {
        const std::span<const std::uint32_t> ahead = listOf(row + kPrefetchDistance);
        prefetchLine(ahead.data());
        prefetchLine(ahead.data() + ahead.size());
      }
      const std::span<const std::uint32_t> list = listOf(row);
      use(row, list, before);
      before += list.size();
    }
  });
}

void PairLists::expand(std::span<Pair> to, bool bySecond, Executor& executor) {
  forEachList(executor, [&](std::size_t row, std::span<const std::uint32_t> list, std::size_t before) {
    bySecond ? expandRow<true>(static_cast<std::uint32_t>(row), list, to.data() + before)
             : expandRow<false>(static_cast<std::uint32_t>(row), list, to.data() + before);
  });
}

void PairLists::gather(const NeighborsMemory& to, Executor& executor) {
  forEachList(executor, [&](std::size_t row, std::span<const std::uint32_t> list, std::size_t before) {
    to.offsets[row] = before;
    std::copy(list.begin(), list.end(), to.indices.data() + before);
  });
  to.offsets[m_rows] = size();
}

}  // namespace allpairs::engine
