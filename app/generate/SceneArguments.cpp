// SPDX-License-Identifier: MIT
#include "generate/SceneArguments.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <limits>

#include "cli/ExitStatus.h"
#include "cli/Options.h"

namespace allpairs::app {

void addSceneOptions(CLI::App& command, SceneArguments& arguments) {
  takeCount(*command.add_option("-n,--boxes", arguments.count, "Number of boxes, also as 1e6")
                 ->type_name("N")
                 ->capture_default_str());
  takeCount(*command.add_option("--seed", arguments.seed, "Seed of the random numbers")
                 ->type_name("S")
                 ->capture_default_str());
  command.add_flag("--sorted", arguments.sorted, "Sort the boxes in Morton order");
}

bool isSceneName(const std::string& name) {
  const auto scenes = generate::boxScenes();
  return std::any_of(scenes.begin(), scenes.end(), [&](const generate::BoxScene& s) { return s.name == name; });
}

generate::SceneRequest sceneRequest(const SceneArguments& arguments) {
  if (!isSceneName(arguments.scene)) throw UsageError("'" + arguments.scene + "' is not the name of a scene");
  if (arguments.count > std::numeric_limits<std::uint32_t>::max()) {
    throw UsageError("-n: a scene has at most 4294967295 boxes");
  }
  const auto scenes = generate::boxScenes();
  const auto scene = std::find_if(scenes.begin(), scenes.end(),
                                  [&](const generate::BoxScene& s) { return s.name == arguments.scene; });
  return {.scene = scene->name,
          .count = static_cast<std::size_t>(arguments.count),
          .seed = arguments.seed,
          .sorted = arguments.sorted};
}

std::string sceneList() {
  constexpr std::size_t kColumn = 13;
  std::string text = "Scenes:";
  for (const generate::BoxScene& scene : generate::boxScenes()) {
    std::string name(scene.name);
    name.resize(kColumn, ' ');
    text.append("\n  ").append(name).append(scene.description);
  }
  return text;
}

}  // namespace allpairs::app
