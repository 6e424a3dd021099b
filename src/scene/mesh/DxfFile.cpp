// SPDX-License-Identifier: MIT
#include "mesh/DxfFile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "allpairs/scene/FileError.h"
#include "input/FileBytes.h"
#include "input/Words.h"
#include "mesh/AssimpWarnings.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

bool isDxfSolid(std::string_view kind) {
  return isOneOf(kind, {"3DSOLID", "BODY", "REGION", "MESH"}) || kind.ends_with("SURFACE");
}

bool isDxfCurve(std::string_view kind) {
  return isOneOf(kind, {"ARC", "CIRCLE", "ELLIPSE", "HATCH", "HELIX", "LWPOLYLINE", "MLINE", "POINT", "RAY", "SOLID",
                        "SPLINE", "TRACE"});
}

/// Whether Assimp makes lines or faces of it. VERTEX is a part of POLYLINE.
bool isDxfShape(std::string_view kind) { return isOneOf(kind, {"3DFACE", "LINE", "3DLINE", "POLYLINE", "VERTEX"}); }

/// Whether two numbers differ by no more than what programs that write them round.
bool isSame(double a, double b) {
  constexpr double kNoise = 1e-9;
  return std::abs(a - b) <= kNoise;
}

using KindCounts = std::map<std::string, std::size_t>;

std::size_t totalOf(const KindCounts& counts) {
  std::size_t total = 0;
  for (const auto& [kind, count] : counts) total += count;
  return total;
}

std::string kindsOf(const KindCounts& counts) {
  std::string kinds;
  for (const auto& [kind, count] : counts) kinds += (kinds.empty() ? "" : ", ") + kind;
  return kinds;
}

/// What is in a block, or in the drawing itself.
struct DxfBlock {
  /// The places of a block in another one.
  struct Inserts {
    std::size_t line = 0;        ///< Of the first.
    std::size_t turnedLine = 0;  ///< Of the first that does more than move the block.
    std::size_t hidingLine = 0;  ///< Of a text that hides one.
  };

  /// What identifies it and says where it lies.
  struct Head {
    std::string name;
    Point base{};
  };

  Head head;
  Head ofAssimp;                                ///< Which takes it from any entity that it does not know.
  std::pair<std::size_t, std::string> stray{};  ///< The line and kind of such an entity.
  bool isElsewhere = false;                     ///< Its content is in another drawing.
  bool hasShapes = false;                       ///< Of its own.
  bool holdsShapes = false;                     ///< Also in the blocks in it.
  std::map<std::string, Inserts> inserts;
  std::size_t insertLine = 0;                     ///< Of the first block in it, behind which Assimp reads nothing.
  bool isCut = false;                             ///< Shapes are behind that.
  std::size_t hidingLine = 0;                     ///< Of a text that hides shapes of it, its head or its end.
  std::pair<std::size_t, std::string> problem{};  ///< Of the first entity that is not read, and its line.
  KindCounts curves;

  void note(std::size_t line, std::string text) {
    if (problem.first == 0) problem = {line, std::move(text)};
  }
};

class DxfCheck {
 public:
  DxfCheck(std::string_view text, const Path& path, const ReadScope& scope)
      : m_rest(text), m_path(path), m_scope(scope) {}

  void run(std::vector<FileWarning>& warnings) {
    while (takePair()) takeValue();
    finishEntity();
    finishPolyline();
    findBlocks();
    propagateShapes();
    if (m_blocks[kDrawing].hidingLine != 0) failOfHiding(m_blocks[kDrawing].hidingLine);
    checkInserts();
    lookAtShown();
    countPaperInserts();
    warn(warnings);
  }

 private:
  static constexpr std::size_t kDrawing = 0;  // in the list of blocks
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// A group code and its value, each on a line.
  bool takePair() {
    if (m_rest.empty()) return false;
    const std::string_view code = trimmed(takeLine(m_rest));
    m_value = trimmed(takeLine(m_rest));
    m_line += 2;
    if (parseWhole(code, m_code) != std::errc()) m_code = -1;
    takeBraces();
    return true;
  }

  /// Assimp reads nothing between any value that begins with { and the next that begins with } or is empty.
  void takeBraces() {
    m_hidingLine = m_braceLine;
    if (m_hidingLine == 0) {
      if (m_value.starts_with('{')) m_braceLine = m_line;
    } else if (m_value.empty() || m_value.starts_with('}')) {
      m_braceLine = 0;
    }
  }

  void takeValue() {
    if (m_code == 0) {
      finishEntity();
      beginEntity();
    } else if (m_kind == "SECTION" && m_code == 2) {
      m_section = m_value;
    } else if (m_kind == "BLOCK" && m_block != kNone) {
      takeOfBlock();
    } else if (m_kind == "INSERT") {
      takeOfInsert();
    } else if (m_kind == "POLYLINE") {
      takeOfPolyline();
    } else if (m_kind == "VERTEX") {
      takeOfVertex();
    } else if (!isDxfShape(m_kind) && m_block != kNone && m_block != kDrawing) {
      takeOfStray();
    }
    if (m_code == 67 && flags() == 1 && m_block == kDrawing) m_isPaper = true;
  }

  void beginEntity() {
    m_scope.checkStop();
    m_kind = m_value;
    m_begin = m_line;
    m_name.clear();
    m_onlyMoves = true;
    m_isPaper = false;
    m_hider = m_hidingLine;
    if (m_kind != "VERTEX") finishPolyline();
    if (m_kind == "ENDBLK" && m_block != kNone && m_hider != 0) m_blocks[m_block].hidingLine = m_hider;
    if (m_kind == "ENDSEC") m_section.clear();
    if (m_section == "ENTITIES") {
      m_block = kDrawing;
    } else if (m_section == "BLOCKS" && m_kind == "BLOCK") {
      m_block = m_blocks.size();
      m_blocks.emplace_back();
    } else if (m_section != "BLOCKS" || m_kind == "ENDBLK") {
      m_block = kNone;
    }
    if (m_kind == "POLYLINE") m_polyline = {.begin = m_begin};
  }

  /// The base or the name of a block.
  void takeOfHead(DxfBlock::Head& head) const {
    if (m_code == 2) head.name = m_value;
    if (m_code == 10 || m_code == 20 || m_code == 30)
      head.base[static_cast<std::size_t>(m_code / 10 - 1)] = parseFinite(m_value).value_or(0.0);
  }

  void takeOfBlock() {
    DxfBlock& block = m_blocks[m_block];
    takeOfHead(block.head);
    takeOfHead(block.ofAssimp);
    if (m_hidingLine != 0) block.hidingLine = m_hidingLine;
    constexpr std::int64_t kIsElsewhere = 4 | 8;
    if (m_code == 70) block.isElsewhere = (flags() & kIsElsewhere) != 0;
  }

  void takeOfStray() {
    DxfBlock& block = m_blocks[m_block];
    if (block.insertLine != 0) return;
    takeOfHead(block.ofAssimp);
    if (isMistaken(block)) block.stray = {m_begin, m_kind};
  }

  static bool isMistaken(const DxfBlock& block) { return block.ofAssimp.name != block.head.name || isMisplaced(block); }

  static bool isMisplaced(const DxfBlock& block) {
    return !std::equal(block.head.base.begin(), block.head.base.end(), block.ofAssimp.base.begin(), isSame);
  }

  void takeOfInsert() {
    if (m_code == 2) m_name = m_value;
    const bool isScale = m_code >= 41 && m_code <= 43;
    const bool isCount = m_code == 70 || m_code == 71;
    const double number = parseFinite(m_value).value_or(0.0);
    const bool isTurn = m_code == 50 && !isSame(std::remainder(number, 360.0), 0.0);
    if (isTurn || (isScale && !isSame(number, 1.0)) || (isCount && number > 1.0) || isOtherAxis()) m_onlyMoves = false;
  }

  /// Whether the value says that another axis than z points up.
  [[nodiscard]] bool isOtherAxis() const {
    const double number = parseFinite(m_value).value_or(0.0);
    return ((m_code == 210 || m_code == 220) && !isSame(number, 0.0)) || (m_code == 230 && !isSame(number, 1.0));
  }

  void takeOfPolyline() {
    if (m_code == 70) m_polyline.flags = flags();
    if (isOtherAxis()) m_polyline.isBent = true;
  }

  void takeOfVertex() {
    if (m_code == 42 && !isSame(parseFinite(m_value).value_or(0.0), 0.0)) m_polyline.isBent = true;
    if (m_code >= 71 && m_code <= 74 && m_value.starts_with('-') && m_polyline.hidingLine == 0)
      m_polyline.hidingLine = m_begin;
  }

  void finishEntity() {
    if (m_block == kNone) return;
    DxfBlock& block = m_blocks[m_block];
    if (m_kind == "POLYLINE") m_polyline.isPaper = m_isPaper;
    if (m_kind == "VERTEX") ++m_polyline.vertices;
    if (isDxfShape(m_kind) && m_kind != "VERTEX") addShape(block);
    if (m_kind == "INSERT" && m_isPaper) ++m_paperInserts[m_name];
    if (m_isPaper) return;
    if (m_kind == "INSERT") addInsert(block);
    if (isDxfSolid(m_kind)) {
      block.note(m_begin, quotedWord(m_kind) + " is not read; export 3DFACEs");
      block.holdsShapes = true;
    }
    if (isDxfCurve(m_kind)) ++block.curves[m_kind];
  }

  void addShape(DxfBlock& block) {
    if (m_isPaper) ++m_paper[m_kind];
    if (m_isPaper) return;
    block.hasShapes = block.holdsShapes = true;
    if (m_hider != 0 && block.hidingLine == 0) block.hidingLine = m_hider;
    block.isCut = block.isCut || block.insertLine != 0;
  }

  void addInsert(DxfBlock& block) {
    DxfBlock::Inserts& inserts = block.inserts[m_name];
    if (inserts.line == 0) inserts.line = m_begin;
    if (!m_onlyMoves && inserts.turnedLine == 0) inserts.turnedLine = m_begin;
    if (m_hider != 0 && inserts.hidingLine == 0) inserts.hidingLine = m_hider;
    if (block.insertLine == 0) block.insertLine = m_begin;
  }

  void finishPolyline() {
    const Polyline line = std::exchange(m_polyline, {});
    if (line.begin == 0 || line.isPaper || m_block == kNone) return;
    constexpr std::int64_t kIsPolyface = 64;
    constexpr std::int64_t kAreStraight = 1 | 8 | 128;  // closed, in space, and how it is dashed
    const bool isLine = line.vertices == 2 && !line.isBent && (line.flags & ~kAreStraight) == 0;
    DxfBlock& block = m_blocks[m_block];
    if ((line.flags & kIsPolyface) == 0 && !isLine)
      block.note(line.begin, "a POLYLINE that is no polyface mesh is not read; export LINEs");
    if (line.hidingLine != 0)
      block.note(line.hidingLine, "a POLYLINE that hides edges of its faces is not read; export 3DFACEs");
  }

  void findBlocks() {
    for (std::size_t i = kDrawing + 1; i < m_blocks.size(); ++i) {
      m_byName[m_blocks[i].head.name] = i;
      m_byAnyCase[lowerCase(m_blocks[i].head.name)] = i;
      m_byNameOfAssimp[m_blocks[i].ofAssimp.name] = i;
    }
  }

  static std::size_t placeIn(const std::map<std::string, std::size_t>& places, const std::string& name) {
    const auto found = places.find(name);
    return found == places.end() ? kNone : found->second;
  }

  /// Names are the same in upper and in lower case, but where a file has both.
  [[nodiscard]] std::size_t blockNamed(const std::string& name) const {
    const std::size_t exact = placeIn(m_byName, name);
    return exact != kNone ? exact : placeIn(m_byAnyCase, lowerCase(name));
  }

  /// From blocks to those that they are in.
  void propagateShapes() {
    std::vector<std::vector<std::size_t>> users(m_blocks.size());
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < m_blocks.size(); ++i) {
      for (const auto& [name, inserts] : m_blocks[i].inserts) {
        const std::size_t block = blockNamed(name);
        if (block != kNone) users[block].push_back(i);
      }
      if (m_blocks[i].holdsShapes) waiting.push_back(i);
    }
    while (!waiting.empty()) {
      const std::size_t block = waiting.back();
      waiting.pop_back();
      for (const std::size_t user : users[block]) {
        if (!std::exchange(m_blocks[user].holdsShapes, true)) waiting.push_back(user);
      }
    }
  }

  /// Those of the drawing itself.
  void checkInserts() const {
    for (const auto& [name, inserts] : m_blocks[kDrawing].inserts) {
      const std::size_t place = blockNamed(name);
      const std::size_t taken = placeIn(m_byNameOfAssimp, name);
      const bool hasTaken = taken != kNone && m_blocks[taken].hasShapes;
      if (place != kNone && m_blocks[place].holdsShapes) checkInsert(m_blocks[place], inserts);
      if (taken == place || !(hasTaken || (place != kNone && m_blocks[place].hasShapes))) continue;
      if (hasTaken) failOfStray(m_blocks[taken]);
      if (m_blocks[place].stray.first != 0) failOfStray(m_blocks[place]);
      fail(inserts.line, "the block " + quotedWord(m_blocks[place].head.name) + " is not read where it is called " +
                             quotedWord(name));
    }
  }

  void checkInsert(const DxfBlock& block, const DxfBlock::Inserts& inserts) const {
    for (const std::size_t line : {inserts.hidingLine, block.hidingLine}) {
      if (line != 0) failOfHiding(line);
    }
    if (inserts.turnedLine != 0)
      fail(inserts.turnedLine, "an INSERT that turns, scales or repeats its block is not read; explode it");
    const bool isNested = std::any_of(block.inserts.begin(), block.inserts.end(), [this](const auto& nested) {
      const std::size_t place = blockNamed(nested.first);
      return place != kNone && m_blocks[place].holdsShapes;
    });
    if (isNested || block.isCut) fail(block.insertLine, "a block within a block is not read; explode it");
    if (block.hasShapes && isMisplaced(block)) failOfStray(block);
  }

  [[noreturn]] void failOfHiding(std::size_t line) const {
    fail(line, "what follows a text that begins with '{' is not read; remove it");
  }

  [[noreturn]] void failOfStray(const DxfBlock& block) const {
    fail(block.stray.first, "a block of faces or lines in which there is " + quotedWord(block.stray.second) +
                                " too is not read; explode it");
  }

  /// What is in the drawing, and in its blocks.
  void lookAtShown() {
    std::vector<bool> isShown(m_blocks.size());
    std::vector<std::size_t> waiting{kDrawing};
    isShown[kDrawing] = true;
    while (!waiting.empty()) {
      const DxfBlock& block = m_blocks[waiting.back()];
      waiting.pop_back();
      if (block.problem.first != 0) fail(block.problem.first, block.problem.second);
      for (const auto& [kind, count] : block.curves) m_curves[kind] += count;
      if (block.isElsewhere && !block.holdsShapes) m_elsewhere.push_back(block.head.name);
      for (const auto& [name, inserts] : block.inserts) {
        const std::size_t inner = blockNamed(name);
        if (inner == kNone || isShown[inner]) continue;
        isShown[inner] = true;
        waiting.push_back(inner);
      }
    }
  }

  void countPaperInserts() {
    for (const auto& [name, count] : m_paperInserts) {
      const std::size_t block = placeIn(m_byNameOfAssimp, name);
      if (block != kNone && m_blocks[block].hasShapes) m_paper["INSERT"] += count;
    }
  }

  void warn(std::vector<FileWarning>& warnings) const {
    const std::size_t curves = totalOf(m_curves);
    const std::size_t paper = totalOf(m_paper);
    if (curves != 0)
      warnings.push_back({"shapes", fmt::format("{} of kinds that are not read {} missing: {}", curves,
                                                curves == 1 ? "is" : "are", kindsOf(m_curves))});
    if (!m_elsewhere.empty())
      warnings.push_back({"shapes", "blocks of other drawings are not read, and missing: " + firstOf(m_elsewhere)});
    if (paper != 0)
      warnings.push_back({"shapes", fmt::format("{} of the paper space {} read as if in the model: {}", paper,
                                                paper == 1 ? "is" : "are", kindsOf(m_paper))});
  }

  [[nodiscard]] std::int64_t flags() const {
    std::int64_t value = 0;
    return parseWhole(m_value, value) == std::errc() ? value : 0;
  }

  [[noreturn]] void fail(std::size_t line, const std::string& problem) const { throw FileError(m_path, problem, line); }

  struct Polyline {
    std::size_t begin = 0;  ///< Its line; 0 where there is none.
    std::int64_t flags = 0;
    bool isPaper = false;
    bool isBent = false;  ///< It has arcs, or lies in a plane of its own.
    std::size_t vertices = 0;
    std::size_t hidingLine = 0;  ///< Of the first vertex that hides an edge.
  };

  std::string_view m_rest;
  const Path& m_path;
  const ReadScope& m_scope;
  std::size_t m_line = 0;
  std::int64_t m_code = 0;
  std::string_view m_value;
  std::string m_section;
  std::size_t m_block = kNone;   ///< That is being read.
  std::string m_kind;            ///< Of the entity that is being read.
  std::size_t m_begin = 0;       ///< Its line.
  std::string m_name;            ///< Of the block that it inserts.
  bool m_onlyMoves = true;       ///< It moves that block, and does nothing else to it.
  bool m_isPaper = false;        ///< It is no part of the model.
  std::size_t m_hider = 0;       ///< The line of the text that hides its begin; 0 where none does.
  std::size_t m_hidingLine = 0;  ///< The same of the value that is being read.
  std::size_t m_braceLine = 0;   ///< The line of the text that hides what comes next.
  Polyline m_polyline;
  std::vector<DxfBlock> m_blocks{1};
  std::map<std::string, std::size_t> m_byName;
  std::map<std::string, std::size_t> m_byAnyCase;
  std::map<std::string, std::size_t> m_byNameOfAssimp;
  KindCounts m_curves;
  KindCounts m_paper;  ///< Of shapes.
  KindCounts m_paperInserts;
  std::vector<std::string> m_elsewhere;
};

}  // namespace

void checkDxf(const Path& path, const ReadScope& scope, std::vector<FileWarning>& warnings) {
  std::string text = readText(path, scope.stop());
  makeLines(text);
  DxfCheck(text, path, scope).run(warnings);
}

}  // namespace allpairs::scene
