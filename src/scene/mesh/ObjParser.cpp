// SPDX-License-Identifier: MIT
#include "mesh/ObjParser.h"

#include <system_error>

#include "allpairs/scene/FileError.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

std::string_view takePart(std::string_view& corner) {
  const std::string_view part = corner.substr(0, corner.find('/'));
  corner.remove_prefix(part.size() == corner.size() ? part.size() : part.size() + 1);
  return part;
}

/// Whether numbers follow the first word of a statement, in which # is no letter.
bool hasNumbers(std::string_view statement) {
  return isOneOf(takeWord(statement, isBlank), {"v", "vn", "vp", "vt", "f", "l", "p"});
}

}  // namespace

/// Calls visit(line, number) for each line, without the blanks around it.
template <class Visit>
void ObjParser::forEachLine(std::string_view text, const Visit& visit) const {
  const std::string_view all = text;
  std::size_t sign = m_syntax.endsInComments ? all.find('#') : std::string_view::npos;  // the next
  std::string joined;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = trimmed(takeLine(text));
    const auto begin = static_cast<std::size_t>(line.data() - all.data());
    if (sign < begin) sign = all.find('#', begin);
    const bool isComment = joined.empty() && line.starts_with('#');  // which may end in the name of a folder
    bool isBetween = false;                                          // a comment between the lines of one statement
    if (sign < begin + line.size() && !isComment && hasNumbers(joined.empty() ? line : joined)) {
      line = trimmed(line.substr(0, sign - begin));
      isBetween = line.empty();
    }
    const bool isContinued = !isComment && line.ends_with('\\');
    const bool goesOn = m_syntax.joinsLines && (isContinued || isBetween) && !text.empty();
    if (goesOn && isContinued) line.remove_suffix(1);
    if (goesOn || !joined.empty()) {
      joined.append(line).append(" ");
      line = trimmed(joined);
    }
    if (goesOn) continue;
    visit(line, number);
    joined.clear();
  }
}

bool ObjParser::hasStatement(std::string_view text, std::string_view keyword) const {
  bool found = false;
  forEachLine(text, [&](std::string_view line, std::size_t) {
    found = found || (line.starts_with(keyword) && takeWord(line, isBlank) == keyword);
  });
  return found;
}

void ObjParser::parse(std::string_view text) {
  forEachLine(text, [this](std::string_view line, std::size_t number) {
    m_line = number;
    const std::string_view keyword = takeWord(line, isBlank);
    parseStatement(keyword, line);
  });
}

void ObjParser::parseStatement(std::string_view keyword, std::string_view rest) {
  if (keyword == "v") {
    addPosition(rest);
    ++m_positionCount;
  } else if (keyword == "vt") {
    ++m_textureCount;
  } else if (keyword == "vn") {
    ++m_normalCount;
  } else if (keyword == "o" || keyword == "g") {
    beginObject(keyword, trimmed(rest));
  } else if (keyword.size() == 1 && m_syntax.elements.find(keyword.front()) != std::string_view::npos) {
    parseElement(keyword.front(), rest);
  } else {
    passOver(keyword);
  }
}

void ObjParser::parseElement(char kind, std::string_view corners) {
  m_element.clear();
  for (auto word = takeWord(corners, isBlank); !word.empty(); word = takeWord(corners, isBlank)) {
    m_element.push_back(parseCorner(word));
  }
  addElement(kind, m_element);
}

ObjCorner ObjParser::parseCorner(std::string_view word) const {
  ObjCorner corner;
  corner.position = resolve(takePart(word), m_positionCount);
  if (m_syntax.readsSeams) {
    corner.texture = resolve(takePart(word), m_textureCount);
    corner.normal = resolve(takePart(word), m_normalCount);
  }
  if (corner.position == ObjCorner::kNone) refuse(ObjProblem::NoPosition, {});
  return corner;
}

/// Indices count from 1, negative ones back from the last so far.
std::int64_t ObjParser::resolve(std::string_view index, std::size_t count) const {
  if (index.empty()) return ObjCorner::kNone;
  std::int64_t value = 0;
  if (parseWhole(index, value) != std::errc()) refuse(ObjProblem::NoNumber, index);
  if (value == 0) refuse(ObjProblem::IsZero, index);
  const std::int64_t resolved = value > 0 ? value - 1 : value + static_cast<std::int64_t>(count);
  if (resolved < 0) refuse(ObjProblem::BeforeFirst, index);
  if (resolved > m_syntax.maxIndex) refuse(ObjProblem::TooLarge, index);
  return resolved;
}

void ObjParser::failAt(std::size_t line, const std::string& problem) const { throw FileError(m_path, problem, line); }

}  // namespace allpairs::scene
