// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>
#include <span>

#include "input/FileBytes.h"
#include "input/Words.h"
#include "mesh/ObjParser.h"
#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {
namespace {

/// Reads faces and lines as SOFA's loader does. What stands in the file no message repeats, as in TextScanner.
class ObjReader final : ObjParser {
 public:
  ObjReader(const std::filesystem::path& path, const ObjOptions& options, const StopFlag* stop)
      : ObjParser(path, {.elements = "fl", .joinsLines = false, .readsSeams = true}),
        m_options(options),
        m_stop(stop) {}

  Mesh read(std::string_view text) {
    parse(text);
    if (m_mesh.positions.empty()) {
      const auto lastLine = static_cast<std::size_t>(std::ranges::count(text, '\n')) + 1;
      failAt(lastLine, "this is no Wavefront mesh: it has no line of 'v' with a point");
    }
    if (m_options.splitSeams) splitSeams();
    for (const auto& face : m_faces) addFace(face);
    return std::move(m_mesh);
  }

 private:
  void addPosition(std::string_view coordinates) override {
    checkStop(m_stop);
    Vec3 position{};
    for (auto& coordinate : position) {
      const auto word = takeWord(coordinates, isBlank);
      if (word.empty()) fail("a number is missing");
      const auto value = parseFinite(word);
      if (!value) fail("what stands here is not a finite number");
      coordinate = *value;
    }
    m_mesh.positions.push_back(position);
  }

  void addElement(char /*kind*/, std::span<const ObjCorner> corners) override {
    checkStop(m_stop);
    if (corners.size() >= 2) m_faces.push_back({line(), {corners.begin(), corners.end()}});
  }

  void beginObject(std::string_view /*keyword*/, std::string_view /*name*/) override {}

  [[noreturn]] void refuse(ObjProblem problem, std::string_view /*index*/) const override {
    switch (problem) {
      case ObjProblem::NoPosition:
        fail("a face without a point");
      case ObjProblem::IsZero:
        fail("indices count from 1, this one is 0");
      case ObjProblem::BeforeFirst:
        fail("an index reaches back before the first point");
      default:
        fail("what stands here is not an integer");
    }
  }

  /// A face, or a line, and where it stands: points may come after it.
  struct Face {
    std::size_t line;
    std::vector<ObjCorner> corners;
  };

  std::size_t pointOf(const Face& face, std::size_t corner, std::size_t count) const {
    const auto point = static_cast<std::size_t>(face.corners[corner].position);
    if (point >= count) failAt(face.line, "a face names a point that isn't there");
    return point;
  }

  /// Renumbers the points so that each has one texture coordinate and one normal; points of no face disappear.
  void splitSeams() {
    std::vector<std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t>> uses(m_mesh.positions.size());
    const auto useOf = [&](const Face& face, std::size_t i) -> std::int64_t& {
      return uses[pointOf(face, i, uses.size())][{face.corners[i].texture, face.corners[i].normal}];
    };
    for (const auto& face : m_faces)
      for (std::size_t i = 0; i < face.corners.size(); ++i) useOf(face, i) = 0;
    std::vector<Vec3> positions;
    for (std::size_t i = 0; i < uses.size(); ++i)
      for (auto& [combination, index] : uses[i]) {
        index = static_cast<std::int64_t>(positions.size());
        positions.push_back(m_mesh.positions[i]);
      }
    for (auto& face : m_faces)
      for (std::size_t i = 0; i < face.corners.size(); ++i) face.corners[i].position = useOf(face, i);
    m_mesh.positions = std::move(positions);
  }

  void addFace(const Face& face) {
    const auto& corners = face.corners;
    const auto at = [&](std::size_t i) { return static_cast<Index>(pointOf(face, i, m_mesh.positions.size())); };
    if (corners.size() == 2) {
      m_mesh.edges.push_back(sorted<2>({at(0), at(1)}));
    } else if (corners.size() == 4 && !m_options.triangulate) {
      m_mesh.quads.push_back({at(0), at(1), at(2), at(3)});
    } else {
      for (std::size_t i = 2; i < corners.size(); ++i) m_mesh.triangles.push_back({at(0), at(i - 1), at(i)});
    }
  }

  ObjOptions m_options;
  const StopFlag* m_stop;
  Mesh m_mesh;
  std::vector<Face> m_faces;
};

}  // namespace

Mesh readObj(const std::filesystem::path& path, const ObjOptions& options, const StopFlag* stop) {
  const std::string text = readText(path, stop);
  refuseUtf16(text, path);
  return ObjReader(path, options, stop).read(text);
}

}  // namespace allpairs::scene::sofa
