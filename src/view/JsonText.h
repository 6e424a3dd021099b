// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace allpairs::view {

/// JSON that is text from the start. The library's documents ask for memory where they are destroyed, and end the
/// program where there is none; only single values are left to it.
class JsonText {
 public:
  /// In one line, or a line for each value.
  enum class Layout { Compact, Indented };

  explicit JsonText(Layout layout) : m_isIndented(layout == Layout::Indented) {}

  void beginObject(std::string_view key = {}) { begin(key, '{'); }
  void endObject() { end('}'); }
  void beginList(std::string_view key = {}) { begin(key, '['); }
  void endList() { end(']'); }

  /// A value of an object, or, without a key, of a list.
  template <class Value>
  void add(std::string_view key, const Value& value) {
    separate(key);
    m_text += textOf(value);
    m_isFirst = false;
  }

  /// A number; "inf" or "-inf", which JSON has no numbers for.
  void addReal(std::string_view key, double value) {
    if (std::isinf(value)) return add(key, value > 0.0 ? "inf" : "-inf");
    add(key, value);
  }

  [[nodiscard]] const std::string& text() const { return m_text; }

 private:
  template <class Value>
  static std::string textOf(const Value& value) {
    return nlohmann::json(value).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }

  void begin(std::string_view key, char bracket) {
    separate(key);
    m_text += bracket;
    ++m_depth;
    m_isFirst = true;
  }

  void end(char bracket) {
    --m_depth;
    if (!m_isFirst) breakLine();
    m_text += bracket;
    m_isFirst = false;
  }

  void separate(std::string_view key) {
    if (!m_isFirst) m_text += ',';
    if (m_depth > 0) breakLine();
    if (!key.empty()) m_text += textOf(key) + (m_isIndented ? ": " : ":");
  }

  void breakLine() {
    if (m_isIndented) m_text.append(1, '\n').append(m_depth, ' ');
  }

  std::string m_text;
  bool m_isIndented;
  bool m_isFirst = true;
  std::size_t m_depth = 0;
};

}  // namespace allpairs::view
