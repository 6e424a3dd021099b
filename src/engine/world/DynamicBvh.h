// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/WorldTypes.h"
#include "bvh/BvhLevels.h"
#include "bvh/HilbertSort.h"
#include "input/BoxReader.h"
#include "memory/Memory.h"
#include "world/RebuildRule.h"

namespace allpairs::engine {

/// Where a box is: in which of several hierarchies, and at which of its places.
struct BoxHome {
  static constexpr std::uint32_t kNowhere = 0xFFFFFFFFU;  ///< There are always fewer hierarchies, worlds and places.

  std::uint32_t tree = kNowhere;
  std::uint32_t place = kNowhere;
};

/// A hierarchy over boxes that move, come and go.
///
/// Each box has a place in curve order, as of the last build. Boxes that move keep their places, and the bounds are
/// updated; boxes that are added get places at the end, ordered among themselves; places of removed boxes stay empty.
/// Changes are noted first, and take effect when the hierarchy is built or refitted. When one of these throws, it has
/// to be built again.
class DynamicBvh {
 public:
  explicit DynamicBvh(std::pmr::memory_resource* memory) : m_memory(memory) {}

  /// Forgets all boxes and keeps the memory.
  void clear() noexcept;

  /// A box has come, which has no place yet.
  void add(BoxId id) { m_fresh.push_back(id); }

  /// The box at that place has gone, or has changed.
  void remove(std::size_t place) noexcept;
  void note(std::size_t place) noexcept;

  /// All boxes may have changed.
  void noteAll() noexcept { m_dirtyBoxes = m_size; }

  /// Whether to build it: because there was no box, RebuildRule says so, or too many boxes have come or gone.
  [[nodiscard]] bool isBuildDue() const noexcept;

  /// Puts boxes that have been added since clear() in order.
  void build(std::span<BoxHome> homes, const BoxReader& reader, Executor& executor);

  /// Applies what was noted; returns whether the order is still good; if not, build it again.
  [[nodiscard]] bool refit(std::span<BoxHome> homes, const BoxReader& reader, Executor& executor);

  /// The hierarchy; of depth 0 if it is empty.
  [[nodiscard]] const BvhView& view() const noexcept { return m_levels.view(); }
  [[nodiscard]] RebuildRule& rule() noexcept { return m_rule; }

  /// The number of its boxes, and of places, of which some may be empty.
  [[nodiscard]] std::size_t size() const noexcept { return m_size + m_fresh.size(); }
  [[nodiscard]] std::size_t places() const noexcept { return m_levels.places(); }

  /// The number of places that it has memory for.
  [[nodiscard]] std::size_t capacity() const noexcept { return m_levels.capacity(); }

  /// Whether the lanes of all boxes are exactly the boxes, for certain.
  [[nodiscard]] bool exact() const noexcept { return m_isExact; }

 private:
  void placeFresh(std::span<BoxHome> homes, const BoxReader& reader, Executor& executor);
  void readDirty(const BoxReader& reader, Executor& executor);
  void readAll(const BoxReader& reader, Executor& executor);
  bool read(std::size_t block, const BoxReader& reader);
  [[nodiscard]] double spread() const noexcept;

  std::pmr::memory_resource* m_memory;
  bool m_isExact = true;
  bool m_isOrdered = false;  ///< Whether the boxes are in curve order.
  double m_mostWidth = 0.0;  ///< The most that a block counts as wide.
  double m_spread = 0.0;     ///< How wide the blocks were when they were put in order.
  BvhLevels m_levels{m_memory};
  RebuildRule m_rule;
  std::size_t m_size = 0;                             ///< Boxes that have a place.
  std::pmr::vector<std::uint16_t> m_used{m_memory};   ///< By block: a bit for each place that holds a box.
  std::pmr::vector<std::uint64_t> m_dirty{m_memory};  ///< A bit for each block whose boxes changed.
  std::size_t m_dirtyBoxes = 0;
  std::pmr::vector<std::uint32_t> m_blockList{m_memory};
  std::pmr::vector<BoxId> m_fresh{m_memory};  ///< Boxes without a place.
  HilbertSort m_order{m_memory};
  Buffer<CurveKey> m_spare{m_memory};
};

}  // namespace allpairs::engine
