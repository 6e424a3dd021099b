// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string_view>

namespace allpairs::scene {

/// The number of letters to replace, leave out, put in or swap with their neighbors.
[[nodiscard]] std::size_t editsBetween(std::string_view a, std::string_view b);

}  // namespace allpairs::scene
