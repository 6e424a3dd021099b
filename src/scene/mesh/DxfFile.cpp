// SPDX-License-Identifier: MIT
#include "mesh/DxfFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

template <std::size_t N>
bool isAmong(const std::array<std::string_view, N>& kinds, std::string_view kind) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

bool isDxfSolid(std::string_view kind) {
  static constexpr std::array<std::string_view, 4> kSolids{"3DSOLID", "BODY", "REGION", "MESH"};
  return isAmong(kSolids, kind) || kind.ends_with("SURFACE");
}

bool isDxfCurve(std::string_view kind) {
  static constexpr std::array<std::string_view, 12> kCurves{
      "ARC", "CIRCLE", "ELLIPSE", "HATCH", "HELIX", "LWPOLYLINE", "MLINE", "POINT", "RAY", "SOLID", "SPLINE", "TRACE"};
  return isAmong(kCurves, kind);
}

class DxfCheck {
 public:
  DxfCheck(std::string_view text, const Path& path, const ReadScope& scope)
      : m_rest(text), m_path(path), m_scope(scope) {}

  void run(std::vector<FileWarning>& warnings) {
    while (takePair()) takeValue();
    finishEntity();
    const auto shown = m_blocks.find("");
    if (shown == m_blocks.end()) return;
    look(shown->second);
    for (const std::string& name : shown->second.inserted) {
      const auto block = m_blocks.find(name);
      if (block == m_blocks.end()) continue;
      if (block->second.insertLine != 0)
        fail(block->second.insertLine, "a block within a block is not read; explode it");
      look(block->second);
    }
    if (m_curves == 0) return;
    std::string kinds;
    for (const std::string& kind : m_kinds) kinds += (kinds.empty() ? "" : ", ") + kind;
    warnings.push_back({"shapes", fmt::format("{} of kinds that are not read {} missing: {}", m_curves,
                                              m_curves == 1 ? "is" : "are", kinds)});
  }

 private:
  /// What is in a block, or in the drawing itself, whose name is empty.
  struct Block {
    std::set<std::string> inserted;
    std::size_t insertLine = 0;                     ///< Of the first block in it.
    std::pair<std::size_t, std::string> problem{};  ///< Of the first entity that is not read, and its line.
    std::multiset<std::string> curves;
  };

  /// A group code and its value, each on a line.
  bool takePair() {
    if (m_rest.empty()) return false;
    const std::string_view code = trimmed(takeLine(m_rest));
    m_value = trimmed(takeLine(m_rest));
    m_line += 2;
    if (parseWhole(code, m_code) != std::errc()) m_code = -1;
    return true;
  }

  void takeValue() {
    if (m_code == 0) {
      finishEntity();
      beginEntity();
    } else if (m_kind == "SECTION" && m_code == 2) {
      m_section = m_value;
    } else if (m_kind == "BLOCK" && m_code == 2) {
      m_block = m_value;
    } else if (m_kind == "INSERT") {
      takeOfInsert();
    } else if (m_kind == "POLYLINE" && m_code == 70) {
      m_isPolyface = (flags() & 64) != 0;
    } else if (m_kind == "VERTEX" && m_code >= 71 && m_code <= 74 && m_value.starts_with('-')) {
      note("a POLYLINE that hides edges of its faces is not read; export 3DFACEs");
    }
  }

  void beginEntity() {
    m_scope.checkStop();
    m_kind = m_value;
    m_begin = m_line;
    m_name.clear();
    m_onlyMoves = true;
    if (m_kind == "ENDSEC") m_section.clear();
    if (m_section == "ENTITIES" || m_kind == "ENDBLK") m_block.clear();
    if (m_kind == "POLYLINE") m_isPolyface = false;
  }

  void takeOfInsert() {
    if (m_code == 2) m_name = m_value;
    const bool isScale = m_code >= 41 && m_code <= 43;
    const bool isCount = m_code == 70 || m_code == 71;
    const bool isAxis = m_code == 210 || m_code == 220;
    const double number = parseFinite(m_value).value_or(0.0);
    if (((isScale || m_code == 230) && number != 1.0) || (isCount && number > 1.0) ||
        ((isAxis || m_code == 50) && number != 0.0))
      m_onlyMoves = false;
  }

  /// Whether the entity is of the drawing or of a block.
  [[nodiscard]] bool isShown() const { return m_section == "ENTITIES" || (m_section == "BLOCKS" && !m_block.empty()); }

  void finishEntity() {
    if (m_kind.empty() || !isShown()) return;
    Block& block = m_blocks[m_block];
    if (m_kind == "INSERT") {
      block.inserted.insert(m_name);
      if (block.insertLine == 0) block.insertLine = m_begin;
      if (!m_onlyMoves) note("an INSERT that turns, scales or repeats its block is not read; explode it");
    }
    if (m_kind == "POLYLINE" && !m_isPolyface) note("a POLYLINE that is no polyface mesh is not read; export LINEs");
    if (isDxfSolid(m_kind)) note("'" + m_kind + "' is not read; export 3DFACEs");
    if (isDxfCurve(m_kind)) block.curves.insert(m_kind);
  }

  void note(std::string problem) {
    if (!isShown()) return;
    Block& block = m_blocks[m_block];
    if (block.problem.first == 0) block.problem = {m_begin, std::move(problem)};
  }

  void look(const Block& block) {
    if (block.problem.first != 0) fail(block.problem.first, block.problem.second);
    m_curves += block.curves.size();
    m_kinds.insert(block.curves.begin(), block.curves.end());
  }

  [[nodiscard]] std::int64_t flags() const {
    std::int64_t value = 0;
    return parseWhole(m_value, value) == std::errc() ? value : 0;
  }

  [[noreturn]] void fail(std::size_t line, const std::string& problem) const { throw FileError(m_path, problem, line); }

  std::string_view m_rest;
  const Path& m_path;
  const ReadScope& m_scope;
  std::size_t m_line = 0;
  std::int64_t m_code = 0;
  std::string_view m_value;
  std::string m_section;
  std::string m_block;
  std::string m_kind;       ///< Of the entity that is being read.
  std::size_t m_begin = 0;  ///< Its line.
  std::string m_name;       ///< Of the block that it inserts.
  bool m_onlyMoves = true;  ///< It moves that block, and does nothing else to it.
  bool m_isPolyface = false;
  std::map<std::string, Block> m_blocks;
  std::size_t m_curves = 0;
  std::set<std::string> m_kinds;
};

}  // namespace

void checkDxf(const Path& path, const ReadScope& scope, std::vector<FileWarning>& warnings) {
  std::string text = readText(path, scope.stop());
  makeLines(text);
  DxfCheck(text, path, scope).run(warnings);
}

}  // namespace allpairs::scene
