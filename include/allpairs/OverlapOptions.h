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

namespace allpairs {

/// How pairs are found. Every strategy gives the same pairs.
enum class Strategy : std::uint8_t {
  Automatic,   ///< Whatever is fastest for the number of boxes.
  Exhaustive,  ///< Every pair is tested: n(n-1)/2 tests, or n*m between two sets.
  Bvh,         ///< A bounding volume hierarchy: groups of boxes are tested by their bounds before their members are.
};

/// In which order pairs are given.
enum class Order : std::uint8_t {
  ByFirst,    ///< Ascending by (first, second). The default.
  BySecond,   ///< Ascending by (second, first): as if boxes had come one by one, each against those before it.
  Unordered,  ///< In the order of discovery, which depends on the strategy and on nothing else.
};

/// Settings of a search for overlapping boxes; the defaults are right for most uses.
struct OverlapOptions {
  Strategy strategy = Strategy::Automatic;
  Order order = Order::ByFirst;

  /// Boxes that are at most this far apart on every axis are a pair; each box's own margin is added:
  /// d = distance + margin(first) + margin(second), summed from left to right. Negative shrinks; infinity pairs
  /// everything that is not empty.
  double distance = 0.0;

  /// Where given, boxes outside of it are left out; the test is widened by distance + margin(box).
  std::optional<Box> region{};

  /// Pairs to leave out although their boxes overlap.
  Filter filter{};

  /// Where parallel work runs; null means on the calling thread. Not owned.
  Executor* executor = nullptr;

  /// Where memory comes from: working memory and results, which point into it. Null means aligned operator new, with
  /// large pages for large blocks where the system has them. Not owned; fixed when the object is made, and must outlive
  /// it. With a parallel executor it is called from several threads. docs/memory.md says more.
  std::pmr::memory_resource* memory = nullptr;

  /// More pairs than this throw LimitExceeded, whether they are found, counted or streamed.
  std::uint64_t maxPairs = std::numeric_limits<std::uint64_t>::max();

  /// The instruction set to use, one of instructionSets(); empty means the best that the processor has.
  std::string_view instructionSet{};
};

}  // namespace allpairs
