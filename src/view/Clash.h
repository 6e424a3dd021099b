// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ViewScene.h"

namespace allpairs::view {

/// One pair of a report, and what its boxes have in common.
struct Clash {
  std::size_t number = 0;  ///< From 1, largest overlap first.
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::array<double, 3> overlap{};  ///< Per axis; negative where the boxes are apart.
  double volume = 0.0;              ///< Of what both boxes share.
  std::string guid;                 ///< The same for the same scene and models, so that a later report renews a topic.

  [[nodiscard]] bool isSelf() const { return first == second; }
};

/// The pairs of the scene's first frame, largest overlap first, those of equal volume as they were found; self pairs
/// last.
[[nodiscard]] std::vector<Clash> clashesOf(const ViewScene& scene);

/// What both boxes of a clash share, or where they are apart the gap between them.
[[nodiscard]] Box placeOf(const ViewScene& scene, const Clash& clash);

/// "A and B", or "A with itself".
[[nodiscard]] std::string titleOf(const ViewScene& scene, const Clash& clash);

/// A number that identifies texts, in the form of a UUID: 8-4-4-4-12 hexadecimal digits.
[[nodiscard]] std::string guidOf(const std::vector<std::string>& texts);

}  // namespace allpairs::view
