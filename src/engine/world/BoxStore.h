// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/WorldTypes.h"
#include "memory/Memory.h"
#include "search/PairTest.h"

namespace allpairs::engine {

/// The filter data of a box.
struct FilterRow {
  std::uint32_t category = 0xFFFFFFFFU;
  std::uint32_t mask = 0xFFFFFFFFU;
  std::uint32_t group = 0;

  friend constexpr bool operator==(const FilterRow&, const FilterRow&) = default;
};

/// The boxes of a world by id, in float32 as long as that represents them all exactly, and their changes since the last
/// step and since the hierarchies were last updated.
///
/// The row of an unused id holds an empty box, which readers skip.
/// Memory: a call that throws changes nothing; a batch is applied completely or not at all.
class BoxStore {
 public:
  /// The state of a box, as bits. Those of the hierarchies are in an array of their own: the first query after a change
  /// clears them, while others read the rest.
  enum Flag : std::uint8_t {
    Live = 1,
    Static = 2,
    Touched = 4,    ///< Changed since the last step.
    Stale = 8,      ///< Of the hierarchies: changed since they were updated.
    Stepped = 16,   ///< Has been part of a step, and so may have pairs.
    Leaving = 32,   ///< While a batch is checked: in it, to be removed.
    Resettled = 64  ///< Of the hierarchies: may belong to another one than before.
  };

  explicit BoxStore(std::pmr::memory_resource* memory) : m_memory(memory) {}

  void reserve(std::size_t boxes);

  /// Releases unused memory, and the highest free ids.
  void shrink() noexcept;

  void add(const BoxView& boxes, std::span<const BoxProperties> properties, std::span<BoxId> ids);
  void move(std::span<const BoxId> ids, const BoxView& boxes);
  void move(BoxId id, const Box& box);
  void remove(std::span<const BoxId> ids);
  void clear();
  void setProperties(std::span<const BoxId> ids, std::span<const BoxProperties> properties);
  void invalidate(std::span<const BoxId> ids);

  /// Throws InvalidBox for the first id that is not in use.
  void check(std::span<const BoxId> ids) const;

  [[nodiscard]] std::size_t size() const noexcept { return m_size; }
  [[nodiscard]] std::size_t idBound() const noexcept { return m_flags.size(); }
  [[nodiscard]] bool contains(BoxId id) const noexcept { return id < m_flags.size() && (m_flags[id] & Live) != 0; }
  [[nodiscard]] bool isStatic(BoxId id) const noexcept { return (m_flags[id] & Static) != 0; }
  [[nodiscard]] bool isTouched(BoxId id) const noexcept { return (m_flags[id] & Touched) != 0; }
  [[nodiscard]] Box box(BoxId id) const noexcept;
  [[nodiscard]] double margin(BoxId id) const noexcept { return m_margins.empty() ? 0.0 : m_margins[id]; }
  /// The number of the box's world; of a removed box, the one it had.
  [[nodiscard]] std::uint32_t worldOf(BoxId id) const noexcept { return m_worlds.empty() ? 0 : m_worlds[id]; }

  /// The same by id, if isNumbered().
  [[nodiscard]] std::span<const std::uint32_t> worlds() const noexcept { return m_worlds; }

  /// Whether any box has, or has had, a world number other than 0.
  [[nodiscard]] bool isNumbered() const noexcept { return !m_worlds.empty(); }

  /// Changes whenever boxes were added, removed, or given another world, or have become static or dynamic.
  [[nodiscard]] std::uint64_t membership() const noexcept { return m_membership; }

  /// The data that a pair test reads; set() has been called since anything changed.
  [[nodiscard]] TestedBoxes tested() const noexcept {
    if (!m_filtered || m_filters.empty()) return {&m_set};
    const FilterRow* rows = m_filters.data();
    static_assert(sizeof(FilterRow) == 3 * sizeof(std::uint32_t));
    return {&m_set, &rows->category, &rows->mask, &rows->group, 3};
  }
  [[nodiscard]] const FilterRow& filter(BoxId id) const noexcept { return m_filters[id]; }
  [[nodiscard]] BoxProperties properties(BoxId id) const noexcept;

  /// The number of static boxes.
  [[nodiscard]] std::size_t staticCount() const noexcept { return m_staticCount; }

  /// Whether any box has, or has had, other than the default filter.
  [[nodiscard]] bool filtered() const noexcept { return m_filtered; }

  /// All rows as a set with its margins, id by id; valid until boxes are added or properties change.
  [[nodiscard]] const BoxView& set();

  /// Ids that were touched since the last step, removed ones included, each once.
  [[nodiscard]] std::span<const BoxId> touched() const noexcept { return {m_touched.data(), m_touchedCount}; }

  /// Ids that changed since the last call of settle(), removed ones included, each once.
  [[nodiscard]] std::span<const BoxId> stale() const noexcept { return {m_stale.data(), m_staleCount}; }

  /// Those of them that were added, removed, or have become static or dynamic, each once.
  [[nodiscard]] std::span<const BoxId> resettled() const noexcept { return m_resettled; }

  /// Clears the list of stale boxes.
  void settle() noexcept;

  /// Ends a step: clears the list of touched boxes, and frees the ids of removed boxes.
  void endStep() noexcept;

 private:
  /// Lists a box as changed, once, at the end of a list that is as long as there are ids; returns the new end.
  [[nodiscard]] static BoxId* list(BoxId id, BoxId* end, std::uint8_t& flags, Flag flag) noexcept {
    *end = id;
    end += (flags & flag) == 0 ? 1 : 0;
    flags = static_cast<std::uint8_t>(flags | flag);
    return end;
  }
  [[nodiscard]] BoxId* touchedEnd() noexcept { return m_touched.data() + m_touchedCount; }
  [[nodiscard]] BoxId* staleEnd() noexcept { return m_stale.data() + m_staleCount; }
  void setListEnds(const BoxId* touched, const BoxId* stale) noexcept {
    m_touchedCount = static_cast<std::size_t>(touched - m_touched.data());
    m_staleCount = static_cast<std::size_t>(stale - m_stale.data());
  }
  void note(BoxId id) noexcept {
    setListEnds(list(id, touchedEnd(), m_flags[id], Touched), list(id, staleEnd(), m_marks[id], Stale));
  }
  void noteResettled(BoxId id);
  template <class T>
  void copyRows(std::span<const BoxId> ids, const T* from, T* to);
  /// What is stored only from when it is first needed.
  struct Needs {
    bool float64 = false;
    bool margins = false;
    bool worlds = false;

    static Needs of(std::span<const BoxProperties> properties) noexcept;
  };
  void reserveRoom(std::size_t bound, Needs needs);
  void reserveResettled(std::size_t boxes, std::size_t bound);
  void prepare(std::size_t bound, Needs needs);
  void prepareRemoval(std::size_t boxes);
  [[nodiscard]] bool needsFloat64(const BoxView& boxes) const;
  void widenToDouble();
  void write(BoxId id, const Box& box);
  void assign(BoxId id, const BoxProperties& properties);
  void removeOne(BoxId id);

  std::pmr::memory_resource* m_memory;
  std::size_t m_size = 0;
  std::size_t m_staticCount = 0;
  bool m_isFloat64 = false;
  bool m_filtered = false;
  bool m_setIsCurrent = false;
  std::pmr::vector<float> m_rows32{m_memory};
  std::pmr::vector<double> m_rows64{m_memory};
  std::pmr::vector<double> m_margins{m_memory};        ///< Empty while all are 0.
  std::pmr::vector<std::uint32_t> m_worlds{m_memory};  ///< Empty while all are 0.
  std::pmr::vector<FilterRow> m_filters{m_memory};
  std::pmr::vector<std::uint8_t> m_flags{m_memory};
  std::pmr::vector<std::uint8_t> m_marks{m_memory};  ///< Stale and Resettled.
  std::pmr::vector<BoxId> m_free{m_memory};
  std::pmr::vector<BoxId> m_removed{m_memory};  ///< Since the last step: not yet free.
  /// One more than there are ids: written before it is known whether it counts.
  std::pmr::vector<BoxId> m_touched{m_memory};
  std::pmr::vector<BoxId> m_stale{m_memory};
  std::pmr::vector<BoxId> m_resettled{m_memory};
  std::size_t m_touchedCount = 0;
  std::size_t m_staleCount = 0;
  std::uint64_t m_membership = 0;
  BoxView m_set;
};

}  // namespace allpairs::engine
