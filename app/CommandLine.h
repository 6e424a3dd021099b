// SPDX-License-Identifier: MIT
#pragma once

namespace allpairs::app {

/// All that the program does, from the arguments of main() to its exit status; what goes wrong is one line on standard
/// error.
[[nodiscard]] int runCommandLine(int count, char** arguments);

}  // namespace allpairs::app
