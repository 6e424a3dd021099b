// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "scene/ReadScope.h"
#include "scene/sofa/Math.h"
#include "scene/sofa/Mesh.h"
#include "scene/sofa/SceneGraph.h"
#include "scene/sofa/Topology.h"
#include "scene/sofa/Values.h"

namespace allpairs::scene::sofa {

/// More points than this no list of elements can number.
inline constexpr double kMaxPoints = 4e9;

/// A map of space that keeps straight lines.
struct AffineMap {
  Mat3 linear;
  Vec3 offset{};

  [[nodiscard]] Vec3 operator()(const Vec3& p) const { return linear * p + offset; }
};

/// The degrees of freedom of a state component at the start of the simulation.
struct State {
  enum class Kind { Points, Rigid, Other };

  Kind kind = Kind::Points;
  std::vector<Vec3> positions;
  std::vector<Quat> orientations;  ///< As many as positions if rigid, else none.
  std::vector<Vec3> rest;          ///< The rest positions.
  /// Set while the positions are the points of a topology, moved by this.
  std::optional<AffineMap> fromTopology;
  /// That topology is a sparse grid: how it is moved is known, where its points are isn't.
  bool pointsUnknown = false;

  void resize(std::size_t count) {
    positions.resize(count);
    if (kind == Kind::Rigid) orientations.resize(count);
  }
};

/// Computes what the components of a scene hold, each when it is first asked for and once.
///
/// Bad input: what cannot be computed throws Unplaceable, or FileError for a mesh file, and nothing is remembered.
class Evaluation {
 public:
  Evaluation(const Node& root, ReadScope& scope);

  /// What a loader has loaded and transformed.
  const Mesh& mesh(const Component& loader);
  Topology& topology(const Component& component);
  /// Where the points of a state are in the end, after its mapping.
  const State& state(const Component& component);
  /// The same, but throws if the points themselves are not known.
  const State& knownState(const Component& component);

  /// Counts points that a component is about to make, of which a scene may ask for more than it writes out.
  void takePoints(const Component& component, std::uint64_t count);
  [[nodiscard]] ReadScope& scope() { return m_scope; }

  using Names = std::initializer_list<std::string_view>;
  /// As a width: all numbers in a row, whatever entries they make where they come from.
  static constexpr std::size_t kFlat = 0;
  /// The numbers of one data of a component, under any of its names: written out, linked, or found through `src`.
  std::optional<Numbers> numbers(const Component& component, Names names, std::size_t width,
                                 const std::vector<double>& filler = {});
  /// The first number of a data, or the default.
  double number(const Component& component, Names names, double standard);
  Vec3 vector(const Component& component, Names names, const Vec3& standard);
  bool flag(const Component& component, std::string_view name, bool standard);
  std::vector<Vec3> points(const Component& component, Names names);
  template <std::size_t N>
  Elements<N> elements(const Component& component, Names names);
  /// The component's data lists of edges, triangles, and so on.
  Mesh elementLists(const Component& component);
  std::vector<std::size_t> indices(const Component& component, Names names);
  /// The file that an attribute names; nothing if the component has no such attribute.
  std::optional<std::filesystem::path> file(const Component& component, Names names);
  /// The Wavefront file that a topology takes its triangles from; empty where it takes them from elsewhere.
  [[nodiscard]] std::string objFileOf(const Component& topology) const;
  /// Whether a data's value comes from elsewhere.
  [[nodiscard]] bool isLinked(const Component& component, Names names) const;
  [[nodiscard]] bool isGiven(const Component& component, Names names) const;

  /// The mapping that moves a state; null if none does.
  [[nodiscard]] const Component* mappingOf(const Component& state) const;
  /// The topological mapping that fills a topology; null if none does.
  [[nodiscard]] const Component* topologicalMappingOf(const Component& topology) const;

 private:
  class Busy;

  std::optional<Numbers> written(const Component& component, std::string_view name, const std::string& text);
  std::optional<Numbers> linked(const Component& component, std::string_view name, const std::string& text);
  std::optional<Numbers> throughSrc(const Component& component, std::string_view name);
  std::optional<Numbers> output(const Component& component, std::string_view name);
  const Component* source(const Component& component) const;
  void indexMappings(const Node& node);

  ReadScope& m_scope;
  std::unordered_map<const Component*, Mesh> m_meshes;
  std::unordered_map<const Component*, Topology> m_topologies;
  std::unordered_map<const Component*, State> m_states;
  std::unordered_map<const Component*, const Component*> m_mappings;
  std::unordered_map<const Component*, const Component*> m_topologicalMappings;
  std::vector<std::pair<const Component*, std::string>> m_busy;
};

// One of these for each kind of component; Evaluation asks them and remembers.

[[nodiscard]] Mesh loadMesh(Evaluation& evaluation, const Component& loader);
[[nodiscard]] Topology buildTopology(Evaluation& evaluation, const Component& component);
[[nodiscard]] Topology mapTopology(Evaluation& evaluation, const Component& mapping, const Component& target);
[[nodiscard]] State initialState(Evaluation& evaluation, const Component& component);
[[nodiscard]] State mapState(Evaluation& evaluation, const Component& mapping, State child);
/// The points of several states, one after the other.
[[nodiscard]] State mapAllOf(Evaluation& evaluation, const Component& mapping, State child);
/// Chosen points of several states.
[[nodiscard]] State mapSomeOf(Evaluation& evaluation, const Component& mapping, State child);
/// The points of one state, carried by a rigid frame of another.
[[nodiscard]] State mapOnFrame(Evaluation& evaluation, const Component& mapping, State child);
/// A skin on bones that are at rest: it stays where it is.
[[nodiscard]] State mapSkin(Evaluation& evaluation, const Component& mapping, const Component& bones, State child);
[[nodiscard]] std::vector<Vec3> mapBarycentrically(Evaluation& evaluation, const Component& mapping,
                                                   const Component& parent, const State& child);
/// How a state or a mesh loader moves its points: the data scale3d, rotation, translation, rotation2 and translation2.
[[nodiscard]] std::optional<Vec3> placementData(Evaluation& evaluation, const Component& component,
                                                std::string_view name);
/// The data of an engine, nothing if it has none of this name.
[[nodiscard]] std::optional<Numbers> engineOutput(Evaluation& evaluation, const Component& engine,
                                                  std::string_view name);

/// The state that a mapping reads or null, the state that it writes or null.
[[nodiscard]] const Component* mappingInput(const Component& mapping);
[[nodiscard]] const Component* mappingOutput(const Component& mapping);

[[nodiscard]] Numbers toNumbers(const std::vector<Vec3>& points);

}  // namespace allpairs::scene::sofa
