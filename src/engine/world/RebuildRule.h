// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace allpairs::engine {

/// Which boxes a join met with the others.
enum class Joined : std::uint8_t { All, Changed };

/// Says when an order is worth making anew: when what joins have lost since it was made adds up to what that costs.
///
/// A join's loss is how many more boxes it tested than it would have at the rate, tests per box, of the first join of its
/// kind after the order was made. Counts depend on nothing but the boxes, so that every run decides alike. Waiting until
/// the loss equals the price is never more than twice as dear as knowing the future.
/// Reference: A. Karlin, M. Manasse, L. Rudolph, D. Sleator, "Competitive snoopy caching", Algorithmica 3, 1988.
class RebuildRule {
 public:
  /// A new order has been made.
  void start() noexcept { *this = {}; }

  /// A join met so many boxes with the others, by so many tests of boxes.
  void note(Joined kind, std::size_t boxes, std::uint64_t tests) noexcept {
    if (boxes == 0) return;
    double& rate = m_rate[static_cast<std::size_t>(kind)];
    if (rate < 0.0) rate = static_cast<double>(tests) / static_cast<double>(boxes);
    m_loss = std::max(0.0, m_loss + static_cast<double>(tests) - rate * static_cast<double>(boxes));
  }

  /// Whether an order of so many boxes is due.
  [[nodiscard]] bool isDue(std::size_t boxes) const noexcept { return m_loss > kPrice * static_cast<double>(boxes); }

 private:
  /// What it costs to order a box anew, in tests of a pair of boxes (docs/decisions/0007).
  static constexpr double kPrice = 24.0;

  std::array<double, 2> m_rate{-1.0, -1.0};
  double m_loss = 0.0;
};

}  // namespace allpairs::engine
