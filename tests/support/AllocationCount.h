// SPDX-License-Identifier: MIT
// Linked with AllocationCount.cpp, which replaces the program's operator new.
#pragma once

#include <cstddef>

namespace allpairs::test {

/// How often operator new has been called in this program.
[[nodiscard]] std::size_t allocationCount();

/// How many bytes those calls asked for in all.
[[nodiscard]] std::size_t allocatedBytes();

}  // namespace allpairs::test
