// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace allpairs::engine {

/// What is kept between steps is made again as a whole if more than one box in this many has changed.
///
/// Hierarchies and lists have room for so many boxes more, and are made again when more have come, or come and gone:
/// one in 16 makes them again twice as often, one in 4 takes twice as much memory beyond need. If so many have moved,
/// all blocks of a hierarchy are read again: most would be anyway (moving_benchmark --scene one-percent, of which fewer
/// move; --scene slow, of which all do).
inline constexpr std::size_t kShareOfChange = 8;

/// Decides when to rebuild a hierarchy: when the losses of the joins since the last rebuild add up to the cost of a
/// rebuild. This is the ski-rental rule, which is 2-competitive: it never costs more than twice the optimum.
///
/// A join's loss is the number of box tests it made beyond the rate, tests per box, of the first join of its kind after
/// the rebuild. Counts depend only on the boxes, so that every run makes the same decision.
/// Reference: A. Karlin, M. Manasse, L. Rudolph, D. Sleator, "Competitive snoopy caching", Algorithmica 3, 1988.
class RebuildRule {
 public:
  /// The hierarchy has been rebuilt.
  void start() noexcept { *this = {}; }

  /// Records a join of all boxes, or of those that changed: how many it tested against the others, and the number of
  /// box tests.
  void noteAll(std::size_t boxes, std::uint64_t tests) noexcept { note(m_rateOfAll, boxes, tests); }
  void noteChanged(std::size_t boxes, std::uint64_t tests) noexcept { note(m_rateOfChanged, boxes, tests); }

  /// Whether a rebuild for that number of boxes is due.
  [[nodiscard]] bool isDue(std::size_t boxes) const noexcept { return m_loss > kPrice * static_cast<double>(boxes); }

 private:
  /// The cost of a rebuild per box, in tests of a pair of boxes (docs/decisions/0007).
  static constexpr double kPrice = 80.0;

  void note(double& rate, std::size_t boxes, std::uint64_t tests) noexcept {
    if (boxes == 0) return;
    if (rate < 0.0) rate = static_cast<double>(tests) / static_cast<double>(boxes);
    m_loss = std::max(0.0, m_loss + static_cast<double>(tests) - rate * static_cast<double>(boxes));
  }

  double m_rateOfAll = -1.0;
  double m_rateOfChanged = -1.0;
  double m_loss = 0.0;
};

}  // namespace allpairs::engine
