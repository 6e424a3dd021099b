// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "ViewScene.h"

namespace allpairs::view {

/// Why two models are a pair, or are not.
enum class Verdict : std::uint8_t {
  Pair,
  Inactive,      ///< One of the two is not active.
  NoElements,    ///< One of the two has none.
  Outside,       ///< One of the two does not touch the region.
  NotSimulated,  ///< Neither of the two is simulated.
  SameOwner,     ///< Parts of one body, of which not both may collide with it.
  SameGroup,
  SharesVertex,  ///< Triangles of a mesh that have one in common.
  Apart,         ///< The boxes are further apart than counts, or one of them is empty.
  NoSelf,        ///< A model with itself: it may not collide with itself.
  Flat,          ///< A model with itself: too flat to touch itself.
};

struct Explanation {
  Verdict verdict = Verdict::Pair;
  int axis = -1;     ///< For Apart: the axis with the widest gap; -1 where a box is empty.
  double gap = 0.0;  ///< For Apart: how wide it is.
  int group = 0;     ///< For SameGroup: the smallest that both are in.
};

/// What the rules say of a model and one that was added before it, or of a model with itself, in the rules' order.
///
/// The page has the same function, in web/src/rules.js; a test compares the two, and this one with the broad phase.
[[nodiscard]] Explanation explain(const ViewScene& scene, const ViewFrame& frame, std::uint32_t newer,
                                  std::uint32_t older);

/// The distance at which two models' boxes are near, the newer first.
[[nodiscard]] double distanceOf(const ViewScene& scene, std::uint32_t newer, std::uint32_t older);

/// Whether two models, triangles of meshes, have a vertex in common.
[[nodiscard]] bool shareVertex(const ViewScene& scene, std::uint32_t a, std::uint32_t b);

/// "pair", "inactive", "no-elements": the verdict's name in tests and tables.
[[nodiscard]] std::string_view verdictName(Verdict verdict);

/// The pairs of models whose boxes are near enough and which a rule keeps apart, (newer, older), as the double loop
/// meets them; nothing where there are more than `most`.
[[nodiscard]] std::optional<std::vector<Pair>> excludedPairs(const ViewScene& scene, const ViewFrame& frame,
                                                             std::size_t most);

}  // namespace allpairs::view
