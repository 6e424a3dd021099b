// SPDX-License-Identifier: MIT
#include "Sampling.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace allpairs::measure {

namespace {

constexpr double kShortestMs = 1e-6;  // Keeps us from dividing by a clock that did not move.

/// How many runs a sample is made of, if one takes so long.
std::size_t runsFor(const Effort& effort, double runMs) {
  constexpr double kMostRuns = 1000.0;
  return static_cast<std::size_t>(
      std::clamp(std::ceil(effort.shortestSampleMs / std::max(runMs, kShortestMs)), 1.0, kMostRuns));
}

std::size_t samplesFor(const Effort& effort, double sampleMs) {
  return static_cast<std::size_t>(std::clamp(effort.seconds * 1e3 / std::max(sampleMs, kShortestMs),
                                             static_cast<double>(effort.fewestSamples),
                                             static_cast<double>(effort.mostSamples)));
}

}  // namespace

Sampling::Sampling(TimedRuns timedRuns, const Effort& effort) : m_timedRuns(std::move(timedRuns)) {
  constexpr double kSlowMs = 200.0;  // One trial of what is slow tells enough.
  const double firstMs = m_timedRuns(1).wallMs;
  // The first run finds nothing in the caches and no memory: of what is fast it says little.
  const double runMs = firstMs < kSlowMs ? m_timedRuns(runsFor(effort, firstMs)).wallMs : firstMs;
  m_runs = runsFor(effort, runMs);
  m_allowance = samplesFor(effort, runMs * static_cast<double>(m_runs));
}

}  // namespace allpairs::measure
