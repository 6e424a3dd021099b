// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/OverlapOptions.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Pair.h"
#include "allpairs/Span.h"

namespace allpairs {

/// Many small worlds, such as the copies of a simulation, as one set of boxes: those of a world follow each other, and
/// boxes of different worlds are never pairs.
///
/// Nothing is copied: the memory of boxes, offsets and pairs must outlive the object and stay unchanged while it is
/// used.
/// Bad input: offsets that do not begin with 0, decrease, exceed the number of boxes or end before it throw
///            InvalidArgument, which names the world.
/// Cost:      one pass over the offsets, no allocation.
/// Threads:   const use from any number of threads.
class Worlds {
 public:
  /// No worlds.
  Worlds() = default;

  /// World k has the boxes [begin[k], begin[k + 1]): one offset more than there are worlds, the last being the number
  /// of boxes.
  Worlds(const BoxView& boxes, Span<const std::uint64_t> begin);

  /// Worlds with the same number of boxes each.
  ///
  /// Bad input: boxes that do not divide equally, and more worlds than there could be offsets of, throw
  ///            InvalidArgument.
  [[nodiscard]] static Worlds ofEqualSize(const BoxView& boxes, std::size_t worlds);

  /// Two boxes of a world, by their indices in it, are no pair in any world, however they overlap: once for all worlds.
  ///
  /// Neither the order of the pairs nor the order within a pair matters. A pair of a box with itself has no effect.
  /// Pairs with shared boxes are not concerned.
  /// Bad input: an index that no world has throws InvalidArgument.
  void setIgnoredPairs(Span<const Pair> pairs);

  /// The number of worlds.
  [[nodiscard]] std::size_t size() const noexcept { return m_size; }

  /// The boxes of all worlds.
  [[nodiscard]] const BoxView& boxes() const noexcept { return m_boxes; }

  /// The index of a world's first box among the boxes of all worlds; of one that follows the last, their number.
  [[nodiscard]] std::size_t begin(std::size_t world) const noexcept {
    return m_begin.empty() ? world * m_eachSize : static_cast<std::size_t>(m_begin[world]);
  }

  /// The boxes of a world.
  [[nodiscard]] BoxView operator[](std::size_t world) const { return m_boxes.slice(begin(world), begin(world + 1)); }

  /// Whether all worlds have the same number of boxes, and the number: then a filter may be given for one world.
  [[nodiscard]] bool hasEqualSizes() const noexcept { return m_hasEqualSizes; }
  [[nodiscard]] std::size_t eachSize() const noexcept { return m_eachSize; }

  /// The number of boxes of the largest world.
  [[nodiscard]] std::size_t largestSize() const noexcept { return m_largestSize; }

  [[nodiscard]] Span<const std::uint64_t> offsets() const noexcept { return m_begin; }
  [[nodiscard]] Span<const Pair> ignoredPairs() const noexcept { return m_ignoredPairs; }

 private:
  BoxView m_boxes;
  Span<const std::uint64_t> m_begin;  ///< Empty if worlds were given by their number.
  Span<const Pair> m_ignoredPairs;
  std::size_t m_size = 0;
  std::size_t m_eachSize = 0;
  std::size_t m_largestSize = 0;
  bool m_hasEqualSizes = true;
};

/// The pairs of each of some worlds. World k has the pairs [begin[k], begin[k + 1]); boxes are numbered within their
/// world.
struct WorldPairs {
  std::vector<Pair> pairs;
  std::vector<std::uint64_t> begin;
};

/// The same, in memory of the search that found them.
struct WorldPairsView {
  Span<const Pair> pairs;
  Span<const std::uint64_t> begin;

  [[nodiscard]] Span<const Pair> operator[](std::size_t world) const noexcept {
    return pairs.subspan(begin[world], begin[world + 1] - begin[world]);
  }
};

/// Finds the overlapping pairs of many worlds, and keeps its memory between searches: what an OverlapSearch would find
/// in each world alone, in the same order, in three fifths of the time that as many calls take for twenty boxes each.
///
/// With `shared`, boxes that are in every world, such as the ground, it finds the pairs (box of the world, shared box):
/// what an OverlapSearch would find of the two sets. Pairs among shared boxes are found in no world, and a world's own
/// pairs take a search without `shared`. The hierarchy of the shared boxes is built once for all worlds.
///
/// Options:   all apply, as to a search of each world alone, with boxes numbered within their world: `accept` does not
///            learn which world a pair is of. maxPairs limits the pairs of all worlds together. The spans of
///            filter.first are empty, or have a value for each box of all worlds, or, if worlds are of equal size, for
///            each box of one world: then it holds for all. Order::Unordered with shared boxes gives Order::ByFirst.
/// Bad input: as for OverlapSearch.
/// Cost:      in worlds of up to a few hundred boxes all pairs are tested, n(n-1)/2 a world; larger ones are searched
///            as OverlapSearch does. 8 bytes a pair and a world, for list() 16 a world. On the calling thread a second
///            search of the same size allocates nothing, unless shared boxes are given with a filter.
/// Threads:   one search at a time per object; worlds are divided among the threads of the options' executor, and one
///            of many boxes is itself searched by all. Results never depend on threads.
/// Memory:    as for OverlapSearch.
/// Callbacks: as for OverlapSearch.
class WorldsSearch {
 public:
  explicit WorldsSearch(OverlapOptions options = {});
  ~WorldsSearch();
  WorldsSearch(WorldsSearch&&) noexcept;
  WorldsSearch& operator=(WorldsSearch&&) noexcept;

  [[nodiscard]] const OverlapOptions& options() const noexcept;

  /// Bad input: a memory resource other than that of construction throws InvalidArgument; null keeps it.
  void setOptions(OverlapOptions options);

  /// The pairs of all worlds. Valid until the next search or the object's destruction.
  [[nodiscard]] WorldPairsView find(const Worlds& worlds);
  [[nodiscard]] WorldPairsView find(const Worlds& worlds, const BoxView& shared);

  /// Where each world's pairs begin in the result of find(), without storing the pairs. The last value is their number.
  /// Valid like the result of find(); list() takes it.
  [[nodiscard]] Span<const std::uint64_t> count(const Worlds& worlds);
  [[nodiscard]] Span<const std::uint64_t> count(const Worlds& worlds, const BoxView& shared);

  /// Writes the pairs of find() to memory of the caller, where count() says.
  ///
  /// Bad input: a `begin` that is not what count() gives for these worlds, or fewer `pairs` than it says, throw
  ///            InvalidArgument; `pairs` may then have been written to.
  void list(const Worlds& worlds, Span<const std::uint64_t> begin, Span<Pair> pairs);
  void list(const Worlds& worlds, const BoxView& shared, Span<const std::uint64_t> begin, Span<Pair> pairs);

  /// Releases the memory kept for the next search, and the last result.
  void shrink();

  [[nodiscard]] const OverlapStatistics& statistics() const noexcept;

 private:
  struct State;
  State& state();
  State* m_state = nullptr;  ///< Owned; null in an object that has been moved from.
};

/// The overlapping pairs of each of many worlds: world k's list is that of overlaps() of its boxes alone. See
/// WorldsSearch.
[[nodiscard]] WorldPairs overlapsInWorlds(const Worlds& worlds, const OverlapOptions& options = {});

/// The pairs of a box of each world and a box that all worlds share: world k's list is that of overlaps() of its boxes
/// and the shared ones.
[[nodiscard]] WorldPairs overlapsInWorlds(const Worlds& worlds, const BoxView& shared,
                                          const OverlapOptions& options = {});

/// Where each world's pairs begin in the result of overlapsInWorlds(), without storing them.
[[nodiscard]] std::vector<std::uint64_t> countOverlapsInWorlds(const Worlds& worlds,
                                                               const OverlapOptions& options = {});
[[nodiscard]] std::vector<std::uint64_t> countOverlapsInWorlds(const Worlds& worlds, const BoxView& shared,
                                                               const OverlapOptions& options = {});

/// Writes the pairs of overlapsInWorlds() to memory of the caller; see WorldsSearch::list().
void listOverlapsInWorlds(const Worlds& worlds, Span<const std::uint64_t> begin, Span<Pair> pairs,
                          const OverlapOptions& options = {});

}  // namespace allpairs
