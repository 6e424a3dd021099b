// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "input/BoxReader.h"
#include "memory/Memory.h"
#include "world/BoxStore.h"
#include "world/DynamicBvh.h"
#include "world/WorldMembers.h"

namespace allpairs::engine {

/// The hierarchies of a store: of each world one over its dynamic boxes and one over its static ones, if it has such.
/// They are kept between steps; an update passes the changes of the store on to those whose boxes they concern.
class WorldForest {
 public:
  explicit WorldForest(std::pmr::memory_resource* memory) : m_memory(memory) {}

  /// Applies the changes of the store since the last call. Returns how many hierarchies were built.
  ///
  /// After an update that threw, only update() may be called; it makes all hierarchies again.
  std::uint64_t update(const BoxStore& store, const WorldMembers& members, const BoxReader& reader, Executor& executor);

  /// Releases all memory. Until the next update nothing else may be called.
  void release() noexcept { *this = WorldForest(m_memory); }

  /// Whether the last update completed, and no memory was released since.
  [[nodiscard]] bool isWhole() const noexcept { return m_isWhole; }

  /// The hierarchy over the static boxes of a world, or over the dynamic ones; an empty one if there are none.
  [[nodiscard]] const DynamicBvh& tree(std::size_t world, bool isStatic) const noexcept;
  [[nodiscard]] DynamicBvh& tree(std::size_t world, bool isStatic) noexcept;

  /// The place of a box in a hierarchy; BoxHome::kNowhere if it is not there.
  [[nodiscard]] std::uint32_t placeIn(const DynamicBvh& tree, BoxId id) const noexcept;

  /// Whether the lanes of all boxes are exactly the boxes.
  [[nodiscard]] bool exact() const noexcept { return m_inexactTrees == 0; }

 private:
  [[nodiscard]] std::uint32_t find(std::size_t world, bool isStatic) const noexcept;
  void plant(const BoxStore& store, const WorldMembers& members);
  void follow(const BoxStore& store, const WorldMembers& members);
  void findTrees(const WorldMembers& members);
  void enter(BoxId id, const BoxStore& store, const WorldMembers& members);
  std::uint32_t takeUnused();
  void noteChanged(const BoxStore& store);
  void markDirty(std::uint32_t tree);
  void list(std::uint32_t tree, const BoxStore& store, const WorldMembers& members);

  std::pmr::memory_resource* m_memory;
  bool m_isWhole = false;
  std::uint64_t m_membership = 0;  ///< That of the store in the last update.
  DynamicBvh m_none{m_memory};     ///< That of no boxes.
  std::pmr::vector<DynamicBvh> m_trees{m_memory};
  /// By tree: twice the number of its world, and 1 more if it is static.
  std::pmr::vector<std::uint64_t> m_keys{m_memory};
  std::pmr::vector<std::uint32_t> m_unused{m_memory};  ///< Trees without boxes, which keep their memory for others.
  std::pmr::vector<std::uint32_t> m_treeOf{m_memory};  ///< By world, first the dynamic and then the static one.
  std::pmr::vector<BoxHome> m_homes{m_memory};         ///< By id.
  std::pmr::vector<std::uint8_t> m_isDirty{m_memory};  ///< By tree: whether it is among those
  std::pmr::vector<std::uint32_t> m_dirty{m_memory};   ///< whose boxes have changed.
  std::ptrdiff_t m_inexactTrees = 0;  ///< Those of which the lanes of some box are not exactly the box.
  std::pmr::vector<std::size_t> m_runs{m_memory};
};

}  // namespace allpairs::engine
