// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "ExactBody.h"
#include "allpairs/FunctionRef.h"

namespace allpairs::exact {

/// A part of each of two bodies, by their numbers, and what lies between their boxes at least. Nearer ones come first.
struct PartPair {
  double distance = 0.0;
  std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t second = std::numeric_limits<std::uint32_t>::max();

  friend auto operator<=>(const PartPair&, const PartPair&) = default;
};

/// Finds the parts of two bodies that are near each other, in memory that grows with the parts and not with the pairs.
class PartSearch {
 public:
  PartSearch(const ExactBody& first, const ExactBody& second) : m_first(first), m_second(second) {}

  /// Passes all pairs whose boxes meet, radii included, by ascending numbers.
  void visitMeeting(FunctionRef<void(const PartPair&)> visitor) const;

  /// Passes pairs whose boxes are apart, each once, near ones early: at least those that are no further apart than
  /// withRounding() of what `visitor` returned last, which never grows.
  void visitApart(double within, FunctionRef<double(const PartPair&)> visitor) const;

  /// A distance of parts and one of their boxes that are the same but for rounding differ by less than is added here.
  [[nodiscard]] double withRounding(double distance) const;

 private:
  [[nodiscard]] double distanceOf(std::size_t first, std::size_t second) const;
  void visitFewApart(double within, FunctionRef<double(const PartPair&)> visitor) const;

  const ExactBody& m_first;
  const ExactBody& m_second;
};

/// Whether each part of one body is there in the other as well.
[[nodiscard]] bool areSame(const ExactBody& first, const ExactBody& second, double tolerance);

}  // namespace allpairs::exact
