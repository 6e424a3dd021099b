// SPDX-License-Identifier: MIT
#include "mesh/PlyHeader.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

/// What the first line ends in; a carriage return before a line feed is a blank.
char lineEndOf(std::string_view text) {
  const std::size_t end = text.find_first_not_of('\r', text.find_first_of("\r\n"));
  return end == std::string_view::npos || text[end] == '\n' ? '\n' : '\r';
}

class HeaderReader {
 public:
  HeaderReader(std::string_view text, const std::filesystem::path& path) : m_text(text), m_path(path) {
    m_header.lineEnd = lineEndOf(text);
  }

  PlyHeader read() {
    if (nextLine() != "ply") fail("is not a .ply file: its first line is not 'ply'");
    bool hasFormat = false;
    for (std::string_view line = nextLine(); line != "end_header"; line = nextLine()) {
      const std::string_view keyword = takeWord(line);
      if (keyword == "format") {
        readFormat(line);
        hasFormat = true;
      } else if (keyword == "element") {
        readElement(line);
      } else if (keyword == "property") {
        readProperty(line);
      } else if (keyword != "comment" && keyword != "obj_info") {
        fail("'" + std::string(keyword) + "' is not known in the header of a .ply file");
      }
    }
    if (!hasFormat) fail("the header names no format");
    m_header.size = m_position;
    return std::move(m_header);
  }

 private:
  std::string_view nextLine() {
    const std::size_t end = m_text.find(m_header.lineEnd, m_position);
    ++m_header.lines;
    if (end == std::string_view::npos) fail("the header has no end");
    const std::string_view line = m_text.substr(m_position, end - m_position);
    m_position = end + 1;
    return trimmed(line);
  }

  void readFormat(std::string_view line) {
    const std::string_view format = takeWord(line);
    if (format == "ascii") {
      m_header.encoding = PlyEncoding::Ascii;
    } else if (format == "binary_little_endian") {
      m_header.encoding = PlyEncoding::LittleEndian;
    } else if (format == "binary_big_endian") {
      m_header.encoding = PlyEncoding::BigEndian;
    } else {
      fail("format '" + std::string(format) + "' is not known");
    }
  }

  void readElement(std::string_view line) {
    PlyElement& element = m_header.elements.emplace_back();
    element.name = takeWord(line);
    const std::string_view count = takeWord(line);
    if (parseWhole(count, element.count) != std::errc()) fail("'" + std::string(count) + "' is no number of elements");
  }

  void readProperty(std::string_view line) {
    if (m_header.elements.empty()) fail("a property before the first element");
    PlyProperty property;
    std::string_view type = takeWord(line);
    if (type == "list") {
      property.countType = typeOf(takeWord(line));
      type = takeWord(line);
    }
    property.type = typeOf(type);
    property.name = takeWord(line);
    m_header.elements.back().properties.push_back(std::move(property));
  }

  PlyType typeOf(std::string_view word) const {
    // Each type has an old and a new name.
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kNames{{{"char", "int8"},
                                                                                          {"uchar", "uint8"},
                                                                                          {"short", "int16"},
                                                                                          {"ushort", "uint16"},
                                                                                          {"int", "int32"},
                                                                                          {"uint", "uint32"},
                                                                                          {"float", "float32"},
                                                                                          {"double", "float64"}}};
    const auto known = std::find_if(kNames.begin(), kNames.end(),
                                    [word](const auto& names) { return word == names.first || word == names.second; });
    if (known == kNames.end()) fail("type '" + std::string(word) + "' is not known");
    return static_cast<PlyType>(known - kNames.begin());
  }

  [[noreturn]] void fail(const std::string& problem) const { throw FileError(m_path, problem, m_header.lines); }

  std::string_view m_text;
  const std::filesystem::path& m_path;
  std::size_t m_position = 0;
  PlyHeader m_header;
};

}  // namespace

PlyHeader parsePlyHeader(std::string_view text, const std::filesystem::path& path) {
  return HeaderReader(text, path).read();
}

}  // namespace allpairs::scene
