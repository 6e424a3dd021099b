// SPDX-License-Identifier: MIT
#pragma once

#include <ctime>

/// How long this program has computed: other programs on the machine don't count.
inline double processorSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}
