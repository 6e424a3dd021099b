// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace allpairs::engine {

/// A box in the order: its key in the upper half, its index in the lower, so that numbers compare as boxes do.
using KeyedBox = std::uint64_t;

/// Keys are above the index.
inline constexpr unsigned kIndexBits = 32;

[[nodiscard]] inline std::uint32_t indexOf(KeyedBox box) noexcept { return static_cast<std::uint32_t>(box); }

}  // namespace allpairs::engine
