// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "BoxInput.h"
#include "Budget.h"
#include "LargeBoxes.h"
#include "PairMerge.h"
#include "allpairs/Box.h"
#include "allpairs/join/Join.h"
#include "allpairs/partition/Partition.h"

namespace allpairs::join {

/// The boxes of a cell are one part for each set, and so are the wide ones, which have the number after the last
/// cell's. Parts of the second set follow all of the first.
[[nodiscard]] inline std::size_t partOf(const partition::Partition& cells, std::size_t set, std::size_t cell) noexcept {
  return set * (cells.size() + 1) + cell;
}

/// How space is cut for one or two sets of boxes, and how many go where.
struct Division {
  partition::Partition cells{};
  std::vector<std::uint64_t> counts{};     ///< Of each part.
  std::array<double, 2> partnerMargins{};  ///< The greatest margin of what a box of each set may be paired with.
  std::array<std::uint64_t, 2> sent{};     ///< Boxes of each set that go anywhere: none that is empty or left out.
  std::array<scene::EmptyBoxes, 2> empty{};
  std::uint64_t pairs = 0;       ///< Estimated.
  std::vector<KeyLoad> loads{};  ///< Likewise, of each range of first boxes.

  /// Boxes and their copies: what is written.
  [[nodiscard]] std::uint64_t records() const;
  [[nodiscard]] std::uint64_t copies() const;

  /// What its pairs take, as far as a file can be.
  [[nodiscard]] std::uint64_t pairBytes(std::size_t pairSize) const {
    constexpr std::uint64_t kMost = std::uint64_t{1} << 60;
    return pairs < kMost / pairSize ? pairs * pairSize : kMost;
  }

  /// What the copies of pairs that do not fit in `memory` take while they are put in order: those of the range of first
  /// boxes that takes the most.
  [[nodiscard]] std::uint64_t scratchBytes(std::size_t pairSize, std::size_t memory) const;

  /// The boxes of all sets in a cell, or those that are wide.
  [[nodiscard]] std::uint64_t countOf(std::size_t cell) const;
  [[nodiscard]] std::uint64_t wideBoxes() const { return countOf(cells.size()); }
};

/// Cuts space so that the boxes of a cell, of all sets, fit in memory where cuts can do that, and counts what each cell
/// gets.
///
/// Bad input: a NaN throws FileError.
class Divider {
 public:
  Divider(BoxInput& input, const JoinOptions& options, const Budget& budget);

  [[nodiscard]] Division divide();

 private:
  [[nodiscard]] double greatestMargin(std::size_t set) const;
  void measureMargins(Division& division) const;
  void count(Division& division);
  [[nodiscard]] BoxSample keptOf(const BoxSample& all) const;
  [[nodiscard]] bool cutFullCells(Division& division, const BoxSample& sample) const;
  void estimatePairs(Division& division) const;
  [[nodiscard]] double pairsOfOthers(const Division& division) const;
  /// Pairs of a sample: of two sets those of boxes with the same number, and others.
  struct SamplePairs {
    std::uint64_t others = 0;
    std::uint64_t ofOneNumber = 0;
  };
  [[nodiscard]] SamplePairs pairsOf(std::span<const BoxSample> parts,
                                    const std::array<std::vector<std::uint64_t>, 2>& numbers) const;
  [[nodiscard]] std::uint64_t stepOf(std::size_t set) const;

  BoxInput& m_input;
  const JoinOptions& m_options;
  const Budget& m_budget;
  LargeBoxes m_large;
  std::array<BoxSample, 2> m_evenSamples;  ///< Others at equal distances in each set, taken while counting.
  std::array<std::vector<std::uint64_t>, 2> m_evenNumbers;  ///< In their set.
};

/// Whether the region does not leave a box out.
[[nodiscard]] inline bool isKept(const BoxBlock& block, std::size_t i, const JoinOptions& options) {
  return !options.region || overlap(block.boxes[i], *options.region, options.distance + block.boxes.margin(i));
}

/// Calls `visit(i, cells)` for each box of a block that is not empty and that the region keeps, with the numbers of its
/// cells; of a box in many, that of the wide ones alone, which is the number after the last.
template <class Visit>
void visitCells(const Division& division, const BoxBlock& block, const JoinOptions& options, const Visit& visit) {
  const auto wide = static_cast<std::uint32_t>(division.cells.size());
  const auto reach = [&](std::size_t i) {
    return partition::reachOf(block.boxes[i], block.boxes.margin(i), options.distance,
                              division.partnerMargins[block.set]);
  };
  division.cells.visitCells(block.boxes.size(), reach, [&](std::size_t i, std::span<const std::uint32_t> cells) {
    if (cells.empty() || !isKept(block, i, options)) return;
    visit(i, division.cells.isWide(cells.size()) ? std::span(&wide, 1) : cells);
  });
}

}  // namespace allpairs::join
