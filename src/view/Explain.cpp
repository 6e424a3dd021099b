// SPDX-License-Identifier: MIT
#include "Explain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/StopFlag.h"

namespace allpairs::view {
namespace {

/// The smallest number that two ascending lists have in common, or null.
const int* commonGroup(const std::vector<int>& a, const std::vector<int>& b) {
  for (const int& group : a) {
    if (std::binary_search(b.begin(), b.end(), group)) return &group;
  }
  return nullptr;
}

Explanation explainSelf(const ViewFrame& frame, std::uint32_t model, double distance) {
  const std::uint8_t flags = frame.flags[model];
  if ((flags & flag::kSimulated) == 0) return {.verdict = Verdict::NotSimulated};
  if ((flags & flag::kSelfCollision) == 0) return {.verdict = Verdict::NoSelf};
  const Box& box = frame.boxes[model];
  if ((flags & flag::kTouchesItself) != 0 && overlap(box, box, distance)) return {};
  return {.verdict = isEmpty(box) ? Verdict::Apart : Verdict::Flat};
}

Explanation explainBoxes(const Box& newer, const Box& older, double distance) {
  if (overlap(newer, older, distance)) return {};
  Explanation result{.verdict = Verdict::Apart};
  if (isEmpty(newer) || isEmpty(older)) return result;
  result.gap = -std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const double gap = std::max(newer.min[a] - older.max[a], older.min[a] - newer.max[a]);
    if (!(gap > result.gap)) continue;
    result.gap = gap;
    result.axis = axis;
  }
  return result;
}

/// What is wrong with one of the two alone, whichever.
Verdict alone(std::uint8_t flags, std::uint8_t otherFlags) {
  if ((flags & otherFlags & flag::kActive) == 0) return Verdict::Inactive;
  if (((flags | otherFlags) & flag::kNoElements) != 0) return Verdict::NoElements;
  return ((flags | otherFlags) & flag::kOutside) != 0 ? Verdict::Outside : Verdict::Pair;
}

Explanation explainFlags(const ViewScene& scene, const ViewFrame& frame, std::uint32_t newer, std::uint32_t older) {
  const std::uint8_t a = frame.flags[newer];
  const std::uint8_t b = frame.flags[older];
  if (((a | b) & flag::kSimulated) == 0) return {.verdict = Verdict::NotSimulated};
  if (scene.owners[newer] == scene.owners[older]) {
    const bool bothMay = (a & b & flag::kSelfCollision) != 0;
    return {.verdict = bothMay ? Verdict::Pair : Verdict::SameOwner};
  }
  const int* group = commonGroup(scene.groupSets[scene.groups[newer]], scene.groupSets[scene.groups[older]]);
  if (group != nullptr) return {.verdict = Verdict::SameGroup, .group = *group};
  return {};
}

/// Visits boxes near by a little more than the rules ask, until `stop` is set; explain() then decides.
void streamNearBoxes(const ViewScene& scene, const ViewFrame& frame, PairVisitor visitor, const StopFlag& stop) {
  constexpr double kSlack = 1e-9;  // sums of three distances in another order differ by less
  BoxView boxes(frame.boxes);
  double largest = std::abs(scene.distance);
  if (scene.addsContactDistances) {
    boxes.setMargins(scene.contactDistances);
    for (const double distance : scene.contactDistances) largest = std::max(largest, std::abs(distance));
  }
  OverlapOptions options;
  options.order = Order::BySecond;
  options.distance = scene.distance + (std::isfinite(largest) ? largest * kSlack : 0.0);
  options.stop = &stop;
  try {
    streamOverlaps(boxes, visitor, options);
  } catch (const Stopped&) {  // by the visitor, who has what it wants
  }
}

}  // namespace

double distanceOf(const ViewScene& scene, std::uint32_t newer, std::uint32_t older) {
  if (!scene.addsContactDistances) return scene.distance;
  return scene.distance + scene.contactDistances[newer] + scene.contactDistances[older];
}

Explanation explain(const ViewScene& scene, const ViewFrame& frame, std::uint32_t newer, std::uint32_t older) {
  const Verdict verdict = alone(frame.flags[newer], frame.flags[older]);
  if (verdict != Verdict::Pair) return {.verdict = verdict};
  if (newer == older) return explainSelf(frame, newer, distanceOf(scene, newer, newer));
  const Explanation byFlags = explainFlags(scene, frame, newer, older);
  if (byFlags.verdict != Verdict::Pair) return byFlags;
  if (!scene.corners.empty() && shareVertex(scene, newer, older)) return {.verdict = Verdict::SharesVertex};
  return explainBoxes(frame.boxes[newer], frame.boxes[older], distanceOf(scene, newer, older));
}

bool shareVertex(const ViewScene& scene, std::uint32_t a, std::uint32_t b) {
  const auto ofA = std::span(scene.corners).subspan(3 * std::size_t{a}, 3);
  const auto ofB = std::span(scene.corners).subspan(3 * std::size_t{b}, 3);
  return std::find_first_of(ofA.begin(), ofA.end(), ofB.begin(), ofB.end()) != ofA.end();
}

std::string_view verdictName(Verdict verdict) {
  static constexpr std::array<std::string_view, 11> kNames{
      "pair",       "inactive",      "no-elements", "outside", "not-simulated", "same-owner",
      "same-group", "shares-vertex", "apart",       "no-self", "flat"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::optional<std::vector<Pair>> excludedPairs(const ViewScene& scene, const ViewFrame& frame, std::size_t most) {
  std::vector<Pair> result;
  StopFlag tooMany;
  const auto isExcluded = [&](std::uint32_t newer, std::uint32_t older) {
    const Verdict verdict = explain(scene, frame, newer, older).verdict;
    const bool isByRule =
        verdict == Verdict::NotSimulated || verdict == Verdict::SameOwner || verdict == Verdict::SameGroup;
    return isByRule && overlap(frame.boxes[newer], frame.boxes[older], distanceOf(scene, newer, older));
  };
  const auto visit = [&](Span<const Pair> pairs) {
    for (const auto& [older, newer] : pairs) {
      if (tooMany.isSet()) return;
      if (!isExcluded(newer, older)) continue;
      if (result.size() == most)
        tooMany.set();
      else
        result.push_back({newer, older});
    }
  };
  streamNearBoxes(scene, frame, visit, tooMany);
  if (tooMany.isSet()) return std::nullopt;
  return result;
}

}  // namespace allpairs::view
