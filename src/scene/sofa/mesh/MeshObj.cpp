// SPDX-License-Identifier: MIT
#include <map>
#include <span>

#include "input/TextScanner.h"
#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {
namespace {

/// One corner of a face: position, texture coordinate and normal, -1 where the file gives none.
struct Corner {
  std::int64_t position = -1;
  std::int64_t texture = -1;
  std::int64_t normal = -1;
};

class ObjReader {
 public:
  ObjReader(const std::filesystem::path& path, const ObjOptions& options) : m_text(path), m_options(options) {}

  Mesh read() {
    for (auto word = m_text.word(); !word.empty(); word = m_text.word()) {
      if (word == "v")
        readPosition();
      else if (word == "vn")
        ++m_normals;
      else if (word == "vt")
        ++m_textures;
      else if (word == "f" || word == "l")
        readFace();
      m_text.skipLine();
    }
    if (m_mesh.positions.empty()) m_text.fail("this is no Wavefront mesh: it has no line of 'v' with a point");
    if (m_options.splitSeams) splitSeams();
    for (const auto& face : m_faces) addFace(face);
    return std::move(m_mesh);
  }

 private:
  void readPosition() {
    Vec3 position{};
    for (auto& coordinate : position) coordinate = m_text.toNumber(m_text.wordInLine());
    m_mesh.positions.push_back(position);
  }

  void readFace() {
    std::vector<Corner> corners;
    for (auto word = m_text.wordInLine(); !word.empty(); word = m_text.wordInLine()) corners.push_back(corner(word));
    if (corners.size() >= 2) m_faces.push_back(std::move(corners));
  }

  Corner corner(std::string_view word) const {
    Corner result;
    const auto part = [&word] {
      const auto text = word.substr(0, word.find('/'));
      word.remove_prefix(std::min(text.size() + 1, word.size()));
      return text;
    };
    result.position = resolve(part(), m_mesh.positions.size());
    result.texture = resolve(part(), m_textures);
    result.normal = resolve(part(), m_normals);
    if (result.position < 0) m_text.fail("a face without a point");
    return result;
  }

  std::int64_t resolve(std::string_view text, std::size_t count) const {
    if (text.empty()) return -1;
    const auto index = m_text.toInteger(text);
    if (index == 0) m_text.fail("indices count from 1, this one is 0");
    const auto resolved = index > 0 ? index - 1 : index + static_cast<std::int64_t>(count);
    if (resolved < 0) m_text.fail("an index reaches back before the first point");
    return resolved;
  }

  template <class Uses>
  auto& usesOf(Uses& uses, const Corner& corner) const {
    if (static_cast<std::size_t>(corner.position) >= uses.size()) m_text.fail("a face names a point that isn't there");
    return uses[static_cast<std::size_t>(corner.position)];
  }

  /// Renumbers the points so that each has one texture coordinate and one normal; points of no face disappear.
  void splitSeams() {
    std::vector<std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t>> uses(m_mesh.positions.size());
    for (const auto& face : m_faces)
      for (const auto& corner : face) usesOf(uses, corner)[{corner.texture, corner.normal}] = 0;
    std::vector<Vec3> positions;
    for (std::size_t i = 0; i < uses.size(); ++i)
      for (auto& [combination, index] : uses[i]) {
        index = static_cast<std::int64_t>(positions.size());
        positions.push_back(m_mesh.positions[i]);
      }
    for (auto& face : m_faces)
      for (auto& corner : face) corner.position = usesOf(uses, corner)[{corner.texture, corner.normal}];
    m_mesh.positions = std::move(positions);
  }

  void addFace(std::span<const Corner> corners) {
    const auto at = [&](std::size_t i) {
      if (static_cast<std::size_t>(corners[i].position) >= m_mesh.positions.size())
        m_text.fail("a face names a point that isn't there");
      return static_cast<Index>(corners[i].position);
    };
    if (corners.size() == 2) {
      m_mesh.edges.push_back({std::min(at(0), at(1)), std::max(at(0), at(1))});
    } else if (corners.size() == 4 && !m_options.triangulate) {
      m_mesh.quads.push_back({at(0), at(1), at(2), at(3)});
    } else {
      for (std::size_t i = 2; i < corners.size(); ++i) m_mesh.triangles.push_back({at(0), at(i - 1), at(i)});
    }
  }

  TextScanner m_text;
  ObjOptions m_options;
  Mesh m_mesh;
  std::size_t m_textures = 0;
  std::size_t m_normals = 0;
  std::vector<std::vector<Corner>> m_faces;
};

}  // namespace

Mesh readObj(const std::filesystem::path& path, const ObjOptions& options) { return ObjReader(path, options).read(); }

}  // namespace allpairs::scene::sofa
