// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "input/FileBytes.h"
#include "mesh/Faces.h"
#include "mesh/MeshObject.h"
#include "mesh/ObjParser.h"
#include "mesh/Position.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

class ObjReader final : ObjParser {
 public:
  ObjReader(const Path& path, ReadScope& scope)
      : ObjParser(path, {.elements = "flp",
                         .joinsLines = true,
                         .endsInComments = true,
                         .readsSeams = false,
                         .maxIndex = kUnused - 1}),
        m_scope(scope) {}

  std::vector<MeshObject> read(std::string_view text) {
    m_objectKeyword = hasStatement(text, "o") ? "o" : "g";
    m_objects.emplace_back();
    parse(text);
    return finish();
  }

 private:
  void addPosition(std::string_view coordinates) override {
    m_scope.takeElements(1, sizeof(Point));
    m_positions.push_back(
        takePosition(coordinates, "a position", [this](const std::string& problem) { fail(problem); }));
  }

  void addElement(char kind, std::span<const ObjCorner> corners) override {
    m_scope.takeElements(corners.size(), sizeof(MeshObject::triangles[0]));
    MeshObject& object = m_objects[m_current];
    if (corners.empty()) fail("an element has no vertices");
    for (const ObjCorner& corner : corners) {
      if (corner.position >= m_highest.index) m_highest = {corner.position, line()};
    }
    const auto vertex = [corners](std::size_t i) { return static_cast<std::uint32_t>(corners[i].position); };
    if (kind == 'p' || corners.size() == 1) {
      for (std::size_t i = 0; i < corners.size(); ++i) object.points.push_back(vertex(i));
    } else if (kind == 'l' || corners.size() == 2) {
      for (std::size_t i = 1; i < corners.size(); ++i) object.lines.push_back({vertex(i - 1), vertex(i)});
    } else {
      m_corners.clear();
      for (std::size_t i = 0; i < corners.size(); ++i) m_corners.push_back(vertex(i));
      addFace(object, m_corners);
      const Fan fan{m_current, object.triangles.size() - (corners.size() - 2), corners.size() - 2, line()};
      const bool hasPositions = *std::max_element(m_corners.begin(), m_corners.end()) < m_positions.size();
      if (hasPositions) {
        cut(fan);
      } else if (fan.count > 1) {
        m_fans.push_back(fan);
      }
    }
  }

  /// The triangles of a face.
  struct Fan {
    std::size_t object;
    std::size_t first;
    std::size_t count;
    std::size_t line;
  };

  void cut(const Fan& fan) {
    const auto triangles = std::span(m_objects[fan.object].triangles).subspan(fan.first, fan.count);
    const std::string problem = cutFan(m_positions, triangles, m_scope);
    if (!problem.empty()) failAt(fan.line, problem);
  }

  /// An "o" always begins an object; a "g" may go back to one of before.
  void beginObject(std::string_view keyword, std::string_view text) override {
    if (keyword != m_objectKeyword) return;
    std::string name(text);
    if (m_objectKeyword == "g") {
      const auto [known, isNew] = m_groups.try_emplace(name, m_objects.size());
      m_current = known->second;
      if (!isNew) return;
    }
    m_scope.takeElements(1, sizeof(MeshObject) + name.size());
    m_current = m_objects.size();
    m_objects.emplace_back().name = std::move(name);
  }

  /// Shapes that would be missing; what else there is tells of looks.
  void passOver(std::string_view keyword) override {
    constexpr std::array<std::string_view, 9> kShapes{"bsp", "bzp", "call", "cdc", "cdp", "curv", "fo", "res", "surf"};
    if (std::find(kShapes.begin(), kShapes.end(), keyword) == kShapes.end()) return;
    fail("'" + std::string(keyword) + "' is not read: export the file with faces and lines alone");
  }

  [[noreturn]] void refuse(ObjProblem problem, std::string_view index) const override {
    if (problem == ObjProblem::NoNumber || problem == ObjProblem::NoPosition) {
      fail("'" + std::string(index) + "' is no index");
    }
    fail("index " + std::string(index) + " names no vertex");
  }

  std::vector<MeshObject> finish() {
    if (m_highest.index >= static_cast<std::int64_t>(m_positions.size())) {
      failAt(m_highest.line, "index " + std::to_string(m_highest.index + 1) + " names no vertex: the file has " +
                                 std::to_string(m_positions.size()));
    }
    std::for_each(m_fans.begin(), m_fans.end(), [this](const Fan& fan) { cut(fan); });
    std::erase_if(m_objects, [](const MeshObject& object) { return !object.hasElements(); });
    if (m_objects.empty() && !m_positions.empty()) return {allPoints()};
    if (m_objects.size() == 1) {  // keeps the numbers of its vertices, by which others may refer to them
      m_objects[0].positions = std::move(m_positions);
      return std::move(m_objects);
    }
    m_localIndex.assign(m_positions.size(), kUnused);
    for (MeshObject& object : m_objects) compact(object);
    return std::move(m_objects);
  }

  MeshObject allPoints() {
    MeshObject object;
    object.positions = std::move(m_positions);
    object.addAllPoints();
    return object;
  }

  /// Gives the object its own positions, only those that it uses, in the order of the file.
  void compact(MeshObject& object) {
    std::vector<std::uint32_t> used;
    forEachIndex(object, [&](std::uint32_t& index) {
      if (m_localIndex[index] == kUnused) used.push_back(index);
      m_localIndex[index] = 0;
    });
    std::sort(used.begin(), used.end());
    for (std::size_t i = 0; i < used.size(); ++i) m_localIndex[used[i]] = static_cast<std::uint32_t>(i);
    forEachIndex(object, [&](std::uint32_t& index) { index = m_localIndex[index]; });
    for (const std::uint32_t index : used) {
      object.positions.push_back(m_positions[index]);
      m_localIndex[index] = kUnused;
    }
  }

  template <class Visit>
  static void forEachIndex(MeshObject& object, const Visit& visit) {
    for (auto& triangle : object.triangles) std::for_each(triangle.begin(), triangle.end(), visit);
    for (auto& line : object.lines) std::for_each(line.begin(), line.end(), visit);
    std::for_each(object.points.begin(), object.points.end(), visit);
  }

  static constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

  struct Highest {
    std::int64_t index = -1;
    std::size_t line = 0;
  };

  ReadScope& m_scope;
  std::string_view m_objectKeyword;
  std::vector<Point> m_positions;
  std::vector<MeshObject> m_objects;
  std::map<std::string, std::size_t> m_groups;
  std::size_t m_current = 0;
  std::vector<std::uint32_t> m_corners;
  std::vector<Fan> m_fans;  ///< Those whose positions were not known yet.
  std::vector<std::uint32_t> m_localIndex;
  Highest m_highest;
};

}  // namespace

std::vector<MeshObject> readObjObjects(const Path& path, ReadScope& scope) {
  std::string text = readText(path, scope.stop());
  refuseUtf16(text, path);
  makeLines(text);
  return ObjReader(path, scope).read(text);
}

}  // namespace allpairs::scene
