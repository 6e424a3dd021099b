// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <string_view>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

using enum ComponentKind;
using namespace std::string_view_literals;

struct Placement {
  Vec3 scale{1, 1, 1};
  Vec3 rotation{};
  Vec3 translation{};
  Vec3 rotation2{};
  Vec3 translation2{};
};

/// Three attributes such as rx, ry and rz, any of which overrides the vector.
struct Singles {
  std::array<std::string_view, 3> names;
  double standard = 0;
};

Vec3 overridden(Evaluation& evaluation, const Component& component, const Singles& by, const Vec3& vector) {
  const auto& names = by.names;
  if (std::ranges::none_of(names, [&](auto name) { return component.attributes.has(name); })) return vector;
  return {evaluation.single(component, names[0], by.standard), evaluation.single(component, names[1], by.standard),
          evaluation.single(component, names[2], by.standard)};
}

Vec3 scaleOf(Evaluation& evaluation, const Component& c) {
  Vec3 scale = evaluation.vector(c, {"scale3d"}, {1, 1, 1});
  if (c.attributes.has("scale")) scale = Vec3{1, 1, 1} * evaluation.single(c, "scale", 1);
  return overridden(evaluation, c, {{"sx", "sy", "sz"}, 1}, scale);
}

/// One of the four data of a state that turn or move it.
struct Turn {
  std::string_view name;
  Singles singles;
};

constexpr Turn kRotation{"rotation", {{"rx", "ry", "rz"}}};
constexpr Turn kTranslation{"translation", {{"dx", "dy", "dz"}}};
constexpr Turn kRotation2{"rotation2", {{"rx2", "ry2", "rz2"}}};
constexpr Turn kTranslation2{"translation2", {{"dx2", "dy2", "dz2"}}};

Vec3 turnOf(Evaluation& evaluation, const Component& c, const Turn& turn) {
  return overridden(evaluation, c, turn.singles, evaluation.vector(c, {turn.name}, {}));
}

Placement placementOf(Evaluation& evaluation, const Component& c) {
  return {.scale = scaleOf(evaluation, c),
          .rotation = turnOf(evaluation, c, kRotation),
          .translation = turnOf(evaluation, c, kTranslation),
          .rotation2 = turnOf(evaluation, c, kRotation2),
          .translation2 = turnOf(evaluation, c, kTranslation2)};
}

void move(State& state, const Vec3& scale, const Vec3& rotation, const Vec3& translation) {
  const bool turned = rotation != Vec3{};
  const auto q = fromEulerDegrees(rotation);
  for (auto& p : state.positions) {
    p = scaled(p, scale);
    if (turned) p = rotate(q, p);
    p = p + translation;
  }
  if (turned)
    for (auto& orientation : state.orientations) orientation = q * orientation;
  if (state.fromTopology)
    state.fromTopology = compose(affine(turned ? q : Quat{}, scale, translation), *state.fromTopology);
}

State::Kind kindOf(const Component& component) {
  const auto given = component.attributes.value("template");
  if (isRigidTemplate(given)) return State::Kind::Rigid;
  for (const auto name : {"Vec1", "Vec1d", "Vec1f", "Vec2", "Vec2d", "Vec2f", "Vec6", "Vec6d", "Vec6f", "Rigid2",
                          "Rigid2d", "Rigid2f", "Affine", "Quadratic", "F331", "F332", "F311", "E331", "U331"})
    if (given == name) return State::Kind::Other;
  return State::Kind::Points;  // Vec3 in its spellings, and what SOFA doesn't know and takes for Vec3.
}

const Component* topologyFor(Evaluation& evaluation, const Component& state) {
  if (!evaluation.flag(state, "useTopology", true)) return nullptr;
  if (const auto link = state.attributes.value("topology"); !link.empty()) return followTo(state, link, isTopology);
  return firstIn(*state.node, isTopology);
}

/// The points of the topology, if there is one that has points.
void setPointsOfTopology(Evaluation& evaluation, const Component& component, State& state) {
  const auto* which = topologyFor(evaluation, component);
  if (which == nullptr) {
    if (state.positions.empty()) state.resize(0);
    return;
  }
  auto& topology = evaluation.topology(*which);
  const bool isMapped = evaluation.topologicalMappingOf(*which) != nullptr;
  const bool isGrid = which->kind() == RegularGrid || which->kind() == SparseGrid;  // Their points are made when asked.
  const bool tooLate = (isMapped || !isGrid) && isTooLate(evaluation, component, *which);
  if (tooLate && (which->attributes.has("filename") || isMapped)) return;
  if (!topology.hasPositions) return;
  state.resize(0);
  evaluation.takePoints(component, tooLate ? 0 : topology.pointCount);
  state.resize(tooLate ? 0 : topology.pointCount);
  for (std::size_t i = 0; i < state.positions.size(); ++i) state.positions[i] = topology.position(i);
  if (const auto given = topology.given.positions.size(); given < state.positions.size())
    evaluation.warn(*which, "it has positions of " + std::to_string(given) +
                                " points, and elements or a count that need " + std::to_string(state.positions.size()) +
                                ": the others are at the origin, as in SOFA");
  state.fromTopology = AffineMap{};
  state.pointsUnknown = topology.unknown;
}

/// How many entries the other vectors of a state have that were written out.
std::size_t countOf(Evaluation& evaluation, const Component& component, std::string_view name, std::size_t width) {
  const auto numbers = evaluation.numbers(component, {name}, width);
  return numbers ? numbers->size() : 0;
}

std::size_t declaredSize(Evaluation& evaluation, const Component& component, std::size_t standard) {
  const double size = evaluation.single(component, "size", -1);
  if (size < 0) return standard;
  if (size > kMaxPoints)
    throw Unplaceable(component,
                      "size=\"" + std::string{component.attributes.value("size")} + "\" is out of all reason");
  return static_cast<std::size_t>(size);
}

/// Whether a state takes its positions from a topology by a link: others write theirs once more before they are used.
bool isOfTopology(const Component& state) {
  const auto* from = followLinkOf(state, "position").component;
  return from != nullptr && isTopology(*from);
}

std::vector<Vec3> restPositions(Evaluation& evaluation, const Component& component, const State& state) {
  std::vector<Vec3> rest;
  const auto given = evaluation.numbers(component, {"rest_position"}, state.width());
  for (std::size_t i = 0; given && i < given->size(); ++i) {
    const auto* v = given->values.data() + i * given->width;
    rest.push_back({v[0], v[1], v[2]});
  }
  return rest;
}

/// Moves a state as its own data say, and takes its rest positions on the way.
void place(Evaluation& evaluation, const Component& component, State& state) {
  const auto placement = placementOf(evaluation, component);
  move(state, placement.scale, placement.rotation, placement.translation);
  state.rest = restPositions(evaluation, component, state);
  if (state.rest.size() != state.positions.size()) {
    state.rest = state.positions;
    if (const double scale = evaluation.number(component, {"restScale"}, 1); scale != 1)
      for (auto& p : state.rest) p = p * scale;
  }
  move(state, {1, 1, 1}, placement.rotation2, placement.translation2);
}

/// The state that a state's position links to; null if it links to none.
const Component* linkedState(const Component& state) {
  const auto [from, data] = followLinkOf(state, "position");
  if (from == nullptr || !isState(*from)) return nullptr;
  const bool isPosition = data.empty() || data == "position";
  return isPosition || !state.attributes.has("position") ? from : nullptr;
}

/// SOFA copies a linked position again when what it links to is written again.
void copyAgain(Evaluation& evaluation, const Component& component, const Numbers& given, State& state) {
  const auto placed = state;
  state.setPositions(given);
  if (state.rest.size() != state.positions.size()) state.rest = state.positions;
  state.fromTopology.reset();
  state.pointsUnknown = false;
  if (state.positions != placed.positions || state.orientations != placed.orientations)
    evaluation.warn(component,
                    "its position links to a state that a mapping moves: as in SOFA, it is that state's in the end, "
                    "without the transforms of its own");
}

/// What puts the points of its state somewhere as the simulation starts, before SOFA detects anything: constraints,
/// and a file of states. Constraints of position-based dynamics do so too, but towards a goal that lies where the points
/// are.
constexpr std::array kProjections{
    "AffineMovementConstraint"sv,
    "AffineMovementProjectiveConstraint"sv,
    "AttachConstraint"sv,
    "AttachProjectiveConstraint"sv,
    "FixedRotationConstraint"sv,
    "FixedRotationProjectiveConstraint"sv,
    "HermiteSplineConstraint"sv,
    "HermiteSplineProjectiveConstraint"sv,
    "LineProjectiveConstraint"sv,
    "LinearMovementConstraint"sv,
    "LinearMovementProjectiveConstraint"sv,
    "LinearVelocityConstraint"sv,
    "LinearVelocityProjectiveConstraint"sv,
    "OscillatorConstraint"sv,
    "OscillatorProjectiveConstraint"sv,
    "ParabolicConstraint"sv,
    "ParabolicProjectiveConstraint"sv,
    "PartialLinearMovementConstraint"sv,
    "PartialLinearMovementProjectiveConstraint"sv,
    "PatchTestMovementConstraint"sv,
    "PatchTestMovementProjectiveConstraint"sv,
    "PlaneProjectiveConstraint"sv,
    "PointProjectiveConstraint"sv,
    "ProjectToLineConstraint"sv,
    "ProjectToPlaneConstraint"sv,
    "ProjectToPointConstraint"sv,
    "ReadState"sv,
    "SkeletalMotionConstraint"sv,
    "SkeletalMotionProjectiveConstraint"sv,
};

void warnOfProjections(Evaluation& evaluation, const Component& state) {
  const Node& node = *state.node;
  if (!evaluation.isFirstStateIn(node)) return;
  takeWork(evaluation, state, node.components.size());
  for (const auto& component : node.components)
    if (std::ranges::binary_search(kProjections, std::string_view{component->type}))
      evaluation.warn(*component,
                      "SOFA may move points by it before it detects anything; here they are where they are without it");
}

}  // namespace

std::optional<Vec3> placementData(Evaluation& evaluation, const Component& component, std::string_view name) {
  // Only what is asked for: each may hang on a chain of others.
  if (name == "scale3d" && component.kind() == MeshLoader)  // Loaders multiply where states replace.
    return evaluation.vector(component, {"scale3d"}, {1, 1, 1}) * evaluation.single(component, "scale", 1);
  if (name == "scale3d") return scaleOf(evaluation, component);
  for (const auto& turn : {kRotation, kTranslation, kRotation2, kTranslation2})
    if (name == turn.name) return turnOf(evaluation, component, turn);
  return std::nullopt;
}

bool isRigidTemplate(std::string_view name) {
  if (name.starts_with("Cuda")) name.remove_prefix(4);
  return name == "Rigid" || name == "Rigid3" || name == "Rigid3d" || name == "Rigid3f";
}

State initialState(Evaluation& evaluation, const Component& component) {
  State state;
  state.kind = kindOf(component);
  if (state.kind == State::Kind::Other || component.kind() != ComponentKind::MechanicalState)
    throw Unplaceable(component, "states of this kind have no points in space that this reader knows");
  warnOfProjections(evaluation, component);
  const std::size_t width = state.width();
  state.resize(1);
  const auto motion = state.kind == State::Kind::Points ? evaluation.gridMotion(component, "position") : std::nullopt;
  if (motion && motion->areUnknown) {
    state.resize(0);
    state.fromTopology = motion->map;
    state.pointsUnknown = true;
    place(evaluation, component, state);
    return state;
  }
  const auto given = evaluation.numbers(component, {"position"}, width, {0, 0, 0, 0, 0, 0, 1});
  if (given) state.setPositions(*given);
  if (const auto size = declaredSize(evaluation, component, state.positions.size());
      !evaluation.isLinked(component, {"position"})) {
    evaluation.takePoints(component, size);
    state.resize(size);
  } else if (size != state.positions.size() && isOfTopology(component)) {
    evaluation.warn(component, "its position is a link to " + std::to_string(state.positions.size()) +
                                   " points; SOFA may make them " + std::to_string(size) + ", as its size says");
  }
  std::size_t largest = 1;
  for (const auto name : {"rest_position", "reset_position"})
    largest = std::max(largest, countOf(evaluation, component, name, width));
  largest = std::max(largest, countOf(evaluation, component, "velocity", width == 7 ? 6 : 3));
  if (largest > std::max<std::size_t>(state.positions.size(), 1)) state.resize(largest);
  if (state.positions.size() <= 1) setPointsOfTopology(evaluation, component, state);

  if (motion) state.fromTopology = motion->map;
  place(evaluation, component, state);
  const bool isMapped = evaluation.mappingOf(component) != nullptr;
  const auto* const from = given ? linkedState(component) : nullptr;  // whose positions are given
  const bool isOfMapped = from != nullptr && evaluation.state(*from).isWrittenAgain;
  if (isOfMapped && !isMapped) copyAgain(evaluation, component, *given, state);
  state.isWrittenAgain = isMapped || isOfMapped;
  return state;
}

}  // namespace allpairs::scene::sofa
