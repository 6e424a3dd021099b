// SPDX-License-Identifier: MIT
#include "allpairs/partition/Partition.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"

namespace allpairs::partition {
namespace {

constexpr double kGreatestShare = 0.9;  // of the boxes on one side: a cut that divides less only makes copies

/// Refuses a distance that a search refuses.
void checkDistance(double distance) { static_cast<void>(countOverlaps(BoxView(), {.distance = distance})); }

std::vector<Box> reachesOf(const BoxView& boxes, double distance) {
  checkDistance(distance);
  const double maxMargin = greatestMargin(boxes);  // of no box it is not asked for
  std::vector<Box> reaches;
  reaches.reserve(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Box reach = reachOf(boxes[i], boxes.margin(i), distance, maxMargin);
    if (!isEmpty(reach)) reaches.push_back(reach);
  }
  return reaches;
}

/// Where to cut some boxes in two, and how many are on either side.
struct Split {
  std::uint32_t axis = 0;
  double at = 0.0;
  std::size_t low = 0;
  std::size_t high = 0;
};

Split splitAt(std::span<const Box> reaches, std::uint32_t axis, double at) {
  Split split{axis, at};
  for (const Box& reach : reaches) {
    split.low += reach.min[axis] < at ? 1U : 0U;
    split.high += reach.max[axis] >= at ? 1U : 0U;
  }
  return split;
}

/// The minimum with the share `low` of all before it; the next greater one where no box is below it. None at infinity,
/// which belongs to the outermost cell.
std::optional<double> cutOf(std::span<const Box> reaches, std::uint32_t axis, double low, std::vector<double>& minima) {
  minima.clear();
  for (const Box& reach : reaches) minima.push_back(reach.min[axis]);
  const auto rank = static_cast<std::ptrdiff_t>(low * static_cast<double>(minima.size()));
  const auto middle = minima.begin() + std::min<std::ptrdiff_t>(rank, std::ssize(minima) - 1);
  std::nth_element(minima.begin(), middle, minima.end());
  const double least = *std::min_element(minima.begin(), middle + 1);
  double at = *middle;
  if (at == least) {
    at = std::numeric_limits<double>::infinity();
    for (const double minimum : minima) {
      if (minimum > least) at = std::min(at, minimum);
    }
  }
  return std::isfinite(at) ? std::optional(at) : std::nullopt;
}

std::optional<Split> bestSplit(std::span<const Box> reaches, double low, std::vector<double>& minima,
                               const StopFlag* stop) {
  std::optional<Split> best;
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    checkStop(stop);
    const std::optional<double> at = cutOf(reaches, axis, low, minima);
    if (!at) continue;
    const Split split = splitAt(reaches, axis, *at);
    const auto most = static_cast<double>(std::max(split.low, split.high));
    if (most > kGreatestShare * static_cast<double>(reaches.size())) continue;
    if (!best || split.low + split.high < best->low + best->high) best = split;
  }
  return best;
}

[[noreturn]] void throwNoCell(std::size_t number, std::size_t cells) {
  throw InvalidArgument("cell " + std::to_string(number) + " of " + std::to_string(cells));
}

std::int32_t sideOfCell(std::size_t number) { return ~static_cast<std::int32_t>(number); }
std::size_t cellOfSide(std::int32_t side) { return static_cast<std::uint32_t>(~side); }

/// Where a walk begins: at the first cut, or in the only cell.
std::int32_t rootOf(std::span<const Cut> cuts) { return cuts.empty() ? sideOfCell(0) : 0; }

/// Leaves one side of a cut.
void narrow(Cell& cell, const Cut& cut, bool isLow) {
  double& bound = isLow ? cell.max[cut.axis] : cell.min[cut.axis];
  bound = isLow ? std::min(bound, cut.at) : std::max(bound, cut.at);
}

void checkCuts(std::span<const Cut> cuts) {
  std::vector<bool> isCutSeen(cuts.size());
  std::vector<bool> isCellSeen(cuts.size() + 1);
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    bool isRight = cuts[i].axis < 3 && std::isfinite(cuts[i].at);
    for (const std::int32_t side : {cuts[i].low, cuts[i].high}) {
      const auto number = static_cast<std::size_t>(side < 0 ? ~side : side);
      std::vector<bool>& seen = side < 0 ? isCellSeen : isCutSeen;
      isRight = isRight && number < seen.size() && !seen[number] && (side < 0 || number > i);
      if (isRight) seen[number] = true;
    }
    if (!isRight) throw InvalidArgument("cut " + std::to_string(i) + " of a partition does not fit the others");
  }
}

/// A reach as it was where the cell was made: a cut below the cell would divide nothing.
Box within(const Cell& cell, Box reach) {
  for (std::size_t axis = 0; axis < 3; ++axis) reach.min[axis] = std::max(reach.min[axis], cell.min[axis]);
  return reach;
}

/// Cells that are to be cut again, and what leads to them.
class Wanted {
 public:
  Wanted(Span<const CellToCut> cells, std::span<const Cut> cuts) : m_parts(cuts.size() + 1), m_leads(cuts.size()) {
    for (const auto& [number, parts] : cells) {
      if (number >= m_parts.size()) throwNoCell(number, m_parts.size());
      if (std::exchange(m_parts[number], std::max<std::size_t>(parts, 1)) == 0) continue;
      throw InvalidArgument("cell " + std::to_string(number) + " is to be cut twice");
    }
    for (std::size_t i = cuts.size(); i-- > 0;) m_leads[i] = isIn(cuts[i].low) || isIn(cuts[i].high);
  }

  /// Whether any of them is on a side of a cut.
  [[nodiscard]] bool isIn(std::int32_t side) const {
    return side < 0 ? parts(cellOfSide(side)) != 0 : m_leads[static_cast<std::size_t>(side)];
  }
  /// Into how many parts; 0 of another cell.
  [[nodiscard]] std::size_t parts(std::size_t number) const { return m_parts[number]; }

 private:
  std::vector<std::size_t> m_parts;
  std::vector<bool> m_leads;
};

}  // namespace

/// Makes the cuts of a part of space.
class Partition::Cutter {
 public:
  Cutter(std::vector<Cut>& cuts, std::size_t cells, const StopFlag* stop = nullptr)
      : m_cuts(cuts), m_cells(cells), m_stop(stop) {}

  /// Cuts cell `number`, whose boxes these are, into about `parts`, and returns what stands in its place. New cells are
  /// numbered on from those there are.
  std::int32_t cut(std::span<Box> reaches, std::size_t number, std::size_t parts) {
    if (parts < 2 || reaches.size() < 2) return sideOfCell(number);
    const std::size_t lowParts = parts / 2;
    const double share = static_cast<double>(lowParts) / static_cast<double>(parts);
    const std::optional<Split> split = bestSplit(reaches, share, m_minima, m_stop);
    if (!split) return sideOfCell(number);
    const std::size_t place = m_cuts.size();
    const std::size_t highNumber = m_cells++;
    m_cuts.push_back({split->at, split->axis, 0, 0});
    const std::size_t axis = split->axis;
    const std::size_t lowFor = partsFor(*split, parts);
    // Those on the low side stand in front, and then those on the high side; some are on both.
    const auto lowEnd =
        std::partition(reaches.begin(), reaches.end(), [&](const Box& reach) { return reach.min[axis] < split->at; });
    const std::int32_t low = cut({reaches.begin(), lowEnd}, number, lowFor);
    const auto highBegin =
        std::partition(reaches.begin(), reaches.end(), [&](const Box& reach) { return reach.max[axis] < split->at; });
    for (auto reach = highBegin; reach != reaches.end(); ++reach) {  // a cut below the cell would divide nothing
      reach->min[axis] = std::max(reach->min[axis], split->at);
    }
    const std::int32_t high = cut({highBegin, reaches.end()}, highNumber, parts - lowFor);
    m_cuts[place].low = low;
    m_cuts[place].high = high;
    return static_cast<std::int32_t>(place);
  }

 private:
  static std::size_t partsFor(const Split& split, std::size_t parts) {
    const double share = static_cast<double>(split.low) / static_cast<double>(split.low + split.high);
    const auto low = static_cast<std::size_t>(std::lround(share * static_cast<double>(parts)));
    return std::clamp<std::size_t>(low, 1, parts - 1);
  }

  std::vector<Cut>& m_cuts;
  std::size_t m_cells;
  const StopFlag* m_stop;
  std::vector<double> m_minima;
};

Partition::Partition(const BoxView& sample, std::size_t cells, double distance, const StopFlag* stop) {
  std::vector<Box> reaches = reachesOf(sample, distance);
  Cutter(m_cuts, 1, stop).cut(reaches, 0, cells);
}

Partition Partition::fromCuts(Span<const Cut> cuts) {
  checkCuts(cuts);
  Partition partition;
  partition.m_cuts.assign(cuts.begin(), cuts.end());
  return partition;
}

Cell Partition::cell(std::size_t number) const {
  if (number >= size()) throwNoCell(number, size());
  Cell cell;
  std::int32_t side = sideOfCell(number);
  for (std::size_t i = m_cuts.size(); i-- > 0;) {  // up to the first cut: each stands before its sides
    const Cut& cut = m_cuts[i];
    if (cut.low != side && cut.high != side) continue;
    narrow(cell, cut, cut.low == side);
    side = static_cast<std::int32_t>(i);
  }
  return cell;
}

std::vector<Cell> Partition::cells() const {
  std::vector<Cell> cells(size());
  std::vector<Cell> parts(m_cuts.size());  // what each cut divides
  for (std::size_t i = 0; i < m_cuts.size(); ++i) {
    const Cut& cut = m_cuts[i];
    for (const std::int32_t side : {cut.low, cut.high}) {
      const auto number = static_cast<std::size_t>(side < 0 ? ~side : side);
      Cell& part = side < 0 ? cells[number] : parts[number];
      part = parts[i];
      narrow(part, cut, side == cut.low);
    }
  }
  return cells;
}

std::uint32_t Partition::cellOf(const Point& point) const noexcept {
  std::int32_t side = rootOf(m_cuts);
  while (side >= 0) {
    const Cut& cut = m_cuts[static_cast<std::size_t>(side)];
    side = point[cut.axis] < cut.at ? cut.low : cut.high;
  }
  return static_cast<std::uint32_t>(~side);
}

void Partition::cellsOf(const Box& reach, std::vector<std::uint32_t>& cells) const {
  cells.clear();
  if (!isEmpty(reach)) addCells(rootOf(m_cuts), reach, cells);
}

/// The cell of each reach that touches one; kNoSoleCell for one that touches more, or none. All reaches go down the
/// tree together, since one by one each cut would be a branch that no processor foresees.
void Partition::findSoleCells(const std::vector<Box>& reaches, std::vector<std::uint32_t>& cells) const {
  struct Part {
    std::int32_t side;
    std::size_t begin;
    std::size_t end;
  };
  cells.assign(reaches.size(), kNoSoleCell);
  std::vector<std::size_t> numbers(reaches.size());  // of the reaches of each part
  std::vector<std::size_t> high(reaches.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    numbers[count] = i;
    count += isEmpty(reaches[i]) ? 0U : 1U;
  }
  std::vector<Part> parts{{rootOf(m_cuts), 0, count}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    if (part.side < 0) {
      for (std::size_t k = part.begin; k < part.end; ++k) cells[numbers[k]] = static_cast<std::uint32_t>(~part.side);
      continue;
    }
    const Cut& cut = m_cuts[static_cast<std::size_t>(part.side)];
    std::size_t lowEnd = part.begin;
    std::size_t highCount = 0;
    for (std::size_t k = part.begin; k < part.end; ++k) {
      const std::size_t i = numbers[k];
      numbers[lowEnd] = i;
      high[highCount] = i;
      lowEnd += reaches[i].max[cut.axis] < cut.at ? 1U : 0U;
      highCount += reaches[i].min[cut.axis] >= cut.at ? 1U : 0U;
    }
    std::copy_n(high.begin(), highCount, numbers.begin() + static_cast<std::ptrdiff_t>(lowEnd));
    if (highCount > 0) parts.push_back({cut.high, lowEnd, lowEnd + highCount});
    if (lowEnd > part.begin) parts.push_back({cut.low, part.begin, lowEnd});
  }
}

void Partition::addCells(std::int32_t side, const Box& reach, std::vector<std::uint32_t>& cells) const {
  while (side >= 0) {
    const Cut& cut = m_cuts[static_cast<std::size_t>(side)];
    const bool isHigh = reach.max[cut.axis] >= cut.at;
    if (isHigh && reach.min[cut.axis] < cut.at) addCells(cut.low, reach, cells);
    side = isHigh ? cut.high : cut.low;
  }
  cells.push_back(static_cast<std::uint32_t>(~side));
}

bool Partition::cutAgain(std::size_t number, const BoxView& sample, std::size_t parts, double distance) {
  const CellToCut cell{number, parts};
  return cutAgain(Span<const CellToCut>(&cell, 1), sample, distance);
}

/// All reaches go down the tree together, as far as it leads to a cell that is to be cut.
bool Partition::cutAgain(Span<const CellToCut> given, const BoxView& sample, double distance) {
  struct Part {
    std::int32_t side;
    std::size_t above;  ///< The cut that it is a side of, unless it is all of space.
    Cell bounds;
    std::vector<std::uint32_t> reaches;
  };
  const Wanted wanted(given, m_cuts);
  if (given.empty()) return false;
  const std::vector<Box> reaches = reachesOf(sample, distance);
  std::vector<Cut> cuts = m_cuts;  // which stay where memory ends
  std::vector<Box> own;
  std::vector<Part> parts(1, Part{rootOf(m_cuts), 0, Cell(), std::vector<std::uint32_t>(reaches.size())});
  std::iota(parts[0].reaches.begin(), parts[0].reaches.end(), std::uint32_t{0});
  while (!parts.empty()) {
    const Part part = std::move(parts.back());
    parts.pop_back();
    if (part.side < 0) {
      own.clear();
      for (const std::uint32_t reach : part.reaches) own.push_back(within(part.bounds, reaches[reach]));
      const std::size_t number = cellOfSide(part.side);
      const std::int32_t side = Cutter(cuts, cuts.size() + 1).cut(own, number, wanted.parts(number));
      if (m_cuts.empty()) continue;
      Cut& above = cuts[part.above];
      (above.low == part.side ? above.low : above.high) = side;
      continue;
    }
    const auto place = static_cast<std::size_t>(part.side);
    const Cut& cut = m_cuts[place];
    for (const bool isLow : {false, true}) {
      const std::int32_t side = isLow ? cut.low : cut.high;
      if (!wanted.isIn(side)) continue;
      Part& half = parts.emplace_back(Part{side, place, part.bounds, {}});
      narrow(half.bounds, cut, isLow);
      for (const std::uint32_t reach : part.reaches) {
        const Box& box = reaches[reach];
        if (isLow ? box.min[cut.axis] < cut.at : box.max[cut.axis] >= cut.at) half.reaches.push_back(reach);
      }
    }
  }
  const bool isCut = cuts.size() > m_cuts.size();
  m_cuts = std::move(cuts);
  return isCut;
}

double greatestMargin(const BoxView& boxes) noexcept {
  double greatest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < boxes.size(); ++i) greatest = std::max(greatest, boxes.margin(i));
  return greatest;
}

std::vector<std::uint64_t> boxesPerCell(const Partition& partition, const BoxView& boxes, double distance,
                                        double maxMargin) {
  checkDistance(distance);
  if (std::isnan(maxMargin)) throw InvalidArgument("the greatest margin is NaN");
  const double greatest = std::max(maxMargin, greatestMargin(boxes));
  std::vector<std::uint64_t> counts(partition.size());
  const auto reach = [&](std::size_t i) { return reachOf(boxes[i], boxes.margin(i), distance, greatest); };
  partition.visitCells(boxes.size(), reach, [&](std::size_t /*box*/, Span<const std::uint32_t> cells) {
    for (const std::uint32_t cell : cells) ++counts[cell];
  });
  return counts;
}

std::size_t cellsOnRanks(std::uint64_t boxes, std::size_t ranks, std::size_t boxesPerCell) noexcept {
  constexpr std::uint64_t kLeastForARank = 8;
  constexpr std::uint64_t kMostForARank = 32;
  constexpr std::uint64_t kMostInCell = 16;  // of boxesPerCell
  const std::uint64_t cells = boxes / std::max<std::uint64_t>(boxesPerCell, 1);
  const std::uint64_t wanted = std::min<std::uint64_t>(cells, kMostForARank * ranks);
  return static_cast<std::size_t>(std::max({kLeastForARank * ranks, wanted, cells / kMostInCell}));
}

std::uint64_t mostInCellOnRanks(std::uint64_t boxes, std::size_t ranks, std::uint64_t least) noexcept {
  return std::max(boxes / std::max<std::uint64_t>(ranks, 1), least);
}

}  // namespace allpairs::partition
