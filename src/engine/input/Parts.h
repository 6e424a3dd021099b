// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>

#include "allpairs/Executor.h"

namespace allpairs::engine {

/// Boxes, rows or pairs of a task, or that are passed on at once: some ten microseconds of work, beside which starting
/// it takes little time.
inline constexpr std::size_t kPartSize = 4096;

/// Tests of boxes, or partners that are copied, between two looks at a flag that stops them: some milliseconds of work.
inline constexpr std::size_t kWorkBetweenLooks = std::size_t{1} << 21;

/// Calls use(begin, end) for parts of [0, size), each of which is a task and, but for the last, of the same size.
template <class Use>
void runInParts(std::size_t size, std::size_t partSize, Executor& executor, const Use& use) {
  executor.run((size + partSize - 1) / partSize,
               [&](std::size_t part) { use(part * partSize, std::min(size, (part + 1) * partSize)); });
}

/// Moves what parts have written, each from beginOf(part) to endOf(part), next to each other; returns how much that is.
template <class T, class BeginOf, class EndOf>
std::size_t closeGaps(T* values, std::size_t parts, const BeginOf& beginOf, const EndOf& endOf) {
  std::size_t size = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    const T* const begin = values + beginOf(part);
    const std::size_t length = endOf(part) - beginOf(part);
    if (begin != values + size) std::copy_n(begin, length, values + size);
    size += length;
  }
  return size;
}

}  // namespace allpairs::engine
