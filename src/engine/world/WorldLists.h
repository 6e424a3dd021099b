// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/Pair.h"
#include "allpairs/WorldTypes.h"
#include "bvh/RadixSort.h"
#include "memory/Memory.h"
#include "world/BoxStore.h"

namespace allpairs::engine {

/// The lists of the last step, by world.
///
/// A pair belongs to the world of its boxes in that step, one that ended to theirs in the step before it; one of two
/// boxes of every world to kEveryWorld. A pair whose box has gone to another world, and which is still a pair because
/// the other one is of every world, has ended there and begun here.
class WorldLists {
 public:
  WorldLists(std::pmr::memory_resource* memory, const WorldOptions& options) : m_memory(memory), m_options(options) {}

  /// A step begins. Allocates what noteStep() needs.
  void prepareStep(const BoxStore& store);

  /// A step is about to complete with the boxes of the store.
  void noteStep(const BoxStore& store) noexcept;

  /// Groups the lists by world: a pass over them, and a sort of those that are not grouped.
  void group(const StepResult& result);

  /// Releases the memory that the lists of the last step do not need.
  void shrink() noexcept;

  /// The lists of a world; group() has been called since the step.
  [[nodiscard]] StepResult of(std::uint32_t world) const noexcept;

 private:
  using Numbers = std::pmr::vector<std::uint32_t>;

  struct Grouped {
    explicit Grouped(std::pmr::memory_resource* memory) : own(memory), kept(memory) {}

    std::span<const Pair> pairs;
    Buffer<Pair> own;             ///< The pairs by world, unless the list was so.
    std::pmr::vector<Pair> kept;  ///< The list, if it is not quite that of the step.
    const Numbers* numbers = nullptr;
  };

  static std::uint32_t numberOf(const Numbers& numbers, Pair pair) noexcept;
  template <class Use>
  void eachIndex(std::size_t pairs, const Use& use) const;
  void moveChanged(const StepResult& result);
  void groupOne(Grouped& list, std::span<const Pair> pairs, const Numbers& numbers);
  [[nodiscard]] static std::span<const Pair> part(const Grouped& list, std::uint32_t world) noexcept;

  std::pmr::memory_resource* m_memory;
  const WorldOptions& m_options;
  std::uint64_t m_membership = 0;
  /// All boxes of the step before the last one had the worlds that they have now; or there are no changes to tell.
  bool m_isSame = true;
  Numbers m_now{m_memory};     ///< By id, in the last step; 0 beyond the end.
  Numbers m_before{m_memory};  ///< In the one before, if they were others.
  Grouped m_pairs{m_memory};
  Grouped m_began{m_memory};
  Grouped m_persisted{m_memory};
  Grouped m_ended{m_memory};
  Buffer<std::uint64_t> m_keyed{m_memory};
  Buffer<std::uint64_t> m_spare{m_memory};
  RadixSort m_radix{m_memory};
};

}  // namespace allpairs::engine
