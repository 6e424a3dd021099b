// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/WorldTypes.h"
#include "bvh/RadixSort.h"
#include "input/Parts.h"
#include "memory/Memory.h"
#include "world/BoxStore.h"

namespace allpairs::engine {

/// The most boxes of an only world that are listed and searched as small ones, which up to there takes no longer than
/// a hierarchy (docs/decisions/0031). Room for all their pairs takes 147 KB.
inline constexpr std::size_t kMostAlone = 192;

/// The boxes of each world of a store, by ascending id; the worlds by ascending number. After the last one come the
/// boxes of every world, as one more. A store without numbers is a single world, of which all boxes are, and has no
/// lists if it is larger than small worlds are.
class WorldMembers {
 public:
  explicit WorldMembers(std::pmr::memory_resource* memory) : m_memory(memory) {}

  /// Brings it up to date with the store. Must be called before each step of the store ends. If few boxes were added or
  /// removed, the lists are copied with these changes; if many, all boxes are listed again.
  void update(const BoxStore& store, Executor& executor);

  /// Releases all memory, until the next update.
  void release() noexcept { *this = WorldMembers(m_memory); }

  /// The world of the boxes that are in every one: there are so many others.
  [[nodiscard]] std::size_t everyWorld() const noexcept { return m_numbers.size(); }

  [[nodiscard]] std::uint32_t numberOf(std::size_t world) const noexcept {
    return world == everyWorld() ? kEveryWorld : m_numbers[world];
  }

  /// The world of that number; one after everyWorld() if there is none.
  [[nodiscard]] std::size_t find(std::uint32_t number) const noexcept;

  [[nodiscard]] std::span<const BoxId> boxes(std::size_t world) const noexcept {
    if (world + 1 >= m_begin.size()) return {};
    return std::span(m_boxes).subspan(m_begin[world], m_begin[world + 1] - m_begin[world]);
  }

  /// The number of boxes of a world.
  [[nodiscard]] std::size_t size(std::size_t world) const noexcept {
    return boxes(world).size() + (world == 0 ? m_unlisted : 0);
  }
  [[nodiscard]] std::span<const BoxId> shared() const noexcept { return boxes(everyWorld()); }

  /// The world of a box of the store.
  [[nodiscard]] std::size_t worldOf(BoxId id) const noexcept { return m_worldOf.empty() ? 0 : m_worldOf[id]; }

  /// Calls use(id) for the boxes of a world, by ascending id.
  template <class Use>
  void eachBox(std::size_t world, const BoxStore& store, const Use& use) const {
    for (const BoxId id : boxes(world)) use(id);
    if (world != 0 || m_unlisted == 0) return;
    for (BoxId id = 0; id < store.idBound(); ++id) {
      if (store.contains(id)) use(id);
    }
  }

 private:
  void list(const BoxStore& store, Executor& executor);
  std::size_t listBoxes(const BoxStore& store);
  bool follow(const BoxStore& store);
  void copyWorlds(std::span<const std::uint64_t> gone, std::span<const std::uint64_t> come);

  std::pmr::memory_resource* m_memory;
  std::size_t m_unlisted = 0;  ///< The number of boxes of a store without lists.
  std::pmr::vector<std::uint32_t> m_numbers{m_memory};
  std::pmr::vector<std::size_t> m_begin{m_memory};
  std::pmr::vector<BoxId> m_boxes{m_memory};
  std::pmr::vector<std::uint32_t> m_worldOf{m_memory};      ///< By id.
  std::pmr::vector<std::uint32_t> m_nextNumbers{m_memory};  ///< What the lists are copied to.
  std::pmr::vector<std::size_t> m_nextBegin{m_memory};
  std::pmr::vector<BoxId> m_nextBoxes{m_memory};
  Buffer<std::uint64_t> m_keyed{m_memory};  ///< World numbers above ids.
  Buffer<std::uint64_t> m_spare{m_memory};
  RadixSort m_radix{m_memory};
  bool m_isWhole = false;
  std::uint64_t m_membership = 0;
};

/// Cuts a list of worlds into runs of some boxes each, a task's work: `ends` receives where each ends, and 0 first.
template <class SizeOf>
void cutIntoRuns(std::span<const std::uint32_t> worlds, const SizeOf& sizeOf, std::pmr::vector<std::size_t>& ends) {
  ends.assign(1, 0);
  std::size_t boxes = 0;
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    boxes += sizeOf(worlds[i]);
    if (boxes < kPartSize && i + 1 < worlds.size()) continue;
    ends.push_back(i + 1);
    boxes = 0;
  }
}

}  // namespace allpairs::engine
