// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <string_view>
#include <utility>

#include "allpairs/scene/WriteResult.h"

namespace allpairs::scene {

/// Collects formatted text and hands it on in large pieces.
class TextBuffer {
 public:
  explicit TextBuffer(ByteSink sink) : m_sink(sink) {}

  template <class... Arguments>
  void format(fmt::format_string<Arguments...> text, Arguments&&... arguments) {
    fmt::format_to(fmt::appender(m_buffer), text, std::forward<Arguments>(arguments)...);
    flushIfFull();
  }

  void append(std::string_view text) {
    m_buffer.append(text);
    flushIfFull();
  }

  /// Must be called at the end; what the sink throws comes through.
  void flush() {
    if (m_buffer.size() != 0) m_sink(std::string_view(m_buffer.data(), m_buffer.size()));
    m_buffer.clear();
  }

 private:
  static constexpr std::size_t kFull = 1 << 16;  // large enough that the cost of a system call does not show

  void flushIfFull() {
    if (m_buffer.size() >= kFull) flush();
  }

  ByteSink m_sink;
  fmt::memory_buffer m_buffer;
};

}  // namespace allpairs::scene
