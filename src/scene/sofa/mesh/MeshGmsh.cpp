// SPDX-License-Identifier: MIT
#include <set>
#include <unordered_map>

#include "input/TextScanner.h"
#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {
namespace {

/// Reads the ASCII forms 1, 2 and 4.1 of Gmsh's meshes. Of form 4.1 SOFA numbers nodes in the order of the file.
/// Reference: Gmsh reference manual, "MSH file format" and "Legacy formats".
class GmshReader {
 public:
  GmshReader(const std::filesystem::path& path, const StopFlag* stop) : m_text(path, stop) {}

  Mesh read() {
    bool points = false, elements = false;
    for (auto word = m_text.word(); !word.empty(); word = m_text.word()) {
      if (word == "$MeshFormat")
        readFormat();
      else if (word == "$NOD" || word == "$Nodes")
        points = true, m_form == 4 ? readPointBlocks() : readPoints();
      else if (word == "$ELM" || word == "$Elements")
        elements = true, m_form == 4 ? readElementBlocks() : readElements();
    }
    if (!points) m_text.fail("this is no Gmsh mesh: it has no list of nodes");
    if (!elements) m_text.fail("the list of elements is missing");
    return std::move(m_mesh);
  }

 private:
  static constexpr std::int64_t kPoint = 15;

  void readFormat() {
    const double version = m_text.number();
    constexpr double kBlocks = 4.1;  // 4.0 has its numbers in another order, which SOFA does not read either
    const bool isPlain = version >= 2 && version < 3;
    if (!isPlain && !(version >= kBlocks && version < 5))
      m_text.fail("only the forms 1, 2 and 4.1 of Gmsh meshes can be read");
    if (m_text.integer() != 0) m_text.fail("only Gmsh meshes in ASCII can be read");
    m_form = isPlain ? 2 : 4;
  }

  void readPoints() {
    const auto count = m_text.integer();
    for (std::int64_t i = 0; i < count; ++i) {
      m_indices[m_text.integer()] = static_cast<Index>(m_mesh.positions.size());
      m_mesh.positions.push_back(m_text.point());
    }
    m_text.expect(m_form == 2 ? "$EndNodes" : "$ENDNOD");
  }

  void readPointBlocks() {
    const auto blocks = m_text.integer();
    for (int i = 0; i < 3; ++i) m_text.integer();
    for (std::int64_t block = 0; block < blocks; ++block) {
      for (int i = 0; i < 3; ++i) m_text.integer();
      const auto count = m_text.integer();
      for (std::int64_t i = 0; i < count; ++i) m_text.integer();
      for (std::int64_t i = 0; i < count; ++i) {
        m_indices[static_cast<std::int64_t>(m_mesh.positions.size()) + 1] = static_cast<Index>(m_mesh.positions.size());
        m_mesh.positions.push_back(m_text.point());
        m_text.skipLine();  // Parametric coordinates may follow.
      }
    }
    m_text.expect("$EndNodes");
  }

  void readElementBlocks() {
    const auto blocks = m_text.integer();
    for (int i = 0; i < 3; ++i) m_text.integer();
    for (std::int64_t block = 0; block < blocks; ++block) {
      for (int i = 0; i < 2; ++i) m_text.integer();
      const auto type = m_text.integer();
      for (auto count = m_text.integer(); count > 0; --count) {
        m_text.integer();
        m_corners.clear();
        for (auto corners = cornersOf(type); corners > 0; --corners) m_corners.push_back(pointIndex());
        if (!addElement(type)) m_text.skipLine();
      }
    }
    m_text.expect("$EndElements");
  }

  void readElements() {
    const auto count = m_text.integer();
    for (std::int64_t i = 0; i < count; ++i) readElement();
    m_text.expect(m_form == 2 ? "$EndElements" : "$ENDELM");
  }

  void readElement() {
    m_text.integer();
    const auto type = m_text.integer();
    std::int64_t corners = 0;
    if (m_form == 1) {
      m_text.integer();
      m_text.integer();
      corners = m_text.integer();
    } else {
      for (auto tags = m_text.integer(); tags > 0; --tags) m_text.integer();
      corners = cornersOf(type);
    }
    m_corners.clear();
    for (; corners > 0; --corners) m_corners.push_back(pointIndex());
    if (static_cast<std::int64_t>(m_corners.size()) < cornersOf(type)) m_text.fail("an element has too few nodes");
    if (!addElement(type)) m_text.skipLine();
  }

  static std::int64_t cornersOf(std::int64_t type) {
    switch (type) {
      case kPoint:
        return 1;
      case 1:
        return 2;
      case 2:
      case 8:
        return 3;
      case 3:
      case 4:
        return 4;
      case 5:
        return 8;
      case 9:
        return 6;
      case 11:
        return 10;
      default:
        return 0;
    }
  }

  Index pointIndex() {
    const auto found = m_indices.find(m_text.integer());
    if (found == m_indices.end()) m_text.fail("an element names a node that isn't there");
    return found->second;
  }

  bool addElement(std::int64_t type) {
    const auto& c = m_corners;
    switch (type) {
      case 1:
      case 8:
        m_mesh.edges.push_back({c[0], c[1]});
        return true;
      case 2:
        m_mesh.triangles.push_back({c[0], c[1], c[2]});
        return true;
      case 3:
        m_mesh.quads.push_back({c[0], c[1], c[2], c[3]});
        return true;
      case 4:
        m_mesh.tetrahedra.push_back({c[0], c[1], c[2], c[3]});
        return true;
      case 5:
        m_mesh.hexahedra.push_back({c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]});
        return true;
      case 9:
        m_mesh.triangles.push_back({c[0], c[1], c[2]});
        addEdges({{0, 1}, {1, 2}, {2, 0}});
        return true;
      case 11:
        m_mesh.tetrahedra.push_back({c[0], c[1], c[2], c[3]});
        addEdges({{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}});
        return true;
      case kPoint:
        return false;
      default:
        ++m_mesh.passedOver;
        return false;
    }
  }

  /// Elements of the second order bring their edges along; those of form 4.1 each edge once in all.
  void addEdges(std::initializer_list<std::array<std::size_t, 2>> edges) {
    if (m_form != 4) m_seen.clear();
    for (const auto& [a, b] : edges) {
      const auto edge = sorted<2>({m_corners[a], m_corners[b]});
      if (m_seen.insert(edge).second) m_mesh.edges.push_back(edge);
    }
  }

  TextScanner m_text;
  int m_form = 1;
  Mesh m_mesh;
  std::unordered_map<std::int64_t, Index> m_indices;
  std::vector<Index> m_corners;
  std::set<std::array<Index, 2>> m_seen;
};

}  // namespace

Mesh readGmsh(const std::filesystem::path& path, const StopFlag* stop) { return GmshReader(path, stop).read(); }

}  // namespace allpairs::scene::sofa
