// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace allpairs::app {

/// Says which file to take away when a signal ends the program; an empty path: none. One file at a time.
void removeOnSignal(const std::string& path);

/// Takes that file away on SIGINT, SIGTERM and SIGHUP, unless they are ignored, and ends as these signals do.
void installSignalCleanup();

}  // namespace allpairs::app
