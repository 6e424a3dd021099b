// SPDX-License-Identifier: MIT
#include "InputOptions.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

namespace allpairs::app {

void addInputOptions(CLI::App& command, InputSettings& settings) {
  command.add_option("INPUT", settings.paths, "Scenes, meshes, folders of meshes, box arrays; taken together")
      ->required()
      ->type_name("");
  command.add_flag("--partial", settings.partial, "Leave out what cannot be placed or read, and go on");
  command.add_option("--data", settings.searchRoots, "Look here too for files that a scene names; repeatable")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
}

}  // namespace allpairs::app
