// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Span.h"
#include "allpairs/collision/CollisionModel.h"
#include "allpairs/collision/Vec3.h"

namespace allpairs {

/// The relation of two models, by their shapes instead of their boxes; the most serious first.
enum class ExactState : std::uint8_t {
  Duplicate,        ///< The same shape in the same place.
  Contained,        ///< One lies wholly within the other's volume; their surfaces may touch.
  Clash,            ///< They share volume, or their surfaces cross, and neither holds all of the other.
  Touching,         ///< Their surfaces meet, and neither reaches into the other.
  Undecided,        ///< Their surfaces are apart; one lies within the box of the other, whose surface is not closed.
  WithinClearance,  ///< They are apart, by no more than the clearance.
  NotExamined,      ///< A model with itself, or of an unsupported type.
  Apart,            ///< They are disjoint.
};

inline constexpr std::size_t kExactStates = 8;

/// Whether both models take the same space: what has to be repaired.
[[nodiscard]] constexpr bool isClash(ExactState state) noexcept { return state <= ExactState::Clash; }

/// Whether the models touch in any way: a clash or a contact.
[[nodiscard]] constexpr bool isContact(ExactState state) noexcept { return state <= ExactState::Touching; }

/// The word that results use for a state: duplicate, contained, clash, touching, undecided, clearance, not-examined,
/// apart.
[[nodiscard]] std::string_view stateName(ExactState state) noexcept;

/// Two models, looked at closely. Lengths are in the units of the models.
struct ExactPair {
  collision::CollisionModel* first = nullptr;
  collision::CollisionModel* second = nullptr;
  ExactState state = ExactState::NotExamined;

  /// Their Euclidean distance; 0 if they touch.
  double distance = 0.0;

  /// How far the deepest point found of one lies below the other's surface; 0 if they only touch. Of balls and capsules
  /// the depth of their cores plus the radii, which may be more: of two of them, the radii less the distance of the
  /// cores. Empty if depth is undefined: for surfaces that enclose no volume, and for duplicates.
  std::optional<double> depth{};

  /// Apart: the nearest point of each. Else: the deepest point, and the point of the other's surface nearest to it, as
  /// far apart as the depth. Of a ball or a capsule it lies on its surface, but where the deepest point found of a
  /// capsule's core, up to 1% less deep than the deepest, is between faces that the core passes aslant: then in the
  /// capsule.
  collision::Vec3 pointOnFirst{};
  collision::Vec3 pointOnSecond{};

  /// A unit vector, away from the second: the direction in which the distance or the depth is measured. Moving the first
  /// along it by the depth brings the deepest point to the surface; others may then still lie within. Where many are as
  /// good, since the cores of balls or capsules meet, it is one of them, of two balls along z. Zero of duplicates and of
  /// what was not examined.
  collision::Vec3 normal{};

  /// The number of pairs of elements (triangles, segments, points, balls) that intersect; 0 where surfaces don't meet.
  /// A mesh that a ball or a capsule meets is one element.
  std::uint64_t contactCount = 0;

  /// Contact points: one for each intersecting pair of elements, evenly sampled if there are more than the limit. Of a
  /// ball or a capsule: the point of the other's surface nearest to its core; of two of them the middle of the circle in
  /// which they meet.
  std::vector<collision::Vec3> contactPoints{};

  /// Where surfaces cross: a segment for each pair of triangles, evenly sampled if there are more than the limit.
  std::vector<std::array<collision::Vec3, 2>> contactLines{};

  /// The box around all contact points, sampled or not; empty without any.
  Box contactBox = kEmptyBox;

  /// Whether the triangles of a model don't close: it has no inside, so that nothing can be said to lie in it.
  bool isFirstOpen = false;
  bool isSecondOpen = false;

  /// Of a pair of which one is contained: whether that is the first.
  bool isFirstInner = false;
};

/// Where to look: between the deepest or the nearest points; in the middle of where surfaces meet that only touch; of
/// what is contained its deepest point.
[[nodiscard]] collision::Vec3 placeOf(const ExactPair& pair) noexcept;

/// Whether a comes before b in a list of what to repair first: by state, then the deepest, then the nearest.
[[nodiscard]] bool isWorse(const ExactPair& a, const ExactPair& b) noexcept;

/// The indices of pairs, the worst first, equal ones in their order.
[[nodiscard]] std::vector<std::size_t> worstFirst(Span<const ExactPair> pairs);

/// How many pairs came out how.
struct ExactCounts {
  std::array<std::uint64_t, kExactStates> ofState{};

  [[nodiscard]] std::uint64_t of(ExactState state) const { return ofState[static_cast<std::size_t>(state)]; }
  [[nodiscard]] std::uint64_t clashes() const;
  [[nodiscard]] std::uint64_t candidates() const;

  /// The part of the examined pairs that only their boxes had in common; 0 where none was examined.
  [[nodiscard]] double falseShare() const;
};

[[nodiscard]] ExactCounts countStates(Span<const ExactPair> pairs);

/// Counts in words, the most serious first: "3 clashes (1 duplicate, 1 contained), 2 touching, 6 apart".
[[nodiscard]] std::string countText(const ExactCounts& counts);

}  // namespace allpairs
