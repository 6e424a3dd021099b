// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

using enum ComponentKind;

constexpr double kSubsetRadius = 1e-5;  // SOFA's default for how near a subset's points are to their originals.

/// For each point of the child the rigid frame that carries it.
class Carriers {
 public:
  Carriers(Evaluation& evaluation, const Component& mapping, std::size_t points, std::size_t frames)
      : m_mapping(mapping), m_frames(frames) {
    m_perPoint = evaluation.indices(mapping, {"rigidIndexPerPoint"});
    const char* repartition = evaluation.generation() == Generation::Sofa20 ? "repartition" : "d_repartition";
    if (mapping.attributes.has(repartition))
      spread(evaluation.indices(mapping, {repartition}), points);
    else if (mapping.attributes.has("repartition"))
      evaluation.warn(mapping, "its repartition is not read, as in SOFA since 25.06, which calls it d_repartition");
    if (m_perPoint.size() != points) m_perPoint.clear();
    const auto index = evaluation.number(mapping, {"index"}, 0);
    m_index = static_cast<std::size_t>(clamped(index, 0, 4e9));
    m_isFromEnd = evaluation.flag(mapping, "indexFromEnd", false);
  }

  [[nodiscard]] std::size_t of(std::size_t point) const {
    const auto frame = m_perPoint.empty() ? m_index : m_perPoint[point];
    const bool isFromEnd = m_isFromEnd && m_perPoint.empty();
    if (frame >= m_frames)
      throw Unplaceable(m_mapping, "there is no rigid frame number " + std::to_string(frame) +
                                       (isFromEnd ? " from the end" : "") + " among the " + std::to_string(m_frames) +
                                       " of its input");
    return isFromEnd ? m_frames - 1 - frame : frame;
  }

 private:
  /// One number: the points of each frame; several: one number per frame.
  void spread(const std::vector<std::size_t>& counts, std::size_t points) {
    m_perPoint.clear();
    for (std::size_t frame = 0; !counts.empty() && m_perPoint.size() < points; ++frame) {
      if (counts.size() > 1 && frame >= counts.size()) break;
      const auto count = counts.size() == 1 ? counts[0] : counts[frame];
      if (count == 0 && counts.size() == 1) break;
      m_perPoint.insert(m_perPoint.end(), std::min(count, points - m_perPoint.size()), frame);
    }
  }

  const Component& m_mapping;
  std::size_t m_frames;
  std::size_t m_index = 0;
  bool m_isFromEnd = false;
  std::vector<std::size_t> m_perPoint;
};

/// Points in the frames that carry them, and whether they are the child's own.
struct LocalPoints {
  State points;
  bool areOfChild = true;
};

LocalPoints localPoints(Evaluation& evaluation, const Component& mapping, const State& child) {
  State local = child;
  if (evaluation.flag(mapping, "useX0", false)) {
    if (child.kind == State::Kind::Rigid && child.rest != child.positions)
      throw Unplaceable(mapping, "its frames at rest are not known to this reader");
    local.setPoints(child.rest);
    local.pointsUnknown = child.pointsUnknown;  // at rest too
    return {std::move(local), false};
  }
  if (const auto file = evaluation.file(mapping, {"filename", "fileRigidMapping"})) {
    if (file->extension() == ".xs3") throw Unplaceable(mapping, "files of the kind .xs3 cannot be read");
    local.setPoints(readMesh(*file, evaluation.scope().stop()).positions);
    return {std::move(local), false};
  } else if (evaluation.isGiven(mapping, {"initialPoints"})) {
    const auto given = evaluation.numbers(mapping, {"initialPoints"}, child.width());
    if (!given || given->size() == 0) return {std::move(local)};
    local.setPositions(*given);
    local.pointsUnknown = false;
    return {std::move(local), false};
  }
  return {std::move(local)};
}

State mapRigidly(Evaluation& evaluation, const Component& mapping, const State& parent, const State& child) {
  if (parent.kind != State::Kind::Rigid) throw Unplaceable(mapping, "the state that it reads is not rigid");
  auto [result, areOfChild] = localPoints(evaluation, mapping, child);
  result.fromTopology.reset();
  const Carriers carriers(evaluation, mapping, result.positions.size(), parent.positions.size());
  const bool isGlobal = areOfChild && evaluation.flag(mapping, "globalToLocalCoords", false);
  for (std::size_t i = 0; i < result.positions.size(); ++i) {
    const auto frame = carriers.of(i);
    if (isGlobal) continue;  // There and back again.
    const auto& q = parent.orientations[frame];
    result.positions[i] = rotate(q, result.positions[i]) + parent.positions[frame];
    if (result.kind == State::Kind::Rigid) result.orientations[i] = q * result.orientations[i];
  }
  return result;
}

State mapIdentically(const State& parent, State child) {
  child.setPoints(parent.positions);
  if (child.kind == State::Kind::Rigid && parent.kind == State::Kind::Rigid) child.orientations = parent.orientations;
  child.fromTopology.reset();
  return child;
}

/// For each wanted point the nearest of the others within a distance; the number of the others where there is none.
std::vector<std::size_t> nearestWithin(Evaluation& evaluation, const Component& mapping,
                                       const std::vector<Vec3>& wanted, const std::vector<Vec3>& others) {
  const double radius = evaluation.number(mapping, {"radius"}, kSubsetRadius);
  std::vector<std::size_t> order(others.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](auto a, auto b) { return std::pair{others[a][0], a} < std::pair{others[b][0], b}; });
  const auto near = [&](const Vec3& p) {
    const auto xOf = [&](auto i) { return others[i][0]; };
    const auto begin = std::ranges::lower_bound(order, p[0] - radius, {}, xOf);
    return std::pair{begin, std::ranges::upper_bound(begin, order.end(), p[0] + radius, {}, xOf)};
  };
  std::uint64_t pairs = 0;  // within a large radius all others are near
  for (const auto& p : wanted) {
    const auto [begin, end] = near(p);
    pairs += static_cast<std::uint64_t>(end - begin);
  }
  takeWork(evaluation, mapping, pairs);
  std::vector<std::size_t> result;
  for (const auto& p : wanted) {
    evaluation.scope().checkStop();
    const auto [begin, end] = near(p);
    auto best = std::pair{radius, others.size()};
    for (auto at = begin; at < end; ++at) {
      const auto candidate = std::pair{lengthOf(p - others[*at]), *at};
      if (candidate.first < radius && candidate < best) best = candidate;
    }
    result.push_back(best.second);
  }
  return result;
}

std::vector<std::size_t> subsetIndices(Evaluation& evaluation, const Component& mapping, const State& parent,
                                       const State& child) {
  const auto count = parent.positions.size();
  auto indices = evaluation.indices(mapping, {"indices"});
  if (!indices.empty()) {
    if (!evaluation.flag(mapping, "ignoreNotFound", false))
      std::erase_if(indices, [count](std::size_t i) { return i >= count; });
    return indices;
  }
  const auto first = evaluation.number(mapping, {"first"}, -1), last = evaluation.number(mapping, {"last"}, -1);
  if (first == -1) return nearestWithin(evaluation, mapping, child.positions, parent.positions);
  const auto end = static_cast<double>(count);
  const auto from = static_cast<std::size_t>(first >= 0 && first < end ? first : 0);
  const auto to = static_cast<std::size_t>(last >= 0 && last < end ? last + 1 : end);
  indices.resize(to > from ? to - from : 0);
  std::iota(indices.begin(), indices.end(), from);
  return indices;
}

State mapSubset(Evaluation& evaluation, const Component& mapping, const State& parent, const State& child) {
  const auto indices = subsetIndices(evaluation, mapping, parent, child);
  State result = child;
  result.fromTopology.reset();
  result.resize(indices.size());
  const bool rigid = result.kind == State::Kind::Rigid && parent.kind == State::Kind::Rigid;
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] < parent.positions.size()) {
      result.positions[i] = parent.positions[indices[i]];
      if (rigid) result.orientations[i] = parent.orientations[indices[i]];
    } else if (i < child.rest.size()) {
      result.positions[i] = child.rest[i];
    }
  }
  const auto isOfParent = [&](std::size_t index) { return index < parent.positions.size(); };
  if (!indices.empty() && std::ranges::all_of(indices, isOfParent)) result.pointsUnknown = false;
  return result;
}

}  // namespace

bool canMap(Evaluation& evaluation, const Component& mapping, const State& from, const State& to) {
  const bool fromFrames = from.kind == State::Kind::Rigid, toFrames = to.kind == State::Kind::Rigid;
  const bool dropsTurns = mapping.kind() == IdentityMapping || mapping.kind() == SubsetMultiMapping;
  if (fromFrames == toFrames || (fromFrames && dropsTurns)) return true;
  evaluation.warn(mapping, std::string{"SOFA has no such mapping from "} +
                               (fromFrames ? "frames to points" : "points to frames") + ", and moves nothing by it");
  return false;
}

State mapState(Evaluation& evaluation, const Component& mapping, State child) {
  const auto* input = mappingInput(mapping, isState);
  if (mapping.kind() == UnknownMapping) throw Unplaceable(mapping, "this kind of mapping is not known to this reader");
  switch (mapping.kind()) {
    case IdentityMultiMapping:
      return mapAllOf(evaluation, mapping, std::move(child));
    case SubsetMultiMapping:
      return mapSomeOf(evaluation, mapping, std::move(child));
    case DeformableOnRigidFrameMapping:
      return mapOnFrame(evaluation, mapping, std::move(child));
    case ArticulatedMapping:
      return mapArticulated(evaluation, mapping, std::move(child));
    default:
      break;
  }
  if (input == nullptr) throw Unplaceable(mapping, "the state that it reads is nowhere to be found");
  switch (mapping.kind()) {
    case SkinningMapping:
      return mapSkin(evaluation, mapping, *input, std::move(child));
    case CenterOfMassMapping:
      return mapCentre(evaluation, mapping, *input, std::move(child));
    case BeamLinearMapping:
      return mapOnBeams(evaluation, mapping, *input, std::move(child));
    case RigidMapping:
      return mapRigidly(evaluation, mapping, evaluation.knownState(*input), child);
    case IdentityMapping:
      if (!canMap(evaluation, mapping, evaluation.knownState(*input), child)) return child;
      return mapIdentically(evaluation.knownState(*input), std::move(child));
    case SubsetMapping:
      if (!canMap(evaluation, mapping, evaluation.knownState(*input), child)) return child;
      return mapSubset(evaluation, mapping, evaluation.knownState(*input), child);
    default:
      break;
  }
  child.positions = mapBarycentrically(evaluation, mapping, *input, child);
  if (child.kind == State::Kind::Rigid) child.orientations.resize(child.positions.size());
  child.fromTopology.reset();
  return child;
}

}  // namespace allpairs::scene::sofa
