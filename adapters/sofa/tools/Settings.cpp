// SPDX-License-Identifier: MIT
#include "Settings.h"

#include <charconv>
#include <stdexcept>
#include <system_error>

namespace allpairs::tools {
namespace {

/// The value of the option at i, which is moved on to it.
std::string valueOf(int argc, const char* const* argv, int& i) {
  if (i + 1 >= argc) throw std::invalid_argument(std::string(argv[i]) + " needs a value");
  return argv[++i];
}

}  // namespace

int countOf(const std::string& argument, const std::string& value) {
  int count = 0;
  const char* const end = value.data() + value.size();
  const auto [read, problem] = std::from_chars(value.data(), end, count);
  if (problem != std::errc{} || read != end || count < 1) {
    throw std::invalid_argument(argument + " is '" + value + "', not a whole number of at least 1");
  }
  return count;
}

Settings readSettings(int argc, const char* const* argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--steps") {
      settings.steps = countOf(argument, valueOf(argc, argv, i));
    } else if (argument == "--plugin") {
      settings.plugins.push_back(valueOf(argc, argv, i));
    } else if (argument == "--data") {
      settings.dataFolders.push_back(valueOf(argc, argv, i));
    } else if (argument == "--broad-phase") {
      settings.broadPhases.push_back(valueOf(argc, argv, i));
    } else if (settings.scene.empty() && !argument.empty() && argument.front() != '-') {
      settings.scene = argument;
    } else {
      throw std::invalid_argument("unknown argument '" + argument + "'");
    }
  }
  if (settings.scene.empty()) throw std::invalid_argument("which scene?");
  return settings;
}

}  // namespace allpairs::tools
