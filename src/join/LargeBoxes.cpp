// SPDX-License-Identifier: MIT
#include "LargeBoxes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "Divider.h"

namespace allpairs::join {
namespace {

constexpr std::size_t kProbes = 256;      // of a set
constexpr std::size_t kFirstProbes = 64;  // after which most boxes are known not to be large
constexpr std::size_t kPart = 16;         // a large box overlaps at least this part of them
constexpr double kUnusual = 4.0;          // times the usual size

/// The length of its sides, with the margins; infinite, or a NaN, if its bounds are.
double sizeOf(const BoxBlock& block, std::size_t i) {
  const Box& box = block.boxes[i];
  double size = 6.0 * block.boxes.margin(i);
  for (std::size_t axis = 0; axis < 3; ++axis) size += box.max[axis] - box.min[axis];
  return size;
}

/// Whether groups, categories and masks let boxes be a pair.
bool mayBePair(const BoxBlock& a, std::size_t i, const BoxBlock& b, std::size_t k) {
  const bool areOfOneGroup = a.group(i) != 0 && a.group(i) == b.group(k);
  return !areOfOneGroup && (a.mask(i) & b.categories(k)) != 0 && (b.mask(k) & a.categories(i)) != 0;
}

double ratio(std::size_t part, std::size_t all) { return static_cast<double>(part) / static_cast<double>(all); }

}  // namespace

LargeBoxes::LargeBoxes(BoxInput& input, const JoinOptions& options)
    : m_input(input), m_options(options), m_ranges(KeyRanges::of(0, input.size(0), false, kMostRanges)) {
  for (Probes& probes : m_probes) probes.boxes = {.type = input.recordType()};
  m_input.forEachProbe(kProbes, [this](const BoxBlock& block) {
    if (isEmpty(block.boxes[0]) || !isKept(block, 0, m_options)) return;
    m_probes[block.set].boxes.add(block, 0);
    m_probes[block.set].numbers.push_back(block.begin);
  });
  m_usualSize = std::numeric_limits<double>::infinity();
  for (Probes& probes : m_probes) {
    probes.block = probes.boxes.block();
    std::vector<double> sizes;
    for (std::size_t i = 0; i < probes.numbers.size(); ++i) {
      const double size = sizeOf(probes.block, i);
      if (std::isfinite(size)) sizes.push_back(size);
    }
    if (sizes.empty()) continue;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    m_usualSize = std::min(m_usualSize, *middle);
  }
}

void LargeBoxes::restart(const partition::Partition& cells, const std::array<double, 2>& partnerMargins) {
  m_cells = cells.size();
  m_found = {};
  m_rows.assign(m_ranges.count(), {});
  for (Probes& probes : m_probes) probes.areLarge.assign(probes.numbers.size(), 0);
  std::array<std::vector<unsigned char>, 2> areLarge;
  std::vector<std::uint32_t> reached;
  for (std::size_t set = 0; set < m_input.sets(); ++set) {
    for (std::size_t i = 0; i < m_probes[set].numbers.size(); ++i) {
      BoxBlock block = m_probes[set].block;
      block.set = set;
      block.begin = m_probes[set].numbers[i] - i;  // so that it has its number
      cells.cellsOf(partition::reachOf(block.boxes[i], block.boxes.margin(i), m_options.distance, partnerMargins[set]),
                    reached);
      Shares ignored;
      areLarge[set].push_back(mayBeLarge(block, i, reached) && isLarge(block, i, ignored) ? 1 : 0);
    }
  }
  for (std::size_t set = 0; set < m_input.sets(); ++set) m_probes[set].areLarge = std::move(areLarge[set]);
}

/// A wide one, one in most cells, or one of unusual size that no cell holds alone, unless there is only one: trying all
/// that lie on a cut would take a tenth of a join.
bool LargeBoxes::mayBeLarge(const BoxBlock& block, std::size_t i, std::span<const std::uint32_t> cells) const {
  if (m_cells > 1 && cells.size() == 1) return cells.front() == m_cells;
  if (cells.size() > 2 && cells.size() > m_cells / 2) return true;
  return sizeOf(block, i) > kUnusual * m_usualSize;
}

bool LargeBoxes::isLarge(const BoxBlock& block, std::size_t i, Shares& shares) const {
  const Probes& probes = m_probes[partnerOf(block.set)];
  const Box box = block.boxes[i];
  const double margin = m_options.distance + block.boxes.margin(i);
  const std::size_t count = probes.numbers.size();
  const std::size_t step = std::max<std::size_t>(count / kFirstProbes, 1);
  std::array<std::size_t, 2> hits{};
  std::array<std::size_t, 2> tried{};
  for (std::size_t begin = 0; begin < step; ++begin) {  // spread from the first on
    for (std::size_t k = begin; k < count; k += step) {
      if (m_input.sets() == 1 && probes.numbers[k] == block.begin + i) continue;
      const std::size_t kind = probes.areLarge[k];
      ++tried[kind];
      const double distance = margin + probes.block.boxes.margin(k);
      const bool isPair = overlap(box, probes.block.boxes[k], distance) && mayBePair(block, i, probes.block, k);
      if (isPair) ++hits[kind];
    }
    if (begin == 0 && step > 1 && hits[0] + hits[1] < 2) return false;  // one may be a large probe
  }
  const std::size_t all = hits[0] + hits[1];
  if (all == 0 || kPart * all < tried[0] + tried[1]) return false;
  // Where there are no probes of a kind it has few boxes.
  shares.small = tried[0] != 0 ? ratio(hits[0], tried[0]) : ratio(hits[1], tried[1]);
  shares.large = tried[1] != 0 ? ratio(hits[1], tried[1]) : shares.small;
  return true;
}

bool LargeBoxes::take(const BoxBlock& block, std::size_t i, std::span<const std::uint32_t> cells) {
  Shares shares;
  if (!mayBeLarge(block, i, cells) || !isLarge(block, i, shares)) return false;
  Found& found = m_found[block.set];
  ++found.boxes;
  found.sum.small += shares.small;
  found.sum.large += shares.large;
  if (block.set != 0) return true;
  const std::uint64_t number = block.begin + i;
  const auto all = static_cast<double>(m_input.size(0));
  // Of one set it is the first in its pairs with those of greater numbers only.
  const double part = m_input.sets() == 2 ? 1.0 : (all - 1.0 - static_cast<double>(number)) / all;
  Row& row = m_rows[m_ranges.rangeOf(number, 0)];
  row.sum.small += part * shares.small;
  row.sum.large += part * shares.large;
  row.most.small = std::max(row.most.small, part * shares.small);
  row.most.large = std::max(row.most.large, part * shares.large);
  return true;
}

/// Of boxes of the first set.
double LargeBoxes::pairsOf(const Shares& shares, const std::array<std::uint64_t, 2>& sent) const {
  const std::size_t partner = partnerOf(0);
  return shares.small * static_cast<double>(sent[partner] - count(partner)) +
         shares.large * static_cast<double>(count(partner));
}

/// Those of two large boxes are found from both.
double LargeBoxes::pairs(const std::array<std::uint64_t, 2>& sent) const {
  double pairs = 0.0;
  for (std::size_t set = 0; set < m_input.sets(); ++set) {
    const std::size_t partner = partnerOf(set);
    const Shares& sum = m_found[set].sum;
    const std::uint64_t large = count(partner);
    const std::uint64_t otherLarge = large - (m_input.sets() == 1 && large != 0 ? 1 : 0);
    pairs += sum.small * static_cast<double>(sent[partner] - large) + sum.large * static_cast<double>(otherLarge) / 2.0;
  }
  return pairs;
}

std::vector<KeyLoad> LargeBoxes::loads(const std::array<std::uint64_t, 2>& sent, double others) const {
  const auto whole = [](double pairs) { return static_cast<std::uint64_t>(std::min(std::ceil(pairs), 0x1p56)); };
  const double even = others / static_cast<double>(std::max<std::size_t>(m_ranges.count(), 1));
  std::vector<KeyLoad> loads;
  for (std::size_t range = 0; range < m_rows.size(); ++range) {
    const Row& row = m_rows[range];
    loads.push_back({.keys = m_ranges.beginOf(range + 1) - m_ranges.beginOf(range),
                     .pairs = whole(pairsOf(row.sum, sent) + even),
                     .longestRow = whole(pairsOf(row.most, sent))});
  }
  return loads;
}

}  // namespace allpairs::join
