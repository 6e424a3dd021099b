// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace allpairs::scene {

/// Why a text is no JSON.
struct JsonProblem {
  std::optional<std::size_t> byte{};  ///< Where, if known.
  bool isTooDeep = false;
};

/// A JSON document that needs no memory to be destroyed. That of the library alone does, even one that could not be
/// read for want of memory, and ends the program where there is none.
class JsonTree {
 public:
  JsonTree() = default;
  ~JsonTree() { clear(root); }
  JsonTree(const JsonTree&) = delete;
  JsonTree& operator=(const JsonTree&) = delete;

  /// Reads a text in which at most so many lists and objects contain each other; returns what is wrong with it.
  [[nodiscard]] std::optional<JsonProblem> parse(std::string_view text, std::size_t mostDepth);

  nlohmann::json root;

 private:
  static void clear(nlohmann::json& json) noexcept;
};

}  // namespace allpairs::scene
