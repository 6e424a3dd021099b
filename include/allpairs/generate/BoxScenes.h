// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "allpairs/Span.h"

namespace allpairs::generate {

/// A named family of boxes that benchmarks and tests share.
struct BoxScene {
  std::string_view name;         ///< As the command line writes it.
  std::string_view description;  ///< One line: what the boxes are and how many pairs there are.
};

/// The families that makeBoxes() knows, in the order in which reports list them.
[[nodiscard]] Span<const BoxScene> boxScenes() noexcept;

/// Which boxes to generate.
struct SceneRequest {
  std::string_view scene = "uniform";
  std::size_t count = 1000;
  std::uint64_t seed = 1;

  /// In Morton order of the boxes' centres, as if they came from a spatial structure; otherwise in no spatial order.
  bool sorted = false;
};

/// The boxes of a named scene as rows of 6 floats, minx miny minz maxx maxy maxz.
///
/// Geometry:  lengths are without unit; every box is finite and not empty; most scenes fill about a unit cube.
/// Bad input: an unknown name, or more than 2^32 - 1 boxes, throws InvalidArgument.
/// Cost:      O(n), and O(n log n) where sorted.
/// Threads:   any; the bytes depend only on the request, not on the machine, compiler or standard library.
[[nodiscard]] std::vector<float> makeBoxes(const SceneRequest& request);

}  // namespace allpairs::generate
