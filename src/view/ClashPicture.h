// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "Clash.h"
#include "Raster.h"

namespace allpairs::view {

/// A camera without perspective.
struct ParallelCamera {
  std::array<double, 3> centre{};     ///< What is in the middle of the picture.
  std::array<double, 3> direction{};  ///< Where it looks, of length 1.
  std::array<double, 3> up{};         ///< At right angles to it.
  double height = 1.0;                ///< How much of the world the picture's height shows.
};

/// A camera that shows both boxes of a clash, or, where one is much larger, the smaller one and what is around it.
[[nodiscard]] ParallelCamera cameraOf(const ViewScene& scene, const Clash& clash);

/// The two models of a clash in two colours with their boxes, and in red what the boxes share.
[[nodiscard]] Raster pictureOf(const ViewScene& scene, const Clash& clash, const ParallelCamera& camera);

}  // namespace allpairs::view
