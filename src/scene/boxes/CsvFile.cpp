// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/FileError.h"
#include "boxes/CsvLine.h"
#include "input/FileBytes.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kNoColumn = static_cast<std::size_t>(-1);

/// In which column each of minx miny minz maxx maxy maxz stands, and the name.
struct CsvLayout {
  std::size_t columns = 0;
  std::array<std::size_t, kCoordinates> coordinates{};
  std::size_t name = kNoColumn;
};

/// Which coordinate a header's word means: minx, min_x, "Min X", xmin, x0 and the like; nothing for other words.
std::optional<std::size_t> coordinateOf(std::string_view word) {
  std::string plain;
  for (const char c : lowerCase(word)) {
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) plain += c;
  }
  for (std::size_t i = 0; i < kCoordinates; ++i) {
    const std::string axis(1, "xyz"[i % 3]);
    const std::string side = i < 3 ? "min" : "max";
    if (plain == side + axis || plain == axis + side || plain == axis + (i < 3 ? "0" : "1")) return i;
  }
  return std::nullopt;
}

std::string columnsText(const std::vector<CsvField>& fields) {
  return "has " + std::to_string(fields.size()) + (fields.size() == 1 ? " column" : " columns");
}

/// Of a line that should have so many columns: what stands where commas should, if they are missing.
std::string separatorHint(const std::vector<CsvField>& fields, std::size_t columns) {
  if (fields.size() >= columns) return {};
  for (const CsvField& field : fields) {
    const std::string separator = otherSeparator(field.text);
    if (!separator.empty()) return "; commas separate them, not " + separator;
  }
  return {};
}

/// The layout of a file without a header: six numbers, or seven columns of which the first or the last is a name.
CsvLayout layoutOfData(const std::vector<CsvField>& fields, const TextPlace& place) {
  if (fields.size() != kCoordinates && fields.size() != kCoordinates + 1) {
    throw FileError(place.file,
                    columnsText(fields) + " where a box has 6, or 7 with a name" + separatorHint(fields, kCoordinates),
                    place.line);
  }
  CsvLayout layout{.columns = fields.size()};
  std::size_t first = 0;
  if (fields.size() == kCoordinates + 1) {
    const bool nameIsLast = !isCsvNumber(fields.back()) && isCsvNumber(fields.front());
    if (isCsvNumber(fields.back()) && isCsvNumber(fields.front())) {
      for (std::size_t i = 1; i < kCoordinates; ++i) static_cast<void>(csvNumber(fields[i], place));  // 0,5;1,5;2,5;...
      throw FileError(place.file,
                      "has seven numbers, of which the first or the last is a name: begin the file with the line "
                      "name,minx,miny,minz,maxx,maxy,maxz, or with the name last",
                      place.line);
    }
    layout.name = nameIsLast ? kCoordinates : 0;
    first = nameIsLast ? 0 : 1;
  }
  for (std::size_t i = 0; i < kCoordinates; ++i) layout.coordinates[i] = first + i;
  return layout;
}

bool looksLikeHeader(const std::vector<CsvField>& fields) {
  const auto isCoordinate = [](const CsvField& field) { return coordinateOf(field.text).has_value(); };
  return std::none_of(fields.begin(), fields.end(), isCsvNumber) &&
         (fields.size() >= kCoordinates || std::any_of(fields.begin(), fields.end(), isCoordinate));
}

/// Whether a comment names all columns, as np.savetxt() writes a header.
bool namesColumns(const std::vector<CsvField>& fields) {
  std::array<std::size_t, kCoordinates> counts{};
  std::size_t others = 0;
  for (const CsvField& field : fields) {
    const std::optional<std::size_t> coordinate = coordinateOf(field.text);
    ++(coordinate ? counts[*coordinate] : others);
  }
  return others <= 1 && std::all_of(counts.begin(), counts.end(), [](std::size_t count) { return count == 1; });
}

/// Whether words of a comment name each coordinate once, but not in the order in which boxes are read.
bool namesOtherOrder(std::string_view comment) {
  const auto separates = [](char c) {
    return isBlank(c) || std::string_view(",;:\"'()[]").find(c) != std::string::npos;
  };
  std::vector<std::size_t> order;
  for (auto word = takeWord(comment, separates); !word.empty(); word = takeWord(comment, separates)) {
    if (const std::optional<std::size_t> coordinate = coordinateOf(word)) order.push_back(*coordinate);
  }
  std::vector<std::size_t> sorted = order;
  std::sort(sorted.begin(), sorted.end());
  return sorted == std::vector<std::size_t>{0, 1, 2, 3, 4, 5} && order != sorted;
}

/// Whether fields number the columns from 0 to 5, as pandas does where they have no names.
bool numbersColumns(std::span<const CsvField> fields) {
  std::size_t number = 0;
  return fields.size() == kCoordinates && std::all_of(fields.begin(), fields.end(), [&](const CsvField& field) {
           return field.text == std::to_string(number++);
         });
}

CsvLayout layoutOfHeader(const std::vector<CsvField>& fields, const TextPlace& place) {
  CsvLayout layout{.columns = fields.size()};
  layout.coordinates.fill(kNoColumn);
  for (std::size_t column = 0; column < fields.size(); ++column) {
    const CsvField& field = fields[column];
    const std::optional<std::size_t> coordinate = coordinateOf(field.text);
    std::size_t& slot = coordinate ? layout.coordinates[*coordinate] : layout.name;
    if (slot != kNoColumn) {
      const std::string problem = coordinate ? "is there twice"
                                             : "is not known: a box has minx,miny,minz,maxx,maxy,maxz and a name, "
                                               "for which '" +
                                                   fields[slot].text + "' is taken";
      throw FileError(place.file, "column '" + field.text + "' " + problem, place.line, field.column);
    }
    slot = column;
  }
  const auto missing = std::find(layout.coordinates.begin(), layout.coordinates.end(), kNoColumn);
  if (missing != layout.coordinates.end()) {
    static constexpr std::array<const char*, kCoordinates> kNames{"minx", "miny", "minz", "maxx", "maxy", "maxz"};
    const auto which = static_cast<std::size_t>(missing - layout.coordinates.begin());
    throw FileError(place.file, std::string("the header has no column '") + kNames[which] + "'", place.line);
  }
  return layout;
}

class CsvReader {
 public:
  CsvReader(const Path& path, ReadScope& scope) : m_place{path}, m_scope(scope) {}

  /// A line, which has more than one of the file's where a quoted name breaks.
  void readLine(std::string_view line) {
    m_place.line += 1 + std::exchange(m_breaks, static_cast<std::size_t>(std::count(line.begin(), line.end(), '\n')));
    const std::size_t first = line.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return;
    if (line[first] == '#') return readComment(line.substr(first + 1));
    splitCsvLine(line, m_place, m_fields);
    if (m_layout.columns == 0 && readHeader()) return;
    readBox();
  }

  BoxArray finish() {
    const std::size_t size = m_values.size() / kCoordinates;
    BoxTable<double> table{std::make_unique_for_overwrite<double[]>(m_values.size()), size};
    std::copy(m_values.begin(), m_values.end(), table.values.get());
    if (m_boxLikeComments > 0 && (m_layout.columns == 0 || m_layout.name == 0)) noteComments();
    return {std::move(table), m_place.file.filename().string(), std::move(m_names), std::move(m_notes)};
  }

 private:
  /// Finds the layout by the first line, and returns whether that holds no box.
  bool readHeader() {
    const std::span<const CsvField> fields(m_fields);
    const bool hasNumbers = fields.size() > kCoordinates && fields[0].text.empty() && numbersColumns(fields.subspan(1));
    const bool isHeader = looksLikeHeader(m_fields);
    if (isHeader) {
      m_layout = layoutOfHeader(m_fields, m_place);
    } else if (m_commented.columns == fields.size()) {
      m_layout = m_commented;
    } else {
      m_layout = layoutOfData(m_fields, m_place);
      if (!hasNumbers && numbersColumns(fields.subspan(m_layout.coordinates[0], kCoordinates)))
        m_notes.push_back({m_place.line, "0,1,2,3,4,5 is taken for a box; if it numbers the columns, remove it"});
      if (m_otherOrder > 0)
        m_notes.push_back({m_otherOrder,
                           "names columns in another order than boxes are read in, and is passed over as a comment; a "
                           "header has commas, and a name for each column"});
    }
    return isHeader || hasNumbers;
  }

  /// It may name the columns, or be a box whose name begins with #. What programs put into quotes is neither.
  void readComment(std::string_view text) {
    if (m_layout.columns == 0 && namesOtherOrder(text)) m_otherOrder = m_place.line;
    if (text.find('"') != std::string_view::npos) return;
    splitCsvLine(text, m_place, m_fields);
    if (m_layout.columns == 0 && namesColumns(m_fields)) {
      m_commented = layoutOfHeader(m_fields, m_place);
      m_otherOrder = std::is_sorted(m_commented.coordinates.begin(), m_commented.coordinates.end()) ? 0 : m_place.line;
    }
    const bool isName = !text.empty() && !isBlank(text.front()) && m_fields.size() == kCoordinates + 1 &&
                        (m_layout.columns == 0 || m_layout.name == 0);
    if (isName && std::all_of(m_fields.begin() + 1, m_fields.end(), isCsvNumber) && m_boxLikeComments++ == 0)
      m_firstBoxLike = m_place.line;
  }

  void noteComments() {
    const std::size_t others = m_boxLikeComments - 1;
    const std::string count = ", as " + std::string(others == 1 ? "is " : "are ") + std::to_string(others) +
                              " other line" + (others == 1 ? "" : "s");
    m_notes.push_back({m_firstBoxLike, "begins with #, and is passed over as a comment" +
                                           (others == 0 ? "; if it is a box, put its name in quotes"
                                                        : count + "; if they are boxes, put their names in quotes")});
  }

  void readBox() {
    if (m_fields.size() != m_layout.columns) {
      throw FileError(m_place.file,
                      columnsText(m_fields) + " where the lines before have " + std::to_string(m_layout.columns) +
                          separatorHint(m_fields, m_layout.columns),
                      m_place.line);
    }
    m_scope.takeElements(2, kCoordinates * sizeof(double));  // once more when it is finished
    for (const std::size_t column : m_layout.coordinates) m_values.push_back(csvNumber(m_fields[column], m_place));
    if (m_layout.name != kNoColumn) m_names.add(m_fields[m_layout.name].text);
  }

  TextPlace m_place;
  std::size_t m_breaks = 0;  ///< In the last line.
  ReadScope& m_scope;
  CsvLayout m_layout;
  CsvLayout m_commented;         ///< Of the last comment that names the columns.
  std::size_t m_otherOrder = 0;  ///< The line of a comment that names them in another order than boxes are read in.
  std::size_t m_boxLikeComments = 0;
  std::size_t m_firstBoxLike = 0;  ///< The line of the first of them.
  std::vector<LineNote> m_notes;
  std::vector<CsvField> m_fields;
  std::vector<double> m_values;
  NameList m_names;
};

}  // namespace

BoxArray readCsv(const Path& path, ReadScope& scope) {
  scope.admit(path);
  std::string text = readText(path, scope.stop());
  makeLines(text);
  std::string_view rest = text;
  if (const std::size_t zero = rest.find('\0'); zero != std::string_view::npos) {
    const auto line =
        static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n'));
    throw FileError(path, "is no text: it holds a byte of zero, as UTF-16 does; UTF-8 can be read", line + 1);
  }
  CsvReader reader(path, scope);
  while (!rest.empty()) {
    const std::size_t end = csvLineEnd(rest);
    reader.readLine(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return reader.finish();
}

BoxArray readCsv(const Path& path) {
  ReadScope scope(path, {});
  return readCsv(path, scope);
}

}  // namespace allpairs::scene
