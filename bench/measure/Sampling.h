// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "Samples.h"
#include "Stopwatch.h"

namespace allpairs::measure {

/// How thoroughly to measure.
struct Effort {
  double seconds = 1.0;           ///< For all samples together; a long run is repeated fewestSamples times even so.
  double shortestSampleMs = 1.0;  ///< Shorter runs are repeated within a sample until it lasts this long.
  std::size_t fewestSamples = 3;
  std::size_t mostSamples = 200;
};

/// Runs the measured function that many times in a row, and returns the time of one run.
using TimedRuns = std::function<Duration(std::size_t runs)>;

/// Takes samples of one thing, as many as an effort allows: a trial or two at first, which do not count, say how many.
class Sampling {
 public:
  Sampling(TimedRuns timedRuns, const Effort& effort);

  /// How many samples there is time for.
  [[nodiscard]] std::size_t allowance() const noexcept { return m_allowance; }

  void take() { m_samples.add(m_timedRuns(m_runs)); }
  [[nodiscard]] Summary summary() const { return m_samples.summary(); }

 private:
  TimedRuns m_timedRuns;
  std::size_t m_runs = 1;
  std::size_t m_allowance = 1;
  Samples m_samples;
};

}  // namespace allpairs::measure
