// SPDX-License-Identifier: MIT
#include "mesh/assimp/IfcNames.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "input/Characters.h"
#include "input/Words.h"

namespace allpairs::scene {
namespace {

constexpr std::size_t kIdLength = 22;

bool isOfWord(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; }

/// Takes a string of a STEP file apart.
class StepDecoder {
 public:
  explicit StepDecoder(std::string_view text) : m_text(text) {}

  std::string decode() {
    while (!m_text.empty()) {
      if (m_text.starts_with("''") || m_text.starts_with("\\\\")) {
        m_result.push_back(m_text.front());
        m_text.remove_prefix(2);
      } else if (m_text.front() != '\\' || !takeDirective()) {
        m_result.push_back(m_text.front());
        m_text.remove_prefix(1);
      }
    }
    return std::move(m_result);
  }

 private:
  /// Returns false, and takes nothing, where it is none.
  bool takeDirective() {
    if (m_text.starts_with("\\X2\\")) return takeCodes(4);
    if (m_text.starts_with("\\X4\\")) return takeCodes(8);
    if (m_text.starts_with("\\X\\")) {
      const std::optional<std::uint32_t> code = hexAt(m_text, 3, 2);
      if (code) take(*code, 5);
      return code.has_value();
    }
    if (!m_text.starts_with("\\S\\") || m_text.size() < 4) return false;
    const auto low = static_cast<unsigned char>(m_text[3]);  // of the second half of ISO 8859-1
    if (low < 0x80) take(low + 0x80U, 4);
    return low < 0x80;
  }

  void take(std::uint32_t code, std::size_t length) {
    appendUtf8(m_result, code);
    m_text.remove_prefix(length);
  }

  /// Codes of so many digits until \X0\.
  bool takeCodes(std::size_t digits) {
    std::string decoded;
    std::uint32_t high = 0;  // of two that are one character
    std::size_t at = 4;
    for (; m_text.substr(std::min(at, m_text.size()), 4) != "\\X0\\"; at += digits) {
      const std::optional<std::uint32_t> code = hexAt(m_text, at, digits);
      if (!code || *code > 0x10FFFF) return false;
      const bool isHigh = isHighHalf(*code);
      const bool isLow = isLowHalf(*code);
      if (isLow != (high != 0)) return false;
      if (isLow) appendUtf8(decoded, joinHalves(high, *code));
      if (!isLow && !isHigh) appendUtf8(decoded, *code);
      high = isHigh ? *code : 0;
    }
    if (high != 0) return false;
    m_result += decoded;
    m_text.remove_prefix(at + 4);
    return true;
  }

  std::string_view m_text;
  std::string m_result;
};

/// Goes through the statements of a STEP file.
class StepScanner {
 public:
  explicit StepScanner(std::string_view text) : m_text(text) {}

  [[nodiscard]] bool isAtEnd() const { return m_at >= m_text.size(); }

  /// Behind the next ';' that is in no string.
  void skipStatement() {
    while (!isAtEnd()) {
      const char c = m_text[m_at];
      if (c == '\'') {
        static_cast<void>(string());
        continue;
      }
      if (c == '/' && skipComment()) continue;
      ++m_at;
      if (c == ';') return;
    }
  }

  /// Takes a character, and what is blank before it.
  bool take(char wanted) {
    const bool isThere = isBefore(wanted);
    m_at += isThere ? 1 : 0;
    return isThere;
  }

  /// Whether a character is the next one that is not blank.
  bool isBefore(char wanted) {
    skipBlanks();
    return !isAtEnd() && m_text[m_at] == wanted;
  }

  void skipCharacter() {
    if (!isAtEnd()) ++m_at;
  }

  std::string_view word() {
    skipBlanks();
    const std::size_t begin = m_at;
    while (!isAtEnd() && isOfWord(m_text[m_at])) ++m_at;
    return m_text.substr(begin, m_at - begin);
  }

  /// What is between quotes; nothing where no quote stands.
  std::optional<std::string_view> string() {
    if (!take('\'')) return std::nullopt;
    const std::size_t begin = m_at;
    for (;;) {
      const std::size_t quote = m_text.find('\'', m_at);
      if (quote == std::string_view::npos) break;
      m_at = quote + 1;
      if (isAtEnd() || m_text[m_at] != '\'') return m_text.substr(begin, quote - begin);
      ++m_at;  // two of them are one in the string
    }
    m_at = m_text.size();
    return std::nullopt;
  }

 private:
  void skipBlanks() {
    while (!isAtEnd() && (isBlankOrLineEnd(m_text[m_at]) || (m_text[m_at] == '/' && skipComment()))) {
      if (!isAtEnd() && isBlankOrLineEnd(m_text[m_at])) ++m_at;
    }
  }

  bool skipComment() {
    if (m_text.substr(m_at, 2) != "/*") return false;
    const std::size_t end = m_text.find("*/", m_at + 2);
    m_at = end == std::string_view::npos ? m_text.size() : end + 2;
    return true;
  }

  std::string_view m_text;
  std::size_t m_at = 0;
};

/// A statement of a STEP file as #7=IFCWALL('name',#5,(#6)), with what it names at any depth.
struct StepStatement {
  std::string_view number;
  std::string_view kind;
  std::vector<std::string_view> strings;
  std::vector<std::string_view> references;
};

StepStatement statementOf(StepScanner& step) {
  StepStatement statement;
  if (!step.take('#')) return statement;
  statement.number = step.word();
  if (step.take('=')) statement.kind = step.word();
  while (!step.isAtEnd() && !step.isBefore(';')) {
    if (step.isBefore('\'')) {
      const std::optional<std::string_view> text = step.string();
      if (text) statement.strings.push_back(*text);
    } else if (step.take('#')) {
      statement.references.push_back(step.word());
    } else {
      step.skipCharacter();
    }
  }
  return statement;
}

/// What the rest of a statement says that begins like #7=IFCWALL('1AvctVUKr0kugbFTf53O9L',#5,'name'.
void readName(StepScanner& step, std::unordered_map<std::string, std::string>& names) {
  if (!step.take('#') || step.word().empty() || !step.take('=') || !step.word().starts_with("IFC")) return;
  if (!step.take('(')) return;
  const std::optional<std::string_view> id = step.string();
  if (!id || id->size() != kIdLength || !step.take(',')) return;
  if (!step.take('$') && (!step.take('#') || step.word().empty())) return;  // the history of its owners
  if (!step.take(',')) return;
  const std::optional<std::string_view> name = step.string();
  if (name) names.try_emplace(std::string(*id), decodedStep(*name));
}

}  // namespace

std::string decodedStep(std::string_view text) { return StepDecoder(text).decode(); }

std::unordered_map<std::string, std::string> ifcNames(std::string_view text) {
  std::unordered_map<std::string, std::string> names;
  if (!text.starts_with("ISO-10303-21")) return names;
  StepScanner step(text);
  while (!step.isAtEnd()) {
    readName(step, names);
    step.skipStatement();
  }
  return names;
}

std::unordered_set<std::string> ifcProductsOfBoxes(std::string_view text, const std::unordered_set<std::string>& ids) {
  using References = std::vector<std::string_view>;
  std::unordered_set<std::string_view> boxes;                    // representations that are one
  std::unordered_map<std::string_view, References> definitions;  // representations of each
  std::vector<std::pair<std::string_view, References>> products;
  StepScanner step(text);
  for (; !step.isAtEnd(); step.skipStatement()) {
    StepStatement statement = statementOf(step);
    const auto& strings = statement.strings;
    if (statement.kind == "IFCSHAPEREPRESENTATION" && !strings.empty() && strings.back() == "BoundingBox") {
      boxes.insert(statement.number);
    } else if (statement.kind == "IFCPRODUCTDEFINITIONSHAPE") {
      definitions[statement.number] = std::move(statement.references);
    } else if (!strings.empty() && ids.contains(std::string(strings.front()))) {
      products.emplace_back(strings.front(), std::move(statement.references));
    }
  }
  std::unordered_set<std::string> found;
  for (const auto& [id, references] : products) {
    for (const std::string_view reference : references) {
      const auto shape = definitions.find(reference);
      if (shape == definitions.end()) continue;
      const References& parts = shape->second;
      if (std::any_of(parts.begin(), parts.end(), [&boxes](std::string_view part) { return boxes.contains(part); }))
        found.emplace(id);
    }
  }
  return found;
}

}  // namespace allpairs::scene
