// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "cli/Output.h"

namespace allpairs::app {

/// What a frame came to.
struct TrackedFrame {
  std::uint64_t pairs = 0;
  std::uint64_t began = 0;
  std::uint64_t ended = 0;
  double milliseconds = 0.0;  ///< To move all boxes and to find the pairs; reading is not part of it.
};

/// What `allpairs track` found.
struct TrackReport {
  std::size_t boxes = 0;
  std::vector<TrackedFrame> frames;
  double distance = 0.0;
  std::size_t threads = 1;
  std::uint64_t rebuilds = 0;
  bool verified = false;
};

/// How long frames took, the first left out, in which all boxes are new, unless there is no other.
struct FrameTimes {
  double medianMs = 0.0;
  double percentile99Ms = 0.0;  ///< As long as that or less took 99 of 100 frames.
  double worstMs = 0.0;
  std::size_t worstFrame = 0;
};

[[nodiscard]] FrameTimes timesOf(const std::vector<TrackedFrame>& frames);

/// Writes the report as "table", "csv", "json" or "npy".
void writeTrack(const TrackReport& report, const std::string& format, Output& output);

}  // namespace allpairs::app
