// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <new>
#include <pugixml.hpp>

#include "allpairs/scene/FileError.h"
#include "input/ByteOrder.h"
#include "input/FileBytes.h"
#include "input/LineIndex.h"
#include "input/TextScanner.h"
#include "input/Words.h"
#include "sofa/graph/Values.h"
#include "sofa/mesh/Mesh.h"
#include "sofa/mesh/VtkCells.h"

namespace allpairs::scene::sofa {
namespace {

constexpr std::size_t kMaxCount = 500'000'000;  // Entries of one array; more is a damaged header.

/// The lists of cells of a file, as unchecked numbers.
struct CellLists {
  std::vector<std::int64_t> cells;  ///< For each cell: number of points, then the points.
  std::vector<std::int64_t> types;  ///< Empty for surfaces.
};

/// Calls fail(problem, place), which throws, with the place of what is wrong in the list of cells.
template <class Fail>
void addCells(const CellLists& lists, Mesh& mesh, const Fail& fail) {
  VtkCells cells(mesh);
  std::vector<Index> corners;
  std::size_t cell = 0;
  for (std::size_t i = 0; i < lists.cells.size(); ++cell) {
    const std::size_t begin = i;
    const auto count = lists.cells[i++];
    if (count < 0 || static_cast<std::size_t>(count) > lists.cells.size() - i)
      fail("the list of cells is cut off", begin);
    corners.clear();
    for (std::int64_t left = count; left > 0; --left) {
      const auto index = lists.cells[i];
      if (index < 0 || static_cast<std::size_t>(index) >= mesh.positions.size())
        fail("a cell names a missing point", i);
      ++i;
      corners.push_back(static_cast<Index>(index));
    }
    if (lists.types.empty())
      cells.addPolygon(corners);
    else if (cell >= lists.types.size() || !cells.add(lists.types[cell], corners))
      fail("a cell does not have the points or the type that it needs", begin);
  }
}

/// The old format: a header in text, the arrays in text or as big-endian bytes.
class LegacyVtkReader {
 public:
  LegacyVtkReader(const std::filesystem::path& path, std::string text, const StopFlag* stop)
      : m_text(path, std::move(text), stop) {}

  Mesh read() {
    m_text.skipLine();
    m_text.skipLine();
    m_binary = m_text.word() == "BINARY";
    m_text.expect("DATASET");
    const auto dataset = m_text.word();
    if (dataset != "POLYDATA" && dataset != "UNSTRUCTURED_GRID")
      m_text.fail("only the datasets POLYDATA and UNSTRUCTURED_GRID can be read");
    for (auto word = m_text.word(); !word.empty() && word != "POINT_DATA" && word != "CELL_DATA"; word = m_text.word())
      readSection(word);
    if (m_needsTypes && m_lists.types.empty()) m_text.fail("the list of the cells' types is missing");
    addCells(m_lists, m_mesh, [this](const char* problem, std::size_t place) { failInCells(problem, place); });
    return std::move(m_mesh);
  }

 private:
  /// Points may come after the cells, which are checked at the end: names the line on which the number of that place is.
  [[noreturn]] void failInCells(const char* problem, std::size_t place) {
    m_text.seek(m_cells);
    for (std::size_t i = 0; i <= place; ++i) m_binary ? (void)bigEndian<std::int32_t>() : (void)m_text.integer();
    m_text.fail(problem);
  }

  void readSection(std::string_view name) {
    if (name == "POINTS") return readPoints();
    const bool kept = name == "POLYGONS" || name == "CELLS" || name == "CELL_TYPES";
    const bool passedOver = name == "LINES" || name == "TRIANGLE_STRIPS";
    if (!kept && !passedOver && name != "VERTICES") return;
    auto count = this->count();
    if (passedOver) m_mesh.passedOver += count;
    if (name == "CELLS") m_needsTypes = count > 0;
    if (name != "CELL_TYPES") count = this->count();
    m_text.skipLine();
    if (m_text.startsWith("OFFSETS")) {
      if (!kept && !passedOver) return;
      m_text.word();
      m_text.fail(
          "is of version 5 of VTK's files, in which cells stand in two arrays: write version 4.2, which can be read");
    }
    if (kept && name != "CELL_TYPES") m_cells = m_text.position();
    auto values = integers(count);
    if (kept) (name == "CELL_TYPES" ? m_lists.types : m_lists.cells) = std::move(values);
  }

  void readPoints() {
    const auto count = this->count();
    const std::string type = lowerCase(m_text.wordInLine());
    const bool isDouble = type == "double" || type == "float64";
    if (!isDouble && type != "float" && type != "float32") m_text.fail("SOFA takes points of float and double only");
    m_text.skipLine();
    for (std::size_t i = 0; i < count; ++i) {
      Vec3 point{};
      for (auto& coordinate : point)
        coordinate = !m_binary  ? m_text.number()
                     : isDouble ? bigEndian<double>()
                                : static_cast<double>(bigEndian<float>());
      m_mesh.positions.push_back(point);
    }
  }

  std::vector<std::int64_t> integers(std::size_t count) {
    std::vector<std::int64_t> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(m_binary ? bigEndian<std::int32_t>() : m_text.integer());
    return values;
  }

  template <class Number>
  Number bigEndian() {
    return numberOf<Number>(m_text.bytes(sizeof(Number)), std::endian::big);
  }

  std::size_t count() {
    const auto value = m_text.integer();
    if (value < 0 || static_cast<std::uint64_t>(value) > kMaxCount) m_text.fail("a count out of all reason");
    return static_cast<std::size_t>(value);
  }

  TextScanner m_text;
  bool m_binary = false;
  Mesh m_mesh;
  CellLists m_lists;
  std::size_t m_cells = 0;    ///< Where in the text the list of cells begins.
  bool m_needsTypes = false;  ///< Its cells are not those of a surface.
};

/// The XML format with its arrays in text.
class XmlVtkReader {
 public:
  XmlVtkReader(const std::filesystem::path& path, const std::string& bytes, XmlSurfaces surfaces, const StopFlag* stop)
      : m_path(path), m_surfaces(surfaces), m_stop(stop) {
    const auto result = m_document.load_buffer(bytes.data(), bytes.size());
    if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
    if (!result) {
      const auto place = LineIndex(bytes).at(static_cast<std::size_t>(std::max<std::ptrdiff_t>(result.offset, 0)));
      throw FileError(path, std::string{"not well-formed XML: "} + result.description(), place.line, place.column);
    }
  }

  Mesh read() {
    const auto file = m_document.child("VTKFile");
    const auto grid = file.child("UnstructuredGrid"), surface = file.child("PolyData");
    if (!grid && !surface) fail("only UnstructuredGrid and PolyData can be read");
    if (!grid && m_surfaces == XmlSurfaces::Refused)
      fail("SOFA 20.06 does not read PolyData in XML; read the scene as one of newer SOFA, or use an UnstructuredGrid");
    const auto piece = (grid ? grid : surface).child("Piece");
    if (piece.next_sibling("Piece")) fail("has several pieces, of which SOFA keeps one only");
    const auto points = numbers(piece.child("Points").child("DataArray"));
    for (std::size_t i = 0; i + 2 < points.size(); i += 3)
      m_mesh.positions.push_back({points[i], points[i + 1], points[i + 2]});
    auto cells = lists(piece.child(grid ? "Cells" : "Polys"));
    if (grid && !cells.cells.empty() && cells.types.empty()) fail("the list of the cells' types is missing");
    if (!grid) {
      cells.types = typesOfPolygons(cells);
      for (const auto* count : {"NumberOfLines", "NumberOfStrips"})
        m_mesh.passedOver += piece.attribute(count).as_uint();
    }
    addCells(cells, m_mesh, [this](const char* problem, std::size_t) { fail(problem); });
    return std::move(m_mesh);
  }

 private:
  /// By the numbers of their corners, as in SOFA: only triangles and quads become faces.
  static std::vector<std::int64_t> typesOfPolygons(const CellLists& polygons) {
    std::vector<std::int64_t> types;
    for (std::size_t i = 0; i < polygons.cells.size(); i += static_cast<std::size_t>(polygons.cells[i]) + 1)
      types.push_back(VtkCells::typeOfPolygon(static_cast<std::size_t>(polygons.cells[i])));
    return types;
  }

  CellLists lists(const pugi::xml_node& cells) const {
    const auto array = [&](const char* name) { return numbers(cells.find_child_by_attribute("Name", name)); };
    const auto corners = array("connectivity"), ends = array("offsets"), types = array("types");
    CellLists result;
    std::size_t begin = 0;
    for (const double end : ends) {
      checkStop(m_stop);
      if (!(end >= static_cast<double>(begin)) || end > static_cast<double>(corners.size())) fail("wrong cell offsets");
      result.cells.push_back(static_cast<std::int64_t>(end) - static_cast<std::int64_t>(begin));
      for (; begin < static_cast<std::size_t>(end); ++begin) result.cells.push_back(toInteger(corners[begin]));
    }
    for (const double type : types) result.types.push_back(toInteger(type));
    return result;
  }

  std::vector<double> numbers(const pugi::xml_node& array) const {
    const std::string_view format = array.attribute("format").value();
    if (array && format != "ascii" && !format.empty()) fail("only arrays in ASCII can be read");
    std::string bad;
    auto values = parseNumbers(array.child_value(), bad, m_stop);
    if (!values) fail("an array holds something that is not a finite number");
    return std::move(*values);
  }

  std::int64_t toInteger(double value) const {
    if (!(value >= 0) || value > static_cast<double>(kMaxCount)) fail("a point number or cell type out of all reason");
    return static_cast<std::int64_t>(value);
  }

  [[noreturn]] void fail(const std::string& problem) const { throw FileError(m_path, problem); }

  std::filesystem::path m_path;
  XmlSurfaces m_surfaces;
  const StopFlag* m_stop;
  pugi::xml_document m_document;
  Mesh m_mesh;
};

}  // namespace

Mesh readVtk(const std::filesystem::path& path, XmlSurfaces surfaces, const StopFlag* stop) {
  constexpr std::size_t kStart = 4096;
  std::string text = readText(path, stop);
  refuseUtf16(text, path);
  if (text.starts_with("# vtk DataFile")) return LegacyVtkReader(path, std::move(text), stop).read();
  if (std::string_view{text}.substr(0, kStart).find("<VTKFile") != std::string_view::npos)
    return XmlVtkReader(path, text, surfaces, stop).read();
  throw FileError(path, "this is no VTK file");
}

}  // namespace allpairs::scene::sofa
