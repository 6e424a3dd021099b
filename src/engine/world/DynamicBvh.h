// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "bvh/BvhLevels.h"
#include "bvh/HilbertSort.h"
#include "input/BoxReader.h"
#include "kernels/CurveGrid.h"
#include "kernels/Kernels.h"
#include "memory/Memory.h"
#include "world/BoxStore.h"
#include "world/RebuildRule.h"

namespace allpairs::engine {

/// A hierarchy over the static or the dynamic boxes of a world, kept between steps.
///
/// Each box has a place in curve order, as of the last rebuild. Boxes that move keep their places, and the bounds are
/// updated; boxes that are added get places at the end, ordered among themselves; places of removed boxes stay empty.
/// The hierarchy is rebuilt when RebuildRule says so, or when too many boxes have been added or removed.
class DynamicBvh {
 public:
  DynamicBvh(std::pmr::memory_resource* memory, bool ofStatic)
      : m_ofStatic(ofStatic),
        m_levels(memory),
        m_places(memory),
        m_used(memory),
        m_inexact(memory),
        m_dirty(memory),
        m_blockList(memory),
        m_fresh(memory),
        m_keyed(memory),
        m_spare(memory),
        m_radix(memory),
        m_denseCells(memory) {}

  /// Applies the changes of the store since the last call. Returns whether the hierarchy was rebuilt.
  ///
  /// After an update that threw, only update() may be called; it rebuilds the hierarchy.
  bool update(const BoxStore& store, const BoxReader& reader, Executor& executor);

  /// Releases all memory. Until the next update, which rebuilds the hierarchy, nothing else may be called.
  void release() noexcept;

  /// Whether the last update completed, and no memory was released since.
  [[nodiscard]] bool isWhole() const noexcept { return m_isWhole; }

  [[nodiscard]] const BvhLevels& levels() const noexcept { return m_levels; }
  [[nodiscard]] RebuildRule& rule() noexcept { return m_rule; }

  /// The number of its boxes.
  [[nodiscard]] std::size_t size() const noexcept { return m_size; }

  /// Whether the lanes of all boxes are exactly the boxes.
  [[nodiscard]] bool exact() const noexcept { return m_inexactBlocks == 0; }

  /// No place: there are fewer boxes.
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFFU;

  /// The place of the box; kNowhere if it is not in this hierarchy.
  [[nodiscard]] std::uint32_t placeOf(BoxId id) const noexcept {
    return id < m_places.size() ? m_places[id] : kNowhere;
  }

 private:
  [[nodiscard]] bool belongs(const BoxStore& store, BoxId id) const noexcept {
    return store.contains(id) && store.isStatic(id) == m_ofStatic;
  }
  void sortOut(const BoxStore& store);
  void leave(BoxId id);
  void markBlock(std::size_t block);
  [[nodiscard]] bool isRebuildDue() const noexcept;
  void rebuild(const BoxStore& store, const BoxReader& reader, Executor& executor);
  void placeFresh(const BoxReader& reader, Executor& executor);
  void orderByCurve(std::span<const BoxId> ids, const BoxReader& reader, Executor& executor);
  void append(std::span<const CurveKey> order);
  void refit(const BoxReader& reader, Executor& executor);
  void refitAll(const BoxReader& reader, Executor& executor);
  void gather(std::size_t block, const BoxReader& reader);

  bool m_ofStatic;
  bool m_isWhole = true;  ///< The last update completed.
  BvhLevels m_levels;
  RebuildRule m_rule;
  CurveGrid m_grid;
  std::size_t m_size = 0;
  std::pmr::vector<std::uint32_t> m_places;  ///< By id.
  std::pmr::vector<std::uint16_t> m_used;    ///< By block: a bit for each place that holds a box.
  std::pmr::vector<std::uint8_t> m_inexact;  ///< By block: whether the lanes of some box are not exactly the box.
  std::size_t m_inexactBlocks = 0;
  std::pmr::vector<std::uint64_t> m_dirty;  ///< A bit for each block whose boxes changed.
  std::size_t m_dirtyBoxes = 0;
  std::pmr::vector<std::uint32_t> m_blockList;
  std::pmr::vector<BoxId> m_fresh;  ///< Boxes without a place.
  Buffer<CurveKey> m_keyed;
  Buffer<CurveKey> m_spare;
  RadixSort m_radix;
  std::pmr::vector<std::span<CurveKey>> m_denseCells;
};

/// Reads sixteen boxes, of which those with a bit in `used` exist, and are not empty, into lanes; the others become lanes
/// that overlap nothing. Returns whether the lanes are exactly the boxes.
[[nodiscard]] bool gatherLanes(const BoxReader& reader, const std::uint32_t* ids, std::uint32_t used, LaneBlock& lanes);

/// A hierarchy over the changed boxes of another hierarchy, in the same order.
///
/// The changed boxes of one block form one block here, however few: if it were filled with distant boxes, its bounds
/// would overlap as many boxes as all the blocks in between together.
class ChangedBoxes {
 public:
  explicit ChangedBoxes(std::pmr::memory_resource* memory) : m_marked(memory), m_levels(memory) {}

  void gather(std::span<const BoxId> changed, DynamicBvh& from, const Kernels& kernels, Executor& executor);

  /// The same of a hierarchy all of whose places have boxes.
  void gather(const BoxStore& store, const BvhView& from, const Kernels& kernels, Executor& executor);

  [[nodiscard]] BvhLevels& levels() noexcept { return m_levels; }

  /// The number of its boxes.
  [[nodiscard]] std::size_t size() const noexcept { return m_size; }

 private:
  void start(std::size_t boxes);
  void append(const BvhView& source, std::size_t place);

  std::pmr::vector<std::uint64_t> m_marked;  ///< A bit for each place of a changed box.
  bool m_marking = false;                    ///< Not all of them have been read.
  BvhLevels m_levels;
  std::size_t m_size = 0;
  std::size_t m_next = 0;         ///< Where the next box goes.
  std::size_t m_sourceBlock = 0;  ///< The block that the last one came from.
};

}  // namespace allpairs::engine
