// SPDX-License-Identifier: MIT
#include "boxes/NpyHeader.h"

#include <charconv>
#include <optional>

#include "allpairs/Error.h"

namespace allpairs::scene {
namespace {

/// Reads the few Python literals that a header may hold.
class HeaderParser {
 public:
  explicit HeaderParser(std::string_view text) : m_text(text) {}

  NpyHeader parse() {
    expect('{');
    while (peek() != '}') {
      parseEntry();
      if (!accept(',')) break;
    }
    expect('}');
    skipSpace();
    if (!m_text.empty()) fail("text after the closing brace");
    return finish();
  }

 private:
  [[noreturn]] static void fail(const std::string& problem) {
    throw InvalidArgument("the .npy header is malformed: " + problem);
  }

  void parseEntry() {
    const std::string key = parseString();
    expect(':');
    if (key == "descr") {
      set(m_descr, key, parseType());
    } else if (key == "fortran_order") {
      set(m_fortranOrder, key, parseBool());
    } else if (key == "shape") {
      set(m_shape, key, parseShape());
    } else {
      fail("unknown key '" + key + "'");
    }
  }

  template <class T>
  static void set(std::optional<T>& field, const std::string& key, T value) {
    if (field) fail("'" + key + "' is there twice");
    field = std::move(value);
  }

  NpyHeader finish() {
    if (!m_descr) fail("'descr' is missing");
    if (!m_fortranOrder) fail("'fortran_order' is missing");
    if (!m_shape) fail("'shape' is missing");
    return {std::move(*m_descr), *m_fortranOrder, std::move(*m_shape)};
  }

  std::string parseType() {
    if (peek() == '[') throw InvalidArgument("holds a structured array; boxes are plain rows of 6 numbers");
    return parseString();
  }

  std::string parseString() {
    const char quote = peek();
    if (quote != '\'' && quote != '"') fail("a quoted text is expected");
    m_text.remove_prefix(1);
    const std::size_t end = m_text.find(quote);
    if (end == std::string_view::npos) fail("a quote is not closed");
    std::string result(m_text.substr(0, end));
    m_text.remove_prefix(end + 1);
    return result;
  }

  bool parseBool() {
    if (acceptWord("True")) return true;
    if (acceptWord("False")) return false;
    fail("'fortran_order' is neither True nor False");
  }

  std::vector<std::uint64_t> parseShape() {
    std::vector<std::uint64_t> shape;
    expect('(');
    while (peek() != ')') {
      shape.push_back(parseCount());
      if (!accept(',')) break;
    }
    expect(')');
    return shape;
  }

  std::uint64_t parseCount() {
    skipSpace();
    std::uint64_t value = 0;
    const auto [end, problem] = std::from_chars(m_text.data(), m_text.data() + m_text.size(), value);
    if (problem == std::errc::result_out_of_range) fail("a number in 'shape' is too large");
    if (problem != std::errc()) fail("'shape' holds something that is no whole number");
    m_text.remove_prefix(static_cast<std::size_t>(end - m_text.data()));
    if (m_text.starts_with('L')) m_text.remove_prefix(1);  // 200L, as Python 2 wrote it
    return value;
  }

  void skipSpace() {
    const std::size_t first = m_text.find_first_not_of(" \t\n");
    m_text.remove_prefix(first == std::string_view::npos ? m_text.size() : first);
  }

  char peek() {
    skipSpace();
    return m_text.empty() ? '\0' : m_text.front();
  }

  bool accept(char c) {
    if (peek() != c) return false;
    m_text.remove_prefix(1);
    return true;
  }

  void expect(char c) {
    if (!accept(c)) fail(std::string("'") + c + "' is expected");
  }

  bool acceptWord(std::string_view word) {
    skipSpace();
    if (!m_text.starts_with(word)) return false;
    m_text.remove_prefix(word.size());
    return true;
  }

  std::string_view m_text;
  std::optional<std::string> m_descr;
  std::optional<bool> m_fortranOrder;
  std::optional<std::vector<std::uint64_t>> m_shape;
};

}  // namespace

NpyHeader parseNpyHeader(std::string_view text) { return HeaderParser(text).parse(); }

std::string shapeText(std::span<const std::uint64_t> shape) {
  std::string text = "(";
  for (const std::uint64_t extent : shape) text += std::to_string(extent) + ", ";
  if (shape.size() > 1) text.resize(text.size() - 2);
  if (shape.size() == 1) text.pop_back();
  return text + ")";
}

}  // namespace allpairs::scene
