// SPDX-License-Identifier: MIT
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <optional>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace allpairs::test {

/// What the system says of the process under such a name, in MiB; 0 where it says nothing.
inline double statusMegabytes(const char* name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != name) continue;
    double kilobytes = 0;
    status >> kilobytes;
    return kilobytes / 1024;
  }
  return 0;
}

/// The memory that the process holds, in MiB, when the C library has given back what it keeps; 0 where nobody says.
inline double residentMegabytes() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
  return statusMegabytes("VmRSS:");
}

/// The most memory that a copy of the process has held after such work, in MiB; 0 where nobody says, none where it threw.
template <class Work>
std::optional<double> peakMegabytesOf(const Work& work) {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return std::nullopt;
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      work();
      const double peak = statusMegabytes("VmHWM:");
      ::_exit(::write(ends[1], &peak, sizeof(peak)) == sizeof(peak) ? 0 : 1);
    } catch (...) {
      ::_exit(1);
    }
  }
  ::close(ends[1]);
  double peak = 0;
  const bool isKnown = ::read(ends[0], &peak, sizeof(peak)) == sizeof(peak);
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return isKnown ? std::optional(peak) : std::nullopt;
}

}  // namespace allpairs::test
