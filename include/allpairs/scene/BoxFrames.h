// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "allpairs/BoxSet.h"

namespace allpairs::scene {

/// The same boxes at several times, in float64, which holds float32 exactly.
struct BoxFrames {
  std::size_t frameCount = 0;
  std::size_t boxCount = 0;
  std::vector<double> rows;  ///< frameCount times boxCount rows of minx miny minz maxx maxy maxz.

  /// A view of the boxes of one frame, not longer valid than this.
  [[nodiscard]] BoxSet frame(std::size_t index) const {
    return BoxSet::fromRows(std::span(rows).subspan(index * boxCount * 6, boxCount * 6));
  }
};

/// Whether the path is a NumPy file whose header says three dimensions.
///
/// Bad input: a .npy file that is missing, unreadable or malformed throws FileError.
[[nodiscard]] bool isBoxFramesFile(const std::filesystem::path& path);

/// Reads boxes over time from a NumPy file: an array of shape (t, n, 6), float32 or float64, either byte order, C or
/// Fortran order.
///
/// Bad input: anything else throws FileError: another type or shape, no frame, a length that is not what the header
///            says, a NaN.
[[nodiscard]] BoxFrames readBoxFrames(const std::filesystem::path& path);

}  // namespace allpairs::scene
