// SPDX-License-Identifier: MIT
#include "DistributedSearch.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/StopFlag.h"
#include "allpairs/partition/Partition.h"

namespace allpairs::mpi {
namespace {

constexpr std::uint64_t kShortIds = std::uint64_t{1} << 32;

}  // namespace

std::vector<IdPair> DistributedSearch::find(std::span<const LocalBoxes> given) {
  search(given);
  std::vector<IdPair> pairs;
  m_ranks.onAll([&] { pairs = m_ranks.size() == 1 ? std::move(m_here) : m_pairs.takeInOrder(); });
  return pairs;
}

std::uint64_t DistributedSearch::count(std::span<const LocalBoxes> given) {
  m_isCount = true;
  search(given);
  return m_count;
}

void DistributedSearch::search(std::span<const LocalBoxes> given) {
  m_ranks.onAll([&] {
    checkStop(m_options.stop);
    takeSets(given);
    checkSets();
  });
  checkAgreement();
  measureSets();
  if (m_ranks.size() == 1) {
    searchHere();
    return;
  }
  const bool isAnyEmpty =
      std::any_of(m_sets.begin(), m_sets.end(), [](const LocalSet& set) { return set.allBoxes == 0; });
  if (!isAnyEmpty) {
    const Distribution distribution(m_ranks, m_sets, m_options, m_tuning);
    searchCells(distribution);
    for (std::size_t set = 0; set < m_sets.size(); ++set) searchWide(distribution, set);
  }
  m_ranks.sum({&m_count, 1});
  m_ranks.onAll([&] {
    if (m_count > m_options.maxPairs)
      throw LimitExceeded(m_count, std::to_string(m_count) + " pairs: more than allowed");
  });
}

void DistributedSearch::takeSets(std::span<const LocalBoxes> given) {
  for (const LocalBoxes& boxes : given) m_sets.push_back({.boxes = boxes.view()});
  m_sets.front().bits = m_options.first;
  if (m_sets.size() > 1) m_sets.back().bits = m_options.second;
}

/// What a search of no cell would not look at.
void DistributedSearch::checkSets() const {
  const bool hasSecond =
      !m_options.second.categories.empty() || !m_options.second.masks.empty() || !m_options.second.groups.empty();
  if (m_sets.size() == 1 && hasSecond) throw InvalidArgument("the filter of a second set, and one set");
  for (const LocalSet& set : m_sets) {
    for (const auto values : {set.bits.categories, set.bits.masks, set.bits.groups}) {
      if (values.empty() || values.size() == set.boxes.size()) continue;
      throw InvalidArgument("a filter of " + std::to_string(values.size()) + " values for " +
                            std::to_string(set.boxes.size()) + " boxes");
    }
  }
  OverlapOptions options = optionsFor({}, {});
  options.executor = nullptr;
  (void)countOverlaps(BoxView(), BoxView(), options);  // refuses a distance or region that makes no sense
}

/// Ranks that search for different things would wait for each other, or give pairs that no search has.
void DistributedSearch::checkAgreement() const {
  const auto bitsOf = [](double value) { return std::bit_cast<std::uint64_t>(value); };
  std::uint64_t digest = 14695981039346656037U;  // FNV-1a, a word at a time
  const auto add = [&digest](std::uint64_t word) { digest = (digest ^ word) * 1099511628211U; };
  add(m_sets.size());
  add(m_isCount ? 1 : 0);
  add(bitsOf(m_options.distance));
  add(m_options.maxPairs);
  add(m_options.region ? 1 : 0);
  const Box region = m_options.region.value_or(Box{});
  for (const double bound : region.min) add(bitsOf(bound));
  for (const double bound : region.max) add(bitsOf(bound));
  const std::vector<std::uint64_t> digests = m_ranks.gather(digest);
  const bool isSame = std::all_of(digests.begin(), digests.end(), [&](auto other) { return other == digests.front(); });
  if (!isSame) throw InvalidArgument("the ranks do not make the same search: its kind, or its settings, differ");
}

/// Numbers the boxes, and finds what those of all ranks have in common.
void DistributedSearch::measureSets() {
  std::uint64_t flags = 0;
  std::vector<double> margins;
  m_ranks.onAll([&] {
    for (const LocalSet& set : m_sets) {
      flags |= RecordLayout::of(set).flags;
      margins.push_back(partition::greatestMargin(set.boxes));
    }
  });
  m_ranks.bits({&flags, 1});
  m_ranks.greatest(margins);
  m_layout.flags = flags;
  bool areIdsShort = true;
  std::vector<std::uint64_t> endsOfFirst;
  for (std::size_t k = 0; k < m_sets.size(); ++k) {
    LocalSet& set = m_sets[k];
    std::vector<std::uint64_t> ends = m_ranks.gather(set.boxes.size());
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    set.allBoxes = ends.back();
    set.firstId = ends[static_cast<std::size_t>(m_ranks.rank())] - set.boxes.size();
    set.maxMargin = m_sets.size() == 1 ? margins.front() : margins[1 - k];
    areIdsShort = areIdsShort && set.allBoxes <= kShortIds;
    if (k == 0) endsOfFirst = std::move(ends);
  }
  m_ranks.onAll([&] { m_pairs.start(endsOfFirst, areIdsShort); });
}

/// One rank has all boxes: no cell is cut, and nothing is sent.
void DistributedSearch::searchHere() {
  const bool isOneSet = m_sets.size() == 1;
  OverlapSearch search(optionsFor(m_sets.front().bits, isOneSet ? FilterBits() : m_sets.back().bits));
  if (m_isCount) {
    m_count = isOneSet ? search.count(m_sets.front().boxes) : search.count(m_sets.front().boxes, m_sets.back().boxes);
    return;
  }
  const std::span<const Pair> pairs =
      isOneSet ? search.find(m_sets.front().boxes) : search.find(m_sets.front().boxes, m_sets.back().boxes);
  m_here.reserve(pairs.size());
  for (const Pair pair : pairs) m_here.push_back({pair.first, pair.second});
}

OverlapOptions DistributedSearch::optionsFor(const FilterBits& first, const FilterBits& second) const {
  return {.order = m_isCount ? Order::Unordered : Order::ByFirst,
          .distance = m_options.distance,
          .region = m_options.region,
          .filter = {.first = first, .second = second},
          .executor = m_options.executor,
          .maxPairs = m_options.maxPairs,
          .stop = m_options.stop};
}

void DistributedSearch::fetchCell(const Distribution& distribution, std::size_t round, std::size_t set,
                                  CellBoxes& boxes) const {
  m_ranks.onAll([&] {
    boxes.bounds.resize(static_cast<std::size_t>(m_ranks.size()));
    boxes.others.resize(boxes.bounds.size());
    for (int rank = 0; rank < m_ranks.size(); ++rank) {
      const std::optional<std::uint32_t> cell = distribution.cellOf(round, rank);
      const auto indices = cell ? distribution.boxesOf(set, *cell) : std::span<const std::uint32_t>();
      auto& bounds = boxes.bounds[static_cast<std::size_t>(rank)];
      auto& others = boxes.others[static_cast<std::size_t>(rank)];
      freeIfLarge(bounds, indices.size() * m_layout.boundsWords());
      freeIfLarge(others, indices.size() * m_layout.otherWords());
      PackedBoxes packed{std::move(bounds), std::move(others)};
      packBoxes(m_sets[set], indices, m_layout, packed);
      bounds = std::move(packed.bounds);
      others = std::move(packed.others);
    }
  });
  m_ranks.exchange(boxes.bounds, boxes.records.packed().bounds);
  m_ranks.exchange(boxes.others, boxes.records.packed().others);
  m_ranks.onAll([&] { boxes.records.unpack(); });
}

/// In each round each rank searches one cell.
void DistributedSearch::searchCells(const Distribution& distribution) {
  std::vector<CellBoxes> sets;
  std::optional<partition::CellSearch> search;
  m_ranks.onAll([&] {
    for (std::size_t set = 0; set < m_sets.size(); ++set) sets.push_back({{}, {}, BoxRecords(m_layout)});
    search.emplace(optionsFor({}, {}));
  });
  for (std::size_t round = 0; round < distribution.rounds(); ++round) {
    for (std::size_t set = 0; set < sets.size(); ++set) fetchCell(distribution, round, set, sets[set]);
    m_ranks.onAll([&] {
      checkStop(m_options.stop);
      const std::optional<std::uint32_t> cell = distribution.cellOf(round, m_ranks.rank());
      if (cell) searchCell(sets, distribution.bounds(*cell), *search);
    });
    sendPairs();
  }
}

/// Boxes come in the order of their numbers, so that the first of a pair has the lower one.
void DistributedSearch::searchCell(std::span<CellBoxes> sets, const partition::Cell& cell,
                                   partition::CellSearch& search) {
  const BoxRecords& first = sets.front().records;
  const BoxRecords& second = sets.back().records;
  const auto take = [&](std::span<const Pair> pairs) { add(pairs, first.ids(), second.ids()); };
  const bool isOneSet = sets.size() == 1;
  search.setFilter({.first = first.bits(), .second = isOneSet ? FilterBits() : second.bits()});
  if (isOneSet && m_isCount) search.stream(first.boxes(), cell, take);
  if (isOneSet && !m_isCount) take(search.find(first.boxes(), cell));
  if (!isOneSet && m_isCount) search.stream(first.boxes(), second.boxes(), cell, take);
  if (!isOneSet && !m_isCount) take(search.find(first.boxes(), second.boxes(), cell));
}

/// The wide boxes of all ranks come to all of them, a part at a time, and each rank pairs them with its own boxes.
void DistributedSearch::searchWide(const Distribution& distribution, std::size_t set) {
  const std::span<const std::uint32_t> own = distribution.wide(set);
  std::vector<std::uint64_t> ends = m_ranks.gather(own.size());
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  const std::uint64_t ownBegin = ends[static_cast<std::size_t>(m_ranks.rank())] - own.size();
  const std::size_t other = m_sets.size() - 1 - set;
  std::vector<char> isWideHere;
  m_ranks.onAll([&] {
    isWideHere.assign(m_sets[other].boxes.size(), 0);
    for (const std::uint32_t box : distribution.wide(other)) isWideHere[box] = 1;
  });
  for (std::uint64_t begin = 0; begin < ends.back(); begin += m_tuning.wideAtOnce) {
    const std::uint64_t end = std::min<std::uint64_t>(begin + m_tuning.wideAtOnce, ends.back());
    PackedBoxes packed;
    m_ranks.onAll([&] {
      const std::uint64_t ownFrom = std::clamp(begin, ownBegin, ownBegin + own.size()) - ownBegin;
      const std::uint64_t ownTo = std::clamp(end, ownBegin, ownBegin + own.size()) - ownBegin;
      packBoxes(m_sets[set], own.subspan(ownFrom, ownTo - ownFrom), m_layout, packed);
    });
    packed.bounds = m_ranks.collect(packed.bounds);
    packed.others = m_ranks.collect(packed.others);
    m_ranks.onAll([&] {
      checkStop(m_options.stop);
      BoxRecords wide(m_layout);
      wide.packed() = std::move(packed);
      wide.unpack();
      searchChunk(wide, set, isWideHere);
    });
    sendPairs();
  }
}

/// Takes all pairs of two sets of boxes: a list of them, or, where that would have more than are allowed, some at a
/// time.
template <class Take>
void DistributedSearch::searchBetween(OverlapOptions options, const BoxView& first, const BoxView& second,
                                      const Take& take) const {
  OverlapSearch search(std::move(options));
  if (!m_isCount) {
    std::optional<std::span<const Pair>> found;
    try {
      found = search.find(first, second);
    } catch (const LimitExceeded&) {  // add() says how many of them count
    }
    if (found) return take(*found);
    options = search.options();
    options.maxPairs = OverlapOptions().maxPairs;
    search.setOptions(std::move(options));
  }
  search.stream(first, second, take);
}

/// Of one set, each pair is found as (lower number, higher number), in which order its margins are added; two wide
/// boxes are a pair on the rank of the higher one.
void DistributedSearch::searchChunk(const BoxRecords& wide, std::size_t set, std::span<const char> isWideHere) {
  const LocalSet& local = m_sets[m_sets.size() - 1 - set];
  const bool isOneSet = m_sets.size() == 1;
  const auto wideId = wide.ids();
  const auto localId = [begin = local.firstId](std::size_t i) { return begin + i; };
  const auto withLimit = [&](OverlapOptions options) {
    // Pairs are found that are another's too: each twice, and a box with itself, but for what rounding makes of margins.
    constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
    const bool isAny = m_isCount || m_options.maxPairs > (kMost - wide.size()) / 2;
    options.maxPairs = isAny ? kMost : 2 * m_options.maxPairs + wide.size();
    return options;
  };
  std::vector<Pair> kept;
  if (isOneSet || set == 0) {
    const auto take = [&](std::span<const Pair> pairs) {
      kept.clear();
      for (const Pair pair : pairs) {
        if (!isOneSet || wideId(pair.first) < localId(pair.second)) kept.push_back(pair);
      }
      add(kept, wideId, localId);
    };
    searchBetween(withLimit(optionsFor(wide.bits(), local.bits)), wide.boxes(), local.boxes, take);
  }
  if (isOneSet || set == 1) {
    const auto take = [&](std::span<const Pair> pairs) {
      kept.clear();
      for (const Pair pair : pairs) {
        const bool isBefore = !isOneSet || localId(pair.first) < wideId(pair.second);
        if (isBefore && isWideHere[pair.first] == 0) kept.push_back(pair);
      }
      add(kept, localId, wideId);
    };
    searchBetween(withLimit(optionsFor(local.bits, wide.bits())), local.boxes, wide.boxes(), take);
  }
}

template <class FirstId, class SecondId>
void DistributedSearch::add(std::span<const Pair> pairs, const FirstId& firstId, const SecondId& secondId) {
  m_count += pairs.size();
  if (m_count > m_options.maxPairs) throw LimitExceeded(m_count, "more pairs than allowed");
  if (!m_isCount) m_pairs.add(pairs, firstId, secondId);
}

void DistributedSearch::sendPairs() {
  if (!m_isCount) m_pairs.send();
}

}  // namespace allpairs::mpi
