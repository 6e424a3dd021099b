// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

namespace allpairs::measure {

/// How long something took, in milliseconds.
struct Duration {
  double wallMs = 0.0;
  double cpuMs = 0.0;  ///< Processor time of the whole process, all threads together.

  friend constexpr Duration operator/(Duration d, double divisor) noexcept {
    return {d.wallMs / divisor, d.cpuMs / divisor};
  }
};

/// Measures wall time and processor time from its construction on.
class Stopwatch {
 public:
  Stopwatch() noexcept;

  [[nodiscard]] Duration elapsed() const noexcept;

 private:
  double m_cpuMs;  // Read before and after the wall clock, so that reading it is not part of the wall time.
  std::chrono::steady_clock::time_point m_start;
};

}  // namespace allpairs::measure
