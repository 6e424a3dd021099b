// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "BoxInput.h"
#include "PairMerge.h"
#include "allpairs/join/Join.h"
#include "allpairs/partition/Partition.h"

namespace allpairs::join {

/// The boxes that overlap very many, such as a ground or the whole domain. A sample of all boxes misses them, or has
/// one that would stand for many. So each box that may be one is tried against some hundred boxes that are spread over
/// the set of its partners, its probes: it has the same share of all as of these.
class LargeBoxes {
 public:
  /// Reads the probes.
  LargeBoxes(BoxInput& input, const JoinOptions& options);
  LargeBoxes(const LargeBoxes&) = delete;
  LargeBoxes& operator=(const LargeBoxes&) = delete;

  /// Forgets all boxes, and finds out which probes are large where space is cut into these cells.
  void restart(const partition::Partition& cells, const std::array<double, 2>& partnerMargins);

  /// Whether box `i` of a block, with these cells, overlaps at least a sixteenth of its probes. If it does, it is
  /// counted.
  bool take(const BoxBlock& block, std::size_t i, std::span<const std::uint32_t> cells);

  /// How many were taken of a set.
  [[nodiscard]] std::uint64_t count(std::size_t set) const { return m_found[set].boxes; }

  /// Their pairs with all boxes, of which `sent[set]` go anywhere.
  [[nodiscard]] double pairs(const std::array<std::uint64_t, 2>& sent) const;

  /// What each range of first boxes has of these pairs; and of `others`, which are taken to be spread evenly.
  [[nodiscard]] std::vector<KeyLoad> loads(const std::array<std::uint64_t, 2>& sent, double others) const;

 private:
  struct Probes {
    BoxSample boxes{};
    BoxBlock block{};  ///< The same.
    std::vector<std::uint64_t> numbers{};
    std::vector<unsigned char> areLarge{};
  };
  /// What a box overlaps of the probes that are not large, and of those that are: 1.0 is all.
  struct Shares {
    double small = 0.0;
    double large = 0.0;
  };
  struct Found {
    std::uint64_t boxes = 0;
    Shares sum{};
  };
  struct Row {
    Shares sum{};
    Shares most{};
  };

  [[nodiscard]] bool mayBeLarge(const BoxBlock& block, std::size_t i, std::span<const std::uint32_t> cells) const;
  [[nodiscard]] bool isLarge(const BoxBlock& block, std::size_t i, Shares& shares) const;
  [[nodiscard]] std::size_t partnerOf(std::size_t set) const { return m_input.sets() - 1 - set; }
  [[nodiscard]] double pairsOf(const Shares& shares, const std::array<std::uint64_t, 2>& sent) const;

  BoxInput& m_input;
  const JoinOptions& m_options;
  KeyRanges m_ranges;
  std::array<Probes, 2> m_probes{};
  double m_usualSize = 0.0;
  std::size_t m_cells = 1;
  std::array<Found, 2> m_found{};
  std::vector<Row> m_rows{};  ///< Of the first set, in each range: those of pairs that it is the first of.
};

}  // namespace allpairs::join
