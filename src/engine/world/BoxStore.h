// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "LaneReader.h"
#include "Memory.h"
#include "allpairs/BoxSet.h"
#include "allpairs/WorldTypes.h"

namespace allpairs::engine {

/// With whom a box may pair.
struct FilterRow {
  std::uint32_t category = 0xFFFFFFFFU;
  std::uint32_t mask = 0xFFFFFFFFU;
  std::uint32_t group = 0;
  std::uint32_t owner = 0;

  friend constexpr bool operator==(const FilterRow&, const FilterRow&) = default;
};

[[nodiscard]] inline bool mayPair(const FilterRow& a, const FilterRow& b) noexcept {
  return ((a.category & b.mask) != 0) & ((b.category & a.mask) != 0) & ((a.group == 0) | (a.group != b.group)) &
         ((a.owner == 0) | (a.owner != b.owner));
}

/// The boxes of a world by id, in float32 as long as that holds them all exactly, and what has become of them since the
/// last step and since the hierarchies were last brought up to date.
///
/// The row of an id that is not in use holds an empty box, which whatever reads it skips.
class BoxStore {
 public:
  static constexpr std::uint8_t kLive = 1;
  static constexpr std::uint8_t kStatic = 2;
  static constexpr std::uint8_t kTouched = 4;   ///< Changed since the last step.
  static constexpr std::uint8_t kStale = 8;     ///< Changed since the hierarchies were brought up to date.
  static constexpr std::uint8_t kStepped = 16;  ///< Has been part of a step, and so may have pairs.

  void reserve(std::size_t boxes);

  void add(const BoxSet& boxes, std::span<const BoxProperties> properties, std::span<BoxId> ids);
  void move(std::span<const BoxId> ids, const BoxSet& boxes);
  void move(BoxId id, const Box& box);
  void remove(std::span<const BoxId> ids);
  void clear();
  void setProperties(std::span<const BoxId> ids, std::span<const BoxProperties> properties);
  void touch(std::span<const BoxId> ids);

  /// Throws InvalidBox for the first id that is not in use.
  void check(std::span<const BoxId> ids) const;

  [[nodiscard]] std::size_t size() const noexcept { return m_size; }
  [[nodiscard]] std::size_t idBound() const noexcept { return m_flags.size(); }
  [[nodiscard]] bool contains(BoxId id) const noexcept { return id < m_flags.size() && (m_flags[id] & kLive) != 0; }
  [[nodiscard]] bool isStatic(BoxId id) const noexcept { return (m_flags[id] & kStatic) != 0; }
  [[nodiscard]] bool isTouched(BoxId id) const noexcept { return (m_flags[id] & kTouched) != 0; }
  [[nodiscard]] Box box(BoxId id) const noexcept;
  [[nodiscard]] double margin(BoxId id) const noexcept { return m_margins.empty() ? 0.0 : m_margins[id]; }
  [[nodiscard]] const FilterRow& filter(BoxId id) const noexcept { return m_filters[id]; }
  [[nodiscard]] BoxProperties properties(BoxId id) const noexcept;

  /// How many of the boxes are static.
  [[nodiscard]] std::size_t staticCount() const noexcept { return m_staticCount; }

  /// Whether any box has, or has had, other than the default filter.
  [[nodiscard]] bool filtered() const noexcept { return m_filtered; }

  /// All rows as a set with its margins, id by id; valid until boxes are added or properties change.
  [[nodiscard]] const BoxSet& set();

  /// Ids that were touched since the last step, removed ones included, each once.
  [[nodiscard]] std::span<const BoxId> touched() const noexcept { return {m_touched.data(), m_touchedCount}; }

  /// Ids that changed since the last call of settle(), removed ones included, each once.
  [[nodiscard]] std::span<const BoxId> stale() const noexcept { return {m_stale.data(), m_staleCount}; }

  /// Those of them that were added, removed, or have become static or dynamic, each once.
  [[nodiscard]] std::span<const BoxId> resettled() const noexcept { return m_resettled; }

  /// Forgets what is stale.
  void settle() noexcept;

  /// Ends a step: forgets what was touched, and gives the ids of removed boxes back for use.
  void endStep();

 private:
  static constexpr std::uint8_t kResettled = 64;  ///< May belong to another hierarchy than before.
  static constexpr std::uint8_t kLeaving = 32;    ///< While a batch is checked: in it, to be removed.

  /// Where the next id goes in the lists of what changed, which are as long as there are ids.
  struct ListEnds {
    BoxId* touched;
    BoxId* stale;

    /// Lists the box as changed, once.
    void note(BoxId id, std::uint8_t& flags) noexcept {
      *touched = id;
      *stale = id;
      touched += (flags & kTouched) == 0 ? 1 : 0;
      stale += (flags & kStale) == 0 ? 1 : 0;
      flags = static_cast<std::uint8_t>(flags | kTouched | kStale);
    }
  };
  [[nodiscard]] ListEnds listEnds() noexcept {
    return {m_touched.data() + m_touchedCount, m_stale.data() + m_staleCount};
  }
  void setListEnds(ListEnds ends) noexcept {
    m_touchedCount = static_cast<std::size_t>(ends.touched - m_touched.data());
    m_staleCount = static_cast<std::size_t>(ends.stale - m_stale.data());
  }
  void note(BoxId id) noexcept {
    ListEnds ends = listEnds();
    ends.note(id, m_flags[id]);
    setListEnds(ends);
  }
  void noteResettled(BoxId id);
  template <class T>
  void copyRows(std::span<const BoxId> ids, const T* from, T* to);
  BoxId takeId();
  void grow(std::size_t bound);
  void widenToDouble();
  void write(BoxId id, const Box& box);
  void writeEmpty(BoxId id);
  void assign(BoxId id, const BoxProperties& properties);
  void removeOne(BoxId id);

  std::size_t m_size = 0;
  std::size_t m_staticCount = 0;
  bool m_isFloat64 = false;
  bool m_filtered = false;
  bool m_setIsCurrent = false;
  std::vector<float> m_rows32;
  std::vector<double> m_rows64;
  std::vector<double> m_margins;  ///< Empty while all are 0.
  std::vector<FilterRow> m_filters;
  std::vector<std::uint8_t> m_flags;
  std::vector<BoxId> m_free;
  std::vector<BoxId> m_removed;  ///< Since the last step: not yet free.
  std::vector<BoxId> m_touched;  ///< One more than there are ids: written before it is known whether it counts.
  std::vector<BoxId> m_stale;
  std::vector<BoxId> m_resettled;
  std::size_t m_touchedCount = 0;
  std::size_t m_staleCount = 0;
  BoxSet m_set;
};

}  // namespace allpairs::engine
