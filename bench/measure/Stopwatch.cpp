// SPDX-License-Identifier: MIT
#include "Stopwatch.h"

#include <time.h>

namespace allpairs::measure {

namespace {

double processMs() noexcept {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace

Stopwatch::Stopwatch() noexcept : m_cpuMs(processMs()), m_start(std::chrono::steady_clock::now()) {}

Duration Stopwatch::elapsed() const noexcept {
  const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - m_start;
  return {.wallMs = wall.count(), .cpuMs = processMs() - m_cpuMs};
}

}  // namespace allpairs::measure
