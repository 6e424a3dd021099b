// SPDX-License-Identifier: MIT
#include "Distribution.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include "allpairs/Overlaps.h"
#include "allpairs/partition/Cell.h"

namespace allpairs::mpi {
namespace {

constexpr std::uint32_t kLast = std::uint32_t{1} << 31;  // marks the last cell of a box
constexpr std::uint32_t kNoCell = kLast - 1;             // of an empty box, and of one outside of the region
constexpr int kRounds = 3;                               // of cutting cells again
constexpr std::size_t kEnoughPairs = 16;                 // of a sample, for each cell
constexpr double kPairWork = 0.1;                        // of a pair, where that of a box is 1

std::uint64_t wordOf(double value) { return std::bit_cast<std::uint64_t>(value); }
double valueOf(std::uint64_t word) { return std::bit_cast<double>(word); }

/// The cell of an entry, or kNoCell.
std::uint32_t numberOf(std::uint32_t entry) { return entry & ~kLast; }

template <class Use>
void forEachCell(std::span<const std::uint32_t> entries, const Use& use) {
  for (const std::uint32_t entry : entries) {
    if (numberOf(entry) != kNoCell) use(numberOf(entry));
  }
}

std::vector<std::uint64_t> wordsOf(std::span<const partition::Cut> cuts) {
  std::vector<std::uint64_t> words;
  for (const partition::Cut& cut : cuts) {
    const std::uint64_t low = std::bit_cast<std::uint32_t>(cut.low);
    words.insert(words.end(), {wordOf(cut.at), cut.axis, low << 32 | std::bit_cast<std::uint32_t>(cut.high)});
  }
  return words;
}

std::vector<partition::Cut> cutsOf(std::span<const std::uint64_t> words) {
  std::vector<partition::Cut> cuts;
  for (std::size_t i = 0; i < words.size(); i += 3) {
    cuts.push_back({valueOf(words[i]), static_cast<std::uint32_t>(words[i + 1]),
                    static_cast<std::int32_t>(words[i + 2] >> 32), static_cast<std::int32_t>(words[i + 2])});
  }
  return cuts;
}

std::vector<Box> everyNth(std::span<const Box> boxes, std::size_t n) {
  std::vector<Box> some;
  for (std::size_t i = 0; i < boxes.size(); i += n) some.push_back(boxes[i]);
  return some;
}

}  // namespace

Distribution::Distribution(const Ranks& ranks, std::span<const LocalSet> sets, const DistributedOptions& options,
                           const Tuning& tuning)
    : m_ranks(ranks), m_sets(sets), m_options(options), m_tuning(tuning) {
  for (const LocalSet& set : sets) m_allBoxes += set.allBoxes;
  m_wanted = partition::cellsOnRanks(m_allBoxes, static_cast<std::size_t>(ranks.size()), tuning.boxesPerCell);
  for (std::size_t set = 0; set < sets.size(); ++set) takeSample(set);
  ranks.onAll([&] {
    if (ranks.rank() == 0) m_cells = partition::Partition(m_sample, m_wanted);
  });
  shareCells();
  countBoxes();
  for (int round = 0; round < kRounds && cutAgain(); ++round) countBoxes();
  spreadCrowded();
  for (std::size_t set = 0; set < sets.size(); ++set) fillRows(set);
  deal();
  m_sample = {};
}

std::optional<std::uint32_t> Distribution::cellOf(std::size_t round, int rank) const {
  const std::uint32_t cell = m_dealt[round * static_cast<std::size_t>(m_ranks.size()) + static_cast<std::size_t>(rank)];
  return cell == kNoCell ? std::nullopt : std::optional(cell);
}

std::span<const std::uint32_t> Distribution::boxesOf(std::size_t set, std::uint32_t cell) const {
  const Rows& rows = m_rows[set];
  return std::span(rows.boxes).subspan(rows.begins[cell], rows.begins[cell + 1] - rows.begins[cell]);
}

Box Distribution::reachOf(const LocalSet& set, std::size_t i) const {
  const Box box = set.boxes[i];
  const double margin = set.boxes.margin(i);
  if (m_options.region && !overlap(box, *m_options.region, m_options.distance + margin)) return kEmptyBox;
  return partition::reachOf(box, margin, m_options.distance, set.maxMargin);
}

/// Takes what the boxes reach, so that no margin has to be known where it is cut.
void Distribution::takeSample(std::size_t set) {
  std::vector<std::vector<std::uint64_t>> outgoing;
  m_ranks.onAll([&] {
    const LocalSet& local = m_sets[set];
    outgoing.resize(static_cast<std::size_t>(m_ranks.size()));
    const std::uint64_t size = std::max<std::uint64_t>(m_tuning.leastSample, m_tuning.samplePerCell * m_wanted);
    const std::uint64_t step = m_allBoxes / size + 1;
    for (std::uint64_t i = (step - local.firstId % step) % step; i < local.boxes.size(); i += step) {
      const Box reach = reachOf(local, i);
      if (isEmpty(reach)) continue;
      for (const double value : reach.min) outgoing.front().push_back(wordOf(value));
      for (const double value : reach.max) outgoing.front().push_back(wordOf(value));
    }
  });
  std::vector<std::uint64_t> words;
  m_ranks.exchange(outgoing, words);
  m_ranks.onAll([&] {
    for (std::size_t i = 0; i < words.size(); i += 6) {
      m_sample.push_back({{valueOf(words[i]), valueOf(words[i + 1]), valueOf(words[i + 2])},
                          {valueOf(words[i + 3]), valueOf(words[i + 4]), valueOf(words[i + 5])}});
    }
  });
  if (set == 0) m_firstSample = m_sample.size();
}

/// Gives the cells of rank 0 to all.
void Distribution::shareCells() {
  std::vector<std::uint64_t> words;
  m_ranks.onAll([&] {
    if (m_ranks.rank() == 0) words = wordsOf(m_cells.cuts());
  });
  std::uint64_t size = words.size();
  m_ranks.broadcast({&size, 1}, 0);
  m_ranks.onAll([&] { words.resize(size); });
  m_ranks.broadcast(words, 0);
  m_ranks.onAll([&] { m_cells = partition::Partition::fromCuts(cutsOf(words)); });
}

void Distribution::findCells(std::size_t set) {
  const LocalSet& local = m_sets[set];
  std::vector<std::uint32_t>& cells = m_rows[set].cells;
  cells.clear();
  cells.reserve(local.boxes.size() + local.boxes.size() / 16);  // few boxes are in two cells
  const auto wide = static_cast<std::uint32_t>(m_cells.size());
  const auto reach = [&](std::size_t i) { return reachOf(local, i); };
  m_cells.visitCells(local.boxes.size(), reach, [&](std::size_t /*box*/, std::span<const std::uint32_t> found) {
    if (found.empty()) {
      cells.push_back(kNoCell);
    } else if (m_cells.isWide(found.size())) {
      cells.push_back(wide);
    } else {
      cells.insert(cells.end(), found.begin(), found.end());
    }
    cells.back() |= kLast;
  });
}

void Distribution::countBoxes() {
  m_ranks.onAll([&] {
    m_counts.assign(m_cells.size() + 1, 0);
    for (std::size_t set = 0; set < m_sets.size(); ++set) {
      findCells(set);
      forEachCell(m_rows[set].cells, [this](std::uint32_t cell) { ++m_counts[cell]; });
    }
  });
  m_ranks.sum(m_counts);
}

/// Cuts each cell that has more than twice what it should; returns whether any was cut.
bool Distribution::cutAgain() {
  const std::uint64_t fair = std::max<std::uint64_t>(m_allBoxes / m_wanted, 1);
  std::uint64_t isCut = 0;
  m_ranks.onAll([&] {
    if (m_ranks.rank() != 0) return;
    std::vector<partition::CellToCut> full;
    for (std::size_t cell = 0; cell < m_cells.size(); ++cell) {
      if (m_counts[cell] > 2 * fair)
        full.push_back({cell, static_cast<std::size_t>((m_counts[cell] + fair - 1) / fair)});
    }
    if (m_cells.cutAgain(full, m_sample)) isCut = 1;
  });
  m_ranks.broadcast({&isCut, 1}, 0);
  if (isCut != 0) shareCells();
  return isCut != 0;
}

void Distribution::spreadCrowded() {
  const std::uint64_t most =
      partition::mostInCellOnRanks(m_allBoxes, static_cast<std::size_t>(m_ranks.size()), m_tuning.leastCrowded);
  const auto wide = static_cast<std::uint32_t>(m_cells.size());
  const auto isTooMany = [most](std::uint64_t count) { return count > most; };
  if (std::none_of(m_counts.begin(), m_counts.end() - 1, isTooMany)) return;  // on all ranks alike
  m_ranks.onAll([&] {
    const auto isCrowded = [&](std::uint32_t entry) {
      const std::uint32_t cell = numberOf(entry);
      return cell < wide && isTooMany(m_counts[cell]);
    };
    std::vector<std::uint64_t> counts(m_counts.size());
    for (std::size_t set = 0; set < m_sets.size(); ++set) {
      std::vector<std::uint32_t>& cells = m_rows[set].cells;
      auto kept = cells.begin();
      for (auto begin = cells.begin(); begin != cells.end();) {
        const auto end = std::find_if(begin, cells.end(), [](std::uint32_t entry) { return (entry & kLast) != 0; }) + 1;
        if (std::any_of(begin, end, isCrowded)) {
          *kept++ = wide | kLast;
        } else {
          kept = std::copy(begin, end, kept);
        }
        begin = end;
      }
      cells.erase(kept, cells.end());
      forEachCell(cells, [&counts](std::uint32_t cell) { ++counts[cell]; });
    }
    m_counts = std::move(counts);
  });
  m_ranks.sum(m_counts);
}

void Distribution::fillRows(std::size_t set) {
  m_ranks.onAll([&] {
    Rows& rows = m_rows[set];
    rows.begins.assign(m_cells.size() + 2, 0);
    forEachCell(rows.cells, [&rows](std::uint32_t cell) { ++rows.begins[cell + 1]; });
    std::partial_sum(rows.begins.begin(), rows.begins.end(), rows.begins.begin());
    rows.boxes.resize(rows.begins.back());
    std::vector<std::uint64_t> next = rows.begins;
    std::uint32_t box = 0;
    for (const std::uint32_t entry : rows.cells) {
      if (numberOf(entry) != kNoCell) rows.boxes[next[numberOf(entry)]++] = box;
      if ((entry & kLast) != 0) ++box;
    }
    rows.cells = {};
    rows.cells.shrink_to_fit();
  });
}

void Distribution::deal() {
  std::uint64_t size = 0;
  m_ranks.onAll([&] {
    if (m_ranks.rank() == 0) m_dealt = dealByWork();
    size = m_dealt.size();
  });
  m_ranks.broadcast({&size, 1}, 0);
  std::vector<std::uint64_t> words;
  m_ranks.onAll([&] {
    words.assign(m_dealt.begin(), m_dealt.end());
    words.resize(size);
  });
  m_ranks.broadcast(words, 0);
  m_ranks.onAll([&] {
    m_dealt.clear();
    for (const std::uint64_t word : words) m_dealt.push_back(static_cast<std::uint32_t>(word));
    m_rounds = m_dealt.size() / static_cast<std::size_t>(m_ranks.size());
  });
}

/// Gives each cell, the one with the most work first, to the rank that has least until then.
std::vector<std::uint32_t> Distribution::dealByWork() const {
  const auto ranks = static_cast<std::size_t>(m_ranks.size());
  std::vector<double> work = estimatePairs();
  std::vector<std::uint32_t> cells;
  for (std::uint32_t cell = 0; cell < m_cells.size(); ++cell) {
    work[cell] = kPairWork * work[cell] + static_cast<double>(m_counts[cell]);
    if (m_counts[cell] > 1) cells.push_back(cell);  // one box makes no pair
  }
  const auto hasMore = [&work](auto a, auto b) { return work[a] != work[b] ? work[a] > work[b] : a < b; };
  std::sort(cells.begin(), cells.end(), hasMore);
  using Load = std::pair<double, std::size_t>;
  std::priority_queue<Load, std::vector<Load>, std::greater<>> least;
  for (std::size_t rank = 0; rank < ranks; ++rank) least.emplace(0.0, rank);
  std::vector<std::vector<std::uint32_t>> dealt(ranks);
  std::size_t rounds = 0;
  for (const std::uint32_t cell : cells) {
    const auto [load, rank] = least.top();
    least.pop();
    least.emplace(load + work[cell], rank);
    dealt[rank].push_back(cell);
    rounds = std::max(rounds, dealt[rank].size());
  }
  std::vector<std::uint32_t> byRound(rounds * ranks, kNoCell);
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    for (std::size_t round = 0; round < dealt[rank].size(); ++round) {
      byRound[round * ranks + rank] = dealt[rank][round];
    }
  }
  return byRound;
}

/// Of each cell, from as few boxes of the sample as say enough: where each overlaps many, the pairs of all would take
/// long. Two reaches overlap where the boxes are a pair, and seldom elsewhere.
std::vector<double> Distribution::estimatePairs() const {
  std::vector<double> pairs(m_cells.size());
  for (std::size_t step = 256; step > 0; step /= 4) {
    const std::vector<Box> first = everyNth(std::span(m_sample).first(m_firstSample), step);
    const std::vector<Box> second = everyNth(std::span(m_sample).subspan(m_firstSample), step);
    const std::size_t size = first.size() + second.size();
    if (size < 2) continue;
    std::fill(pairs.begin(), pairs.end(), 0.0);
    std::uint64_t found = 0;
    const bool isOneSet = m_sets.size() == 1;
    const double share = static_cast<double>(m_allBoxes) / static_cast<double>(size);
    const auto count = [&](std::span<const Pair> batch) {
      found += batch.size();
      for (const Pair pair : batch) {
        const Box& other = isOneSet ? first[pair.second] : second[pair.second];
        pairs[m_cells.cellOf(partition::pairPoint(first[pair.first], other))] += share * share;
      }
    };
    if (isOneSet) {
      streamOverlaps(first, count);
    } else {
      streamOverlaps(first, second, count);
    }
    if (found >= kEnoughPairs * m_cells.size()) break;
  }
  return pairs;
}

}  // namespace allpairs::mpi
