// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "Raster.h"

namespace allpairs::view {

/// The picture as the bytes of a PNG file.
[[nodiscard]] std::string encodePng(const Raster& picture);

}  // namespace allpairs::view
