// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "allpairs/StopFlag.h"

namespace allpairs::app {

/// Takes a file, or a folder that is empty by then, away when a signal ends the program: what was named last goes
/// first.
///
/// Threads: one at a time calls this and the next.
void removeOnSignal(std::string path);

/// Undoes it, as for a file that is complete, or gone.
void keepOnSignal(std::string_view path) noexcept;

/// Says a line on standard error when a signal ends the program, if `file` is there then. The last call counts.
void sayOnSignal(std::string file, std::string line);

/// Takes these away on SIGINT, SIGTERM and SIGHUP, unless they are ignored, and ends as these signals do.
void installSignalCleanup();

/// While it lives, the first of these signals sets the flag, for work whose files only a destructor knows; the program
/// ends by it when this goes. A second one ends it at once.
class StopOnSignal {
 public:
  StopOnSignal() noexcept;
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  [[nodiscard]] const StopFlag* flag() const noexcept { return &m_flag; }

 private:
  StopFlag m_flag;
};

}  // namespace allpairs::app
