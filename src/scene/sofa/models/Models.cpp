// SPDX-License-Identifier: MIT
#include "sofa/models/Models.h"

#include <algorithm>
#include <limits>

#include "input/FileBytes.h"
#include "sofa/evaluation/Components.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

using enum ComponentKind;

const State& stateOf(Evaluation& evaluation, const Component& model) {
  const auto* which = inContext(*model.node, isState);
  if (which == nullptr) throw Unplaceable(model, "there is no MechanicalObject in its node or above");
  return evaluation.knownState(*which);
}

/// The topology that a model names, else the one that it sees.
const Component& topologyComponentOf(const Component& model) {
  const auto* which = namedTopology(model, "topology", *model.node);
  if (which == nullptr) throw Unplaceable(model, "there is no topology in its node or above");
  return *which;
}

Topology& topologyOf(Evaluation& evaluation, const Component& model) {
  const auto* which = &topologyComponentOf(model);
  auto& topology = evaluation.topology(*which);
  if (topology.sparse) throw Unplaceable(model, "the edges and faces of its sparse grid are not known to this reader");
  return topology;
}

const State& pointsOf(Evaluation& evaluation, const Component& model) {
  const auto& state = stateOf(evaluation, model);
  if (state.kind != State::Kind::Points) throw Unplaceable(model, "it needs a state of points, its state is rigid");
  return state;
}

const State& framesOf(Evaluation& evaluation, const Component& model) {
  const auto& state = stateOf(evaluation, model);
  if (state.kind != State::Kind::Rigid) throw Unplaceable(model, "it needs a rigid state, its state has only points");
  return state;
}

template <std::size_t N>
void checkCorners(const Component& model, const Elements<N>& elements, std::size_t points) {
  for (const auto& corners : elements)
    for (const auto corner : corners)
      if (corner >= points)
        throw Unplaceable(
            model, "its topology names point " + std::to_string(corner) + ", its state has " + std::to_string(points));
}

/// How many values a list must have, and what follows those that are given.
struct Padding {
  std::size_t count = 0;
  double value = 0;
};

std::vector<double> padded(Evaluation& evaluation, const Component& model, std::string_view list,
                           const Padding& padding) {
  std::vector<double> values;
  if (evaluation.isDeadLink(model, list)) {
    evaluation.warn(model, std::string{list} + " links to nothing; all elements have the default, as in SOFA");
  } else if (auto given = evaluation.numbers(model, {list}, 1)) {
    values = std::move(given->values);
  }
  values.resize(padding.count, padding.value);
  return values;
}

/// An empty model is right where SOFA has one too; most often another file, or another topology, was meant.
void noteEmpty(Evaluation& evaluation, const Component& model) {
  std::string reason = "it has no elements, and is in no pair";
  if (model.kind() == ComponentKind::TriangleModel) {
    const auto file = evaluation.objFileOf(topologyComponentOf(model));
    if (!file.empty()) reason += ": '" + file + "' has no line of 'f' with a face";
  }
  evaluation.warn(model, std::move(reason));
}

/// SOFA asks a topology for its lines or tetrahedra once, as the model starts: those that the topology has by then.
template <std::size_t N>
Elements<N> elementsAtStart(Evaluation& evaluation, const Component& model, const Elements<N>& inTheEnd,
                            Evaluation::Names names) {
  const auto& topology = topologyComponentOf(model);
  if (!isTooLate(evaluation, model, topology)) return inTheEnd;
  auto written = evaluation.elements<N>(topology, names);
  if (written != inTheEnd)
    evaluation.warn(model, "its topology " + topology.describe() +
                               " comes later, or what fills it does: as in SOFA, it has only the elements that are "
                               "written there");
  return written;
}

void describeTriangles(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  model.positions = pointsOf(evaluation, component).positions;
  auto& topology = topologyOf(evaluation, component);
  model.triangles = topology.triangles();
  for (const auto& q : topology.quads()) {
    model.triangles.push_back({q[1], q[2], q[0]});
    model.triangles.push_back({q[3], q[0], q[2]});
  }
  checkCorners(component, model.triangles, model.positions.size());
}

void describeLines(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  model.positions = pointsOf(evaluation, component).positions;
  model.lines =
      elementsAtStart<2>(evaluation, component, topologyOf(evaluation, component).edges(), {"edges", "lines"});
  checkCorners(component, model.lines, model.positions.size());
}

/// The box around the points of the surface of a distance grid, scaled.
Box boundsOfGridSurface(Evaluation& evaluation, const Component& component) {
  const auto file = evaluation.file(component, {"filename", "fileRigidDistanceGrid"});
  if (!file || lowerExtension(*file) != ".obj") throw Unplaceable(component, "its surface is no Wavefront file");
  if (evaluation.number(component, {"sampling"}, 0) != 0 || evaluation.flag(component, "flipNormals", false) ||
      evaluation.vector(component, {"rotation"}, {}) != Vec3{})
    throw Unplaceable(component, "a distance grid that is sampled, turned or inside out is not known to this reader");
  const double scale = std::abs(evaluation.number(component, {"scale"}, 1));
  auto surface = readObj(*file, {}, evaluation.scope().stop());
  if (surface.positions.empty()) throw Unplaceable(component, "its surface has no points");
  for (auto& p : surface.positions) p = p * scale;
  return boundsOf(surface.positions);
}

void describeTetrahedra(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  model.positions = pointsOf(evaluation, component).positions;
  model.tetrahedra = elementsAtStart<4>(evaluation, component, topologyOf(evaluation, component).tetrahedra(),
                                        {"tetrahedra", "tetras"});
  checkCorners(component, model.tetrahedra, model.positions.size());
}

void describeSpheres(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  model.positions = stateOf(evaluation, component).positions;
  const double radius = evaluation.number(component, {"radius"}, 1);
  model.radii = padded(evaluation, component, "listRadius", {model.positions.size(), radius});
}

void describeOrientedBoxes(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  const auto& state = framesOf(evaluation, component);
  model.positions = state.positions;
  model.orientations = state.orientations;
  const double extent = evaluation.number(component, {"defaultExtent"}, 1);
  model.halfExtents = evaluation.points(component, {"extents"});
  model.halfExtents.resize(model.positions.size(), {extent, extent, extent});
}

/// Capsules and cylinders of a rigid state: along an axis of each frame, half the height to either side.
void describeRigidCapsules(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  const auto& state = framesOf(evaluation, component);
  const auto count = state.positions.size();
  const bool cylinder = component.kind() == CylinderModel;
  const double height = evaluation.number(component, {cylinder ? "defaultHeight" : "dafaultHeight"}, 2);  // so SOFA
  const auto heights = padded(evaluation, component, "heights", {count, height});
  model.radii = padded(evaluation, component, "radii", {count, evaluation.number(component, {"defaultRadius"}, 0.5)});
  const Vec3 along = cylinder ? evaluation.vector(component, {"defaultLocalAxis"}, {0, 1, 0}) : Vec3{0, 1, 0};
  for (std::size_t i = 0; i < count; ++i) {
    const auto half = rotate(state.orientations[i], along) * (heights[i] / 2);
    model.positions.push_back(state.positions[i] - half);
    model.positions.push_back(state.positions[i] + half);
    model.lines.push_back({static_cast<Index>(2 * i), static_cast<Index>(2 * i + 1)});
  }
}

void describeCapsules(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  if (component.kind() == CylinderModel || stateOf(evaluation, component).kind == State::Kind::Rigid)
    return describeRigidCapsules(evaluation, component, model);
  describeLines(evaluation, component, model);
  const double radius = evaluation.number(component, {"defaultRadius"}, 0.5);
  model.radii = padded(evaluation, component, "listCapsuleRadii", {model.lines.size(), radius});
}

/// A surface in the frame of a body: SOFA bounds the corners of the box around its points.
void describeRigidGrid(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  const auto& frames = framesOf(evaluation, component);
  if (frames.positions.empty()) throw Unplaceable(component, "its state has no frame");
  const auto [low, high] = boundsOfGridSurface(evaluation, component);
  const Vec3 shift = evaluation.vector(component, {"translation"}, {});
  const auto& turn = frames.orientations[0];
  const Vec3 place = shift == Vec3{} ? frames.positions[0] : frames.positions[0] + rotate(turn, shift);
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 local{corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1], corner & 4 ? high[2] : low[2]};
    model.positions.push_back(place + rotate(turn, local));
  }
  model.cells.push_back({0, 1, 2, 3, 4, 5, 6, 7});
}

/// A surface that bends with a grid: SOFA bounds the cells of the grid, whatever the surface is.
void describeDeformedGrid(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  model.positions = pointsOf(evaluation, component).positions;
  const auto isGrid = [](const Component& c) { return c.kind() == RegularGrid || c.kind() == SparseGrid; };
  const auto* link = component.attributes.find("topology");
  const auto* grid = link != nullptr ? followTo(component, *link, isGrid) : &topologyComponentOf(component);
  if (grid == nullptr || !isGrid(*grid)) throw Unplaceable(component, "its topology is no grid");
  const auto& topology = evaluation.topology(*grid);
  if (topology.unknown) throw Unplaceable(component, "the cells of its sparse grid are not known to this reader");
  model.cells = topology.hexahedra();
  checkCorners(component, model.cells, model.positions.size());
}

void describeElements(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  switch (component.kind()) {
    case PointModel:
      model.positions = pointsOf(evaluation, component).positions;
      break;
    case LineModel:
      describeLines(evaluation, component, model);
      break;
    case TriangleModel:
      describeTriangles(evaluation, component, model);
      break;
    case SphereModel:
      describeSpheres(evaluation, component, model);
      break;
    case CapsuleModel:
    case CylinderModel:
      describeCapsules(evaluation, component, model);
      break;
    case OrientedBoxModel:
      describeOrientedBoxes(evaluation, component, model);
      break;
    case TetrahedronModel:
      describeTetrahedra(evaluation, component, model);
      break;
    case RigidDistanceGrid:
      describeRigidGrid(evaluation, component, model);
      break;
    case DeformedDistanceGrid:
      describeDeformedGrid(evaluation, component, model);
      break;
    default:
      throw Unplaceable(component, "this kind of collision model is not known to this reader");
  }
}

ModelShape shapeOf(ComponentKind kind) {
  switch (kind) {
    case LineModel:
      return ModelShape::Lines;
    case TriangleModel:
      return ModelShape::Triangles;
    case SphereModel:
      return ModelShape::Spheres;
    case CapsuleModel:
    case CylinderModel:
      return ModelShape::Capsules;
    case OrientedBoxModel:
      return ModelShape::OrientedBoxes;
    case TetrahedronModel:
      return ModelShape::Tetrahedra;
    case RigidDistanceGrid:
    case DeformedDistanceGrid:
      return ModelShape::Cells;
    default:
      return ModelShape::Points;
  }
}

void describeRules(Evaluation& evaluation, const Component& component, ModelDescription& model) {
  model.active = evaluation.flag(component, "active", true);
  model.simulated = evaluation.flag(component, "simulated", true);
  model.moving = evaluation.flag(component, "moving", true);
  model.selfCollision = evaluation.flag(component, "selfCollision", false);
  const bool isOld = evaluation.hasOldDistances();
  model.useCurvature = !isOld && evaluation.flag(component, "useCurvature", false);
  model.contactDistance = isOld ? evaluation.number(component, {"proximity"}, 0)
                                : evaluation.number(component, {"contactDistance", "proximity"}, 0);
  if (const auto groups = evaluation.numbers(component, {"group"}, 1))
    for (const double group : groups->values) {
      if (!(std::abs(group) <= std::numeric_limits<int>::max()))
        throw Unplaceable(component, "a group beyond all integers");
      model.groups.insert(static_cast<int>(group));
    }
}

/// The state that a model sees when SOFA makes it: inContext() among those that come before it in the file, in whose
/// order a node has them.
const Component* stateSeenBefore(const Component& model) {
  const auto isBefore = [&](const Component* state) { return state->order < model.order; };
  const auto& own = model.node->states;
  if (const auto end = std::ranges::partition_point(own, isBefore); end != own.begin()) return *(end - 1);
  for (const auto* at = model.node->parent; at != nullptr; at = at->parent)
    if (!at->states.empty() && isBefore(at->states.front())) return at->states.front();
  return nullptr;
}

}  // namespace

bool isMade(Evaluation& evaluation, const Component& model) {
  if (model.kind() != PointModel && model.kind() != LineModel && model.kind() != TriangleModel) return true;
  const auto* state = inContext(*model.node, isState);
  if (state == nullptr || state->order < model.order) return true;
  const auto* seen = stateSeenBefore(model);
  if (seen == state || (seen != nullptr && !isRigidTemplate(seen->attributes.value("template")))) return true;
  return evaluation.isMadeFor(model, *state, "it is left out");
}

std::size_t ModelDescription::elementCount() const {
  switch (shape) {
    case ModelShape::Lines:
    case ModelShape::Capsules:
      return lines.size();
    case ModelShape::Triangles:
      return triangles.size();
    case ModelShape::Tetrahedra:
      return tetrahedra.size();
    case ModelShape::Cells:
      return cells.size();
    default:
      return positions.size();
  }
}

ModelDescription describeModel(Evaluation& evaluation, const Component& component) {
  ModelDescription model;
  model.path = component.path();
  model.type = component.what.name.empty() ? component.type : std::string{component.what.name};
  model.shape = shapeOf(component.kind());
  model.file = *component.place.file;
  model.line = component.place.line;
  describeRules(evaluation, component, model);
  evaluation.scope().take(ReadScope::kBytesPerModel + 4 * model.path.size());
  if (model.active) describeElements(evaluation, component, model);
  if (model.active && model.elementCount() == 0) noteEmpty(evaluation, component);
  const auto points = std::max<std::uint64_t>(model.positions.size(), 1);
  evaluation.takePoints(component, points, 1 + (model.elementCount() + points - 1) / points);
  return model;
}

}  // namespace allpairs::scene::sofa
