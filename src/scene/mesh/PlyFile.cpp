// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "allpairs/scene/FileError.h"
#include "input/ByteOrder.h"
#include "input/FileBytes.h"
#include "input/Words.h"
#include "mesh/Faces.h"
#include "mesh/MeshObject.h"
#include "mesh/PlyHeader.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

/// Gives the numbers of a body one after the other, whatever its encoding.
class PlyBody {
 public:
  PlyBody(std::string_view text, const PlyHeader& header, const Path& path)
      : m_text(text.substr(header.size)),
        m_encoding(header.encoding),
        m_lineEnd(header.lineEnd),
        m_line(header.lines + 1),
        m_path(path) {}

  /// Of the number that is next; 0 in a binary file.
  std::size_t nextLine() {
    if (m_encoding != PlyEncoding::Ascii) return 0;
    skipBlanks();
    return m_line;
  }

  double next(PlyType type) { return m_encoding == PlyEncoding::Ascii ? nextWord() : nextBinary(type); }

  /// Nothing is left out that stands behind the last number.
  void checkEnd() {
    if (m_encoding != PlyEncoding::Ascii) return requireFilling(m_text, m_path);
    skipBlanks();
    if (!m_text.empty()) fail("has more than its header promises");
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw FileError(m_path, problem, m_encoding == PlyEncoding::Ascii ? m_line : 0);
  }

 private:
  void skipBlanks() {
    std::size_t begin = 0;
    while (begin < m_text.size() && isBlankOrLineEnd(m_text[begin])) {
      if (m_text[begin] == m_lineEnd) ++m_line;
      ++begin;
    }
    m_text.remove_prefix(begin);
  }

  double nextWord() {
    skipBlanks();
    if (m_text.empty()) fail("truncated: its header promises more than the file has");
    const std::string_view word = takeWord(m_text, isBlankOrLineEnd);
    const std::optional<double> value = parseNumber(word);
    if (!value) fail("'" + std::string(word) + "' is not a number");
    return *value;
  }

  double nextBinary(PlyType type) {
    switch (type) {
      case PlyType::Int8:
        return take<std::int8_t>();
      case PlyType::UInt8:
        return take<std::uint8_t>();
      case PlyType::Int16:
        return take<std::int16_t>();
      case PlyType::UInt16:
        return take<std::uint16_t>();
      case PlyType::Int32:
        return take<std::int32_t>();
      case PlyType::UInt32:
        return take<std::uint32_t>();
      case PlyType::Float32:
        return static_cast<double>(take<float>());
      case PlyType::Float64:
        return take<double>();
    }
    return 0.0;
  }

  template <class T>
  T take() {
    if (m_text.size() < sizeof(T)) fail("truncated: its header promises more than the file has");
    const T number =
        numberOf<T>(m_text, m_encoding == PlyEncoding::LittleEndian ? std::endian::little : std::endian::big);
    m_text.remove_prefix(sizeof(T));
    return number;
  }

  std::string_view m_text;
  PlyEncoding m_encoding;
  char m_lineEnd;
  std::size_t m_line;
  const Path& m_path;
};

class PlyReader {
 public:
  PlyReader(const std::string& text, const Path& path, ReadScope& scope)
      : m_path(path), m_scope(scope), m_header(parsePlyHeader(text, path)), m_body(text, m_header, path) {}

  std::vector<MeshObject> read() {
    checkElements();
    for (const PlyElement& element : m_header.elements) {
      if (element.properties.empty()) continue;  // takes no room in the file, however many there are
      for (std::uint64_t row = 0; row < element.count; ++row) {
        m_place = {&element, row, m_body.nextLine()};
        readRow(element);
      }
    }
    m_body.checkEnd();
    const std::size_t vertices = m_object.positions.size();
    if (m_highest.index >= static_cast<double>(vertices)) {
      failAt(m_highest.place, " names vertex " + std::to_string(static_cast<std::uint64_t>(m_highest.index)) + " of " +
                                  std::to_string(vertices));
    }
    for (const Fan& fan : m_fans) {
      const auto triangles = std::span(m_object.triangles).subspan(fan.first, fan.count);
      const std::string problem = cutFan(m_object.positions, triangles, m_scope);
      if (!problem.empty()) failAt(fan.place, " is " + problem);
    }
    if (!m_object.hasElements()) m_object.addAllPoints();
    return {std::move(m_object)};
  }

 private:
  /// What tristrips have is a strip.
  static bool isCorners(const PlyElement& element, const PlyProperty& property) {
    const bool isNamed = property.name == "vertex_indices" || property.name == "vertex_index";
    return isNamed && property.countType && element.name != "vertex";
  }

  static bool isEnd(const PlyProperty& property, std::string_view name) {
    return property.name == name && !property.countType;
  }

  /// Faces, strips and edges whose vertices go by other names would be missing, or lie at the first vertex.
  void checkElements() const {
    for (const PlyElement& element : m_header.elements) {
      if (element.count == 0) continue;
      const auto has = [&](const auto& isWanted) {
        return std::any_of(element.properties.begin(), element.properties.end(), isWanted);
      };
      const bool hasCorners = has([&](const PlyProperty& property) { return isCorners(element, property); });
      if (element.name == "face" && !hasCorners) throw FileError(m_path, "its faces have no list 'vertex_indices'");
      if (element.name == "tristrips" && !hasCorners)
        throw FileError(m_path, "its strips of triangles have no list 'vertex_indices'");
      if (element.name == "tetra" && hasCorners)
        throw FileError(m_path, "has tetrahedra, which are not read: export their surface");
      const auto hasEnd = [&](std::string_view name) {
        return has([name](const PlyProperty& property) { return isEnd(property, name); });
      };
      if (element.name == "edge" && !(hasEnd("vertex1") && hasEnd("vertex2")))
        throw FileError(m_path, "its edges have no numbers 'vertex1' and 'vertex2'");
    }
  }

  void readRow(const PlyElement& element) {
    const bool isVertex = element.name == "vertex";
    const bool isEdge = element.name == "edge";
    Point position{kMissing, kMissing, kMissing};
    std::array<std::uint32_t, 2> ends{};
    for (const PlyProperty& property : element.properties) {
      if (property.countType) {
        readList(element, property);
        continue;
      }
      const double value = m_body.next(property.type);
      if (isVertex && property.name.size() == 1 && property.name >= "x" && property.name <= "z") {
        position[static_cast<std::size_t>(property.name[0] - 'x')] = value;
      }
      if (isEdge && property.name == "vertex1") ends[0] = index(value);
      if (isEdge && property.name == "vertex2") ends[1] = index(value);
    }
    if (isVertex) addPosition(position);
    if (isEdge) m_object.lines.push_back(ends);
  }

  void addPosition(const Point& position) {
    for (const double coordinate : position) {
      if (!std::isfinite(coordinate))
        m_body.fail(m_place.text() + " has a coordinate that is missing or no finite number");
    }
    m_scope.takeElements(1, sizeof(Point));
    m_object.positions.push_back(position);
  }

  void readList(const PlyElement& element, const PlyProperty& property) {
    const double count = m_body.next(*property.countType);
    if (!(count >= 0.0) || count != std::floor(count))
      m_body.fail(m_place.text() + " has a list without a proper length");
    const bool hasCorners = isCorners(element, property);
    const bool isStrip = element.name == "tristrips";
    m_corners.clear();
    for (double i = 0; i < count; ++i) {
      const double value = m_body.next(property.type);
      m_scope.takeElements(1, sizeof(m_object.triangles[0]));
      if (hasCorners && isStrip) addToStrip(value);
      if (hasCorners && !isStrip) m_corners.push_back(index(value));
    }
    if (isStrip) return;
    addFace(m_object, m_corners);
    if (m_corners.size() < 4) return;
    const std::size_t triangles = m_corners.size() - 2;
    m_fans.push_back({m_object.triangles.size() - triangles, triangles, m_place});
  }

  /// Each vertex of a strip makes a triangle with the two before it, which turn the other way in every second one; -1
  /// begins another strip.
  void addToStrip(double value) {
    if (value == -1.0) {
      m_corners.clear();
      return;
    }
    m_corners.push_back(index(value));
    const std::size_t count = m_corners.size();
    if (count < 3) return;
    const std::size_t turn = count % 2 == 0 ? 1 : 0;
    addDrawn(m_object, {m_corners[count - 3 + turn], m_corners[count - 2 - turn], m_corners[count - 1]});
  }

  /// The vertices may come after the faces; whether there are as many as named is asked at the end.
  std::uint32_t index(double value) {
    if (!(value >= 0.0) || value > std::numeric_limits<std::uint32_t>::max() || value != std::floor(value)) {
      m_body.fail(m_place.text() + " has an index that names no vertex");
    }
    if (value > m_highest.index) m_highest = {value, m_place};
    return static_cast<std::uint32_t>(value);
  }

  /// A row of an element of the header, counted from 0.
  struct Place {
    const PlyElement* element = nullptr;
    std::uint64_t row = 0;
    std::size_t line = 0;  ///< In which it begins; 0 in a binary file.

    /// As errors call it: "face 7". A file may give elements any name; only known ones are repeated.
    [[nodiscard]] std::string text() const {
      const bool isKnown = element->name == "vertex" || element->name == "face" || element->name == "edge";
      return (isKnown ? element->name : "element") + ' ' + std::to_string(row);
    }
  };

  /// Of what is only known at the end of the file.
  [[noreturn]] void failAt(const Place& place, const std::string& problem) const {
    throw FileError(m_path, place.text() + problem, place.line);
  }

  struct Highest {
    double index = -1.0;
    Place place;
  };

  /// The triangles of a face, whose vertices may come later.
  struct Fan {
    std::size_t first;
    std::size_t count;
    Place place;
  };

  static constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

  const Path& m_path;
  ReadScope& m_scope;
  PlyHeader m_header;
  PlyBody m_body;
  MeshObject m_object;
  std::vector<std::uint32_t> m_corners;
  std::vector<Fan> m_fans;
  Place m_place;
  Highest m_highest;
};

}  // namespace

std::vector<MeshObject> readPlyObjects(const Path& path, ReadScope& scope) {
  std::string text = readText(path, scope.stop());
  refuseUtf16(text, path);
  removeByteOrderMark(text);
  return PlyReader(text, path, scope).read();
}

}  // namespace allpairs::scene
