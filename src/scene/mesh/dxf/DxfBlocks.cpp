// SPDX-License-Identifier: MIT
#include "mesh/dxf/DxfBlocks.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "allpairs/scene/FileError.h"
#include "input/Characters.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

using Path = std::filesystem::path;

/// The layer whose shapes are those of the layer in which their block is inserted.
constexpr std::string_view kLayerOfInsert = "0";

/// The name of a layer in UTF-8, where it has characters as \U+00E4. What is no such character stays as it is.
std::string decodedDxf(std::string_view text) {
  constexpr std::string_view kBegin = "\\U+";
  constexpr std::uint32_t kFirstPrinted = 0x20;
  constexpr std::size_t kDigits = 4;
  constexpr std::size_t kLength = kBegin.size() + kDigits;
  const auto codeAt = [&](std::size_t at) {
    const bool isThere = at < text.size() && text.substr(at).starts_with(kBegin);
    return isThere ? hexAt(text, at + kBegin.size(), kDigits).value_or(0) : 0;
  };
  std::string decoded;
  for (std::size_t at = 0; at < text.size();) {
    const std::uint32_t code = codeAt(at);
    const std::uint32_t next = isHighHalf(code) ? codeAt(at + kLength) : 0;
    if (isLowHalf(next)) {
      appendUtf8(decoded, joinHalves(code, next));
      at += 2 * kLength;
    } else if (code >= kFirstPrinted && !isHighHalf(code) && !isLowHalf(code)) {
      appendUtf8(decoded, code);
      at += kLength;
    } else {
      decoded.push_back(text[at++]);
    }
  }
  return decoded;
}

/// Puts blocks in their places.
class DxfDrawing {
 public:
  DxfDrawing(const std::vector<DxfBlock>& blocks, const Path& path, ReadScope& scope)
      : m_blocks(blocks), m_path(path), m_scope(scope), m_holdsShapes(blocks.size()) {
    for (std::size_t i = 1; i < blocks.size(); ++i) {
      if (!m_byName.insert_or_assign(blocks[i].name, i).second) m_repeated.insert(blocks[i].name);
      m_byAnyCase[lowerCase(blocks[i].name)] = i;
    }
  }

  std::vector<MeshObject> show(FileNotes& notes) {
    lookAtShown();
    warn(notes.warnings);
    if (m_hidden != 0)
      notes.passedOver.push_back(
          fmt::format("{} of its entities {} hidden, and passed over", m_hidden, m_hidden == 1 ? "is" : "are"));
    findShapes();
    addBlock(0, kIdentity, std::string(kLayerOfInsert), 0);
    if (m_shown.objects().empty() && !m_unread.empty())
      throw FileError(m_path, "holds no triangles, lines or points: " + unread());
    for (MeshObject& object : m_shown.objects()) object.name = decodedDxf(object.name);
    return std::move(m_shown.objects());
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  static std::size_t placeIn(const std::map<std::string, std::size_t>& places, const std::string& name) {
    const auto found = places.find(name);
    return found == places.end() ? kNone : found->second;
  }

  /// Names are the same in upper and in lower case, but where a file has both.
  [[nodiscard]] std::size_t blockNamed(const std::string& name) const {
    const std::size_t exact = placeIn(m_byName, name);
    return exact != kNone ? exact : placeIn(m_byAnyCase, lowerCase(name));
  }

  /// What is in the drawing, and in its blocks.
  void lookAtShown() {
    std::vector<bool> isShown(m_blocks.size());
    std::vector<std::size_t> waiting{0};
    std::map<std::string, bool> isNamed;
    isShown[0] = true;
    while (!waiting.empty()) {
      const DxfBlock& block = m_blocks[waiting.back()];
      waiting.pop_back();
      if (block.problemLine != 0) throw FileError(m_path, block.problem, block.problemLine);
      m_hidden += block.hidden;
      for (const auto& [kind, count] : block.unread) m_unread[kind] += count;
      for (const DxfInsert& insert : block.inserts) {
        const std::size_t inner = blockNamed(insert.block);
        if (inner == kNone && !std::exchange(isNamed[insert.block], true)) m_undefined.push_back(insert.block);
        if (inner == kNone || isShown[inner]) continue;
        isShown[inner] = true;
        waiting.push_back(inner);
        const DxfBlock& found = m_blocks[inner];
        if (m_repeated.contains(found.name)) m_lastOfName.push_back(found.name);
        if (found.isElsewhere && found.layers.objects().empty() && found.inserts.empty())
          m_elsewhere.push_back(found.name);
      }
    }
  }

  [[nodiscard]] std::string unread() const {
    constexpr std::size_t kNamed = 10;
    std::size_t total = 0;
    std::size_t named = 0;
    std::string kinds;
    for (const auto& [kind, count] : m_unread) {
      total += count;
      if (named < kNamed) kinds += (named++ == 0 ? "" : ", ") + kind;
    }
    if (m_unread.size() > named) kinds += fmt::format(" and {} more", m_unread.size() - named);
    return fmt::format("{} of kinds that are not read {} missing: {}", total, total == 1 ? "is" : "are", kinds);
  }

  void warn(std::vector<FileWarning>& warnings) const {
    if (!m_unread.empty()) warnings.push_back({"shapes", unread()});
    if (!m_elsewhere.empty())
      warnings.push_back({"shapes", "blocks of other drawings are not read, and missing: " + firstOf(m_elsewhere)});
    if (!m_undefined.empty())
      warnings.push_back({"shapes", "blocks that the file does not have are missing: " + firstOf(m_undefined)});
    if (!m_lastOfName.empty())
      warnings.push_back({"shapes", "of blocks with the same name only the last is shown: " + firstOf(m_lastOfName)});
  }

  /// Passes what holds shapes from blocks to those that they are in.
  void findShapes() {
    std::vector<std::vector<std::size_t>> users(m_blocks.size());
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < m_blocks.size(); ++i) {
      for (const DxfInsert& insert : m_blocks[i].inserts) {
        const std::size_t block = blockNamed(insert.block);
        if (block != kNone) users[block].push_back(i);
      }
      m_holdsShapes[i] = !m_blocks[i].layers.objects().empty();
      if (m_holdsShapes[i]) waiting.push_back(i);
    }
    while (!waiting.empty()) {
      const std::size_t block = waiting.back();
      waiting.pop_back();
      for (const std::size_t user : users[block]) {
        if (m_holdsShapes[user]) continue;
        m_holdsShapes[user] = true;
        waiting.push_back(user);
      }
    }
  }

  void addBlock(std::size_t place, const Transform& transform, const std::string& layer, std::size_t depth) {
    constexpr std::size_t kDeepest = 200;  // far more than drawings have, and no danger to the stack
    const DxfBlock& block = m_blocks[place];
    if (depth > kDeepest)
      throw FileError(m_path, "the block " + quotedWord(block.name) + " is in itself, or in too many others");
    for (const MeshObject& object : block.layers.objects())
      addObject(m_shown.of(object.name == kLayerOfInsert ? layer : object.name, m_scope), object, transform);
    for (const DxfInsert& insert : block.inserts) {
      m_scope.take(sizeof(DxfInsert));  // for the time: a few blocks in each other may ask for much of it
      const std::size_t inner = blockNamed(insert.block);
      if (inner == kNone || !m_holdsShapes[inner]) continue;
      const std::string& inserted = insert.layer == kLayerOfInsert ? layer : insert.layer;
      Transform base = kIdentity;
      for (std::size_t axis = 0; axis < 3; ++axis) base[axis][3] = -m_blocks[inner].base[axis];
      for (std::uint64_t row = 0; row < insert.rows; ++row) {
        for (std::uint64_t column = 0; column < insert.columns; ++column) {
          Transform there = insert.place;
          for (std::size_t axis = 0; axis < 3; ++axis)
            there[axis][3] +=
                static_cast<double>(column) * insert.columnStep[axis] + static_cast<double>(row) * insert.rowStep[axis];
          addBlock(inner, multiply(transform, multiply(there, base)), inserted, depth + 1);
        }
      }
    }
  }

  void addObject(MeshObject& shown, const MeshObject& object, const Transform& transform) {
    const std::size_t first = shown.positions.size();
    if (first + object.positions.size() > std::numeric_limits<std::uint32_t>::max())
      throw FileError(m_path, "has too many vertices in the layer " + quotedWord(shown.name));
    m_scope.takeElements(object.positions.size(), sizeof(Point));
    m_scope.takeElements(object.triangles.size() + object.lines.size() + object.points.size(),
                         sizeof(object.triangles[0]));
    for (const Point& position : object.positions) {
      shown.positions.push_back(placed(transform, position));
      for (const double coordinate : shown.positions.back()) {
        if (!std::isfinite(coordinate))
          throw FileError(m_path, "has coordinates too large for a number in the layer " + quotedWord(shown.name));
      }
    }
    const auto moved = [first](std::uint32_t index) { return static_cast<std::uint32_t>(first + index); };
    for (const auto& [a, b, c] : object.triangles) shown.triangles.push_back({moved(a), moved(b), moved(c)});
    for (const auto& [a, b] : object.lines) shown.lines.push_back({moved(a), moved(b)});
    for (const std::uint32_t point : object.points) shown.points.push_back(moved(point));
  }

  const std::vector<DxfBlock>& m_blocks;
  const Path& m_path;
  ReadScope& m_scope;
  std::map<std::string, std::size_t> m_byName;
  std::map<std::string, std::size_t> m_byAnyCase;
  std::set<std::string> m_repeated;  ///< Names that several blocks have.
  std::vector<bool> m_holdsShapes;
  std::size_t m_hidden = 0;
  std::map<std::string, std::size_t> m_unread;
  std::vector<std::string> m_lastOfName;
  std::vector<std::string> m_elsewhere;
  std::vector<std::string> m_undefined;
  DxfLayers m_shown;
};

}  // namespace

MeshObject& DxfLayers::of(std::string_view layer, ReadScope& scope) {
  auto found = m_places.find(layer);
  if (found == m_places.end()) {
    scope.takeElements(1, sizeof(MeshObject) + layer.size());
    found = m_places.emplace(layer, m_objects.size()).first;
    m_objects.emplace_back().name = layer;
  }
  return m_objects[found->second];
}

std::vector<MeshObject> showDrawing(const std::vector<DxfBlock>& blocks, const Path& path, ReadScope& scope,
                                    FileNotes& notes) {
  return DxfDrawing(blocks, path, scope).show(notes);
}

}  // namespace allpairs::scene
