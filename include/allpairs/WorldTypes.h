// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Executor.h"
#include "allpairs/MemoryResource.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"
#include "allpairs/PairPredicate.h"

namespace allpairs {

/// The number by which a World knows a box from when it is added until it is removed.
using BoxId = std::uint32_t;

/// The id that no box has.
inline constexpr BoxId kNoBox = 0xFFFFFFFFU;

/// What a box of a World is besides its place: with whom it may pair, how far it reaches, whether it moves.
///
/// Two boxes that overlap are a pair if each one's mask has a bit of the other's category, they are not of the same
/// non-zero group, and they are not both static.
struct BoxProperties {
  std::uint32_t category = 0xFFFFFFFFU;  ///< What the box is, as bits.
  std::uint32_t mask = 0xFFFFFFFFU;      ///< Which categories it accepts as partners.
  std::uint32_t group = 0;               ///< Boxes of the same non-zero group are no pair.
  double margin = 0.0;    ///< How far the box reaches beyond its bounds, in units of length; may shrink it.
  bool isStatic = false;  ///< Static boxes are never tested against each other. They may be moved all the same.

  friend constexpr bool operator==(const BoxProperties&, const BoxProperties&) = default;
};

/// Settings of a World; the defaults are right for most uses.
struct WorldOptions {
  /// How the lists of a step, and of findBetween(), are ordered. A world orders them in any case: Unordered is refused with
  /// InvalidArgument.
  Order order = Order::ByFirst;

  /// Boxes that are at most this far apart on every axis are a pair; each box's own margin is added, as in
  /// OverlapOptions: d = distance + margin(first) + margin(second), summed from left to right. Queries don't use it.
  double distance = 0.0;

  /// Where given, asked about a pair that passed the rest, with first < second. Its answer must stay the same until one
  /// of the two boxes gets other bounds or properties or is invalidated; in between it may or may not be asked again. With a
  /// parallel executor it is called from several threads.
  PairPredicate accept{};

  /// Where parallel work runs; null means on the calling thread. Not owned.
  Executor* executor = nullptr;

  /// Where memory comes from: working memory and the lists of a step, which point into it. Queries allocate what they
  /// return, and what they need meanwhile, by operator new. Null means aligned operator new, with
  /// large pages for large blocks where the system has them. Not owned; fixed when the object is made, and must outlive
  /// it. With a parallel executor it is called from several threads. docs/memory.md says more.
  std::pmr::memory_resource* memory = nullptr;

  /// The instruction set to use, one of instructionSets(); empty means the best that the processor has.
  std::string_view instructionSet{};
};

/// The pairs of a step, each with first < second, each list in the order of the options; valid until the next step.
struct StepResult {
  std::span<const Pair> pairs;      ///< All pairs of this step.
  std::span<const Pair> began;      ///< Those that were no pair in the last step.
  std::span<const Pair> persisted;  ///< Those that were: `pairs` without `began`.
  std::span<const Pair> ended;      ///< Pairs of the last step that are none now; a box in it may have been removed.
};

/// What the last step of a World did, and all so far.
struct WorldStatistics {
  std::uint64_t boxTests = 0;    ///< Pairs of boxes that were tested, each by one lane of a vector.
  std::uint64_t groupTests = 0;  ///< Pairs of groups, or of a box and a group, that were tested by their bounds.
  std::uint64_t exactTests = 0;  ///< Survivors of the float32 test that were tested again in double.
  std::uint64_t changed = 0;     ///< Boxes that were added, moved, removed or given properties for this step.
  bool joinedAll = false;        ///< Whether all boxes were met with each other, or only the changed ones with all.
  std::uint64_t rebuilds = 0;    ///< How often an order was made anew so far, by steps and queries.
};

/// The points origin + t * direction with 0 <= t <= length.
///
/// Bad input: a NaN, an infinite origin or direction, or a negative length throw InvalidArgument.
struct Ray {
  std::array<double, 3> origin{};
  std::array<double, 3>
      direction{};  ///< Not necessarily of unit length; t counts in it. All zero makes the ray a point.
  double length = std::numeric_limits<double>::infinity();
};

/// A box on its way: moved by t * motion, with 0 <= t <= length.
///
/// Bad input: as for a ray; an empty box meets nothing.
struct BoxSweep {
  Box box;
  std::array<double, 3> motion{};
  double length = 1.0;
};

/// A box that a ray or a swept box meets, and the least t at which it does.
struct SweepHit {
  BoxId id = kNoBox;
  double t = std::numeric_limits<double>::infinity();

  friend constexpr bool operator==(const SweepHit&, const SweepHit&) = default;
};

/// A box and its Euclidean distance from a point; 0 for a point in it.
struct Neighbor {
  BoxId id = kNoBox;
  double distance = std::numeric_limits<double>::infinity();

  friend constexpr bool operator==(const Neighbor&, const Neighbor&) = default;
};

/// Which boxes a query looks at: those whose category has a bit of `mask` and whose mask has a bit of `category`.
struct QueryFilter {
  std::uint32_t category = 0xFFFFFFFFU;
  std::uint32_t mask = 0xFFFFFFFFU;
  bool staticBoxes = true;   ///< Whether it looks at static boxes.
  bool dynamicBoxes = true;  ///< Whether it looks at the others.
};

/// The results of many queries: those of query i are values[offsets[i]] to values[offsets[i + 1] - 1].
template <class T>
struct ResultLists {
  std::vector<std::size_t> offsets;  ///< One more than there are queries.
  std::vector<T> values;

  [[nodiscard]] std::size_t size() const noexcept { return offsets.empty() ? 0 : offsets.size() - 1; }
  [[nodiscard]] std::span<const T> operator[](std::size_t i) const& noexcept {
    return std::span(values).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }
  std::span<const T> operator[](std::size_t i) const&& = delete;  // of a temporary: nothing would hold the values
};

}  // namespace allpairs
