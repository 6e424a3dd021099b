// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <limits>
#include <map>
#include <string_view>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/Words.h"
#include "mesh/MeshObject.h"
#include "mesh/Position.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

bool isKeyword(std::string_view line, std::string_view keyword) {
  const std::string_view text = trimmed(line);
  return text.starts_with(keyword) &&
         (text.size() == keyword.size() || kBlanks.find(text[keyword.size()]) != std::string_view::npos);
}

/// Calls visit(line, number) for each line; one that ends in a backslash goes on in the next.
template <class Visit>
void forEachLine(const std::string& text, Visit visit) {
  std::string_view rest = text;
  std::string joined;
  for (std::size_t number = 1; !rest.empty(); ++number) {
    std::string_view line = trimmed(takeLine(rest));
    const bool goesOn = line.ends_with('\\') && !rest.empty();
    if (goesOn) line.remove_suffix(1);
    if (goesOn || !joined.empty()) {
      joined.append(line).append(" ");
      line = joined;
    }
    if (goesOn) continue;
    visit(line, number);
    joined.clear();
  }
}

class ObjReader {
 public:
  ObjReader(const Path& path, ReadScope& scope) : m_path(path), m_scope(scope) {}

  std::vector<MeshObject> read() {
    const std::string text = readText(m_path);
    bool hasObjects = false;
    forEachLine(text, [&](std::string_view line, std::size_t) { hasObjects |= isKeyword(line, "o"); });
    m_objectKeyword = hasObjects ? "o" : "g";
    m_objects.emplace_back();
    forEachLine(text, [this](std::string_view line, std::size_t number) { readLine(line, number); });
    return finish();
  }

 private:
  void readLine(std::string_view line, std::size_t number) {
    m_line = number;
    const std::string_view keyword = takeWord(line);
    if (keyword == "v") {
      addPosition(line);
    } else if (keyword == "f" || keyword == "l" || keyword == "p") {
      readElement(keyword.front(), line);
    } else if (keyword == m_objectKeyword) {
      beginObject(std::string(trimmed(line)));
    }
  }

  void addPosition(std::string_view line) {
    m_scope.takeElements(1, sizeof(Point));
    m_positions.push_back(readPosition(line, "a position", [this](const std::string& problem) { fail(problem); }));
  }

  void readElement(char kind, std::string_view line) {
    std::vector<std::uint32_t>& corners = m_corners;
    corners.clear();
    for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line)) {
      corners.push_back(resolve(word.substr(0, word.find('/'))));
    }
    m_scope.takeElements(corners.size(), sizeof(MeshObject::triangles[0]));
    MeshObject& object = m_objects[m_current];
    if (corners.empty()) fail("an element has no vertices");
    if (kind == 'p' || corners.size() == 1) {
      object.points.insert(object.points.end(), corners.begin(), corners.end());
    } else if (kind == 'l' || corners.size() == 2) {
      for (std::size_t i = 1; i < corners.size(); ++i) object.lines.push_back({corners[i - 1], corners[i]});
    } else {
      for (std::size_t i = 2; i < corners.size(); ++i)
        object.triangles.push_back({corners[0], corners[i - 1], corners[i]});
    }
  }

  /// Indices count from 1, negative ones back from the last position so far.
  std::uint32_t resolve(std::string_view word) {
    std::int64_t index = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (problem != std::errc() || end != word.data() + word.size()) fail("'" + std::string(word) + "' is no index");
    const auto count = static_cast<std::int64_t>(m_positions.size());
    const std::int64_t resolved = index > 0 ? index - 1 : index + count;
    if (index == 0 || resolved < 0 || resolved >= std::int64_t{std::numeric_limits<std::uint32_t>::max()}) {
      fail("index " + std::string(word) + " names no vertex");
    }
    if (resolved >= m_highest.index) m_highest = {resolved, m_line};
    return static_cast<std::uint32_t>(resolved);
  }

  /// An "o" always begins an object; a "g" may go back to one of before.
  void beginObject(std::string name) {
    if (m_objectKeyword == "g") {
      const auto [known, isNew] = m_groups.try_emplace(name, m_objects.size());
      m_current = known->second;
      if (!isNew) return;
    }
    m_scope.takeElements(1, sizeof(MeshObject) + name.size());
    m_current = m_objects.size();
    m_objects.emplace_back().name = std::move(name);
  }

  std::vector<MeshObject> finish() {
    if (m_highest.index >= static_cast<std::int64_t>(m_positions.size())) {
      m_line = m_highest.line;
      fail("index " + std::to_string(m_highest.index + 1) + " names no vertex: the file has " +
           std::to_string(m_positions.size()));
    }
    std::erase_if(m_objects, [](const MeshObject& object) {
      return object.triangles.empty() && object.lines.empty() && object.points.empty();
    });
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
    for (std::uint32_t i = 0; i < object.positions.size(); ++i) object.points.push_back(i);
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

  [[noreturn]] void fail(const std::string& problem) const { throw FileError(m_path, problem, m_line); }

  static constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();

  struct Highest {
    std::int64_t index = -1;
    std::size_t line = 0;
  };

  const Path& m_path;
  ReadScope& m_scope;
  std::size_t m_line = 0;
  std::string_view m_objectKeyword;
  std::vector<Point> m_positions;
  std::vector<MeshObject> m_objects;
  std::map<std::string, std::size_t> m_groups;
  std::size_t m_current = 0;
  std::vector<std::uint32_t> m_corners;
  std::vector<std::uint32_t> m_localIndex;
  Highest m_highest;
};

}  // namespace

std::vector<MeshObject> readObjObjects(const Path& path, ReadScope& scope) { return ObjReader(path, scope).read(); }

}  // namespace allpairs::scene
