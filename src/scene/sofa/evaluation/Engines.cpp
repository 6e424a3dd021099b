// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

struct Steps {
  Vec3 scale{1, 1, 1};
  Quat rotation;
  Quat quaternion;
  Vec3 translation{};
};

Vec3 forwards(const Steps& steps, const Vec3& p) {
  return rotate(steps.quaternion, rotate(steps.rotation, scaled(p, steps.scale))) + steps.translation;
}

Vec3 backwards(const Steps& steps, const Vec3& p) {
  const Vec3 inverse{1 / steps.scale[0], 1 / steps.scale[1], 1 / steps.scale[2]};
  return scaled(rotate(conjugate(steps.rotation), rotate(conjugate(steps.quaternion), p - steps.translation)), inverse);
}

Steps stepsOf(Evaluation& evaluation, const Component& engine) {
  const auto given = evaluation.numbers(engine, {"quaternion"}, Evaluation::kFlat);
  const bool whole = given && given->values.size() == 4;
  return {.scale = evaluation.vector(engine, {"scale"}, {1, 1, 1}),
          .rotation = fromEulerDegrees(evaluation.vector(engine, {"rotation"}, {})),
          .quaternion = whole ? Quat{given->values[0], given->values[1], given->values[2], given->values[3]} : Quat{},
          .translation = evaluation.vector(engine, {"translation"}, {})};
}

bool hasFrames(const Component& engine) { return isRigidTemplate(engine.attributes.value("template")); }

std::optional<Numbers> transformed(Evaluation& evaluation, const Component& engine, std::string_view name) {
  if (name != "output_position") return std::nullopt;
  const auto steps = stepsOf(evaluation, engine);
  const bool inverse = evaluation.flag(engine, "inverse", false);
  const bool isRigid = hasFrames(engine);
  auto given = evaluation.numbers(engine, {"input_position"}, isRigid ? 7 : 3, {0, 0, 0, 0, 0, 0, 1});
  if (!given) return Numbers{.values = {}, .width = isRigid ? 7U : 3U};
  const Quat turn =
      inverse ? conjugate(steps.rotation) * conjugate(steps.quaternion) : steps.quaternion * steps.rotation;
  for (std::size_t i = 0; i < given->size(); ++i) {
    auto* v = given->values.data() + i * given->width;
    const Vec3 point{v[0], v[1], v[2]};
    std::ranges::copy(inverse ? backwards(steps, point) : forwards(steps, point), v);
    if (!isRigid) continue;
    const Quat q = turn * Quat{v[3], v[4], v[5], v[6]};
    std::ranges::copy(std::array{q.x, q.y, q.z, q.w}, v + 3);
  }
  return given;
}

/// A map by where it takes the origin and the three axes.
template <class Move>
AffineMap affineOf(const Move& move) {
  const Vec3 origin = move({});
  return {{move({1, 0, 0}) - origin, move({0, 1, 0}) - origin, move({0, 0, 1}) - origin}, origin};
}

AffineMap motionOf(Evaluation& evaluation, const Component& engine) {
  const auto steps = stepsOf(evaluation, engine);
  const bool inverse = evaluation.flag(engine, "inverse", false);
  return affineOf([&](const Vec3& p) { return inverse ? backwards(steps, p) : forwards(steps, p); });
}

std::optional<Numbers> merged(Evaluation& evaluation, const Component& engine, std::string_view name) {
  if (name != "points") return std::nullopt;
  const std::size_t width = hasFrames(engine) ? 7 : 3;
  auto points = evaluation.numbers(engine, {"position1"}, width);
  const auto others = evaluation.numbers(engine, {"position2"}, width);
  if (!points) points = Numbers{.values = {}, .width = width};
  if (!others) return points;
  if (const auto places = evaluation.indices(engine, {"mappingX2"}); !places.empty()) {
    if (places.size() > others->size()) throw Unplaceable(engine, "its mappingX2 is longer than its position2");
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i] < points->size())
        std::copy_n(others->values.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                    points->values.begin() + static_cast<std::ptrdiff_t>(places[i] * width));
    return points;
  }
  evaluation.takePoints(engine, points->size() + others->size());  // a chain of these doubles with each
  points->values.insert(points->values.end(), others->values.begin(), others->values.end());
  return points;
}

}  // namespace

std::optional<GridMotion> gridMotion(Evaluation& evaluation, const Component& component, std::string_view name) {
  const auto link = followLinkOf(component, name);
  const auto* from = link.component;
  if (from == nullptr || from->order > component.order) return std::nullopt;
  const bool isNamed = component.attributes.has(name) && !link.data.empty();
  const std::string_view data = isNamed ? std::string_view{link.data} : name;
  if (from->kind() == ComponentKind::SparseGrid && data == "position")
    return GridMotion{.map = {}, .areUnknown = evaluation.topology(*from).unknown};
  if (from->kind() == ComponentKind::MechanicalState && data == "position") {
    const auto& state = evaluation.state(*from);
    if (!state.pointsUnknown || !state.fromTopology) return std::nullopt;
    return GridMotion{.map = *state.fromTopology, .areUnknown = true};
  }
  if (from->kind() != ComponentKind::TransformEngine || data != "output_position") return std::nullopt;
  const auto before = evaluation.gridMotion(*from, "input_position");
  if (!before) return before;
  return GridMotion{.map = compose(motionOf(evaluation, *from), before->map), .areUnknown = before->areUnknown};
}

std::optional<Numbers> engineOutput(Evaluation& evaluation, const Component& engine, std::string_view name) {
  switch (engine.kind()) {
    case ComponentKind::TransformEngine:
      return transformed(evaluation, engine, name);
    case ComponentKind::MergePoints:
      return merged(evaluation, engine, name);
    case ComponentKind::SubsetTopology:
      return subsetOutput(evaluation, engine, name);
    case ComponentKind::BoxRoi:
      return roiOutput(evaluation, engine, name);
    case ComponentKind::QuatToRigid:
      return frameOutput(evaluation, engine, name);
    case ComponentKind::MeanComputation:
      return meanOutput(evaluation, engine, name);
    case ComponentKind::Spiral:
      return spiralOutput(evaluation, engine, name);
    case ComponentKind::MeshTetraStuffing:
      if (name == "outputPoints") return toNumbers(evaluation.mesh(engine).positions);
      if (name == "outputTetrahedra" || name == "outputTetras") return toNumbers(evaluation.mesh(engine).tetrahedra);
      return std::nullopt;
    case ComponentKind::Device:
      return deviceOutput(evaluation, engine, name);
    default:
      return std::nullopt;
  }
}

}  // namespace allpairs::scene::sofa
