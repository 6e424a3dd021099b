// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "input/Words.h"
#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"

namespace allpairs::scene::sofa {
namespace {

Vec3 unit(const Vec3& v) {
  const double length = lengthOf(v);
  return length > std::numeric_limits<double>::epsilon() ? Vec3{v[0] / length, v[1] / length, v[2] / length} : v;
}

/// The angle up to which a spiral r = curvature * angle is so long, by ten steps of Newton's method, as in SOFA.
double spiralAngle(double length, double curvature) {
  constexpr int kNewtonSteps = 10;
  double angle = std::sqrt(length);
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double reached = curvature / 2 * (angle * std::sqrt(1 + angle * angle) + std::asinh(angle));
    const double slope = curvature * std::sqrt(1 + angle * angle);
    angle = angle - (reached - length) / slope;
  }
  return angle;
}

Vec3 rolledUp(const Vec3& p, double curvature) {
  constexpr double kSteepest =
      static_cast<double>(0.8F);  // y of a normal near the middle, where the spiral's sheets would meet
  const double angle = spiralAngle(p[0] > 0 ? p[0] : -p[0], curvature);
  const double radius = p[0] > 0 ? curvature * angle : -curvature * angle;
  const double sine = std::sin(angle), cosine = std::cos(angle);
  Vec3 normal =
      unit({-curvature * sine - curvature * angle * cosine, curvature * cosine - curvature * angle * sine, 0});
  if (angle > -std::numbers::pi / 2 && angle < std::numbers::pi / 2 && normal[1] > kSteepest) {
    normal[1] = kSteepest;
    normal[0] = -std::sqrt(1 - normal[1] * normal[1]);
  }
  return Vec3{radius * cosine, radius * sine, p[2]} + normal * p[1];
}

bool hasTag(const Component& component, std::string_view wanted) {
  const std::vector<std::string> tags = allWords(component.attributes.value("tags"));
  return std::find(tags.begin(), tags.end(), wanted) != tags.end();
}

void add(const std::vector<Vec3>& points, std::vector<Vec3>& sums) {
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = sums[i] + points[i];
}

}  // namespace

std::optional<Numbers> spiralOutput(Evaluation& evaluation, const Component& engine, std::string_view name) {
  if (name != "position") return std::nullopt;
  const double curvature = evaluation.number(engine, {"curvature"}, 0.2);
  auto points = evaluation.points(engine, {"rest_position"});
  for (auto& point : points) point = rolledUp(point, curvature);
  return toNumbers(points);
}

std::optional<Numbers> meanOutput(Evaluation& evaluation, const Component& engine, std::string_view name) {
  if (name != "result") return std::nullopt;
  std::vector<const State*> states;
  std::size_t count = std::numeric_limits<std::size_t>::max();
  for (const auto& component : engine.node->components) {
    if (component->kind() != ComponentKind::MechanicalState || hasTag(*component, "MeanOutput")) continue;
    states.push_back(&evaluation.knownState(*component));
    if (states.back()->kind != State::Kind::Points) throw Unplaceable(engine, "it knows the mean of points only");
    count = std::min(count, states.back()->positions.size());
  }
  if (states.empty()) throw Unplaceable(engine, "there is no state beside it");
  std::vector<Vec3> result(count);
  for (const auto* state : states) add(state->positions, result);
  const double share = 1.0 / static_cast<double>(states.size());
  for (auto& point : result) point = point * share;
  return toNumbers(result);
}

std::optional<Numbers> frameOutput(Evaluation& evaluation, const Component& engine, std::string_view name) {
  if (name != "rigids" && name != "rigid") return std::nullopt;
  const auto points = evaluation.points(engine, {"positions", "position"});
  const auto turns = evaluation.numbers(engine, {"orientations", "orientation"}, 4);
  const auto lines = evaluation.points(engine, {"colinearPositions", "colinearPosition"});
  const std::size_t turnCount = turns ? turns->size() : 0;
  const std::size_t count = turnCount == 1 ? points.size() : std::min(points.size(), turnCount);
  Numbers result{.values = {}, .width = 7};
  for (std::size_t i = 0; i < count; ++i) {
    const auto* q = turns->values.data() + 4 * (i % turnCount);
    Vec3 place = points[i];
    if (i < lines.size()) {
      const Vec3 along = rotate({q[0], q[1], q[2], q[3]}, {0, 0, 1});
      place = lines[i] + along * (dot(along, place - lines[i]) / lengthOf(along));
    }
    result.values.insert(result.values.end(), place.begin(), place.end());
    result.values.insert(result.values.end(), q, q + 4);
  }
  return result;
}

}  // namespace allpairs::scene::sofa
