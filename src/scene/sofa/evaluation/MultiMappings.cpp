// SPDX-License-Identifier: MIT
#include <algorithm>

#include "input/Words.h"
#include "sofa/evaluation/Components.h"
#include "sofa/evaluation/Evaluation.h"
#include "sofa/graph/Links.h"

namespace allpairs::scene::sofa {
namespace {

const State& stateAt(Evaluation& evaluation, const Component& mapping, std::string_view link) {
  const auto* which = followTo(mapping, link, isState);
  if (which == nullptr)
    throw Unplaceable(mapping, "the state '" + std::string{link.substr(0, 80)} + "' is nowhere to be found");
  return evaluation.knownState(*which);
}

std::vector<const State*> inputsOf(Evaluation& evaluation, const Component& mapping) {
  std::vector<const State*> inputs;
  for (const std::string& link : allWords(mapping.attributes.value("input")))
    inputs.push_back(&stateAt(evaluation, mapping, link));
  if (inputs.empty()) throw Unplaceable(mapping, "it names no state that it reads");
  return inputs;
}

void append(State& to, const State& from, std::size_t index) {
  to.positions.push_back(from.positions[index]);
  if (to.kind == State::Kind::Rigid)
    to.orientations.push_back(from.kind == State::Kind::Rigid ? from.orientations[index] : Quat{});
}

/// The mass of each body of a state, all of which are equal; nothing where there is no mass.
std::optional<double> massOf(const Component& bodies, std::size_t count) {
  const auto* mass = firstIn(*bodies.node, [](const Component& c) { return c.type.ends_with("Mass"); });
  if (mass == nullptr) return std::nullopt;
  const auto& attributes = mass->attributes;
  const auto* total = attributes.find("totalMass");
  const auto* each = total != nullptr ? total : attributes.find("vertexMass");
  if (mass->type != "UniformMass" || each == nullptr || each->starts_with('@') || attributes.has("filename"))
    throw Unplaceable(*mass, "masses of this kind are not known to this reader");
  const double value = leadingNumber(*each);  // Of a rigid body more numbers follow.
  return total != nullptr ? value / static_cast<double>(count) : value;
}

}  // namespace

State mapAllOf(Evaluation& evaluation, const Component& mapping, State child) {
  const auto inputs = inputsOf(evaluation, mapping);
  for (const auto* input : inputs)
    if (!canMap(evaluation, mapping, *input, child)) return child;
  child.setCount(0);
  for (const auto* input : inputs) {
    evaluation.takePoints(mapping, input->positions.size());
    for (std::size_t i = 0; i < input->positions.size(); ++i) append(child, *input, i);
  }
  return child;
}

State mapSomeOf(Evaluation& evaluation, const Component& mapping, State child) {
  const auto inputs = inputsOf(evaluation, mapping);
  for (const auto* input : inputs)
    if (!canMap(evaluation, mapping, *input, child)) return child;
  const auto pairs = evaluation.indices(mapping, {"indexPairs"});
  child.setCount(0);
  for (std::size_t i = 0; i + 1 < pairs.size(); i += 2) {
    if (pairs[i] >= inputs.size() || pairs[i + 1] >= inputs[pairs[i]]->positions.size())
      throw Unplaceable(mapping, "indexPairs names a point that isn't there");
    append(child, *inputs[pairs[i]], pairs[i + 1]);
  }
  return child;
}

State mapOnFrame(Evaluation& evaluation, const Component& mapping, State child) {
  const auto& deformed = stateAt(evaluation, mapping, mapping.attributes.value("input1"));
  child.setPoints(deformed.positions);
  child.fromTopology = deformed.fromTopology;
  const auto carrier = mapping.attributes.value("input2");
  if (carrier.empty()) return child;
  const auto& frames = stateAt(evaluation, mapping, carrier);
  const auto index = evaluation.number(mapping, {"index"}, 0);
  if (frames.kind != State::Kind::Rigid || !(index >= 0) || index >= static_cast<double>(frames.positions.size()) ||
      evaluation.isGiven(mapping, {"repartition", "indexFromEnd"}))
    throw Unplaceable(mapping, "how its rigid frames carry its points is not known to this reader");
  const auto frame = static_cast<std::size_t>(index);
  const auto carried = affine(frames.orientations[frame], {1, 1, 1}, frames.positions[frame]);
  for (auto& p : child.positions) p = carried(p);
  if (child.fromTopology) child.fromTopology = compose(carried, *child.fromTopology);
  return child;
}

State mapCentre(Evaluation& evaluation, const Component& mapping, const Component& bodies, State child) {
  const auto& in = evaluation.knownState(bodies);
  if (in.kind != State::Kind::Rigid) throw Unplaceable(mapping, "the state that it reads is not rigid");
  const auto mass = massOf(bodies, in.positions.size());
  child.fromTopology.reset();
  double total = 0;
  Vec3 sum{};
  for (const auto& position : in.positions) {
    total += mass.value_or(0);
    sum = sum + position * mass.value_or(0);
  }
  if (total == 0)
    evaluation.warn(mapping, "its input has no mass, and it moves nothing, as in SOFA");
  else if (!child.positions.empty())
    child.positions[0] = {sum[0] / total, sum[1] / total, sum[2] / total};
  return child;
}

State mapSkin(Evaluation& evaluation, const Component& mapping, const Component& bones, State child) {
  (void)evaluation.knownState(bones);  // What is wrong with the bones is wrong with the skin.
  if (evaluation.mappingOf(bones) != nullptr ||
      evaluation.isGiven(bones,
                         {"rest_position", "rotation2", "translation2", "rx2", "ry2", "rz2", "dx2", "dy2", "dz2"}) ||
      evaluation.number(bones, {"restScale"}, 1) != 1 || evaluation.isGiven(mapping, {"initPos"}))
    throw Unplaceable(mapping, "its bones are not where they rest, and this reader bends no skin");
  child.fromTopology.reset();
  return child;
}

}  // namespace allpairs::scene::sofa
