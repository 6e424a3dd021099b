// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <initializer_list>
#include <istream>
#include <string>
#include <vector>

namespace sofa::helper {

/// One of several named choices. Reads a name, else a number, which any other word is too: 0.
class OptionsGroup {
 public:
  OptionsGroup(std::initializer_list<std::string> names) : m_names(names) {}

  OptionsGroup& setSelectedItem(const std::string& name) {
    if (const std::size_t place = placeOf(name); place < m_names.size()) m_selected = static_cast<unsigned>(place);
    return *this;
  }
  [[nodiscard]] unsigned getSelectedId() const { return m_selected; }
  [[nodiscard]] const std::string& getSelectedItem() const { return m_names[m_selected]; }

  friend std::istream& operator>>(std::istream& stream, OptionsGroup& group) {
    std::string word;
    std::getline(stream, word);
    const std::size_t named = group.placeOf(word);
    const bool isName = named < group.m_names.size();
    const int place = isName ? static_cast<int>(named) : std::atoi(word.c_str());
    if (place >= 0 && place < static_cast<int>(group.m_names.size())) group.m_selected = static_cast<unsigned>(place);
    return stream;
  }

 private:
  [[nodiscard]] std::size_t placeOf(const std::string& name) const {
    return static_cast<std::size_t>(std::find(m_names.begin(), m_names.end(), name) - m_names.begin());
  }

  std::vector<std::string> m_names;
  unsigned m_selected = 0;
};

}  // namespace sofa::helper
