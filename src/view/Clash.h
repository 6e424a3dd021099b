// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ViewScene.h"

namespace allpairs::view {

/// What has become of a row since an earlier report.
enum class Change : std::uint8_t {
  New,         ///< It was not there, or was no clash and is one.
  Persisting,  ///< It was there.
  Resolved,    ///< It was a clash and is none any more.
};

/// One row of a report: a pair, and what its boxes have in common. Where models are parts of bodies, the worst pair of
/// two bodies.
struct Clash {
  std::size_t number = 0;  ///< From 1, the worst first.
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::array<double, 3> overlap{};   ///< Per axis; negative where the boxes are apart.
  double volume = 0.0;               ///< Of what both boxes share.
  const ExactPair* exact = nullptr;  ///< What the shapes say, in the scene; null where only boxes were asked.
  std::vector<Clash> inside{};    ///< The other pairs of the same two bodies, the worst first, without number and GUID.
  std::optional<Change> since{};  ///< Since an earlier report, if there is one.
  std::string before{};           ///< How the earlier report had it, if otherwise: "clash, 0.3 deep".
  std::string guid;  ///< The same for the same two models or bodies, so that a later report renews a topic.

  [[nodiscard]] bool isSelf() const { return first == second; }
};

/// The rows of the scene's first frame. Where shapes were asked: pairs that are not apart, the worst first. Else the
/// largest overlap first, then the smallest gap, those that are alike as they were found; self pairs last. Pairs of the
/// same two bodies are one row.
[[nodiscard]] std::vector<Clash> clashesOf(const ViewScene& scene);

/// The pair at one place of the first frame's, without number and GUID.
[[nodiscard]] Clash clashOf(const ViewScene& scene, std::size_t pair);

/// Where to look: the contact, or the nearest points; of boxes what both share, or where they are apart the gap
/// between.
[[nodiscard]] Box placeOf(const ViewScene& scene, const Clash& clash);

/// What was found, as a sentence or two.
[[nodiscard]] std::string findingOf(const ViewScene& scene, const Clash& clash);

/// " Before: touching." where an earlier report had the row otherwise.
[[nodiscard]] std::string beforeText(const Clash& clash);

/// What was found in all, in a few words: "3 clashes (1 duplicate), 6 apart", or "12 pairs of boxes".
[[nodiscard]] std::string headlineOf(const ViewScene& scene);

/// A number with few digits, and all before the point: 0.125, 102361. From 1e-6 to 1e15 measure() in web/src/format.js
/// writes the same, but for the sign of what is below 0.
[[nodiscard]] std::string shortNumber(double value);

/// The coordinates of a point as short numbers, or with as many digits as it takes to tell hundredths apart; what is
/// nothing beside the largest of them is 0. From 1e-6 to 1e15 coordinate() in web/src/format.js writes the same.
[[nodiscard]] std::array<std::string, 3> coordinatesOf(const std::array<double, 3>& point);

/// What the two of a row are called: by their bodies where it holds several pairs.
[[nodiscard]] std::string firstNameOf(const ViewScene& scene, const Clash& clash);
[[nodiscard]] std::string secondNameOf(const ViewScene& scene, const Clash& clash);

/// "A and B", or "A with itself".
[[nodiscard]] std::string titleOf(const ViewScene& scene, const Clash& clash);

/// What a model is known by in reports to come: by its body where it holds several.
[[nodiscard]] std::string identityOf(const ViewScene& scene, std::uint32_t model);

/// A number that identifies texts, in the form of a UUID: 8-4-4-4-12 hexadecimal digits.
[[nodiscard]] std::string guidOf(const std::vector<std::string>& texts);

}  // namespace allpairs::view
