// SPDX-License-Identifier: MIT
#include "Samples.h"

#include <algorithm>

namespace allpairs::measure {

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

Summary Samples::summary() const {
  if (m_durations.empty()) return {};
  std::vector<double> wall;
  std::vector<double> cpu;
  for (const Duration& duration : m_durations) {
    wall.push_back(duration.wallMs);
    cpu.push_back(duration.cpuMs);
  }
  const auto [shortest, longest] = std::minmax_element(wall.begin(), wall.end());
  return {.repetitions = wall.size(),
          .medianMs = median(wall),
          .medianCpuMs = median(cpu),
          .minMs = *shortest,
          .maxMs = *longest};
}

}  // namespace allpairs::measure
