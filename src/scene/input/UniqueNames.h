// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

namespace allpairs::scene {

/// Tells names apart by a number behind those that come again: wheel, wheel#2, wheel#3.
class UniqueNames {
 public:
  /// Keeps a name for what has it by itself: of names that are all known, before the first is told apart.
  void note(const std::string& name) { m_next.try_emplace(name, 1); }

  void add(const std::string& name) { m_next.try_emplace(name, 2); }
  [[nodiscard]] bool contains(const std::string& name) const { return m_next.contains(name); }

  /// The name itself, or with the first number that makes it a new one; it is taken from now on.
  [[nodiscard]] std::string unique(const std::string& name) {
    std::size_t& next = m_next.try_emplace(name, 1).first->second;
    if (next == 1) {
      next = 2;
      return name;
    }
    std::string numbered;
    do {
      numbered = name + '#' + std::to_string(next++);
    } while (contains(numbered));
    add(numbered);
    return numbered;
  }

 private:
  std::unordered_map<std::string, std::size_t> m_next;  ///< The next number; 1: nothing has the name yet.
};

}  // namespace allpairs::scene
