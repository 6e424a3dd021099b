// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace allpairs::scene {

/// A corner of an element by indices from 0, kNone where the file gives none.
struct ObjCorner {
  static constexpr std::int64_t kNone = -1;

  std::int64_t position = kNone;
  std::int64_t texture = kNone;
  std::int64_t normal = kNone;
};

/// What one reader of Wavefront files takes from them and another does not.
struct ObjSyntax {
  std::string_view elements;    ///< The statements that are elements: of f, l and p.
  bool joinsLines = false;      ///< A line that ends in a backslash goes on in the next.
  bool endsInComments = false;  ///< A comment may follow the numbers of a statement. In a name, # is a letter.
  bool readsSeams = false;      ///< Corners have a texture coordinate and a normal beside their position.
  std::int64_t maxIndex = std::numeric_limits<std::int64_t>::max();  ///< From 0; a larger one names no vertex.
};

/// What is wrong with an index.
enum class ObjProblem { NoNumber, NoPosition, IsZero, BeforeFirst, TooLarge };

/// Parses a Wavefront file, statement by statement. What becomes of them, and in which words an error says what is
/// wrong, is up to the reader that derives from this.
class ObjParser {
 public:
  ObjParser(const ObjParser&) = delete;
  ObjParser& operator=(const ObjParser&) = delete;
  ObjParser(ObjParser&&) = delete;
  ObjParser& operator=(ObjParser&&) = delete;
  virtual ~ObjParser() = default;

 protected:
  ObjParser(const std::filesystem::path& path, const ObjSyntax& syntax) : m_path(path), m_syntax(syntax) {}

  void parse(std::string_view text);
  /// Whether the text has a statement of this keyword.
  [[nodiscard]] bool hasStatement(std::string_view text, std::string_view keyword) const;

  /// The line that is parsed, the last one of those that are joined.
  [[nodiscard]] std::size_t line() const noexcept { return m_line; }
  [[noreturn]] void fail(const std::string& problem) const { failAt(m_line, problem); }
  [[noreturn]] void failAt(std::size_t line, const std::string& problem) const;

 private:
  virtual void addPosition(std::string_view coordinates) = 0;
  virtual void addElement(char kind, std::span<const ObjCorner> corners) = 0;
  /// At an "o" or a "g".
  virtual void beginObject(std::string_view keyword, std::string_view name) = 0;
  /// At any other statement.
  virtual void passOver(std::string_view /*keyword*/) {}
  /// Throws what fail throws.
  [[noreturn]] virtual void refuse(ObjProblem problem, std::string_view index) const = 0;

  template <class Visit>
  void forEachLine(std::string_view text, const Visit& visit) const;
  void parseStatement(std::string_view keyword, std::string_view rest);
  void parseElement(char kind, std::string_view corners);
  [[nodiscard]] ObjCorner parseCorner(std::string_view word) const;
  [[nodiscard]] std::int64_t resolve(std::string_view index, std::size_t count) const;

  const std::filesystem::path& m_path;
  ObjSyntax m_syntax;
  std::size_t m_line = 0;
  std::size_t m_positionCount = 0;
  std::size_t m_textureCount = 0;
  std::size_t m_normalCount = 0;
  std::vector<ObjCorner> m_element;
};

}  // namespace allpairs::scene
