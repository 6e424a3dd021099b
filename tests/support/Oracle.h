// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Pair.h"

namespace allpairs::test {

/// Whether two boxes are a pair.
inline bool overlapByOracle(const Box& first, const Box& second, double distance) {
  const auto empty = [](const Box& b) { return b.min[0] > b.max[0] || b.min[1] > b.max[1] || b.min[2] > b.max[2]; };
  bool apart = empty(first) || empty(second);
  for (std::size_t a = 0; a < 3; ++a) {
    apart = apart || first.min[a] > second.max[a] + distance || second.min[a] > first.max[a] + distance;
  }
  return !apart;
}

/// The double loop that every search must agree with. It shares no code with the engine: not even the box test.
inline std::vector<Pair> oracle(const std::vector<Box>& boxes, double distance = 0.0,
                                const std::vector<double>& margins = {}) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
      const double d = margins.empty() ? distance : distance + margins[i] + margins[j];
      if (overlapByOracle(boxes[i], boxes[j], d)) pairs.push_back({i, j});
    }
  }
  return pairs;
}

/// The same between two sets.
inline std::vector<Pair> oracleBetween(const std::vector<Box>& first, const std::vector<Box>& second,
                                       double distance = 0.0) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    for (std::uint32_t j = 0; j < second.size(); ++j) {
      if (overlapByOracle(first[i], second[j], distance)) pairs.push_back({i, j});
    }
  }
  return pairs;
}

}  // namespace allpairs::test
