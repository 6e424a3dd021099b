// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "input/ReadScope.h"
#include "sofa/evaluation/State.h"
#include "sofa/graph/Generation.h"
#include "sofa/graph/Links.h"
#include "sofa/graph/SceneGraph.h"
#include "sofa/graph/Values.h"
#include "sofa/mesh/Mesh.h"
#include "sofa/mesh/Topology.h"

namespace allpairs::scene::sofa {

/// Computes what the components of a scene hold, each when it is first asked for and once.
///
/// Bad input: what cannot be computed throws Unplaceable, or FileError for a mesh file, and nothing is remembered.
class Evaluation {
 public:
  Evaluation(const Node& root, ReadScope& scope, Generation generation);

  /// What a loader has loaded and transformed.
  const Mesh& mesh(const Component& loader);
  Topology& topology(const Component& component);
  /// Where the points of a state are in the end, after its mapping.
  const State& state(const Component& component);
  /// The same, but throws if the points themselves are not known.
  const State& knownState(const Component& component);

  /// How a data of a component moves the points of a sparse grid that it is made of; nothing if it is made of others.
  std::optional<GridMotion> gridMotion(const Component& component, std::string_view name);

  /// Counts points that a component is about to make, of which a scene may ask for more than it writes out, each with
  /// so many times the memory of a point alone: for the elements between them.
  void takePoints(const Component& component, std::uint64_t count, std::uint64_t each = 1);
  [[nodiscard]] ReadScope& scope() { return m_scope; }
  [[nodiscard]] Generation generation() const { return m_generation; }

  /// Whether SOFA 20.06 was asked for, and not taken for want of a sign of a newer one: then the models' contact
  /// distances, too, are what they were there.
  void setOldDistances(bool old) { m_hasOldDistances = old; }
  [[nodiscard]] bool hasOldDistances() const { return m_hasOldDistances; }

  using Names = std::initializer_list<std::string_view>;
  /// As a width: all numbers in a row, whatever entries they make where they come from.
  static constexpr std::size_t kFlat = 0;
  /// The numbers of one data of a component, under any of its names: written out, linked, or found through `src`.
  std::optional<Numbers> numbers(const Component& component, Names names, std::size_t width,
                                 const std::vector<double>& filler = {});
  /// The first number of a data, or the default.
  double number(const Component& component, Names names, double standard);
  Vec3 vector(const Component& component, Names names, const Vec3& standard);
  /// An attribute that SOFA takes as one number from its first character to its last; else it has the default there.
  ///
  /// Bad input: throws Unplaceable for a word that is no number, and warns of what SOFA passes over besides.
  double single(const Component& component, std::string_view name, double standard);
  bool flag(const Component& component, std::string_view name, bool standard);
  std::vector<Vec3> points(const Component& component, Names names);
  template <std::size_t N>
  Elements<N> elements(const Component& component, Names names);
  /// The component's data lists of edges, triangles, and so on.
  Mesh elementLists(const Component& component);
  std::vector<std::size_t> indices(const Component& component, Names names);
  /// The file that an attribute names, or another that it links to, beside which the file may be; nothing if the
  /// component has no such attribute.
  std::optional<std::filesystem::path> file(const Component& component, Names names);
  /// Whether an attribute names a file that is there and may be read.
  [[nodiscard]] bool hasFile(const Component& component, Names names);
  /// The Wavefront file that a topology takes its triangles from; empty where it takes them from elsewhere.
  [[nodiscard]] std::string objFileOf(const Component& topology);
  /// Whether a data's value comes from elsewhere.
  [[nodiscard]] bool isLinked(const Component& component, Names names) const;
  [[nodiscard]] bool isGiven(const Component& component, Names names) const;
  /// Whether a data is a link to a component that is not there.
  [[nodiscard]] bool isDeadLink(const Component& component, std::string_view name) const;

  using Warnings = std::vector<std::pair<const Component*, std::string>>;
  /// Notes, once, what was read otherwise than it is written.
  void warn(const Component& component, std::string text);
  [[nodiscard]] const Warnings& warnings() const { return m_warnings; }

  /// Whether a component comes before another that needs it. SOFA makes them in the order of the file, and what needs
  /// something later goes without; a warning says how.
  bool isMadeFor(const Component& component, const Component& needed, std::string_view without);

  /// Whether this was never asked of a node before: what holds for all of its states is looked for once.
  [[nodiscard]] bool isFirstStateIn(const Node& node) { return m_nodesOfStates.insert(&node).second; }

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
  std::optional<Numbers> computed(const Component& component, std::string_view name);
  /// The name of a file that an attribute holds, or one that it links to, and the component whose attribute it is; an
  /// empty one where there is none.
  std::pair<std::string_view, const Component*> fileName(const Component& component, std::string_view name);
  void indexMappings(const Node& node);
  bool isMade(const Component& mapping, const Wanted& wanted);

  ReadScope& m_scope;
  Generation m_generation;
  bool m_hasOldDistances = false;
  std::unordered_map<const Component*, Mesh> m_meshes;
  std::unordered_map<const Component*, Topology> m_topologies;
  std::unordered_map<const Component*, State> m_states;
  std::map<std::pair<const Component*, std::string>, std::optional<Numbers>> m_outputs;
  std::unordered_map<const Component*, const Component*> m_mappings;
  std::unordered_map<const Component*, const Component*> m_topologicalMappings;
  std::vector<std::pair<const Component*, std::string>> m_busy;
  Warnings m_warnings;
  std::set<Warnings::value_type> m_warned;
  std::set<const Node*> m_nodesOfStates;
};

[[nodiscard]] Numbers toNumbers(const std::vector<Vec3>& points);
template <std::size_t N>
[[nodiscard]] Numbers toNumbers(const Elements<N>& elements) {
  Numbers result{.values = {}, .width = N};
  result.values.reserve(elements.size() * N);
  for (const auto& element : elements)
    for (const auto corner : element) result.values.push_back(corner);
  return result;
}

}  // namespace allpairs::scene::sofa
