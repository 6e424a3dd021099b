// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "BlockReader.h"
#include "CurveGrid.h"
#include "CurveOrder.h"
#include "Kernels.h"
#include "LaneReader.h"
#include "Memory.h"
#include "allpairs/Executor.h"
#include "world/BoxStore.h"
#include "world/LevelStack.h"
#include "world/RebuildRule.h"

namespace allpairs::engine {

/// What an update works with.
struct UpdateTools {
  const LaneReader& reader;
  const Kernels& kernels;
  Executor& executor;
};

/// A hierarchy over the static or the dynamic boxes of a world, kept from step to step.
///
/// Each box has a place in the order of a curve, as it was when the order was made. Boxes that move stay in their
/// places, and the bounds follow; boxes that come later get places at the end, ordered among themselves; places of boxes
/// that go stay empty. The order is made anew when the rule says so, or when too many boxes have come or gone.
class KeptHierarchy {
 public:
  explicit KeptHierarchy(bool ofStatic) : m_ofStatic(ofStatic) {}

  /// Takes over what has changed in the store since the last call. Returns whether the order was made anew.
  bool update(const BoxStore& store, const UpdateTools& tools);

  [[nodiscard]] LevelStack& levels() noexcept { return m_levels; }
  [[nodiscard]] RebuildRule& rule() noexcept { return m_rule; }

  /// How many boxes it holds.
  [[nodiscard]] std::size_t size() const noexcept { return m_size; }

  /// Whether the lanes of all boxes are exactly the boxes.
  [[nodiscard]] bool exact() const noexcept { return m_inexactBlocks == 0; }

  static constexpr std::uint32_t kNowhere = 0xFFFFFFFFU;

  /// Where the box is; kNowhere if it isn't here.
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
  void rebuild(const BoxStore& store, const UpdateTools& tools);
  void placeFresh(const UpdateTools& tools);
  void orderByCurve(std::span<const BoxId> ids, const UpdateTools& tools);
  void writeKeys(std::span<const BoxId> ids, const UpdateTools& tools, KeyedBox* to) const;
  static void readBoxes(std::span<const BoxId> ids, const BlockReader& blocks, const LaneReader& reader,
                        LaneBlock& block);
  void append(std::span<const KeyedBox> order);
  void refit(const UpdateTools& tools);
  void refitAll(const UpdateTools& tools);
  void gather(std::size_t block, const BlockReader& blocks, const LaneReader& reader);
  [[nodiscard]] bool gatherPlain(std::size_t block, const BlockReader& blocks, const LaneReader& reader);
  [[nodiscard]] bool gatherAny(std::size_t block, const LaneReader& reader);

  bool m_ofStatic;
  LevelStack m_levels;
  RebuildRule m_rule;
  CurveGrid m_grid;
  std::size_t m_size = 0;
  std::vector<std::uint32_t> m_places;  ///< By id.
  std::vector<std::uint16_t> m_used;    ///< By block: a bit for each place that holds a box.
  std::vector<std::uint8_t> m_inexact;  ///< By block: whether the lanes of some box are not exactly the box.
  std::size_t m_inexactBlocks = 0;
  std::vector<std::uint64_t> m_dirty;  ///< A bit for each block whose boxes changed.
  std::size_t m_dirtyBoxes = 0;
  std::vector<std::uint32_t> m_blockList;
  std::vector<BoxId> m_fresh;  ///< Boxes without a place.
  Buffer<KeyedBox> m_keyed;
  Buffer<KeyedBox> m_spare;
  CrowdOrder m_crowds;
};

}  // namespace allpairs::engine
