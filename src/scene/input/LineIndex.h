// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

namespace allpairs::scene {

/// Turns an offset into a text into a line and a column, both from 1.
class LineIndex {
 public:
  struct Position {
    std::size_t line;
    std::size_t column;
  };

  explicit LineIndex(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == '\n') m_starts.push_back(i + 1);
  }

  [[nodiscard]] Position at(std::size_t offset) const {
    const auto after = std::ranges::upper_bound(m_starts, offset);
    const auto line = static_cast<std::size_t>(after - m_starts.begin());
    return {line, offset - m_starts[line - 1] + 1};
  }

 private:
  std::vector<std::size_t> m_starts{0};
};

}  // namespace allpairs::scene
