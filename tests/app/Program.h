// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace allpairs::test {

/// How one run of the program ended.
struct ProgramRun {
  int status = -1;  ///< Its exit status; -1 if a signal ended it.
  std::string out;
  std::string err;
};

/// Where the program's standard output goes instead of into ProgramRun::out.
enum class StandardOutput { Captured, FullDevice, ClosedPipe, Closed };

/// Runs the command with these arguments and waits for its end.
[[nodiscard]] ProgramRun runProgram(const std::vector<std::string>& arguments,
                                    StandardOutput output = StandardOutput::Captured);

/// Runs a script of the shell, in which "$0" is the program.
[[nodiscard]] ProgramRun runScript(const std::string& script);

}  // namespace allpairs::test
