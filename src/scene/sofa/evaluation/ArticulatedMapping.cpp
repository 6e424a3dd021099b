// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

using enum ComponentKind;

using Found = std::vector<const Component*>;

/// The components of a kind in a node and below, each node before its children.
void addFrom(const Node& node, ComponentKind kind, Found& found) {
  for (const auto& component : node.components)
    if (component->kind() == kind) found.push_back(component.get());
  for (const auto& child : node.children) addFrom(*child, kind, found);
}

const Component* stateNamed(const Component& mapping, std::string_view data) {
  const auto* link = mapping.attributes.find(data);
  if (link == nullptr) return nullptr;
  const auto* state = followTo(mapping, *link, isState);
  if (state == nullptr) throw Unplaceable(mapping, "its " + std::string{data} + " is nowhere to be found");
  return state;
}

/// The component that holds the joints: the one that the mapping names, or the first below the state of the angles.
const Component& hierarchyOf(const Component& mapping, const Component& angles) {
  Found found;
  if (const auto* link = mapping.attributes.find("container"); link != nullptr) {
    const auto* named = followTo(mapping, *link, [](const Component& c) { return c.kind() == ArticulatedHierarchy; });
    if (named != nullptr) found.push_back(named);
  } else {
    addFrom(*angles.node, ArticulatedHierarchy, found);
  }
  if (found.empty()) throw Unplaceable(mapping, "there is no ArticulatedHierarchyContainer for it");
  if (found.front()->attributes.has("filename"))
    throw Unplaceable(mapping, "its articulations are those of a file, which this reader does not read");
  return *found.front();
}

Quat turn(const Vec3& axis, double angle) {
  const double length = lengthOf(axis);
  if (!(length > 0)) return {};
  const Vec3 v = axis * (std::sin(angle / 2) / length);
  return {v[0], v[1], v[2], std::cos(angle / 2)};
}

/// A body that hangs on another by a joint, which moves about and along axes.
class Joint {
 public:
  Joint(Evaluation& evaluation, const Component& mapping, const Component& center, std::size_t frames)
      : m_evaluation(evaluation),
        m_mapping(mapping),
        m_parent(frameOf(center, "parentIndex", frames)),
        m_child(frameOf(center, "childIndex", frames)),
        m_process(evaluation.number(center, {"articulationProcess"}, 0)),
        m_onParent(evaluation.vector(center, {"posOnParent"}, {0, 0, 0})),
        m_onChild(evaluation.vector(center, {"posOnChild"}, {0, 0, 0})) {
    for (const auto& node : center.node->children) addFrom(*node, Articulation, m_axes);
  }

  void place(State& bodies, const std::vector<double>& angles) const {
    const Vec3 parent = bodies.positions[m_parent];
    const Quat& turned = bodies.orientations[m_parent];
    const Quat before = bodies.orientations[m_child];
    const Vec3 joint = parent + rotate(turned, m_onParent);
    Quat orientation = m_process == 0 ? turned : Quat{};
    Vec3 moved{};
    for (const auto* articulation : m_axes) {
      const double value = valueOf(*articulation, angles);
      const Vec3 axis = m_evaluation.vector(*articulation, {"axis", "rotationAxis"}, {1, 0, 0});
      const Quat& about = m_process == 0 ? orientation : m_process == 1 ? turned : before;
      const Vec3 here = rotate(about, m_process == 0 ? unit(axis) : axis);
      if (m_evaluation.flag(*articulation, "rotation", false)) orientation = turn(here, value) * orientation;
      if (m_evaluation.flag(*articulation, "translation", false)) moved = moved + movedBy(here, value);
    }
    if (m_process != 0) orientation = orientation * turned;
    bodies.orientations[m_child] = orientation;
    bodies.positions[m_child] = joint + moved - rotate(orientation, m_onChild);
  }

 private:
  std::size_t frameOf(const Component& center, std::string_view name, std::size_t frames) const {
    const double index = m_evaluation.number(center, {name}, 0);
    if (!(index >= 0) || index >= static_cast<double>(frames))
      throw Unplaceable(m_mapping, "its articulations name a frame that its output does not have");
    return static_cast<std::size_t>(index);
  }

  double valueOf(const Component& articulation, const std::vector<double>& angles) const {
    const double index = m_evaluation.number(articulation, {"articulationIndex"}, 0);
    if (!(index >= 0) || index >= static_cast<double>(angles.size()))
      throw Unplaceable(m_mapping, "its articulations name a value that its input does not have");
    return angles[static_cast<std::size_t>(index)];
  }

  /// Along axes of the child SOFA goes again with each step of the start, and how many there are is not known here.
  Vec3 movedBy(const Vec3& axis, double value) const {
    if (m_process == 2 && value != 0)
      throw Unplaceable(m_mapping, "it moves a body along an axis of that body, which this reader does not follow");
    return axis * value;
  }

  static Vec3 unit(const Vec3& v) {
    const double length = lengthOf(v);
    return length > 0 ? v * (1 / length) : v;
  }

  Evaluation& m_evaluation;
  const Component& m_mapping;
  std::size_t m_parent;
  std::size_t m_child;
  double m_process;
  Vec3 m_onParent;
  Vec3 m_onChild;
  Found m_axes;
};

/// The first frame is that of a state, where one carries the whole.
void placeRoot(Evaluation& evaluation, const Component& mapping, State& bodies) {
  const auto* root = stateNamed(mapping, "input2");
  if (root == nullptr) return;
  const State& carrier = evaluation.knownState(*root);
  if (carrier.kind != State::Kind::Rigid || carrier.positions.empty() || bodies.positions.empty())
    throw Unplaceable(mapping, "its input2 has no rigid frame");
  const auto last = static_cast<double>(carrier.positions.size() - 1);
  const auto index = clamped(evaluation.number(mapping, {"indexInput2"}, last), 0, last);
  bodies.positions[0] = carrier.positions[static_cast<std::size_t>(index)];
  bodies.orientations[0] = carrier.orientations[static_cast<std::size_t>(index)];
}

}  // namespace

State articulatedAtStart(Evaluation& evaluation, const Component& mapping, State child) {
  if (stateNamed(mapping, "input1") != nullptr) placeRoot(evaluation, mapping, child);
  return child;
}

State mapArticulated(Evaluation& evaluation, const Component& mapping, State child) {
  const auto* angles = stateNamed(mapping, "input1");
  if (angles == nullptr) {
    evaluation.warn(mapping, "it names no input1, the state of its articulations, and moves nothing, as in SOFA");
    return child;
  }
  if (child.kind != State::Kind::Rigid) throw Unplaceable(mapping, "its output is no state of rigid frames");
  const auto given = evaluation.numbers(*angles, {"position"}, 1);
  const std::vector<double> values = given ? given->values : std::vector<double>{};
  Found centers;
  addFrom(*hierarchyOf(mapping, *angles).node, ArticulationCenter, centers);
  if (centers.size() > values.size()) throw Unplaceable(mapping, "it has more articulations than values");
  child.fromTopology.reset();
  placeRoot(evaluation, mapping, child);
  for (const auto* center : centers) Joint(evaluation, mapping, *center, child.positions.size()).place(child, values);
  return child;
}

}  // namespace allpairs::scene::sofa
