// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "mesh/Assemblies.h"
#include "mesh/Faces.h"
#include "mesh/MeshObject.h"
#include "mesh/PathNames.h"
#include "mesh/Transform.h"
#include "mesh/gltf/GltfDocument.h"

namespace allpairs::scene {
namespace {

/// So far numbers of float32 may be from what is meant by them; they are taken as they are.
constexpr double kFloat32Rounding = 1e-6;

enum class Mode : std::uint8_t { Points, Lines, LineLoop, LineStrip, Triangles, TriangleStrip, TriangleFan };

/// The rotation by a quaternion x y z w.
Transform rotation(const std::vector<double>& q) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 0},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 0},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y), 0}}};
}

/// Puts the elements of a primitive together from its corners, in the order of the specification's figures.
class ElementBuilder {
 public:
  ElementBuilder(MeshObject& object, const std::vector<std::uint32_t>& corners)
      : m_object(object), m_corners(corners) {}

  void add(Mode mode) {
    const std::size_t count = m_corners.size();
    if (mode == Mode::Points) m_object.points.insert(m_object.points.end(), m_corners.begin(), m_corners.end());
    if (mode == Mode::Lines) forEach(count / 2, [this](std::size_t i) { line(2 * i, 2 * i + 1); });
    if (mode == Mode::LineStrip || mode == Mode::LineLoop) forEach(less(1), [this](std::size_t i) { line(i, i + 1); });
    if (mode == Mode::LineLoop && count > 1) line(count - 1, 0);
    if (mode == Mode::Triangles)
      forEach(count / 3,
              [this](std::size_t i) { m_object.triangles.push_back(triangle(3 * i, 3 * i + 1, 3 * i + 2)); });
    if (mode == Mode::TriangleStrip)
      forEach(less(2), [this](std::size_t i) { addDrawn(m_object, triangle(i + i % 2, i + 1 - i % 2, i + 2)); });
    if (mode == Mode::TriangleFan)
      forEach(less(2), [this](std::size_t i) { addDrawn(m_object, triangle(0, i + 1, i + 2)); });
  }

 private:
  [[nodiscard]] std::size_t less(std::size_t by) const { return m_corners.size() - std::min(by, m_corners.size()); }

  template <class Visit>
  static void forEach(std::size_t count, const Visit& visit) {
    for (std::size_t i = 0; i < count; ++i) visit(i);
  }

  void line(std::size_t a, std::size_t b) { m_object.lines.push_back({m_corners[a], m_corners[b]}); }
  [[nodiscard]] std::array<std::uint32_t, 3> triangle(std::size_t a, std::size_t b, std::size_t c) const {
    return {m_corners[a], m_corners[b], m_corners[c]};
  }

  MeshObject& m_object;
  const std::vector<std::uint32_t>& m_corners;
};

/// Goes through the nodes of the scene that is shown, parents before children, without recursion.
class GltfNodeReader {
 public:
  explicit GltfNodeReader(GltfDocument& document) : m_document(document), m_isSeen(document.size("nodes")) {}

  std::vector<MeshObject> read() {
    std::vector<Entry> open;
    push(open, roots(), {.parent = kIdentity});
    while (!open.empty()) {
      const Entry entry = open.back();
      open.pop_back();
      const GltfItem node = m_document.item("nodes", entry.node);
      if (m_isSeen[static_cast<std::size_t>(entry.node)]) m_document.fail(node.name + " has more than one parent");
      m_isSeen[static_cast<std::size_t>(entry.node)] = true;
      const Transform world = multiply(entry.parent, transformOf(node));
      if (m_document.hasExtension(node, "EXT_mesh_gpu_instancing"))
        m_document.fail(node.name + " has copies by EXT_mesh_gpu_instancing, which is not read");
      const auto mesh = m_document.count(node, "mesh");
      if (mesh) addObject(node, m_document.item("meshes", *mesh), world);
      push(open, m_document.indices(node, "children"), {.parent = world, .parentPlace = m_nodes.size()});
      noteNode(node, mesh.has_value(), entry.parentPlace);
    }
    const std::vector<std::string> assemblies = assembliesOf(m_nodes, m_document.scope());
    for (std::size_t i = 0; i < m_objects.size(); ++i) m_objects[i].assembly = assemblies[m_places[i]];
    nameByPath(m_objects, m_places, m_nodes, m_document.scope());
    if (std::ranges::none_of(m_objects, &MeshObject::hasElements)) blameExtensions();
    return std::move(m_objects);
  }

 private:
  struct Entry {
    std::uint64_t node = 0;
    Transform parent{};
    std::size_t parentPlace = NestedNode::kNoParent;  ///< In the list of nodes.
  };

  /// Says what is missing to read a document in which nothing was found.
  void blameExtensions() const {
    std::string names;
    for (const std::string& name : m_document.requiredExtensions()) names += (names.empty() ? "" : ", ") + name;
    if (!names.empty()) m_document.fail("holds no triangles, lines or points that can be read without " + names);
  }

  /// The last is taken first. They have the parent of `like`.
  void push(std::vector<Entry>& open, const std::vector<std::uint64_t>& nodes, Entry like) const {
    m_document.scope().takeElements(nodes.size(), sizeof(Entry));
    std::for_each(nodes.rbegin(), nodes.rend(), [&](std::uint64_t node) {
      like.node = node;
      open.push_back(like);
    });
  }

  void noteNode(const GltfItem& node, bool hasObject, std::size_t parent) {
    if (hasObject) m_places.push_back(m_nodes.size());
    m_nodes.push_back({parent, hasObject, m_document.text(node, "name")});
    m_document.scope().takeElements(1, sizeof(NestedNode) + 4 * m_nodes.back().name.size());  // of assemblies too
  }

  /// Those of the scene to be shown, else of the first; without scenes, the nodes without a parent.
  std::vector<std::uint64_t> roots() const {
    if (m_document.size("scenes") != 0) {
      const std::uint64_t scene = m_document.count({&m_document.root(), "the document"}, "scene").value_or(0);
      return m_document.indices(m_document.item("scenes", scene), "nodes");
    }
    std::vector<bool> isChild(m_isSeen.size());
    for (std::size_t i = 0; i < isChild.size(); ++i) {
      for (const std::uint64_t child : m_document.indices(m_document.item("nodes", i), "children")) {
        if (child < isChild.size()) isChild[static_cast<std::size_t>(child)] = true;
      }
    }
    std::vector<std::uint64_t> result;
    for (std::size_t i = 0; i < isChild.size(); ++i) {
      if (!isChild[i]) result.push_back(i);
    }
    return result;
  }

  Transform transformOf(const GltfItem& node) const {
    if (const std::vector<double> m = m_document.numbers(node, "matrix", 16); !m.empty()) {  // column by column
      const auto isNear = [](double value, double wanted) { return std::abs(value - wanted) <= kFloat32Rounding; };
      if (!isNear(m[3], 0.0) || !isNear(m[7], 0.0) || !isNear(m[11], 0.0) || !isNear(m[15], 1.0))
        m_document.fail(node.name + " has a matrix whose last row is not 0 0 0 1");
      return {{{m[0], m[4], m[8], m[12]}, {m[1], m[5], m[9], m[13]}, {m[2], m[6], m[10], m[14]}}};
    }
    Transform result = kIdentity;
    if (auto q = m_document.numbers(node, "rotation", 4); !q.empty()) {
      constexpr double kMost = 0.00769;  // the glTF-Validator's: quaternions in 8 bits are so far from length 1
      const double length = std::sqrt(std::inner_product(q.begin(), q.end(), q.begin(), 0.0));
      if (!(std::abs(length - 1.0) <= kMost))
        m_document.fail(node.name + " has a rotation that is no quaternion of length 1");
      if (std::abs(length - 1.0) > kFloat32Rounding)
        for (double& number : q) number /= length;
      result = rotation(q);
    }
    if (const auto scale = m_document.numbers(node, "scale", 3); !scale.empty()) {
      for (auto& row : result)
        std::transform(scale.begin(), scale.end(), row.begin(), row.begin(), std::multiplies<>());
    }
    if (const auto offset = m_document.numbers(node, "translation", 3); !offset.empty()) {
      for (std::size_t axis = 0; axis < 3; ++axis) result[axis][3] = offset[axis];
    }
    return result;
  }

  void addObject(const GltfItem& node, const GltfItem& mesh, const Transform& world) {
    MeshObject object;
    object.name = m_document.text(node, "name");
    if (object.name.empty()) object.name = m_document.text(mesh, "name");
    m_document.scope().takeElements(1, sizeof(MeshObject) + object.name.size());
    const auto primitives = mesh.json->find("primitives");
    if (primitives == mesh.json->end() || !primitives->is_array()) m_document.fail(mesh.name + " has no primitives");
    for (const nlohmann::json& primitive : *primitives) {
      if (!primitive.is_object()) m_document.fail(mesh.name + " has a primitive that is no object");
      addPrimitive(object, {&primitive, mesh.name}, world);
    }
    object.passedOver = passedOver(node, mesh);
    m_objects.push_back(std::move(object));
  }

  /// What would move the vertices of a mesh.
  std::string passedOver(const GltfItem& node, const GltfItem& mesh) const {
    if (m_document.count(node, "skin")) return "its skin is passed over: the vertices are where they are without it";
    const auto isMorphed = [](const GltfItem& item) {
      const auto weights = item.json->find("weights");
      return weights != item.json->end() && weights->is_array() &&
             std::any_of(weights->begin(), weights->end(), [](const nlohmann::json& weight) { return weight != 0; });
    };
    const bool hasOwn = node.json->contains("weights");
    if (!isMorphed(hasOwn ? node : mesh)) return {};
    return "its morph targets are passed over: the vertices are where they are without them";
  }

  void addPrimitive(MeshObject& object, const GltfItem& primitive, const Transform& world) const {
    if (m_document.hasExtension(primitive, "KHR_draco_mesh_compression"))
      m_document.fail(primitive.name + " is compressed by KHR_draco_mesh_compression, which is not read");
    const std::uint64_t mode = m_document.count(primitive, "mode").value_or(std::uint64_t{4});
    if (mode > static_cast<std::uint64_t>(Mode::TriangleFan)) m_document.fail(primitive.name + " has an unknown mode");
    const auto attributes = m_document.part(primitive, "attributes");
    const auto position = attributes ? m_document.count(*attributes, "POSITION") : std::nullopt;
    if (!position) return;  // shows nothing
    const std::size_t base = object.positions.size();
    addPositions(object, primitive, *position, world);
    const std::vector<std::uint32_t> corners = cornersOf(object, primitive, base);
    m_document.scope().takeElements(corners.size(), sizeof(object.triangles[0]));
    if (static_cast<Mode>(mode) == Mode::Triangles && corners.size() % 3 != 0)
      m_document.fail(fmt::format("{} has {} corners, no whole number of triangles", primitive.name, corners.size()));
    if (static_cast<Mode>(mode) == Mode::Lines && corners.size() % 2 != 0)
      m_document.fail(fmt::format("{} has {} corners, no whole number of lines", primitive.name, corners.size()));
    ElementBuilder(object, corners).add(static_cast<Mode>(mode));
  }

  void addPositions(MeshObject& object, const GltfItem& primitive, std::uint64_t accessor,
                    const Transform& world) const {
    const std::vector<double> numbers = readGltfAccessor(m_document, accessor, 3);
    const std::size_t count = numbers.size() / 3;
    if (object.positions.size() + count > std::numeric_limits<std::uint32_t>::max()) {
      m_document.fail(primitive.name + " has too many vertices");
    }
    m_document.scope().takeElements(count, sizeof(Point));
    for (std::size_t i = 0; i < count; ++i) {
      const Point point = placed(world, {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]});
      if (!std::all_of(point.begin(), point.end(), [](double x) { return std::isfinite(x); })) {
        m_document.fail(primitive.name + " has a coordinate that is no finite number");
      }
      object.positions.push_back(point);
    }
  }

  /// The vertices of a primitive in the order in which its elements use them.
  std::vector<std::uint32_t> cornersOf(const MeshObject& object, const GltfItem& primitive, std::size_t base) const {
    const std::size_t count = object.positions.size() - base;
    std::vector<std::uint32_t> corners;
    if (const auto accessor = m_document.count(primitive, "indices")) {
      const std::vector<double> indices = readGltfAccessor(m_document, *accessor, 1);
      corners.reserve(indices.size());
      for (const double index : indices) {
        if (!(index >= 0.0) || index >= static_cast<double>(count) || index != std::floor(index)) {
          m_document.fail(primitive.name + " names a vertex that isn't there");
        }
        corners.push_back(static_cast<std::uint32_t>(base + static_cast<std::size_t>(index)));
      }
    } else {
      corners.resize(count);
      std::iota(corners.begin(), corners.end(), static_cast<std::uint32_t>(base));
    }
    return corners;
  }

  GltfDocument& m_document;
  std::vector<bool> m_isSeen;
  std::vector<NestedNode> m_nodes;
  std::vector<std::size_t> m_places;  ///< Of each object its node's in that list.
  std::vector<MeshObject> m_objects;
};

}  // namespace

std::vector<MeshObject> readGltfObjects(const std::filesystem::path& path, ReadScope& scope, FileNotes& notes) {
  GltfDocument document(path, scope);
  auto objects = GltfNodeReader(document).read();
  notes.frame = {.up = 2, .metresPerUnit = 1.0};  // as its specification has it
  if (document.size("animations") != 0)
    notes.passedOver.emplace_back("its animations are passed over: nodes are where they are without them");
  if (const std::size_t scenes = document.size("scenes"); scenes > 1) {
    const bool isNamed = document.root().contains("scene");
    notes.passedOver.push_back(fmt::format("{} of its {} scenes {} passed over: only {} is read", scenes - 1, scenes,
                                           scenes == 2 ? "is" : "are", isNamed ? "the one to be shown" : "the first"));
  }
  return objects;
}

}  // namespace allpairs::scene
