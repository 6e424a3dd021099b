// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "cli/Output.h"

namespace allpairs::app {

/// Passes on text a part at a time: a call of the system for each line takes longer than the line, most of all on
/// network disks.
class TextParts {
 public:
  explicit TextParts(Output& output) : m_output(output) {}

  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(m_text), format, std::forward<Values>(values)...);
    if (m_text.size() > kPart) flush();
  }

  void write(std::string_view bytes) {
    if (m_text.size() + bytes.size() > kPart) flush();
    if (bytes.size() > kPart) return m_output.write(bytes);
    m_text += bytes;
  }

  /// At the end.
  void flush() {
    m_output.write(m_text);
    m_text.clear();
  }

 private:
  static constexpr std::size_t kPart = std::size_t{1} << 16;

  Output& m_output;
  std::string m_text;
};

}  // namespace allpairs::app
