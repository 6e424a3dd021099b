// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "input/BoxReader.h"
#include "kernels/CurveGrid.h"

namespace allpairs::engine {

/// A box in the order: its key in the upper half, its index in the lower, so that comparing the numbers compares the
/// boxes.
using CurveKey = std::uint64_t;

/// Keys are above the index.
inline constexpr unsigned kIndexBits = 32;

[[nodiscard]] inline std::uint32_t indexOf(CurveKey box) noexcept { return static_cast<std::uint32_t>(box); }

/// Fits a grid to a sample of the boxes: of all that the reader reads, or of some of them.
[[nodiscard]] CurveGrid fitCurveGrid(const BoxReader& reader);
[[nodiscard]] CurveGrid fitCurveGrid(const BoxReader& reader, std::span<const CurveKey> boxes);

}  // namespace allpairs::engine
