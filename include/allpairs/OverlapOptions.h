// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "allpairs/Box.h"
#include "allpairs/Executor.h"
#include "allpairs/Filter.h"
#include "allpairs/MemoryResource.h"
#include "allpairs/StopFlag.h"

namespace allpairs {

/// How pairs are found. Every strategy gives the same pairs.
enum class Strategy : std::uint8_t {
  Automatic,   ///< The strategy expected to be fastest for the given boxes.
  Exhaustive,  ///< Every pair is tested: n(n-1)/2 tests, or n*m between two sets.
  Bvh,         ///< A bounding volume hierarchy: groups of boxes are tested by their bounds before their members are.
};

/// The order of the pairs in the result.
enum class Order : std::uint8_t {
  ByFirst,    ///< Ascending by (first, second). The default.
  BySecond,   ///< Ascending by (second, first): as if boxes were added one by one and tested against earlier ones.
  Unordered,  ///< In the order of discovery: it depends only on the boxes and the strategy, and where that is
              ///< Automatic, on the instruction set.
};

/// Settings of a search for overlapping boxes; the defaults are right for most uses.
struct OverlapOptions {
  Strategy strategy = Strategy::Automatic;
  Order order = Order::ByFirst;

  /// Boxes that are at most this far apart on every axis are a pair; each box's own margin is added:
  /// d = distance + margin(first) + margin(second), summed from left to right. A negative d requires that much overlap;
  /// infinity pairs all boxes that are not empty.
  double distance = 0.0;

  /// If set, boxes outside it are excluded; the test uses the distance distance + margin(box).
  std::optional<Box> region{};

  /// Excludes pairs although their boxes overlap.
  Filter filter{};

  /// Runs parallel work; null means on the calling thread. Not owned.
  Executor* executor = nullptr;

  /// Allocates working memory and results. Null means aligned operator new, with large pages for large blocks where the
  /// system has them. Not owned; fixed at construction, and must outlive the object. With a parallel executor it is
  /// called from several threads. See docs/memory.md.
  std::pmr::memory_resource* memory = nullptr;

  /// More pairs than this, found, counted or streamed, throw LimitExceeded.
  std::uint64_t maxPairs = std::numeric_limits<std::uint64_t>::max();

  /// The instruction set to use, one of instructionSets(); empty means the best that the processor has.
  std::string_view instructionSet{};

  /// If given, a search throws Stopped soon after this is set. Not owned. Null costs nothing.
  const StopFlag* stop = nullptr;
};

}  // namespace allpairs
