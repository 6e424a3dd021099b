// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "ViewScene.h"

namespace allpairs::view {

/// What a page reads of a scene.
struct SceneData {
  std::string json;   ///< Names, words and settings, and a list of arrays; no character in it can end a script element.
  std::string bytes;  ///< The numbers of the arrays, in the order of their list.
};

/// Bad input: more than a page can hold throws Error.
[[nodiscard]] SceneData dataOf(const ViewScene& scene);

}  // namespace allpairs::view
