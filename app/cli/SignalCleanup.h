// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace allpairs::app {

/// What is taken away when a signal ends the program: one of each.
enum class SignalSlot : std::uint8_t { Output, Spool, SpoolFolder };

/// Says which file, or folder that is empty by then, to take away; an empty path: none.
void removeOnSignal(const std::string& path, SignalSlot slot = SignalSlot::Output);

/// Takes these away on SIGINT, SIGTERM and SIGHUP, unless they are ignored, and ends as these signals do.
void installSignalCleanup();

}  // namespace allpairs::app
