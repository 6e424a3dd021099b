// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace allpairs::app {

/// Takes a file, or a folder that is empty by then, away when a signal ends the program: what was named last goes
/// first.
///
/// Threads: one at a time calls this and the next.
void removeOnSignal(std::string path);

/// Undoes it, as for a file that is complete, or gone.
void keepOnSignal(std::string_view path) noexcept;

/// Takes these away on SIGINT, SIGTERM and SIGHUP, unless they are ignored, and ends as these signals do.
void installSignalCleanup();

}  // namespace allpairs::app
