// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace allpairs::engine {

/// For each selection of lanes, as bits: where the bytes of the selected lanes are, one lane after the other. What follows
/// them is the first byte.
template <std::size_t kLanes, std::size_t kLaneBytes>
using LaneSelections = std::array<std::array<std::uint8_t, kLanes * kLaneBytes>, std::size_t{1} << kLanes>;

template <std::size_t kLanes, std::size_t kLaneBytes>
[[nodiscard]] constexpr LaneSelections<kLanes, kLaneBytes> laneSelections() {
  LaneSelections<kLanes, kLaneBytes> result{};
  for (std::size_t selection = 0; selection < result.size(); ++selection) {
    std::size_t size = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      if ((selection >> lane & 1U) == 0) continue;
      for (std::size_t byte = 0; byte < kLaneBytes; ++byte) {
        result[selection][size++] = static_cast<std::uint8_t>(lane * kLaneBytes + byte);
      }
    }
  }
  return result;
}

/// Of vectors with 4 lanes the bytes, of those with 8 the lanes: what their instructions for a permutation take.
template <std::size_t kLanes, std::size_t kLaneBytes>
alignas(64) inline constexpr auto kLaneSelections = laneSelections<kLanes, kLaneBytes>();

}  // namespace allpairs::engine
