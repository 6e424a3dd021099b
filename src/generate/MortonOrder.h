// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace allpairs::generate {

/// The same rows of 6 floats in Morton order of the boxes' centres, on a cubic grid of 2^21 cells a side over them all.
[[nodiscard]] std::vector<float> inMortonOrder(const std::vector<float>& rows);

}  // namespace allpairs::generate
