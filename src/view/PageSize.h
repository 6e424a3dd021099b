// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "ViewScene.h"

namespace allpairs::view {

/// The size of a frame with that many pairs in a page, in bytes.
[[nodiscard]] std::size_t bytesOf(const ViewFrame& frame, std::size_t pairs);

/// Whether float32 holds all numbers exactly: of a sequence of meshes, positions are then kept so.
[[nodiscard]] bool areFloats(const std::vector<double>& numbers);

/// Throws Error, with what to do about it, where a scene of so many frames takes more bytes than a page can hold.
void checkPageSize(const ViewScene& scene, std::size_t frames, std::size_t bytes);

}  // namespace allpairs::view
