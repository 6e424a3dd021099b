// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "allpairs/Span.h"

namespace allpairs::generate {

/// A named way in which boxes move that benchmarks and tests share.
struct BoxMotion {
  std::string_view name;         ///< As the command line writes it.
  std::string_view description;  ///< One line: how the boxes move.
};

/// The motions that MotionFrames knows, in the order in which reports list them.
[[nodiscard]] Span<const BoxMotion> boxMotions() noexcept;

/// Which boxes to move, and how.
struct MotionRequest {
  std::string_view motion = "brownian";
  std::size_t count = 1000;
  std::uint64_t seed = 1;
};

/// Equal cubes that fill a tenth of the unit cube and move in it, frame after frame.
///
/// Geometry:  lengths are without unit; every box is finite, not empty, and within the unit cube up to rounding.
/// Bad input: an unknown name, or more than 2^32 - 1 boxes, throws InvalidArgument.
/// Cost:      O(n) a frame; up to 128 bytes a box, whatever the number of frames.
/// Threads:   one call at a time per object; the bytes depend only on the request, not on the machine, compiler or
///            standard library.
/// Reference: Serpa, Rodrigues: Broadmark, a testing framework for broad-phase collision detection algorithms, Computer
///            Graphics Forum 39 (2020), whose scenes fill as much and move in these three ways. Its bodies push each
///            other; ours come to rest at predetermined places, which gives piles of about the same density.
class MotionFrames {
 public:
  explicit MotionFrames(const MotionRequest& request);
  ~MotionFrames();
  MotionFrames(MotionFrames&&) noexcept;
  MotionFrames& operator=(MotionFrames&&) noexcept;

  /// The boxes of the next frame as rows of 6 floats, minx miny minz maxx maxy maxz; valid until the next call.
  [[nodiscard]] Span<const float> next();

 private:
  struct State;
  std::unique_ptr<State> m_state;
};

}  // namespace allpairs::generate
