// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Pair.h"

namespace allpairs::measure {

/// FNV-1a, 64 bits, over the pairs as they are given: of each, first and then second as 32-bit little-endian numbers.
///
/// Over pairs in the order (first, second), first < second, it is the hash of the data of an (m,2) uint32 .npy file of
/// the result, so that any program in any language can compare its own result with ours.
/// Reference: Fowler, Noll, Vo; http://www.isthe.com/chongo/tech/comp/fnv/
[[nodiscard]] std::uint64_t hashOfPairs(std::span<const Pair> pairs) noexcept;

/// The pairs in the order (first, second), each with first < second.
[[nodiscard]] std::vector<Pair> normalised(std::span<const Pair> pairs);

/// 16 hexadecimal digits.
[[nodiscard]] std::string hexadecimal(std::uint64_t hash);

}  // namespace allpairs::measure
