// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "bvh/CurveKey.h"
#include "input/BoxReader.h"
#include "kernels/Lanes.h"
#include "memory/Memory.h"
#include "world/BoxStore.h"
#include "world/RebuildRule.h"
#include "world/WorldMembers.h"

namespace allpairs::engine {

/// Hierarchies over the static or the dynamic boxes of each world of a numbered store, one after the other in memory.
///
/// A world's boxes keep their order until RebuildRule says that it has become a bad one, or they have gone far, as in the
/// reset of a simulation, or many have been added. An update reads the boxes of worlds again in
/// which many have changed, else of blocks in which some have. A world that needs more room moves to the end of the memory.
class WorldForest {
 public:
  WorldForest(std::pmr::memory_resource* memory, bool ofStatic)
      : m_ofStatic(ofStatic),
        m_trees(memory),
        m_nextTrees(memory),
        m_home(memory),
        m_marked(memory),
        m_dirty(memory),
        m_runs(memory),
        m_blocks(memory),
        m_ids(memory),
        m_keyed(memory),
        m_spare(memory) {}

  /// Applies the changes of the store since the last call. Returns how many worlds were put in order along the curve.
  ///
  /// After an update that threw, only update() may be called; it makes all hierarchies again.
  std::uint64_t update(const BoxStore& store, const WorldMembers& members, const BoxReader& reader, Executor& executor);

  /// Releases all memory. Until the next update nothing else may be called.
  void release() noexcept { *this = WorldForest(m_trees.get_allocator().resource(), m_ofStatic); }

  /// Whether the last update completed, and no memory was released since.
  [[nodiscard]] bool isWhole() const noexcept { return m_isWhole; }

  /// The hierarchy of a world; of depth 0 if it has no boxes.
  [[nodiscard]] BvhView view(std::size_t world) const noexcept;

  /// Whether the lanes of all boxes are exactly the boxes.
  [[nodiscard]] bool exact() const noexcept { return m_isExact; }

  /// The rule of a world.
  [[nodiscard]] RebuildRule& rule(std::size_t world) noexcept { return m_trees[world].rule; }

 private:
  struct Tree {
    std::uint32_t number = 0;
    std::size_t room = 0;        ///< For so many blocks of boxes, with the levels above them.
    std::size_t firstBlock = 0;  ///< Of all levels, the lowest one first.
    std::size_t firstLeaf = 0;   ///< Its ids have places from here on, in blocks.
    std::size_t size = 0;
    std::size_t listed = 0;    ///< Boxes in its list of ids; others than `size` during an update only.
    std::size_t moved = 0;     ///< During an update: boxes that have changed.
    std::size_t appended = 0;  ///< Boxes since they were put in order.
    bool isChanged = false;    ///< During an update: whether boxes have come or gone.
    bool isInexact = false;    ///< Whether the lanes of some box are not exactly the box.
    bool isOrdered = false;    ///< Whether they have been put in order.
    double spread = 0.0;       ///< How wide its blocks of boxes were when they were put in order.
    RebuildRule rule;
  };

  [[nodiscard]] bool belongs(const BoxStore& store, BoxId id) const noexcept {
    return store.contains(id) && store.isStatic(id) == m_ofStatic;
  }
  void plant(const BoxStore& store, const WorldMembers& members);
  bool follow(const BoxStore& store, const WorldMembers& members);
  void renumber(const WorldMembers& members);
  void giveRoom(Tree& tree);
  void requireRoom(std::size_t largest);
  void markDirty(std::size_t world);
  void findDirty(const BoxStore& store);
  bool refresh(std::size_t world, const BoxStore& store, const BoxReader& reader);
  void orderByCurve(Tree& tree, const BoxReader& reader);
  void gather(std::size_t world, const BoxReader& reader);
  void gatherStale(Tree& tree, const BoxStore& store, const BoxReader& reader);
  void boundAbove(LaneBlock* blocks, std::size_t count, const BoxReader& reader) const;
  [[nodiscard]] double spreadOf(const Tree& tree) const noexcept;

  bool m_ofStatic;
  bool m_isWhole = false;
  std::uint64_t m_membership = 0;          ///< That of the store when the trees were planted.
  std::pmr::vector<Tree> m_trees;          ///< By world.
  std::pmr::vector<Tree> m_nextTrees;      ///< Where they are renumbered.
  std::pmr::vector<std::uint32_t> m_home;  ///< By id: the world whose tree has it.
  std::size_t m_endBlock = 0;              ///< Where the next tree's blocks have room,
  std::size_t m_endLeaf = 0;               ///< and its ids.
  std::size_t m_wasted = 0;                ///< Room for so many blocks of boxes is of no tree.
  bool m_isExact = true;
  std::pmr::vector<std::uint8_t> m_marked;  ///< By world: whether it is among the dirty ones.
  std::pmr::vector<std::uint32_t> m_dirty;  ///< The worlds whose boxes changed.
  std::pmr::vector<std::size_t> m_runs;
  Buffer<LaneBlock> m_blocks;
  Buffer<std::uint32_t> m_ids;
  Buffer<CurveKey> m_keyed;  ///< Only if there is a world large enough for an order.
  Buffer<CurveKey> m_spare;
};

}  // namespace allpairs::engine
