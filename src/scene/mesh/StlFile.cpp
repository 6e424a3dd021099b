// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string_view>

#include "allpairs/scene/FileError.h"
#include "input/ByteOrder.h"
#include "input/FileBytes.h"
#include "input/Words.h"
#include "mesh/MeshObject.h"
#include "mesh/Position.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kHeaderSize = 84;  // eighty bytes of anything, and the number of facets
constexpr std::size_t kFacetSize = 50;   // a normal, three corners, and two bytes that mean nothing
constexpr std::size_t kNormalSize = 12;

/// Adds a triangle of the last three positions.
void addTriangle(MeshObject& object) {
  const auto last = static_cast<std::uint32_t>(object.positions.size());
  object.triangles.push_back({last - 3, last - 2, last - 1});
}

std::uint64_t binarySize(std::string_view text) {
  return kHeaderSize + std::uint64_t{kFacetSize} * littleEndian<std::uint32_t>(text.substr(kHeaderSize - 4));
}

/// Binary files may begin with "solid" too; then their size gives them away, or a byte of their header that no text has,
/// which most have in their number of facets.
bool isBinary(std::string_view text) {
  if (text.size() >= kHeaderSize && text.size() >= binarySize(text)) {
    const bool isText = text.substr(0, kHeaderSize).find('\0') == std::string_view::npos;
    if (!isText || text.size() == binarySize(text)) return true;
  }
  if (text.size() >= kHeaderSize && text.substr(kHeaderSize - 4, 4).find('\0') != std::string_view::npos) return true;
  const std::size_t first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");  // or the mark of a text in UTF-8
  return first == std::string_view::npos || lowerCase(text.substr(first, 5)) != "solid";
}

/// What stands behind the facets may be no geometry: some programs add a few bytes, too few for a facet.
void checkRest(std::string_view rest, std::uint32_t count, const Path& path) {
  if (rest.size() < kFacetSize || isFilling(rest)) return;
  if (rest.size() % kFacetSize == 0)
    throw FileError(path, "has " + std::to_string(count + rest.size() / kFacetSize) + " facets where its header says " +
                              std::to_string(count));
  throw FileError(path, "has " + std::to_string(rest.size()) + " bytes behind the " + std::to_string(count) +
                            " facets that its header promises; a binary STL file holds one solid");
}

std::vector<MeshObject> readBinary(std::string_view text, const Path& path, ReadScope& scope) {
  if (text.size() < kHeaderSize) throw FileError(path, "is too short for an STL file");
  if (text.size() < binarySize(text))
    throw FileError(path, "truncated: the header promises " + std::to_string(binarySize(text)) +
                              " bytes, the file has " + std::to_string(text.size()));
  const std::uint32_t count = littleEndian<std::uint32_t>(text.substr(kHeaderSize - 4));
  checkRest(text.substr(binarySize(text)), count, path);
  if (count > std::numeric_limits<std::uint32_t>::max() / 3) throw FileError(path, "has too many facets");
  scope.takeElements(count, 3 * sizeof(Point) + sizeof(MeshObject::triangles[0]));
  MeshObject object;
  for (std::size_t facet = 0; facet < count; ++facet) {
    std::string_view bytes = text.substr(kHeaderSize + facet * kFacetSize + kNormalSize);
    for (int corner = 0; corner < 3; ++corner) {
      Point& position = object.positions.emplace_back();
      for (double& coordinate : position) {
        coordinate = static_cast<double>(littleEndian<float>(bytes));
        if (!std::isfinite(coordinate)) {
          throw FileError(path, "facet " + std::to_string(facet) + " has a coordinate that is no finite number");
        }
        bytes.remove_prefix(sizeof(float));
      }
    }
    addTriangle(object);
  }
  return {std::move(object)};
}

/// Where in a line a facet begins, or its length: behind the name of a solid, which may be any words but "facet normal"
/// with a number.
std::size_t facetIn(std::string_view line) {
  std::string_view rest = line;
  for (auto word = takeWord(rest, isBlank); !word.empty(); word = takeWord(rest, isBlank)) {
    if (lowerCase(word) != "facet") continue;
    std::string_view next = rest;
    if (lowerCase(takeWord(next, isBlank)) == "normal" && parseNumber(takeWord(next, isBlank)))
      return static_cast<std::size_t>(word.data() - line.data());
  }
  return line.size();
}

class TextReader {
 public:
  TextReader(std::string_view text, const Path& path, ReadScope& scope) : m_rest(text), m_path(path), m_scope(scope) {}

  std::vector<MeshObject> read() {
    while (!m_rest.empty()) {
      ++m_line;
      readLine(trimmed(takeLine(m_rest)));
    }
    if (m_isInSolid) fail("ends within a solid: there is no 'endsolid'");
    return std::move(m_objects);
  }

 private:
  /// The words of a facet may stand in one line or in several.
  void readLine(std::string_view line) {
    bool isFirst = true;
    for (auto word = takeWord(line); !word.empty(); word = takeWord(line), isFirst = false) {
      const std::string keyword = lowerCase(word);
      if (isFirst && keyword == "solid") {
        line = beginSolid(line);
      } else if (isFirst && keyword == "color") {
        line.remove_prefix(facetIn(line));
      } else if (keyword == "vertex") {
        addPosition(line);
      } else if (keyword == "facet") {
        requireCorners(0);
        while (!word.empty() && lowerCase(word) != "outer") word = takeWord(line);  // the normal means nothing
      } else if (keyword == "endfacet") {
        requireCorners(3);
        addTriangle(m_objects.back());
        m_corners = 0;
      } else if (keyword == "endsolid") {
        return endSolid(line);
      } else if (keyword != "outer" && keyword != "loop" && keyword != "endloop") {
        fail(quotedWord(word) + " is no word of STL");
      }
    }
  }

  /// Returns what stands behind its name.
  std::string_view beginSolid(std::string_view line) {
    if (m_isInSolid) fail("a solid begins within another");
    m_isInSolid = true;
    const std::size_t facet = facetIn(line);
    m_scope.takeElements(1, sizeof(MeshObject) + facet);
    m_objects.emplace_back().name = std::string(trimmed(line.substr(0, facet)));
    return line.substr(facet);
  }

  void endSolid(std::string_view name) {
    requireCorners(0);
    if (facetIn(name) < name.size()) fail("a facet stands behind the end of a solid, in one line");
    m_isInSolid = false;
  }

  void requireCorners(std::size_t count) const {
    if (!m_isInSolid) fail("a facet or its end stands outside of any solid");
    if (m_corners != count) fail("a facet has three vertices, not " + std::to_string(m_corners));
  }

  void addPosition(std::string_view& line) {
    if (!m_isInSolid) fail("a vertex stands outside of any solid");
    ++m_corners;
    m_scope.takeElements(1, sizeof(Point) + sizeof(MeshObject::triangles[0]));
    m_objects.back().positions.push_back(
        takePosition(line, "a vertex", [this](const std::string& problem) { fail(problem); }));
  }

  [[noreturn]] void fail(const std::string& problem) const { throw FileError(m_path, problem, m_line); }

  std::string_view m_rest;
  const Path& m_path;
  ReadScope& m_scope;
  std::size_t m_line = 0;
  bool m_isInSolid = false;
  std::size_t m_corners = 0;
  std::vector<MeshObject> m_objects;
};

}  // namespace

std::vector<MeshObject> readStlObjects(const Path& path, ReadScope& scope) {
  std::string text = readText(path, scope.stop());
  if (text.size() < kHeaderSize || text.size() < binarySize(text)) refuseUtf16(text, path);
  if (isBinary(text)) return readBinary(text, path, scope);
  makeLines(text);
  return TextReader(text, path, scope).read();
}

}  // namespace allpairs::scene
