// SPDX-License-Identifier: MIT
#pragma once

#include <fstream>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace allpairs::test {

/// The memory that the process holds, in MiB, when the C library has given back what it keeps; 0 where nobody says.
inline double residentMegabytes() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmRSS:") continue;
    double kilobytes = 0;
    status >> kilobytes;
    return kilobytes / 1024;
  }
  return 0;
}

}  // namespace allpairs::test
