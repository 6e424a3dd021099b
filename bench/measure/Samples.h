// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "Stopwatch.h"

namespace allpairs::measure {

/// What a number of repetitions came to, in milliseconds.
struct Summary {
  std::size_t repetitions = 0;
  double medianMs = 0.0;
  double medianCpuMs = 0.0;
  double minMs = 0.0;
  double maxMs = 0.0;
};

/// The middle of the values, or the mean of the two in the middle; 0 of none.
[[nodiscard]] double median(std::vector<double> values);

/// The times of one thing that was done again and again.
class Samples {
 public:
  void add(Duration duration) { m_durations.push_back(duration); }

  [[nodiscard]] std::size_t size() const noexcept { return m_durations.size(); }
  [[nodiscard]] Summary summary() const;

 private:
  std::vector<Duration> m_durations;
};

}  // namespace allpairs::measure
