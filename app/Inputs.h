// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "allpairs/scene/BoxArray.h"
#include "allpairs/scene/ReadOptions.h"
#include "allpairs/scene/Scene.h"

namespace allpairs::app {

/// What the inputs hold together: boxes in one block where all are box arrays, else a scene of models.
using Inputs = std::variant<scene::BoxArray, scene::Scene>;

/// Which inputs to read, and how: what every command that reads has in common.
struct InputSettings {
  std::vector<std::string> paths;
  std::vector<std::string> searchRoots;
  bool partial = false;
};

/// Reads the inputs and puts them together in the order given.
[[nodiscard]] Inputs readInputs(const InputSettings& settings);

}  // namespace allpairs::app
