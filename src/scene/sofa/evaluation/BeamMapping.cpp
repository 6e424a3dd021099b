// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"

namespace allpairs::scene::sofa {
namespace {

/// How long each beam is, from one frame to the next; what is behind the last counts as long as the last.
std::vector<double> beamLengths(const State& frames) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i + 1 < frames.positions.size(); ++i)
    lengths.push_back(lengthOf(frames.positions[i + 1] - frames.positions[i]));
  lengths.push_back(lengths.back());
  return lengths;
}

/// A point in the axes of the first frame, its first coordinate by the number of beams passed, all in beam lengths.
Vec3 alongBeams(const Component& mapping, const State& frames, const std::vector<double>& lengths, const Vec3& point) {
  Vec3 p = rotate(conjugate(frames.orientations[0]), point - frames.positions[0]);
  std::size_t beam = 0;
  for (; beam < lengths.size() && p[0] >= lengths[beam]; ++beam) p[0] -= lengths[beam];
  if (beam == lengths.size()) throw Unplaceable(mapping, "one of its points is far behind the last beam");
  p = p * (1 / lengths[beam]);
  p[0] += static_cast<double>(beam);
  return p;
}

Vec3 inFrame(const State& frames, std::size_t frame, const Vec3& p, double length) {
  return frames.positions[frame] + rotate(frames.orientations[frame], p) * length;
}

/// Between the two frames of a beam, by a cubic that leaves each along its own axis.
Vec3 onBeam(const State& frames, const std::vector<double>& lengths, Vec3 p) {
  const auto last = static_cast<double>(frames.positions.size() - 2);
  const double beam = clamped(std::floor(p[0]), 0, last);
  const auto index = static_cast<std::size_t>(beam);
  p[0] -= beam;
  const double weight = 3 * p[0] * p[0] - 2 * p[0] * p[0] * p[0];
  const auto first = inFrame(frames, index, p, lengths[index]);
  const auto second = inFrame(frames, index + 1, p - Vec3{1, 0, 0}, lengths[index]);
  return first * (1 - weight) + second * weight;
}

}  // namespace

State mapOnBeams(Evaluation& evaluation, const Component& mapping, const Component& beams, State child) {
  const auto& frames = evaluation.knownState(beams);
  if (frames.kind != State::Kind::Rigid || frames.positions.size() < 2)
    throw Unplaceable(mapping, "it needs beams: a rigid state of two frames or more");
  if (child.kind != State::Kind::Points) throw Unplaceable(mapping, "its output is no state of points");
  const auto* joints = evaluation.mappingOf(beams);
  const bool isJointed = joints != nullptr && joints->kind() == ComponentKind::ArticulatedMapping;
  const auto bound = isJointed ? articulatedAtStart(evaluation, *joints, initialState(evaluation, beams)) : frames;
  const auto lengths = beamLengths(bound);
  const bool isLocal = evaluation.flag(mapping, "localCoord", true);
  if (!isLocal) takeWork(evaluation, mapping, std::uint64_t{child.positions.size()} * lengths.size());
  for (auto& p : child.positions) {
    evaluation.scope().checkStop();
    p = onBeam(frames, lengths, isLocal ? p : alongBeams(mapping, bound, lengths, p));
  }
  child.fromTopology.reset();
  return child;
}

}  // namespace allpairs::scene::sofa
