// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

namespace allpairs::scene {

/// Tells names apart by a number behind those that come again: wheel, wheel#2, wheel#3.
class UniqueNames {
 public:
  void add(const std::string& name) { m_next.try_emplace(name, 2); }
  [[nodiscard]] bool contains(const std::string& name) const { return m_next.contains(name); }

  /// The name itself, or with the first number that makes it a new one; it is taken from now on.
  [[nodiscard]] std::string unique(const std::string& name) {
    if (!contains(name)) {
      add(name);
      return name;
    }
    std::string numbered;
    do {
      numbered = name + '#' + std::to_string(m_next[name]++);
    } while (contains(numbered));
    add(numbered);
    return numbered;
  }

 private:
  std::unordered_map<std::string, std::size_t> m_next;
};

}  // namespace allpairs::scene
