// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Executor.h"
#include "allpairs/MemoryResource.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"
#include "allpairs/PairPredicate.h"
#include "allpairs/Span.h"
#include "allpairs/StopFlag.h"

namespace allpairs {

/// Identifies a box in a World, from when it is added until it is removed.
using BoxId = std::uint32_t;

/// An id that no box has.
inline constexpr BoxId kNoBox = 0xFFFFFFFFU;

/// The world number of a box that every world has, such as the ground; in a QueryFilter, of the boxes of all worlds.
inline constexpr std::uint32_t kEveryWorld = 0xFFFFFFFFU;

/// The properties of a box in a World, besides its bounds.
///
/// Two boxes that overlap are a pair if they are of the same world or one is of every world, each one's mask shares a
/// bit with the other's category, they are not in the same non-zero group, and they are not both static.
struct BoxProperties {
  std::uint32_t category = 0xFFFFFFFFU;  ///< The categories of the box, as bits.
  std::uint32_t mask = 0xFFFFFFFFU;      ///< The categories that it accepts as partners.
  std::uint32_t group = 0;               ///< Boxes of the same non-zero group are never paired.
  double margin = 0.0;                   ///< How far the box extends beyond its bounds; may be negative.
  bool isStatic = false;                 ///< Static boxes are never tested against each other. They may still be moved.
  std::uint32_t world = 0;               ///< The number of the box's world, any number; or kEveryWorld.

  friend constexpr bool operator==(const BoxProperties& a, const BoxProperties& b) {
    return a.category == b.category && a.mask == b.mask && a.group == b.group && a.margin == b.margin &&
           a.isStatic == b.isStatic && a.world == b.world;
  }
  friend constexpr bool operator!=(const BoxProperties& a, const BoxProperties& b) { return !(a == b); }
};

/// Settings of a World; the defaults are right for most uses.
struct WorldOptions {
  /// The order of the lists of a step and of findBetween(). A world always orders them: Unordered throws
  /// InvalidArgument.
  Order order = Order::ByFirst;

  /// Boxes that are at most this far apart on every axis are a pair; each box's own margin is added, as in
  /// OverlapOptions: d = distance + margin(first) + margin(second), summed from left to right. Queries ignore it.
  double distance = 0.0;

  /// If set, called for each pair that passed all other filters, with first < second. Its answer must not change until
  /// one of the two boxes gets other bounds or properties or is invalidated; until then it may be called again or not.
  /// With a parallel executor it is called from several threads.
  PairPredicate accept{};

  /// Runs parallel work; null means on the calling thread. Not owned.
  Executor* executor = nullptr;

  /// Allocates working memory and the lists of a step. Queries allocate their results and temporary memory with
  /// operator new. Null means aligned operator new, with large pages for large blocks where the system has them. Not
  /// owned; fixed at construction, and must outlive the object. With a parallel executor it is called from several
  /// threads. See docs/memory.md.
  std::pmr::memory_resource* memory = nullptr;

  /// The instruction set to use, one of instructionSets(); empty means the best that the processor has.
  std::string_view instructionSet{};

  /// If given, a step or query throws Stopped soon after this is set. The boxes are as they were, and the next step
  /// reports the changes since the last one that returned. Not owned.
  const StopFlag* stop = nullptr;
};

/// The pairs of a step, each with first < second, each list in the order of the options; valid until the next step.
struct StepResult {
  Span<const Pair> pairs;      ///< All pairs of this step.
  Span<const Pair> began;      ///< Pairs that did not exist in the last step.
  Span<const Pair> persisted;  ///< Pairs that did: `pairs` without `began`.
  Span<const Pair> ended;      ///< Pairs of the last step that no longer exist; their boxes may have been removed.
};

/// Statistics of the last step of a World, and of all steps. After a step that threw they mean nothing.
struct WorldStatistics {
  std::uint64_t boxTests = 0;    ///< Tests of two boxes, each in one lane of a vector.
  std::uint64_t groupTests = 0;  ///< Tests of the bounds of two groups, or of a box and a group.
  std::uint64_t exactTests = 0;  ///< Candidates of the float32 test that were tested again in double, but for those of
                                 ///< small worlds.
  std::uint64_t changed = 0;     ///< Boxes that were added, moved, removed or given other properties.
  bool joinedAll = false;        ///< Whether the step joined all boxes, instead of only the changed ones with all.
  /// The number of full rebuilds of a hierarchy up to the last step, by steps and queries; with world numbers, of how
  /// often a world's boxes were put in order.
  std::uint64_t rebuilds = 0;
};

/// The points origin + t * direction with 0 <= t <= length.
///
/// Bad input: a NaN, an infinite origin or direction, or a negative length throw InvalidArgument.
struct Ray {
  std::array<double, 3> origin{};
  std::array<double, 3>
      direction{};  ///< Need not have unit length; t is in units of it. All zero makes the ray a point.
  double length = std::numeric_limits<double>::infinity();
};

/// A swept box: moved by t * motion, with 0 <= t <= length. An infinite box is taken; an empty one hits nothing.
///
/// Bad input: InvalidBox for a box with a NaN; InvalidArgument for an infinite motion, a NaN, or a negative length.
struct BoxSweep {
  Box box;
  std::array<double, 3> motion{};
  double length = 1.0;
};

/// A box that a ray or a swept box hits, and the smallest t at which it does.
struct SweepHit {
  BoxId id = kNoBox;
  double t = std::numeric_limits<double>::infinity();

  friend constexpr bool operator==(const SweepHit& a, const SweepHit& b) { return a.id == b.id && a.t == b.t; }
  friend constexpr bool operator!=(const SweepHit& a, const SweepHit& b) { return !(a == b); }
};

/// A box and its Euclidean distance from a point or a box; 0 if the point is in it, or the two overlap.
struct Neighbor {
  BoxId id = kNoBox;
  double distance = std::numeric_limits<double>::infinity();

  friend constexpr bool operator==(const Neighbor& a, const Neighbor& b) {
    return a.id == b.id && a.distance == b.distance;
  }
  friend constexpr bool operator!=(const Neighbor& a, const Neighbor& b) { return !(a == b); }
};

/// Which boxes a query considers: those whose category shares a bit with `mask` and whose mask with `category`, of all
/// worlds or of one.
struct QueryFilter {
  std::uint32_t category = 0xFFFFFFFFU;
  std::uint32_t mask = 0xFFFFFFFFU;
  bool staticBoxes = true;            ///< Whether it considers static boxes.
  bool dynamicBoxes = true;           ///< Whether it considers the others.
  std::uint32_t world = kEveryWorld;  ///< If not kEveryWorld: it considers the boxes of this world and of every world.
};

/// The results of many queries: those of query i are values[offsets[i]] to values[offsets[i + 1] - 1].
template <class T>
struct ResultLists {
  std::vector<std::size_t> offsets;  ///< One more than there are queries.
  std::vector<T> values;

  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  [[nodiscard]] Span<const T> operator[](std::size_t i) const& noexcept {
    return Span<const T>(values).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }
  Span<const T> operator[](std::size_t i) const&& = delete;  // of a temporary: the values would be destroyed
};

}  // namespace allpairs
