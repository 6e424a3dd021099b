// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

namespace sofa::helper {

/// One of several named choices.
class OptionsGroup {
 public:
  OptionsGroup(std::initializer_list<std::string> names) : m_names(names) {}

  OptionsGroup& setSelectedItem(const std::string& name) {
    m_selected = static_cast<unsigned>(std::find(m_names.begin(), m_names.end(), name) - m_names.begin());
    return *this;
  }
  [[nodiscard]] unsigned getSelectedId() const { return m_selected; }

 private:
  std::vector<std::string> m_names;
  unsigned m_selected = 0;
};

}  // namespace sofa::helper
