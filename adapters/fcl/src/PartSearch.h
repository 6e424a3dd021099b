// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "ExactBody.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/World.h"

namespace allpairs::exact {

/// A part of each of two bodies, by their numbers, and what lies between their boxes at least. Nearer ones come first.
struct PartPair {
  double distance = 0.0;
  std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t second = std::numeric_limits<std::uint32_t>::max();

  friend auto operator<=>(const PartPair&, const PartPair&) = default;
};

/// Finds the parts of two bodies that are near each other, in memory that does not grow with the number of pairs.
class PartSearch {
 public:
  PartSearch(const ExactBody& first, const ExactBody& second) : m_first(first), m_second(second) {}

  /// Passes all pairs whose boxes meet, radii included, by ascending numbers.
  void visitMeeting(FunctionRef<void(const PartPair&)> visitor) const;

  /// Of the pairs that are no further apart, the nearest that come after `last`, in order: all of them if fewer than
  /// kMost.
  [[nodiscard]] std::vector<PartPair> after(const PartPair& last, double limit);

  /// As far apart as a pair that is among the nearest of those that are apart; infinite where all pairs are few.
  [[nodiscard]] double likelyLimit();

  static constexpr std::size_t kMost = std::size_t{1} << 17;

 private:
  [[nodiscard]] double distanceOf(std::size_t first, std::size_t second) const;
  [[nodiscard]] std::vector<Neighbor> nearest(std::size_t first, std::size_t count);
  [[nodiscard]] std::vector<Neighbor> allWithin(std::size_t first, double limit);

  const ExactBody& m_first;
  const ExactBody& m_second;
  std::unique_ptr<World> m_world;  ///< Of the boxes of the second's parts, by their numbers; made when it is needed.
};

/// Whether each part of one body is there in the other as well.
[[nodiscard]] bool areSame(const ExactBody& first, const ExactBody& second, double tolerance);

}  // namespace allpairs::exact
