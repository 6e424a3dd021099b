// SPDX-License-Identifier: MIT
#include "OutputOption.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>

namespace allpairs::app {

void addOutputOption(CLI::App& command, std::string& path) {
  command.add_option("-o,--output", path, "Write to FILE, which appears only when it is complete")
      ->type_name("FILE")
      ->check([](const std::string& text) { return text.empty() ? "the name of a file is needed" : std::string(); });
}

std::string lowerExtension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return extension;
}

}  // namespace allpairs::app
