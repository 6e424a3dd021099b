// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace allpairs::app {

/// What a shell may write behind an option or a command.
struct ValueWords {
  std::vector<std::string> choices{};
  bool isFile = false;
  bool isFolder = false;
};

struct OptionWords {
  std::vector<std::string> names;  ///< "-o", "--output".
  std::string description;
  std::string value{};  ///< What its value is called; empty where it takes none.
  ValueWords values{};
};

struct CommandWords {
  std::string name;
  std::string description;
  std::vector<OptionWords> options;
  ValueWords arguments{};
};

/// A program's commands, and the options before any.
struct ProgramWords {
  std::string name;
  std::vector<OptionWords> options;
  std::vector<CommandWords> commands;
};

/// Scripts that complete a program's command line.
[[nodiscard]] std::string bashCompletion(const ProgramWords& program);
[[nodiscard]] std::string zshCompletion(const ProgramWords& program);
[[nodiscard]] std::string fishCompletion(const ProgramWords& program);

}  // namespace allpairs::app
