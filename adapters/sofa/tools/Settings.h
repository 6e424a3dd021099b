// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace allpairs::tools {

/// What the programs of this folder are told.
struct Settings {
  std::string scene;
  std::vector<std::string> plugins;
  std::vector<std::string> dataFolders;
  std::vector<std::string> broadPhases;
  int steps = 200;
};

/// Reads: SCENE [--steps N] [--plugin NAME]... [--data FOLDER]... [--broad-phase CLASS]...
///
/// Bad input: throws std::invalid_argument that names the argument.
[[nodiscard]] Settings readSettings(int argc, const char* const* argv);

/// A number of things, of which there is one at least, as an argument gives it.
///
/// Bad input: throws std::invalid_argument that names the argument.
[[nodiscard]] int countOf(const std::string& argument, const std::string& value);

}  // namespace allpairs::tools
