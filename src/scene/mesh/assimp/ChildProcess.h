// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace allpairs::scene {

/// What a child process may take.
struct ChildLimits {
  std::uint64_t memory = 0;      ///< Bytes on top of what this process has; more fails in the child.
  std::uint64_t cpuSeconds = 0;  ///< Of the processor, after which the child is ended.
};

/// Runs work in a process of its own, which is forked off, and returns what it returned. Whatever the work does to its
/// memory, its stack or its time is done to the child alone. `beforeReading` is told how many bytes come next, and may
/// throw.
///
/// Bad input: work that ends its process, or throws, gives an empty text.
/// Threads:   only the calling one lives in the child; the work must not wait for others.
[[nodiscard]] std::string runInChild(const std::function<std::string()>& work, const ChildLimits& limits,
                                     const std::function<void(std::uint64_t)>& beforeReading);

}  // namespace allpairs::scene
