// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "input/Words.h"
#include "mesh/MeshObject.h"

namespace allpairs::scene {

/// Takes the position that a line of a mesh begins with off the line. fail(problem) must throw; `name` is what the
/// format calls a position, with its article.
template <class Fail>
[[nodiscard]] Point takePosition(std::string_view& line, const char* name, const Fail& fail) {
  Point position{};
  for (double& coordinate : position) {
    const std::string_view word = takeWord(line);
    const std::optional<double> value = parseNumber(word);
    if (word.empty()) fail(std::string(name) + " has three coordinates");
    if (!value || !std::isfinite(*value)) fail(quotedWord(word) + " is no finite number");
    coordinate = *value;
  }
  return position;
}

}  // namespace allpairs::scene
