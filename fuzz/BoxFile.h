// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "SceneFile.h"
#include "allpairs/scene/BoxArray.h"

namespace allpairs::fuzz {

/// Reads a box array alone and twice in a row, asks for each box and name, and then reads it as a scene.
inline void readBoxes(const std::filesystem::path& path) {
  try {
    std::vector<scene::BoxArray> arrays;
    arrays.push_back(scene::readBoxArray(path));
    const std::size_t size = arrays.front().size();
    for (std::size_t i = 0; i < size; ++i) {
      require(!hasNan(arrays.front().boxes()[i]), "a box has no NaN");
      require(!arrays.front().name(i).empty(), "a box has a name");
    }
    arrays.push_back(scene::readBoxArray(path));
    const scene::BoxArray both = scene::BoxArray::concatenate(std::move(arrays));
    require(both.size() == 2 * size, "concatenate() keeps all boxes");
    for (std::size_t i = 0; i < size; ++i)
      require(both.boxes()[i] == both.boxes()[i + size], "a file reads the same twice");
  } catch (const Error& error) {
    examine(error);
  }
  readAndDetect(path);
}

}  // namespace allpairs::fuzz
