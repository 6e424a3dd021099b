// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/Words.h"
#include "mesh/Faces.h"
#include "mesh/dxf/DxfBlocks.h"
#include "mesh/dxf/DxfEntity.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

/// Metres for each number that $INSUNITS may be; 0 where it is unknown.
double metresOf(std::int64_t unit) {
  constexpr double kSurveyFoot = 1200.0 / 3937.0;
  static constexpr std::array kMetres{0.0,
                                      0.0254,
                                      0.3048,
                                      1609.344,
                                      1e-3,
                                      1e-2,
                                      1.0,
                                      1e3,
                                      2.54e-8,
                                      2.54e-5,
                                      0.9144,
                                      1e-10,
                                      1e-9,
                                      1e-6,
                                      0.1,
                                      10.0,
                                      100.0,
                                      1e9,
                                      149597870700.0,
                                      9460730472580800.0,
                                      3.0856775814913673e16,
                                      kSurveyFoot,
                                      kSurveyFoot / 12.0,
                                      kSurveyFoot * 3.0,
                                      kSurveyFoot * 5280.0};
  const bool isKnown = unit > 0 && unit < static_cast<std::int64_t>(kMetres.size());
  return isKnown ? kMetres[static_cast<std::size_t>(unit)] : 0.0;
}

/// What shows no shape: texts, dimensions, pictures, and what belongs to other entities.
bool isAnnotation(std::string_view kind) {
  return isOneOf(kind, {"ACAD_TABLE",
                        "ARCALIGNEDTEXT",
                        "ATTDEF",
                        "ATTRIB",
                        "DGNUNDERLAY",
                        "DWFUNDERLAY",
                        "GEOPOSITIONMARKER",
                        "IMAGE",
                        "LEADER",
                        "LIGHT",
                        "MLEADER",
                        "MTEXT",
                        "MULTILEADER",
                        "OLE2FRAME",
                        "OLEFRAME",
                        "PDFUNDERLAY",
                        "RTEXT",
                        "SECTION",
                        "SECTIONOBJECT",
                        "SEQEND",
                        "TEXT",
                        "TOLERANCE",
                        "VERTEX",
                        "VIEWPORT",
                        "WIPEOUT"}) ||
         kind.ends_with("DIMENSION");
}

/// Shapes that a drawing cannot be understood without.
bool isSolid(std::string_view kind) {
  return isOneOf(kind, {"3DSOLID", "BODY", "REGION", "MESH"}) || kind.ends_with("SURFACE");
}

/// A transform that turns around z by an angle in degrees: exactly, where that is a multiple of 90.
Transform turn(double degrees) {
  const double angle = std::remainder(degrees, 360.0);
  const double radians = angle * (std::numbers::pi / 180.0);
  double sine = std::sin(radians);
  double cosine = std::cos(radians);
  if (angle == 0.0 || std::abs(angle) == 180.0) sine = 0.0;
  if (std::abs(angle) == 90.0) cosine = 0.0;
  return {{{cosine, -sine, 0.0, 0.0}, {sine, cosine, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}}};
}

class DxfReader {
 public:
  DxfReader(std::string_view text, const Path& path, ReadScope& scope) : m_rest(text), m_path(path), m_scope(scope) {}

  void read() {
    DxfEntity entity(m_path, {}, 0);
    DxfGroup group;
    bool isOfApplication = false;
    while (takeGroup(group)) {
      if (group.code == 0) {
        isOfApplication = false;
        takeEntity(std::exchange(entity, DxfEntity(m_path, group.value, group.line)));
        m_scope.checkStop();
        if (group.value == "EOF") break;
      } else if (entity.kind().empty() && group.code != kComment) {
        throw FileError(m_path, "is no DXF file: it does not begin with a section", group.line);
      } else if (group.code == kApplication) {
        isOfApplication = group.value.starts_with('{');
      } else if (!isOfApplication) {
        if (entity.groups().size() == m_mostGroups) {
          m_scope.takeElements(1, sizeof(DxfGroup));
          ++m_mostGroups;
        }
        entity.add(group);
      }
    }
    takeEntity(entity);
    if (!m_section.empty()) throw FileError(m_path, "ends within its section " + quotedWord(m_section), m_line);
  }

  [[nodiscard]] const std::vector<DxfBlock>& blocks() const { return m_blocks; }
  [[nodiscard]] double metresPerUnit() const { return m_metresPerUnit; }
  /// How many entities of the paper space were left out.
  [[nodiscard]] std::size_t paperEntities() const { return m_paperEntities; }

 private:
  static constexpr std::int64_t kComment = 999;
  static constexpr std::int64_t kApplication = 102;  // begins or ends groups whose codes mean what an application likes
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  struct Vertex {
    Point position{};
    double bulge = 0.0;
    bool isWide = false;
  };

  /// A code and its value, each on a line.
  bool takeGroup(DxfGroup& group) {
    if (m_rest.find_first_not_of(" \t\r\n") == std::string_view::npos) return false;
    const std::string_view code = trimmed(takeLine(m_rest));
    ++m_line;
    if (parseWhole(code, group.code) != std::errc())
      throw FileError(m_path, quotedWord(code) + " is no group code", m_line);
    if (m_rest.empty()) throw FileError(m_path, "truncated: a group without a value", m_line);
    group.value = trimmed(takeLine(m_rest));
    group.line = ++m_line;
    return true;
  }

  void takeEntity(const DxfEntity& entity) {
    const std::string_view kind = entity.kind();
    if (kind.empty()) return;
    if (kind == "SECTION" && m_section.empty()) {
      m_section = entity.text(2);
      if (m_section == "HEADER") readHeader(entity);
      if (m_section == "ENTITIES") m_block = 0;
    } else if (kind == "ENDSEC") {
      finishPolyline();
      m_section.clear();
      m_block = kNone;
      m_isPaperSpace = false;
    } else if (m_section == "BLOCKS" && kind == "BLOCK") {
      finishPolyline();
      beginBlock(entity);
    } else if (m_section == "BLOCKS" && kind == "ENDBLK") {
      finishPolyline();
      m_block = kNone;
      m_isPaperSpace = false;
    } else if (m_block != kNone) {
      addEntity(entity);
    }
  }

  /// The model space and the paper space are blocks too, most often empty ones: what they show is in the section of
  /// entities. Other layouts have theirs in blocks *Paper_Space0, *Paper_Space1, ...; R12 writes $ for the star.
  void beginBlock(const DxfEntity& block) {
    const std::string name = lowerCase(block.text(2));
    m_isPaperSpace = isOneOf(withoutDigits(name), {"*paper_space", "$paper_space"});
    if (m_isPaperSpace || isOneOf(name, {"*model_space", "$model_space"})) {
      m_block = 0;
      return;
    }
    m_scope.takeElements(1, sizeof(DxfBlock));
    m_block = m_blocks.size();
    constexpr std::int64_t kIsElsewhere = 4 | 8;
    m_blocks.push_back({.name = std::string(block.text(2)),
                        .base = block.point(10),
                        .isElsewhere = (block.integer(70) & kIsElsewhere) != 0});
  }

  /// Its variables are groups of the section.
  void readHeader(const DxfEntity& header) {
    bool isUnit = false;
    for (const DxfGroup& group : header.groups()) {
      std::int64_t unit = 0;
      if (group.code == 9) isUnit = group.value == "$INSUNITS";
      if (isUnit && group.code == 70 && parseWhole(group.value, unit) == std::errc()) m_metresPerUnit = metresOf(unit);
    }
  }

  void addEntity(const DxfEntity& entity) {
    const std::string_view kind = entity.kind();
    if (kind == "VERTEX" && m_polyline) {
      m_scope.takeElements(1, sizeof(DxfEntity));
      m_scope.take(entity.groups().size() * sizeof(DxfGroup));
      m_vertices.push_back(entity);
      return;
    }
    finishPolyline();
    const bool isPaper = m_block == 0 && (m_isPaperSpace || entity.integer(67) == 1);
    const bool isHidden = entity.integer(60) == 1;
    if (isPaper && !isAnnotation(kind)) ++m_paperEntities;
    if (isHidden && !isPaper && !isAnnotation(kind)) ++block().hidden;
    if (kind == "POLYLINE") {
      m_polyline = entity;
      m_isPassedOver = isPaper || isHidden;
    }
    if (isPaper || isHidden || kind == "POLYLINE" || isAnnotation(kind)) return;
    if (kind == "INSERT") return addInsert(entity);
    if (kind == "3DFACE") return addFaceEntity(entity);
    if (kind == "SOLID" || kind == "TRACE") return addBand(entity);
    if (kind == "LINE" || kind == "3DLINE") return addLine(entity);
    if (kind == "POINT") return addPath(entity, {{.position = entity.requiredPoint(10)}}, false, kIdentity);
    if (kind == "LWPOLYLINE") return addFlatPolyline(entity);
    if (isSolid(kind)) note(entity, quotedWord(kind) + " is not read; export 3DFACEs");
    ++block().unread[shortWord(kind)];
  }

  DxfBlock& block() { return m_blocks[m_block]; }

  MeshObject& objectOf(const DxfEntity& entity) { return block().layers.of(entity.layer(), m_scope); }

  void note(const DxfEntity& entity, std::string problem) {
    if (block().problemLine != 0) return;
    block().problemLine = entity.line();
    block().problem = std::move(problem);
  }

  void addInsert(const DxfEntity& entity) {
    const auto count = [&entity](std::int64_t code) {
      return static_cast<std::uint64_t>(std::max<std::int64_t>(entity.integer(code, 1), 1));
    };
    m_scope.takeElements(1, sizeof(DxfInsert));
    Transform scale = kIdentity;
    for (std::size_t axis = 0; axis < 3; ++axis)
      scale[axis][axis] = entity.number(41 + static_cast<std::int64_t>(axis), 1.0);
    const Transform turned = multiply(entity.plane(), turn(entity.number(50)));
    Transform place = multiply(turned, scale);
    const Point at = placed(entity.plane(), entity.point(10));
    for (std::size_t axis = 0; axis < 3; ++axis) place[axis][3] = at[axis];
    block().inserts.push_back({.block = std::string(entity.text(2)),
                               .layer = std::string(entity.layer()),
                               .place = place,
                               .columns = count(70),
                               .rows = count(71),
                               .columnStep = placed(turned, {entity.number(44), 0.0, 0.0}),
                               .rowStep = placed(turned, {0.0, entity.number(45), 0.0})});
  }

  /// Adds a point, a line or a face.
  void addShape(const DxfEntity& entity, std::span<const Point> corners) {
    MeshObject& object = objectOf(entity);
    m_scope.takeElements(corners.size(), sizeof(Point) + sizeof(object.triangles[0]));
    m_corners.clear();
    for (const Point& corner : corners) {
      m_corners.push_back(static_cast<std::uint32_t>(object.positions.size()));
      object.positions.push_back(corner);
    }
    const std::string problem = addCutFace(object, m_corners, m_scope);
    if (!problem.empty()) entity.fail(problem);
  }

  void addFaceEntity(const DxfEntity& entity) {
    std::vector<Point> corners{entity.requiredPoint(10), entity.requiredPoint(11), entity.requiredPoint(12)};
    if (entity.has(13)) corners.push_back(entity.point(13));
    if (corners.back() == corners[2]) corners.resize(3);
    addShape(entity, corners);
  }

  /// The third and the fourth corner are across from the first and the second, not behind them.
  void addBand(const DxfEntity& entity) {
    const Transform plane = entity.plane();
    std::vector<Point> corners{entity.requiredPoint(10), entity.requiredPoint(11), entity.requiredPoint(12)};
    if (entity.has(13)) corners.insert(corners.begin() + 2, entity.point(13));
    if (corners.size() == 4 && corners[2] == corners[3]) corners.pop_back();
    for (Point& corner : corners) corner = placed(plane, corner);
    addShape(entity, corners);
    const Point height = thicknessOf(entity);
    if (height == Point{}) return;
    for (std::size_t i = 0; i < corners.size(); ++i)
      addSide(entity, corners[i], corners[(i + 1) % corners.size()], height);
    for (Point& corner : corners) corner = sum(corner, height);
    addShape(entity, corners);
  }

  void addLine(const DxfEntity& entity) {
    addPath(entity, {{.position = entity.requiredPoint(10)}, {.position = entity.requiredPoint(11)}}, false, kIdentity);
  }

  static Point sum(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

  /// What it is extruded by.
  static Point thicknessOf(const DxfEntity& entity) {
    const double thickness = entity.number(39);
    return thickness == 0.0 ? Point{} : placed(entity.plane(), {0.0, 0.0, thickness});
  }

  void addSide(const DxfEntity& entity, const Point& a, const Point& b, const Point& height) {
    addShape(entity, std::array{a, b, sum(b, height), sum(a, height)});
  }

  /// The pieces between positions, extruded where the entity has a thickness.
  void addPath(const DxfEntity& entity, const std::vector<Vertex>& path, bool isClosed, const Transform& plane) {
    const Point height = thicknessOf(entity);
    const std::size_t pieces = path.size() == 1 ? 1 : path.size() - (isClosed || path.empty() ? 0 : 1);
    for (std::size_t i = 0; i < pieces; ++i) {
      const Vertex& vertex = path[i];
      if (vertex.isWide) ++block().unread["widths of " + std::string(entity.kind())];
      if (vertex.bulge != 0.0) {
        ++block().unread["arcs of " + std::string(entity.kind())];
        continue;
      }
      const Point a = placed(plane, vertex.position);
      const Point b = placed(plane, path[(i + 1) % path.size()].position);
      if (path.size() == 1) {
        addPoint(entity, a, height);
      } else if (height == Point{}) {
        addShape(entity, std::array{a, b});
      } else {
        addSide(entity, a, b, height);
      }
    }
  }

  void addPoint(const DxfEntity& entity, const Point& point, const Point& height) {
    if (height == Point{}) return addShape(entity, std::array<Point, 1>{point});
    addShape(entity, std::array{point, sum(point, height)});
  }

  void addFlatPolyline(const DxfEntity& entity) {
    std::vector<Vertex> path;
    const double elevation = entity.number(38);
    const bool isWide = entity.number(43) != 0.0;
    for (const DxfGroup& group : entity.groups()) {
      if (group.code == 10) path.push_back({.position = {entity.numberOf(group), 0.0, elevation}, .isWide = isWide});
      if (path.empty()) continue;
      Vertex& vertex = path.back();
      if (group.code == 20) vertex.position[1] = entity.numberOf(group);
      if (group.code == 42) vertex.bulge = entity.numberOf(group);
      if (group.code == 40 || group.code == 41) vertex.isWide = vertex.isWide || entity.numberOf(group) != 0.0;
    }
    addPath(entity, path, (entity.integer(70) & kIsClosed) != 0, entity.plane());
  }

  // What a polyline is, and of what kinds its vertices are.
  static constexpr std::int64_t kIsClosed = 1;
  static constexpr std::int64_t kIsSmoothed = 4;
  static constexpr std::int64_t kIsInSpace = 8;
  static constexpr std::int64_t kIsMesh = 16;
  static constexpr std::int64_t kIsClosedAcross = 32;
  static constexpr std::int64_t kIsPolyface = 64;
  static constexpr std::int64_t kIsControlPoint = 16;
  static constexpr std::int64_t kIsPosition = 64;

  void finishPolyline() {
    if (!m_polyline) return;
    const DxfEntity polyline = *std::exchange(m_polyline, std::nullopt);
    const std::vector<DxfEntity> vertices = std::exchange(m_vertices, {});
    if (m_isPassedOver) return;
    const std::int64_t flags = polyline.integer(70);
    if ((flags & kIsPolyface) != 0) return addPolyface(polyline, vertices);
    std::vector<Vertex> path;
    const bool isFlat = (flags & (kIsInSpace | kIsMesh)) == 0;
    const bool isWide = isFlat && (polyline.number(40) != 0.0 || polyline.number(41) != 0.0);
    const double elevation = polyline.point(10)[2];
    const bool isOfAll = polyline.has(30);
    for (const DxfEntity& vertex : vertices) {
      if ((vertex.integer(70) & kIsControlPoint) != 0) continue;
      path.push_back({.position = vertex.point(10)});
      if (!isFlat) continue;
      if (isOfAll || !vertex.hasZ(10)) path.back().position[2] = elevation;
      path.back().bulge = vertex.number(42);
      path.back().isWide =
          vertex.has(40) || vertex.has(41) ? vertex.number(40) != 0.0 || vertex.number(41) != 0.0 : isWide;
    }
    if ((flags & kIsMesh) != 0) return addMesh(polyline, path, flags);
    addPath(polyline, path, (flags & kIsClosed) != 0, isFlat ? polyline.plane() : kIdentity);
  }

  /// Positions in rows, with a face between any four that are beside each other.
  void addMesh(const DxfEntity& mesh, const std::vector<Vertex>& positions, std::int64_t flags) {
    const bool isSmoothed = (flags & kIsSmoothed) != 0;
    const std::int64_t rows = mesh.integer(isSmoothed ? 73 : 71);
    const std::int64_t columns = mesh.integer(isSmoothed ? 74 : 72);
    const auto size = static_cast<std::int64_t>(positions.size());
    if (rows < 1 || columns < 1 || size % rows != 0 || size / rows != columns)
      mesh.fail("a POLYLINE of " + std::to_string(rows) + " x " + std::to_string(columns) + " vertices has " +
                std::to_string(size));
    const std::int64_t pieces = (flags & kIsClosed) != 0 ? rows : rows - 1;
    const std::int64_t piecesAcross = (flags & kIsClosedAcross) != 0 ? columns : columns - 1;
    const auto at = [&](std::int64_t row, std::int64_t column) {
      return positions[static_cast<std::size_t>(row % rows * columns + column % columns)].position;
    };
    for (std::int64_t row = 0; row < pieces; ++row) {
      for (std::int64_t column = 0; column < piecesAcross; ++column)
        addShape(mesh, std::array{at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)});
    }
  }

  /// Positions, and faces that name up to four of them by numbers from 1 on, negative before an edge that is hidden.
  void addPolyface(const DxfEntity& polyface, const std::vector<DxfEntity>& vertices) {
    std::vector<Point> positions;
    for (const DxfEntity& vertex : vertices) {
      if (!isFace(vertex)) positions.push_back(vertex.point(10));
    }
    std::vector<Point> corners;
    for (const DxfEntity& face : vertices) {
      if (!isFace(face)) continue;
      corners.clear();
      for (std::int64_t code = 71; code <= 74 && face.integer(code) != 0; ++code) {
        const std::int64_t number = face.integer(code);
        const auto size = static_cast<std::int64_t>(positions.size());
        if (number > size || number < -size)
          face.fail("index " + std::to_string(number) + " names no vertex: the POLYLINE has " + std::to_string(size));
        corners.push_back(positions[static_cast<std::size_t>(std::abs(number) - 1)]);
      }
      if (!corners.empty()) addShape(face.has(8) ? face : polyface, corners);
    }
  }

  static bool isFace(const DxfEntity& vertex) { return vertex.has(71) && (vertex.integer(70) & kIsPosition) == 0; }

  std::string_view m_rest;
  const Path& m_path;
  ReadScope& m_scope;
  std::size_t m_line = 0;
  std::size_t m_mostGroups = 0;  ///< Of an entity so far.
  std::string m_section;
  std::vector<DxfBlock> m_blocks{1};  ///< The first is the drawing itself.
  std::size_t m_block = kNone;        ///< That is being read.
  bool m_isPaperSpace = false;        ///< So is that block.
  std::optional<DxfEntity> m_polyline;
  std::vector<DxfEntity> m_vertices;  ///< Of the polyline.
  bool m_isPassedOver = false;        ///< So is the polyline.
  std::size_t m_paperEntities = 0;
  double m_metresPerUnit = 0.0;
  std::vector<std::uint32_t> m_corners;
};

}  // namespace

std::vector<MeshObject> readDxfObjects(const Path& path, ReadScope& scope, FileNotes& notes) {
  std::string text = readText(path, scope.stop());
  if (text.starts_with("AutoCAD Binary DXF"))
    throw FileError(path, "is a binary DXF, which is not read: save it as text");
  refuseUtf16(text, path);
  makeLines(text);
  DxfReader reader(text, path, scope);
  reader.read();
  notes.frame = {.up = 3, .metresPerUnit = reader.metresPerUnit()};
  const std::size_t paper = reader.paperEntities();
  if (paper != 0) notes.passedOver.push_back(fmt::format("its paper space, of {} entities, is passed over", paper));
  return showDrawing(reader.blocks(), path, scope, notes);
}

}  // namespace allpairs::scene
