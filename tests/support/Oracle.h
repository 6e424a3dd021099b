// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Pair.h"

namespace allpairs::test {

/// The double loop that every search must agree with. It shares no code with the engine: not even the box test.
inline std::vector<Pair> oracle(const std::vector<Box>& boxes, double distance = 0.0,
                                const std::vector<double>& margins = {}) {
  const auto empty = [](const Box& b) { return b.min[0] > b.max[0] || b.min[1] > b.max[1] || b.min[2] > b.max[2]; };
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      const double d = margins.empty() ? distance : distance + margins[i] + margins[j];
      bool apart = empty(boxes[i]) || empty(boxes[j]);
      for (std::size_t a = 0; a < 3; ++a) {
        apart = apart || boxes[i].min[a] > boxes[j].max[a] + d || boxes[j].min[a] > boxes[i].max[a] + d;
      }
      if (!apart) pairs.push_back({i, j});
    }
  }
  return pairs;
}

/// The same between two sets.
inline std::vector<Pair> oracleBetween(const std::vector<Box>& first, const std::vector<Box>& second,
                                       double distance = 0.0) {
  std::vector<Box> all = first;
  all.insert(all.end(), second.begin(), second.end());
  std::vector<Pair> pairs;
  for (const Pair& pair : oracle(all, distance)) {
    const auto offset = static_cast<std::uint32_t>(first.size());
    if (pair.first < offset && pair.second >= offset) pairs.push_back({pair.first, pair.second - offset});
  }
  return pairs;
}

}  // namespace allpairs::test
