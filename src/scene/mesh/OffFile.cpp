// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/Words.h"
#include "mesh/Faces.h"
#include "mesh/MeshObject.h"
#include "mesh/Position.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

class OffReader {
 public:
  OffReader(const std::string& text, const Path& path, ReadScope& scope) : m_rest(text), m_path(path), m_scope(scope) {}

  std::vector<MeshObject> read() {
    readHeader();
    for (std::uint64_t i = 0; i < m_vertices; ++i) addPosition(nextLine());
    for (std::uint64_t i = 0; i < m_faces; ++i) readFace(nextLine());
    if (!findLine().empty()) fail("has more than its header promises");
    if (!m_object.hasElements()) m_object.addAllPoints();
    return {std::move(m_object)};
  }

 private:
  /// The next line that holds more than blanks and a comment; empty where there is none.
  std::string_view findLine() {
    while (!m_rest.empty()) {
      const std::string_view line = takeLine(m_rest);
      ++m_line;
      const std::string_view content = trimmed(line.substr(0, line.find('#')));
      if (!content.empty()) return content;
    }
    return {};
  }

  std::string_view nextLine() {
    const std::string_view line = findLine();
    if (line.empty()) fail("truncated: its header promises more than the file has");
    return line;
  }

  /// OFF, or with prefixes that say what stands behind each position: COFF, NOFF, STOFF, or nothing. The counts may
  /// follow in the same line, in some files without a blank between, or in several.
  void readHeader() {
    std::string_view line = nextLine();
    const std::size_t keyword = line.find("OFF");
    if (keyword != std::string_view::npos && line.find_first_not_of("STCN") == keyword) {
      line = trimmed(line.substr(keyword + 3));
      if (line == "BINARY") fail("is a binary OFF file, which is not read");
    } else if (!isCount(line)) {
      fail("is no OFF file of points in space: its first word is " + quotedWord(takeWord(line)));
    }
    m_vertices = headerCount(line);
    m_faces = headerCount(line);
    if (line.empty()) passOverEdges();
    if (m_vertices > std::numeric_limits<std::uint32_t>::max()) fail("claims more vertices than can be numbered");
  }

  /// Whether a line begins with a count.
  static bool isCount(std::string_view line) {
    std::uint64_t value = 0;
    return parseWhole(takeWord(line), value) == std::errc();
  }

  std::uint64_t headerCount(std::string_view& line) {
    if (line.empty()) line = nextLine();
    const std::uint64_t value = count(line);
    line = trimmed(line);
    return value;
  }

  /// Their number may be missing, or stand in a line of its own.
  void passOverEdges() {
    const auto before = std::pair(m_rest, m_line);
    const std::string_view line = findLine();
    const bool isOneWord = std::none_of(line.begin(), line.end(), isBlank);
    if (!isOneWord || !isCount(line)) std::tie(m_rest, m_line) = before;
  }

  std::uint64_t count(std::string_view& line) {
    const std::string_view word = takeWord(line);
    std::uint64_t value = 0;
    if (parseWhole(word, value) != std::errc()) fail(quotedWord(word) + " is not a number of vertices or faces");
    return value;
  }

  void addPosition(std::string_view line) {
    m_scope.takeElements(1, sizeof(Point));
    m_object.positions.push_back(
        takePosition(line, "a position", [this](const std::string& problem) { fail(problem); }));
  }

  /// How many corners, their indices, and perhaps a colour.
  void readFace(std::string_view line) {
    m_corners.clear();
    const std::uint64_t size = count(line);
    if (size == 0) fail("a face has no vertices");
    while (m_corners.size() < size) {
      const std::string_view word = takeWord(line);
      if (word.empty()) {
        fail("a face names " + std::to_string(m_corners.size()) + " vertices instead of " + std::to_string(size));
      }
      m_scope.takeElements(1, sizeof(m_object.triangles[0]));
      m_corners.push_back(resolve(word));
    }
    const std::string problem = addCutFace(m_object, m_corners, m_scope);
    if (!problem.empty()) fail(problem);
  }

  std::uint32_t resolve(std::string_view word) const {
    std::uint32_t index = 0;
    if (parseWhole(word, index) != std::errc() || index >= m_object.positions.size()) {
      fail("index " + shortWord(word) + " names no vertex: the file has " + std::to_string(m_object.positions.size()));
    }
    return index;
  }

  [[noreturn]] void fail(const std::string& problem) const { throw FileError(m_path, problem, m_line); }

  std::string_view m_rest;
  const Path& m_path;
  ReadScope& m_scope;
  std::size_t m_line = 0;
  std::uint64_t m_vertices = 0;
  std::uint64_t m_faces = 0;
  MeshObject m_object;
  std::vector<std::uint32_t> m_corners;
};

}  // namespace

std::vector<MeshObject> readOffObjects(const Path& path, ReadScope& scope) {
  std::string text = readText(path, scope.stop());
  refuseUtf16(text, path);
  makeLines(text);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) throw FileError(path, "is empty");
  return OffReader(text, path, scope).read();
}

}  // namespace allpairs::scene
