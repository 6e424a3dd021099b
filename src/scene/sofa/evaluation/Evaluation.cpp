// SPDX-License-Identifier: MIT
#include "sofa/evaluation/Evaluation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "input/FileBytes.h"
#include "input/Words.h"
#include "sofa/evaluation/Components.h"

namespace allpairs::scene::sofa {
namespace {

constexpr std::size_t kMaxBusy = 150;  // Components that wait for one another; scenes have chains of about ten.

bool isIndexList(std::string_view name) {
  return name == "indices" || name.ends_with("ndexPerPoint") || name == "group" || name == "points_indices" ||
         name == "indexPairs" || name.ends_with("repartition");
}

bool isMeshData(std::string_view name) {
  for (const auto known : {"position", "points", "edges", "lines", "triangles", "quads", "tetrahedra", "tetras",
                           "hexahedra", "hexas", "listRadius", "output_position"})
    if (name == known) return true;
  return false;
}

/// One of the lists that loaders and topologies have in common.
template <class Source>
std::optional<Numbers> listOf(std::string_view name, const std::vector<Vec3>& positions, Source&& source) {
  if (name == "position" || name == "points") return toNumbers(positions);
  if (name == "edges" || name == "lines") return toNumbers(source.edges());
  if (name == "triangles") return toNumbers(source.triangles());
  if (name == "quads") return toNumbers(source.quads());
  if (name == "tetrahedra" || name == "tetras") return toNumbers(source.tetrahedra());
  if (name == "hexahedra" || name == "hexas") return toNumbers(source.hexahedra());
  return std::nullopt;
}

struct MeshLists {
  const Mesh& mesh;
  [[nodiscard]] const auto& edges() const { return mesh.edges; }
  [[nodiscard]] const auto& triangles() const { return mesh.triangles; }
  [[nodiscard]] const auto& quads() const { return mesh.quads; }
  [[nodiscard]] const auto& tetrahedra() const { return mesh.tetrahedra; }
  [[nodiscard]] const auto& hexahedra() const { return mesh.hexahedra; }
};

std::optional<Numbers> loaderOutput(const Component& loader, const Mesh& mesh, std::string_view name) {
  if (loader.kind() == ComponentKind::SphereLoader) {
    if (name == "listRadius") return Numbers{mesh.radii, 1};
    if (name == "position" || name == "sphere_centers") return toNumbers(mesh.positions);
    return std::nullopt;
  }
  return name == "points" ? std::nullopt : listOf(name, mesh.positions, MeshLists{mesh});
}

std::optional<Numbers> stateOutput(const State& state, std::string_view name) {
  if (name == "rest_position") return toNumbers(state.rest);
  if (name != "position" && name != "free_position" && name != "reset_position") return std::nullopt;
  if (state.kind != State::Kind::Rigid) return toNumbers(state.positions);
  Numbers result{.values = {}, .width = 7};
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    const auto& p = state.positions[i];
    const auto& q = state.orientations[i];
    result.values.insert(result.values.end(), {p[0], p[1], p[2], q.x, q.y, q.z, q.w});
  }
  return result;
}

Index toIndex(const Component& component, std::string_view name, double value) {
  if (!(value >= 0) || value > 4'000'000'000.0 || value != std::floor(value))
    throw Unplaceable(component, fmt::format("{} has the index {}, which is no point's number", name, value));
  return static_cast<Index>(value);
}

std::uint64_t sizeOf(const Mesh& mesh) {
  const auto bytes = [](const auto& list) { return list.size() * sizeof(list[0]); };
  return bytes(mesh.positions) + bytes(mesh.edges) + bytes(mesh.triangles) + bytes(mesh.quads) +
         bytes(mesh.tetrahedra) + bytes(mesh.hexahedra);
}

bool isEngine(ComponentKind kind) { return kind >= ComponentKind::TransformEngine && kind <= ComponentKind::Device; }

/// Mappings that read several states, or those of two kinds.
bool mapsSeveral(ComponentKind kind) {
  using enum ComponentKind;
  return kind == IdentityMultiMapping || kind == SubsetMultiMapping || kind == DeformableOnRigidFrameMapping ||
         kind == ArticulatedMapping;
}

/// The name under which a component gives a value that has several. Where it gives more than one, SOFA, which goes
/// through them in the order of the alphabet, keeps the last.
std::string_view givenName(const Component& component, std::initializer_list<std::string_view> names) {
  std::string_view given;
  for (const auto name : names)
    if (name > given && component.attributes.has(name)) given = name;
  return given;
}

}  // namespace

/// Notes that a component's value is being computed, and throws where it turns out to need itself.
class Evaluation::Busy {
 public:
  Busy(Evaluation& evaluation, const Component& component, std::string_view what) : m_busy(evaluation.m_busy) {
    const std::pair<const Component*, std::string> entry{&component, what};
    if (std::ranges::find(m_busy, entry) != m_busy.end())
      throw Unplaceable(component, "its " + entry.second + " depends on itself");
    if (m_busy.size() >= kMaxBusy) throw Unplaceable(component, "the chain of links that it hangs on is too long");
    m_busy.push_back(entry);
  }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  Busy(Busy&&) = delete;
  Busy& operator=(Busy&&) = delete;
  ~Busy() { m_busy.pop_back(); }

 private:
  std::vector<std::pair<const Component*, std::string>>& m_busy;
};

Evaluation::Evaluation(const Node& root, ReadScope& scope, Generation generation)
    : m_scope(scope), m_generation(generation) {
  indexMappings(root);
}

void Evaluation::indexMappings(const Node& node) {
  if (!node.active) return;
  for (const auto& component : node.components) {
    if (isMapping(*component))
      if (const auto* state = mappingOutput(*component, isState);
          state != nullptr && state != mappingInput(*component, isState) && isMade(*component, isState))
        m_mappings[state] = component.get();
    if (isTopologicalMapping(*component))
      if (const auto* topology = mappingOutput(*component, isTopology);
          topology != nullptr && isMade(*component, isTopology))
        m_topologicalMappings[topology] = component.get();
  }
  for (const auto& child : node.children) indexMappings(*child);
}

bool Evaluation::isMade(const Component& mapping, const Wanted& wanted) {
  const auto kind = mapping.kind();
  if (kind == ComponentKind::UnknownMapping || kind == ComponentKind::UnknownTopologicalMapping) return true;
  if (mapsSeveral(kind) && mapping.attributes.value("output").empty()) {
    warn(mapping, "it names no output: as in SOFA, it is left out");
    return false;
  }
  std::vector<const Component*> ends{mappingOutput(mapping, wanted)};
  if (!mapsSeveral(kind)) ends.push_back(mappingInput(mapping, wanted));
  for (const auto name : {"input", "input1", "input2"})
    for (const std::string& link : allWords(mapping.attributes.value(name)))
      ends.push_back(followTo(mapping, link, wanted));
  return std::ranges::all_of(
      ends, [&](const auto* end) { return end == nullptr || isMadeFor(mapping, *end, "it is left out"); });
}

const Component* Evaluation::mappingOf(const Component& state) const {
  const auto found = m_mappings.find(&state);
  return found == m_mappings.end() ? nullptr : found->second;
}

const Component* Evaluation::topologicalMappingOf(const Component& topology) const {
  const auto found = m_topologicalMappings.find(&topology);
  return found == m_topologicalMappings.end() ? nullptr : found->second;
}

void Evaluation::takePoints(const Component& component, std::uint64_t count, std::uint64_t each) {
  try {
    m_scope.takeElements(count, each * sizeof(Vec3));
  } catch (const FileError& problem) {
    throw Unplaceable(component, "with " + std::to_string(count) + " points it " + problem.problem());
  }
}

const Mesh& Evaluation::mesh(const Component& loader) {
  if (const auto found = m_meshes.find(&loader); found != m_meshes.end()) return found->second;
  const Busy busy(*this, loader, "mesh");
  auto mesh = loadMesh(*this, loader);
  m_scope.take(sizeOf(mesh));
  return m_meshes.emplace(&loader, std::move(mesh)).first->second;
}

Topology& Evaluation::topology(const Component& component) {
  if (const auto found = m_topologies.find(&component); found != m_topologies.end()) return found->second;
  const Busy busy(*this, component, "topology");
  const auto* mapping = topologicalMappingOf(component);
  auto topology = mapping != nullptr ? mapTopology(*this, *mapping, component) : buildTopology(*this, component);
  m_scope.take(sizeOf(topology.given));
  return m_topologies.emplace(&component, std::move(topology)).first->second;
}

const State& Evaluation::state(const Component& component) {
  if (const auto found = m_states.find(&component); found != m_states.end()) return found->second;
  const Busy busy(*this, component, "position");
  auto state = initialState(*this, component);
  takePoints(component, state.positions.size());
  if (const auto* mapping = mappingOf(component)) state = mapState(*this, *mapping, std::move(state));
  for (const auto& position : state.positions)
    if (!isFinite(position)) throw Unplaceable(component, "one of its positions is not finite");
  return m_states.emplace(&component, std::move(state)).first->second;
}

const State& Evaluation::knownState(const Component& component) {
  const auto& result = state(component);
  if (result.pointsUnknown)
    throw Unplaceable(component, "its points are those of a sparse grid, which this reader does not compute");
  return result;
}

std::optional<GridMotion> Evaluation::gridMotion(const Component& component, std::string_view name) {
  const Busy busy(*this, component, std::string{name} + " motion");
  return sofa::gridMotion(*this, component, name);
}

std::optional<Numbers> Evaluation::written(const Component& component, std::string_view name, const std::string& text) {
  if (text.starts_with('@')) return linked(component, name, text);
  std::string bad;
  auto values = isIndexList(name) ? parseIntegers(text, bad, m_scope) : parseNumbers(text, bad);
  if (!values && name == "group") {
    const auto word = bad;
    values = parseIntegers(text, bad, m_scope, WordEnd::Dropped);
    const bool isRange = word.find('-', 1) != std::string::npos;
    if (values)
      warn(component, "group: of '" + word.substr(0, 40) +
                          (isRange ? "' only the integers that its numbers start with are"
                                   : "' only the integer that it starts with is") +
                          " read, as in SOFA");
  }
  if (!values && !isIndexList(name)) {
    const auto joined = bad;
    values = parseNumberStream(text, bad);
    if (values)
      warn(component, std::string{name} + ": '" + joined.substr(0, 40) + "' is read as several numbers, as SOFA does");
  }
  if (!values) {
    throw Unplaceable(component, std::string{name} + ": '" + bad.substr(0, 40) +
                                     (isIndexList(name) ? "' is neither an index nor a range of few enough to be read"
                                                        : "' is not a finite number"));
  }
  return Numbers{std::move(*values), 1};
}

void Evaluation::warn(const Component& component, std::string text) {
  if (const auto [warning, isNew] = m_warned.emplace(&component, std::move(text)); isNew)
    m_warnings.push_back(*warning);
}

bool Evaluation::isMadeFor(const Component& component, const Component& needed, std::string_view without) {
  if (needed.order <= component.order) return true;
  warn(component,
       "it needs " + needed.describe() + ", which comes later in the file: as in SOFA, " + std::string{without});
  return false;
}

bool Evaluation::isDeadLink(const Component& component, std::string_view name) const {
  const auto text = component.attributes.value(name);
  return text.starts_with('@') && followLink(component, text).component == nullptr;
}

std::optional<Numbers> Evaluation::linked(const Component& component, std::string_view name, const std::string& text) {
  const auto target = followLink(component, text);
  const auto what = std::string{name} + "=\"" + text.substr(0, 80) + '"';
  if (target.component == nullptr) throw Unplaceable(component, what + " links to nothing");
  if (target.data.empty()) {
    warn(component, what + " links to a component and names no data of it; it is not read, as in SOFA");
    return std::nullopt;
  }
  if (!isMadeFor(component, *target.component, "its " + std::string{name} + " has the default")) return std::nullopt;
  auto result = output(*target.component, target.data);
  if (!result)
    throw Unplaceable(component, what + " needs the " + target.data + " of " + target.component->describe() +
                                     ", which this reader cannot compute");
  return result;
}

std::optional<Numbers> Evaluation::throughSrc(const Component& component, std::string_view name) {
  const auto* text = component.attributes.find("src");
  if (text == nullptr || component.attributes.has(name)) return std::nullopt;
  const auto* from = followLink(component, *text).component;
  if (from == nullptr) throw Unplaceable(component, "src=\"" + text->substr(0, 80) + "\" links to nothing");
  if (!isMadeFor(component, *from, "its src gives nothing")) return std::nullopt;
  if (from->kind() == ComponentKind::MeshLoader &&
      (name == "translation" || name == "rotation" || name == "scale3d" || name == "scale"))
    return std::nullopt;
  auto result = output(*from, name);
  const bool unknown = from->kind() == ComponentKind::Other || from->kind() == ComponentKind::UnknownLoader ||
                       from->kind() == ComponentKind::UnknownTopology;
  if (!result && unknown && isMeshData(name))
    throw Unplaceable(component, "it takes its data from " + from->describe() + ", which this reader cannot compute");
  return result;
}

std::optional<Numbers> Evaluation::output(const Component& component, std::string_view name) {
  std::pair<const Component*, std::string> key{&component, name};
  if (const auto found = m_outputs.find(key); found != m_outputs.end()) return found->second;
  const Busy busy(*this, component, key.second + " data");
  auto value = computed(component, name);
  // The lists of meshes, topologies and states are large, and those are remembered themselves.
  if (isMeshData(name) && !isEngine(component.kind())) return value;
  if (value) m_scope.take(value->values.size() * sizeof(double));
  return m_outputs.emplace(std::move(key), std::move(value)).first->second;
}

std::optional<Numbers> Evaluation::computed(const Component& component, std::string_view name) {
  const auto kind = component.kind();
  if (kind == ComponentKind::MechanicalState || kind == ComponentKind::MeshLoader)
    if (const auto value = placementData(*this, component, name)) return Numbers{{value->begin(), value->end()}, 3};
  if (kind == ComponentKind::SphereLoader && name == "scale3d") {  // A second name of its scale, since 20.12.
    if (m_generation == Generation::Sofa20) return std::nullopt;
    const auto scale = vector(component, {"scale", "scale3d"}, {1, 1, 1});
    return Numbers{{scale.begin(), scale.end()}, 3};
  }
  if (kind == ComponentKind::MeshLoader || kind == ComponentKind::SphereLoader)
    if (auto value = loaderOutput(component, mesh(component), name)) return value;
  if (const auto value = gridData(*this, component, name)) return Numbers{{value->begin(), value->end()}, 3};
  if (isTopology(component) && isMeshData(name)) {
    auto& from = topology(component);
    const bool isKnown = name == "position" || name == "points" || name == "hexahedra" || name == "hexas";
    if (from.unknown || (from.sparse && !isKnown))
      throw Unplaceable(component,
                        "its " + std::string{name} + " are those of a sparse grid, which this reader does not compute");
    if (auto value = listOf(name, from.given.positions, from)) return value;
  }
  if (kind == ComponentKind::MechanicalState)
    if (auto value = stateOutput(knownState(component), name)) return value;
  if (isEngine(kind))
    if (auto value = engineOutput(*this, component, name)) return value;
  if (const auto* text = component.attributes.find(name)) return written(component, name, *text);
  return component.attributes.has("src") ? throughSrc(component, name) : std::nullopt;
}

std::optional<Numbers> Evaluation::numbers(const Component& component, Names names, std::size_t width,
                                           const std::vector<double>& filler) {
  std::optional<Numbers> found;
  if (const auto name = givenName(component, names); !name.empty())
    found = written(component, name, *component.attributes.find(name));
  if (!found && component.attributes.has("src"))
    for (const auto name : names)
      if (!found) found = throughSrc(component, name);
  if (!found) return found;
  if (width == kFlat) return Numbers{std::move(found->values), 1};
  if (found->width == 1) {
    found->width = width;  // Plain numbers are cut into entries; what is left over is dropped.
    if (const auto left = found->values.size() % width; left != 0)
      warn(component, std::string{*names.begin()} + ": the last " + std::to_string(left) + " of " +
                          std::to_string(found->values.size()) + " numbers are dropped, as SOFA does: each entry has " +
                          std::to_string(width));
    found->values.resize(found->size() * width);
    return found;
  }
  return withWidth(*found, width, filler);
}

bool Evaluation::isGiven(const Component& component, Names names) const {
  return std::ranges::any_of(names, [&](auto name) { return component.attributes.has(name); });
}

bool Evaluation::isLinked(const Component& component, Names names) const {
  if (const auto name = givenName(component, names); !name.empty())
    return component.attributes.find(name)->starts_with('@');
  return component.attributes.has("src");
}

double Evaluation::number(const Component& component, Names names, double standard) {
  const auto found = numbers(component, names, 1);
  return found && !found->values.empty() ? found->values[0] : standard;
}

Vec3 Evaluation::vector(const Component& component, Names names, const Vec3& standard) {
  const auto found = numbers(component, names, kFlat);
  Vec3 result = standard;
  if (found) std::copy_n(found->values.begin(), std::min<std::size_t>(3, found->values.size()), result.begin());
  return result;
}

double Evaluation::single(const Component& component, std::string_view name, double standard) {
  const auto* text = component.attributes.find(name);
  if (text == nullptr || text->empty()) return standard;
  if (const auto value = parseWholeFloat(*text)) return *value;
  if (text->starts_with('@')) {
    warn(component, std::string{name} + ": a link is not followed here; it has the default, as in SOFA");
    return standard;
  }
  std::string bad;
  const auto given = parseNumbers(*text, bad);
  constexpr auto kMost = static_cast<double>(std::numeric_limits<float>::max());
  const auto isTooLarge = [](double value) { return std::abs(value) > kMost; };
  if (!given) throw Unplaceable(component, std::string{name} + ": " + quotedWord(bad) + " is not a finite number");
  if (std::ranges::any_of(*given, isTooLarge))
    throw Unplaceable(component, std::string{name} + ": " + quotedWord(*text) + " is out of the range of float32");
  warn(component,
       std::string{name} + ": " + quotedWord(*text) + " is not one number alone; it has the default, as in SOFA");
  return standard;
}

bool Evaluation::flag(const Component& component, std::string_view name, bool standard) {
  const auto text = component.attributes.value(name);
  if (!text.starts_with('@')) {
    const auto value = parseBool(text);
    if (!value && !text.empty())
      warn(component,
           std::string{name} + ": " + quotedWord(text) + " is neither true nor false; it has the default, as in SOFA");
    return value.value_or(standard);
  }
  // A link to what is written elsewhere has its words, such as "true"; what is computed is a number.
  const auto target = followLink(component, text);
  if (target.component == nullptr || !target.component->attributes.has(target.data))
    return number(component, {name}, standard ? 1 : 0) != 0;
  const Busy busy(*this, component, std::string{name} + " flag");
  const bool isThere = isMadeFor(component, *target.component, "its " + std::string{name} + " has the default");
  return isThere ? flag(*target.component, target.data, standard) : standard;
}

std::vector<Vec3> Evaluation::points(const Component& component, Names names) {
  std::vector<Vec3> result;
  const auto found = numbers(component, names, 3);
  if (!found) return result;
  result.reserve(found->size());
  for (std::size_t i = 0; i < found->size(); ++i)
    result.push_back({found->values[3 * i], found->values[3 * i + 1], found->values[3 * i + 2]});
  return result;
}

template <std::size_t N>
Elements<N> Evaluation::elements(const Component& component, Names names) {
  Elements<N> result;
  const auto found = numbers(component, names, N);
  if (!found) return result;
  result.resize(found->size());
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t j = 0; j < N; ++j) result[i][j] = toIndex(component, *names.begin(), found->values[i * N + j]);
  return result;
}

Mesh Evaluation::elementLists(const Component& component) {
  Mesh mesh;
  mesh.edges = elements<2>(component, {"edges", "lines"});
  mesh.triangles = elements<3>(component, {"triangles"});
  mesh.quads = elements<4>(component, {"quads"});
  mesh.tetrahedra = elements<4>(component, {"tetrahedra", "tetras"});
  mesh.hexahedra = elements<8>(component, {"hexahedra", "hexas"});
  return mesh;
}

std::vector<std::size_t> Evaluation::indices(const Component& component, Names names) {
  std::vector<std::size_t> result;
  if (const auto found = numbers(component, names, 1))
    for (const double value : found->values) result.push_back(toIndex(component, *names.begin(), value));
  return result;
}

std::pair<std::string_view, const Component*> Evaluation::fileName(const Component& component, std::string_view name) {
  const auto text = component.attributes.value(name);
  const auto target = followLink(component, text);
  if (target.component == nullptr || target.data.empty()) return {text, &component};
  const Busy busy(*this, component, std::string{name} + " name");
  if (!isMadeFor(component, *target.component, "its " + std::string{name} + " names no file")) return {{}, &component};
  return fileName(*target.component, target.data);
}

std::optional<std::filesystem::path> Evaluation::file(const Component& component, Names names) {
  for (const auto name : names) {
    const auto [text, from] = fileName(component, name);
    if (text.empty()) continue;
    auto found = m_scope.find(text, *from->base);
    if (!found.problem.empty()) throw Unplaceable(component, "the file '" + std::string{text} + "' " + found.problem);
    m_scope.admit(found.path);
    return std::move(found.path);
  }
  return std::nullopt;
}

bool Evaluation::hasFile(const Component& component, Names names) {
  return std::ranges::any_of(names, [&](auto name) {
    const auto [text, from] = fileName(component, name);
    return !text.empty() && m_scope.find(text, *from->base).problem.empty();
  });
}

std::string Evaluation::objFileOf(const Component& topology) {
  const auto text = topology.attributes.value("src", topology.attributes.value("triangles"));
  const auto* from = text.starts_with('@') ? followLink(topology, text).component : &topology;
  if (from == nullptr || from->order > topology.order) return {};
  const auto name = fileName(*from, "filename").first;
  return lowerExtension(name) == ".obj" ? std::string{name} : std::string{};
}

Numbers toNumbers(const std::vector<Vec3>& points) {
  Numbers result{.values = {}, .width = 3};
  result.values.reserve(points.size() * 3);
  for (const auto& point : points) result.values.insert(result.values.end(), point.begin(), point.end());
  return result;
}

}  // namespace allpairs::scene::sofa
