// SPDX-License-Identifier: MIT
#include "Divider.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "allpairs/Overlaps.h"
#include "allpairs/StopFlag.h"

namespace allpairs::join {
namespace {

constexpr std::size_t kCutSample = std::size_t{1} << 16;  // boxes that decide where to cut
constexpr std::size_t kSamplePerCell = 256;               // of these, where there are many cells
constexpr double kLoad = 0.7;                             // of what fits: samples err
constexpr int kRounds = 3;                                // of cutting cells again, each of which reads the input
constexpr std::size_t kCellsPerWorker = 4;
constexpr std::uint64_t kWorthCutting = 100'000;  // boxes; fewer are searched sooner than cut

/// A sample with fewer pairs says little about the whole.
constexpr std::uint64_t kEnoughPairs = 2'000;

std::size_t cellsFor(std::uint64_t boxes, const Budget& budget) {
  const double full = kLoad * static_cast<double>(std::max<std::size_t>(budget.cellBoxes, 1));
  const auto forMemory = boxes <= budget.cellBoxes
                             ? std::size_t{1}
                             : static_cast<std::size_t>(std::ceil(static_cast<double>(boxes) / full));
  const std::size_t forWorkers = budget.workers > 1 && boxes > kWorthCutting ? kCellsPerWorker * budget.workers : 1;
  return std::max(forMemory, forWorkers);
}

/// Into how many parts a cell is cut again.
std::size_t partsOfFull(std::uint64_t boxes, const Budget& budget) {
  if (budget.fairBoxes == 0) return 2 * cellsFor(boxes, budget);
  return static_cast<std::size_t>((boxes + budget.fairBoxes - 1) / budget.fairBoxes);
}

}  // namespace

std::uint64_t Division::records() const { return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}); }

std::uint64_t Division::copies() const { return records() - sent[0] - sent[1]; }

std::uint64_t Division::countOf(std::size_t cell) const {
  std::uint64_t count = 0;
  for (std::size_t part = cell; part < counts.size(); part += cells.size() + 1) count += counts[part];
  return count;
}

std::uint64_t Division::scratchBytes(std::size_t pairSize, std::size_t memory) const {
  std::uint64_t most = 0;
  for (const KeyLoad& load : loads) most = std::max(most, scratchBytesFor(load, pairSize, memory));
  return most;
}

Divider::Divider(BoxInput& input, const JoinOptions& options, const Budget& budget)
    : m_input(input), m_options(options), m_budget(budget), m_large(input, options) {}

Division Divider::divide() {
  Division division;
  measureMargins(division);
  const std::size_t most = cellsFor(m_input.size(), m_budget);
  const std::size_t sampleSize = m_options.region ? m_budget.sampleBoxes : std::max(kCutSample, kSamplePerCell * most);
  BoxSample sample = m_input.sample(std::min(sampleSize, m_budget.sampleBoxes));
  std::uint64_t boxes = m_input.size();
  if (m_options.region) {
    const std::size_t all = std::max<std::size_t>(sample.boxes.size(), 1);
    sample = keptOf(sample);
    boxes = static_cast<std::uint64_t>(static_cast<double>(boxes) * static_cast<double>(sample.boxes.size()) /
                                       static_cast<double>(all));
  }
  const std::size_t cells = std::max(cellsFor(boxes, m_budget), m_budget.leastCells);
  division.cells = partition::Partition(sample.view(), cells, m_options.distance, m_options.stop);
  count(division);
  for (int round = 0; round < kRounds && cutFullCells(division, sample); ++round) count(division);
  estimatePairs(division);
  return division;
}

/// Of no box 0, which is asked for where the other set has some.
double Divider::greatestMargin(std::size_t set) const {
  if (!m_input.hasMargins(set) || m_input.size(set) == 0) return 0.0;
  double greatest = -std::numeric_limits<double>::infinity();
  for (std::uint64_t begin = 0; begin < m_input.size(set);) {
    checkStop(m_options.stop);
    const std::span<const double> margins = m_input.margins(set, begin);
    greatest = std::max(greatest, *std::max_element(margins.begin(), margins.end()));
    begin += margins.size();
  }
  return greatest;
}

void Divider::measureMargins(Division& division) const {
  division.partnerMargins = {greatestMargin(0), greatestMargin(1)};
  if (m_input.sets() == 2) std::swap(division.partnerMargins[0], division.partnerMargins[1]);
}

BoxSample Divider::keptOf(const BoxSample& all) const {
  BoxSample kept{.type = all.type};
  const BoxBlock block = all.block();
  for (std::size_t i = 0; i < block.boxes.size(); ++i) {
    if (isKept(block, i, m_options)) kept.add(block, i);
  }
  return kept;
}

void Divider::count(Division& division) {
  division.counts.assign(m_input.sets() * (division.cells.size() + 1), 0);
  division.sent = {};
  division.empty = {};
  for (BoxSample& sample : m_evenSamples) sample = {.type = m_input.recordType()};
  m_evenNumbers = {};
  m_large.restart(division.cells, division.partnerMargins);
  m_input.forEachBlock([&](const BoxBlock& block) {
    checkStop(m_options.stop);
    const std::uint64_t step = stepOf(block.set);
    division.empty[block.set].look(block.boxes, block.begin);
    visitCells(division, block, m_options, [&](std::size_t i, std::span<const std::uint32_t> cells) {
      ++division.sent[block.set];
      for (const std::uint32_t cell : cells) ++division.counts[partOf(division.cells, block.set, cell)];
      if (m_large.take(block, i, cells) || (block.begin + i) % step != 0) return;
      m_evenSamples[block.set].add(block, i);
      m_evenNumbers[block.set].push_back(block.begin + i);
    });
    if (m_options.progress) m_options.progress({"counting", block.before + block.boxes.size(), m_input.size()});
  });
}

/// Returns whether anything was cut.
bool Divider::cutFullCells(Division& division, const BoxSample& sample) const {
  std::vector<partition::CellToCut> full;
  for (std::size_t cell = 0; cell < division.cells.size(); ++cell) {
    const std::uint64_t boxes = division.countOf(cell);
    if (boxes > m_budget.cellBoxes) full.push_back({cell, partsOfFull(boxes, m_budget)});
  }
  return division.cells.cutAgain(full, sample.view(), m_options.distance);
}

/// Every so many boxes of a set are in its sample; of two sets of about the same size those with the same numbers.
std::uint64_t Divider::stepOf(std::size_t set) const {
  const std::uint64_t most = std::max<std::uint64_t>(m_budget.sampleBoxes / m_input.sets(), 1);
  const std::uint64_t own = m_input.size(set) / most + 1;
  const std::uint64_t others = m_input.size(m_input.sets() - 1 - set) / most + 1;
  return others <= 2 * own ? std::max(own, others) : own;
}

void Divider::estimatePairs(Division& division) const {
  const double others = pairsOfOthers(division);
  const double all = others + m_large.pairs(division.sent);
  division.pairs = static_cast<std::uint64_t>(std::min(all, 0x1p63));  // billions of boxes in one place have more
  division.loads = m_large.loads(division.sent, others);
}

/// From as few boxes of the sample as say enough: where each overlaps many, the pairs of all would take long. Boxes of
/// two sets with the same number may be the same object, so that their pairs say nothing of those of other numbers.
double Divider::pairsOfOthers(const Division& division) const {
  SamplePairs pairs;
  std::array<BoxSample, 2> parts;
  for (std::size_t step = 256; step > 0 && pairs.others < kEnoughPairs; step /= 4) {
    std::array<std::vector<std::uint64_t>, 2> numbers;
    for (std::size_t set = 0; set < m_input.sets(); ++set) {
      parts[set] = {.type = m_input.recordType()};
      const BoxBlock block = m_evenSamples[set].block();
      const std::uint64_t stepOfNumbers = step * stepOf(set);
      for (std::size_t i = 0; i < block.boxes.size(); ++i) {
        const std::uint64_t number = m_evenNumbers[set][i];
        if (number % stepOfNumbers != 0) continue;
        parts[set].add(block, i);
        numbers[set].push_back(number);
      }
    }
    pairs = pairsOf(std::span(parts).first(m_input.sets()), numbers);
  }
  const bool isOneSet = m_input.sets() == 1;
  const auto shareOf = [&](std::size_t set, std::size_t less) {  // of how many boxes one of the sample stands for
    const auto all = static_cast<double>(division.sent[set] - m_large.count(set) - less);
    return all / static_cast<double>(parts[set].boxes.size() - less);
  };
  if (pairs.others + pairs.ofOneNumber == 0) return 0.0;
  const double share = shareOf(0, 0) * (isOneSet ? shareOf(0, 1) : shareOf(1, 0));
  return static_cast<double>(pairs.others) * share + static_cast<double>(pairs.ofOneNumber) * shareOf(0, 0);
}

Divider::SamplePairs Divider::pairsOf(std::span<const BoxSample> parts,
                                      const std::array<std::vector<std::uint64_t>, 2>& numbers) const {
  OverlapOptions options{.distance = m_options.distance, .stop = m_options.stop};
  options.filter.first = parts[0].bits();
  if (parts.size() == 1) return {.others = countOverlaps(parts[0].view(), options)};
  options.filter.second = parts[1].bits();
  SamplePairs pairs;
  options.filter.accept = [&](std::uint32_t first, std::uint32_t second) {
    pairs.ofOneNumber += numbers[0][first] == numbers[1][second] ? 1U : 0U;
    return true;
  };
  pairs.others = countOverlaps(parts[0].view(), parts[1].view(), options) - pairs.ofOneNumber;
  return pairs;
}

}  // namespace allpairs::join
