// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace allpairs::engine {

/// Sorts a run of numbers, of which only the bits below `bits` differ, from `from` into `to`; `from` is lost.
///
/// Long runs are sorted by a pass for each digit from the lowest up; shorter ones are cut by their highest bits into
/// buckets, and those are sorted on, down to runs that insertion sorts.
/// The lower `keyEnd` bits are not looked at: numbers that agree above them keep their order.
void sortRun(std::uint64_t* from, std::uint64_t* to, std::size_t size, unsigned bits, unsigned keyEnd);

}  // namespace allpairs::engine
