// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "sofa/evaluation/State.h"
#include "sofa/graph/SceneGraph.h"
#include "sofa/graph/Values.h"
#include "sofa/mesh/Mesh.h"
#include "sofa/mesh/Topology.h"

namespace allpairs::scene::sofa {

class Evaluation;

// One of these for each kind of component; Evaluation asks them and remembers, and they ask it for what they need.

[[nodiscard]] Mesh loadMesh(Evaluation& evaluation, const Component& loader);
/// Notes what of a component's file SOFA does not read.
void warnOfPassedOver(Evaluation& evaluation, const Component& component, const Mesh& mesh);
[[nodiscard]] Topology buildTopology(Evaluation& evaluation, const Component& component);
/// Whether a container has elements of the kind of another: SOFA derives its class from that of the other.
[[nodiscard]] bool canHold(ComponentKind container, ComponentKind element);
/// Whether a topology is empty when a component of its node asks it, because it, or what fills it, comes later.
[[nodiscard]] bool isTooLate(const Evaluation& evaluation, const Component& asking, const Component& topology);
/// What a mapping fills a topology with; what is written there where SOFA refuses the mapping.
[[nodiscard]] Topology mapTopology(Evaluation& evaluation, const Component& mapping, const Component& target);
/// Whether a template's name means frames of a rigid body in space: seven numbers each.
[[nodiscard]] bool isRigidTemplate(std::string_view name);
[[nodiscard]] State initialState(Evaluation& evaluation, const Component& component);
[[nodiscard]] State mapState(Evaluation& evaluation, const Component& mapping, State child);
/// Whether SOFA has a mapping of this class between two kinds of states. If it has not it makes none, and that is noted.
[[nodiscard]] bool canMap(Evaluation& evaluation, const Component& mapping, const State& from, const State& to);
/// The points of several states, one after the other.
[[nodiscard]] State mapAllOf(Evaluation& evaluation, const Component& mapping, State child);
/// Chosen points of several states.
[[nodiscard]] State mapSomeOf(Evaluation& evaluation, const Component& mapping, State child);
/// The points of one state, carried by a rigid frame of another.
[[nodiscard]] State mapOnFrame(Evaluation& evaluation, const Component& mapping, State child);
/// Points that follow beams: the frames of a rigid state, one after the other.
[[nodiscard]] State mapOnBeams(Evaluation& evaluation, const Component& mapping, const Component& beams, State child);
/// A skin on bones that are at rest: it stays where it is.
[[nodiscard]] State mapSkin(Evaluation& evaluation, const Component& mapping, const Component& bones, State child);
/// One point, in the middle of the masses of rigid frames.
[[nodiscard]] State mapCentre(Evaluation& evaluation, const Component& mapping, const Component& bodies, State child);
/// The same frames when those that follow them are made: as written, the first one carried, before any joint counts.
[[nodiscard]] State articulatedAtStart(Evaluation& evaluation, const Component& mapping, State child);
/// Rigid frames that hang on each other by joints, at the angles of another state.
[[nodiscard]] State mapArticulated(Evaluation& evaluation, const Component& mapping, State child);
/// Counts pairs of what is about to be compared, and throws Unplaceable where that takes too long, and Stopped where
/// reading is to stop.
void takeWork(Evaluation& evaluation, const Component& component, std::uint64_t pairs);
[[nodiscard]] std::vector<Vec3> mapBarycentrically(Evaluation& evaluation, const Component& mapping,
                                                   const Component& parent, const State& child);
/// How a state or a mesh loader moves its points: the data scale3d, rotation, translation, rotation2 and translation2.
[[nodiscard]] std::optional<Vec3> placementData(Evaluation& evaluation, const Component& component,
                                                std::string_view name);
/// The shape of a regular grid: the data n, min, max and p0, whatever attributes give them.
[[nodiscard]] std::optional<Vec3> gridData(Evaluation& evaluation, const Component& grid, std::string_view name);
[[nodiscard]] std::optional<GridMotion> gridMotion(Evaluation& evaluation, const Component& component,
                                                   std::string_view name);
/// The data of an engine, nothing if it has none of this name.
[[nodiscard]] std::optional<Numbers> engineOutput(Evaluation& evaluation, const Component& engine,
                                                  std::string_view name);

/// The data of an engine that parts a mesh in two: what lies in its boxes or spheres, and the rest.
[[nodiscard]] std::optional<Numbers> subsetOutput(Evaluation& evaluation, const Component& engine,
                                                  std::string_view name);
/// The points and elements that lie in boxes, and those that don't.
[[nodiscard]] std::optional<Numbers> roiOutput(Evaluation& evaluation, const Component& engine, std::string_view name);
/// Points of a straight strip, rolled up to a spiral.
[[nodiscard]] std::optional<Numbers> spiralOutput(Evaluation& evaluation, const Component& engine,
                                                  std::string_view name);
/// The mean of the points of all states in a node.
[[nodiscard]] std::optional<Numbers> meanOutput(Evaluation& evaluation, const Component& engine, std::string_view name);
/// Rigid frames made of points and quaternions.
[[nodiscard]] std::optional<Numbers> frameOutput(Evaluation& evaluation, const Component& engine,
                                                 std::string_view name);
/// The tetrahedra inside of a surface.
[[nodiscard]] Mesh stuffedMesh(Evaluation& evaluation, const Component& engine);
/// What the driver of a device says of it at the start.
[[nodiscard]] std::optional<Numbers> deviceOutput(Evaluation& evaluation, const Component& driver,
                                                  std::string_view name);

}  // namespace allpairs::scene::sofa
