// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "support/Data.h"

namespace allpairs::scene {

/// The folder of scenes with known answers; empty where there is none.
inline std::filesystem::path dataScenes() {
  const auto scenes = test::dataFolder() / "scenes";
  return std::filesystem::is_directory(scenes) ? scenes : std::filesystem::path{};
}

}  // namespace allpairs::scene

/// Names the folder of scenes, or leaves the test and says so.
#define ALLPAIRS_NEED_SCENES(scenes)                   \
  const auto scenes = ::allpairs::scene::dataScenes(); \
  if (scenes.empty()) GTEST_SKIP() << "no ../shared/data/scenes, and ALLPAIRS_DATA names none: nothing was compared"
