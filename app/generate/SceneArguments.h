// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "allpairs/generate/BoxScenes.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace allpairs::app {

/// A made-up scene as the command line names it.
struct SceneArguments {
  std::string scene;
  std::uint64_t count = 1000;
  std::uint64_t seed = 1;
  bool sorted = false;
};

/// Adds -n, --seed and --sorted.
void addSceneOptions(CLI::App& command, SceneArguments& arguments);

/// Whether there is a scene of this name.
[[nodiscard]] bool isSceneName(const std::string& name);

/// Bad input: an unknown scene or too many boxes throw UsageError.
[[nodiscard]] generate::SceneRequest sceneRequest(const SceneArguments& arguments);

/// The scenes with their descriptions, one on a line, for --help.
[[nodiscard]] std::string sceneList();

}  // namespace allpairs::app
