// SPDX-License-Identifier: MIT
#include "world/BoxStore.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "allpairs/Error.h"
#include "kernels/Lanes.h"
#include "world/RebuildRule.h"

namespace allpairs::engine {
namespace {

std::string entryOfIds(std::size_t index) { return ", entry " + std::to_string(index) + " of the ids"; }

[[noreturn]] void throwUnknown(std::size_t index, BoxId id) {
  throw InvalidBox(index, "there is no box with the id " + std::to_string(id) + entryOfIds(index));
}

[[noreturn]] void throwRepeated(std::size_t index, BoxId id) {
  throw InvalidBox(index, "the box with the id " + std::to_string(id) + entryOfIds(index) + ", was named before");
}

void checkLength(std::size_t values, const char* what, std::size_t others, const char* whatOthers = "boxes") {
  if (values == others) return;
  throw InvalidArgument(std::to_string(values) + ' ' + what + " for " + std::to_string(others) + ' ' + whatOthers);
}

/// Of boxes that `nameOf` calls by their place in the batch.
template <class NameOf>
void checkMargins(std::span<const BoxProperties> properties, const NameOf& nameOf) {
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (!isDistance(properties[i].margin)) throw InvalidBox(i, nameOf(i) + ": its margin is NaN or -infinity");
  }
}

/// Entry i of as many properties as boxes, or of one for all; the defaults where there are none.
BoxProperties at(std::span<const BoxProperties> properties, std::size_t i) {
  return properties.empty() ? BoxProperties() : properties[properties.size() == 1 ? 0 : i];
}

bool areFloat32(const Box& box) {
  const auto is = [](double value) { return isFloat32(value) || std::isinf(value); };
  bool result = true;
  for (std::size_t axis = 0; axis < 3; ++axis) result = result && is(box.min[axis]) && is(box.max[axis]);
  return result;
}

/// Copies the bounds; returns whether that changed any.
template <class T>
bool copyBounds(const Box& box, T* row) {
  bool changed = false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const T low = static_cast<T>(box.min[axis]);
    const T high = static_cast<T>(box.max[axis]);
    changed |= (row[axis] != low) | (row[axis + 3] != high);
    row[axis] = low;
    row[axis + 3] = high;
  }
  return changed;
}

template <class T>
Box readBounds(const T* row) {
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = static_cast<double>(row[axis]);
    box.max[axis] = static_cast<double>(row[axis + 3]);
  }
  return box;
}

/// Reserves memory for that many values; at least doubles, so that adding boxes one by one is linear.
template <class T>
void makeRoom(std::pmr::vector<T>& values, std::size_t size) {
  if (size > values.capacity()) values.reserve(std::max(size, 2 * values.capacity()));
}

}  // namespace

BoxStore::Needs BoxStore::Needs::of(std::span<const BoxProperties> properties) noexcept {
  Needs needs;
  for (const BoxProperties& p : properties) {
    needs.margins = needs.margins || p.margin != 0.0;
    needs.worlds = needs.worlds || p.world != 0;
  }
  return needs;
}

void BoxStore::reserve(std::size_t boxes) {
  if (boxes > kNoBox) throw InvalidArgument(std::to_string(boxes) + " boxes; at most 4294967295 can be numbered");
  m_setIsCurrent = false;  // The rows may move.
  reserveRoom(boxes, {});
}

/// Allocates what boxes with ids below the bound need, and changes nothing else.
void BoxStore::reserveRoom(std::size_t bound, Needs needs) {
  makeRoom(m_flags, bound);
  makeRoom(m_marks, bound);
  makeRoom(m_filters, bound);
  makeRoom(m_touched, bound + 1);
  makeRoom(m_stale, bound + 1);
  if (needs.worlds || !m_worlds.empty()) makeRoom(m_worlds, bound);
  // What the set is a view of moves even if the next of these fails.
  const auto makeRoomOfSet = [this](auto& values, std::size_t size) {
    m_setIsCurrent = m_setIsCurrent && size <= values.capacity();
    makeRoom(values, size);
  };
  if (needs.margins || !m_margins.empty()) makeRoomOfSet(m_margins, bound);
  if (m_isFloat64 || needs.float64) {
    makeRoomOfSet(m_rows64, 6 * bound);
  } else {
    makeRoomOfSet(m_rows32, 6 * bound);
  }
}

/// Creates ids below the bound, and float64 rows, margins and world numbers if they are needed and missing. A change
/// allocates everything before it changes anything: a batch is applied completely or not at all.
void BoxStore::prepare(std::size_t bound, Needs needs) {
  reserveRoom(bound, needs);
  // Nothing below throws: memory is reserved.
  if (needs.float64 && !m_isFloat64) widenToDouble();
  const bool margins = needs.margins || !m_margins.empty();
  m_setIsCurrent = m_setIsCurrent && bound == idBound() && m_margins.empty() == !margins;
  m_flags.resize(bound, 0);
  m_marks.resize(bound, 0);
  m_filters.resize(bound);
  m_touched.resize(bound + 1);
  m_stale.resize(bound + 1);
  if (margins) m_margins.resize(bound, 0.0);
  if (needs.worlds || !m_worlds.empty()) m_worlds.resize(bound, 0);
  if (m_isFloat64) {
    m_rows64.resize(6 * bound, 0.0);
  } else {
    m_rows32.resize(6 * bound, 0.0F);
  }
}

void BoxStore::shrink() noexcept {
  std::size_t bound = idBound();
  while (bound > 0 && (m_flags[bound - 1] | m_marks[bound - 1]) == 0) --bound;  // Not live, nor in a list of changes.
  std::erase_if(m_free, [&](BoxId id) { return id >= bound; });
  m_rows32.resize(m_isFloat64 ? 0 : 6 * bound);
  m_rows64.resize(m_isFloat64 ? 6 * bound : 0);
  m_margins.resize(m_margins.empty() ? 0 : bound);
  m_worlds.resize(m_worlds.empty() ? 0 : bound);
  m_filters.resize(bound);
  m_flags.resize(bound);
  m_marks.resize(bound);
  // Before a box was added they are empty, and this must not allocate.
  m_touched.resize(std::min(m_touched.size(), bound + 1));
  m_stale.resize(std::min(m_stale.size(), bound + 1));
  const auto trim = [](auto&... lists) { (lists.shrink_to_fit(), ...); };
  trim(m_rows32, m_rows64, m_margins, m_worlds, m_filters, m_flags, m_marks, m_touched, m_stale, m_resettled);
  if (m_removed.empty()) trim(m_free, m_removed);  // Else there is room for them among the free ones, for endStep().
  m_setIsCurrent = false;
}

/// Reserves memory for that many more resettled boxes, of all with ids below the bound.
void BoxStore::reserveResettled(std::size_t boxes, std::size_t bound) {
  makeRoom(m_resettled, std::min(m_resettled.size() + boxes, bound));
}

/// Whether boxes have bounds that the current rows cannot represent exactly.
bool BoxStore::needsFloat64(const BoxView& boxes) const {
  if (m_isFloat64 || !boxes.isFloat64()) return false;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!areFloat32(boxes[i])) return true;
  }
  return false;
}

void BoxStore::check(std::span<const BoxId> ids) const {
  bool known = true;
  for (const BoxId id : ids) known = known && contains(id);
  if (known) return;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!contains(ids[i])) throwUnknown(i, ids[i]);
  }
}

void BoxStore::add(const BoxView& boxes, std::span<const BoxProperties> properties, std::span<BoxId> ids) {
  checkLength(ids.size(), "ids", boxes.size());
  if (properties.size() > 1) checkLength(properties.size(), "properties", boxes.size());
  checkMargins(properties, [](std::size_t i) { return "box " + std::to_string(i) + " of the batch"; });
  const std::size_t fresh = boxes.size() - std::min(boxes.size(), m_free.size());
  if (fresh > kNoBox - idBound()) {
    throw InvalidArgument(std::to_string(boxes.size()) + " more boxes; at most 4294967295 can be numbered");
  }
  const std::size_t bound = idBound() + fresh;
  reserveResettled(boxes.size(), bound);
  auto next = static_cast<BoxId>(idBound());
  Needs needs = Needs::of(properties);
  needs.float64 = needsFloat64(boxes);
  prepare(bound, needs);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    ids[i] = m_free.empty() ? next++ : m_free.back();
    if (!m_free.empty()) m_free.pop_back();
    m_flags[ids[i]] |= Live;
    assign(ids[i], at(properties, i));
    write(ids[i], boxes[i]);
    noteResettled(ids[i]);
  }
  m_size += boxes.size();
}

void BoxStore::widenToDouble() {
  m_rows64.assign(m_rows32.begin(), m_rows32.end());
  m_rows32.clear();
  m_rows32.shrink_to_fit();
  m_isFloat64 = true;
  m_setIsCurrent = false;
}

void BoxStore::write(BoxId id, const Box& box) {
  const std::size_t row = std::size_t{6} * id;
  const bool changed = m_isFloat64 ? copyBounds(box, &m_rows64[row]) : copyBounds(box, &m_rows32[row]);
  if (changed) note(id);
}

void BoxStore::move(BoxId id, const Box& box) {
  if (!contains(id)) throwUnknown(0, id);
  if (hasNan(box)) throw InvalidBox(0, "the box with the id " + std::to_string(id) + " has a NaN");
  if (!m_isFloat64 && !areFloat32(box)) prepare(idBound(), {.float64 = true});
  write(id, box);
}

void BoxStore::move(std::span<const BoxId> ids, const BoxView& boxes) {
  checkLength(boxes.size(), "boxes", ids.size(), "ids");
  check(ids);
  if (needsFloat64(boxes)) prepare(idBound(), {.float64 = true});
  if (!m_isFloat64 && !boxes.isFloat64() && boxes.float32().isPacked()) {
    copyRows(ids, boxes.float32().min.data, m_rows32.data());
  } else if (m_isFloat64 && boxes.isFloat64() && boxes.float64().isPacked()) {
    copyRows(ids, boxes.float64().min.data, m_rows64.data());
  } else {
    for (std::size_t i = 0; i < ids.size(); ++i) write(ids[i], boxes[i]);
  }
}

/// Rows of six to rows of six, of the same kind. Where the lists are and end is kept in registers: flags are bytes, and
/// a byte that is written may be of anything.
template <class T>
void BoxStore::copyRows(std::span<const BoxId> ids, const T* from, T* to) {
  BoxId* touched = touchedEnd();
  BoxId* stale = staleEnd();
  std::uint8_t* const flags = m_flags.data();
  std::uint8_t* const marks = m_marks.data();
  for (const BoxId id : ids) {
    T* const row = to + std::size_t{6} * id;
    // Does not compare bytes: 0 and -0 are the same bound.
    const bool changed = !std::equal(from, from + 6, row);
    std::memcpy(row, from, 6 * sizeof(T));  // std::copy_n is a call of memmove.
    from += 6;
    if (!changed) continue;
    touched = list(id, touched, flags[id], Touched);
    stale = list(id, stale, marks[id], Stale);
  }
  setListEnds(touched, stale);
}

void BoxStore::remove(std::span<const BoxId> ids) {
  std::size_t known = 0;
  while (known < ids.size() && contains(ids[known]) && (m_flags[ids[known]] & Leaving) == 0) {
    m_flags[ids[known++]] |= Leaving;
  }
  for (std::size_t i = 0; i < known; ++i) m_flags[ids[i]] &= static_cast<std::uint8_t>(~Leaving);
  if (known < ids.size()) contains(ids[known]) ? throwRepeated(known, ids[known]) : throwUnknown(known, ids[known]);
  prepareRemoval(ids.size());
  for (const BoxId id : ids) removeOne(id);
}

/// Room in the lists of ids, now and at the end of the step, which must not fail.
void BoxStore::prepareRemoval(std::size_t boxes) {
  reserveResettled(boxes, idBound());
  makeRoom(m_removed, m_removed.size() + boxes);
  makeRoom(m_free, m_free.size() + m_removed.size() + boxes);
}

void BoxStore::removeOne(BoxId id) {
  noteResettled(id);
  write(id, kEmptyBox);
  const bool stepped = (m_flags[id] & Stepped) != 0;
  if (isStatic(id)) --m_staticCount;
  BoxProperties none;
  none.world = worldOf(id);
  assign(id, none);
  m_flags[id] &= static_cast<std::uint8_t>(~(Live | Stepped));
  --m_size;
  (stepped ? m_removed : m_free).push_back(id);
}

void BoxStore::clear() {
  prepareRemoval(m_size);
  for (std::size_t id = 0; id < idBound(); ++id) {
    if (contains(static_cast<BoxId>(id))) removeOne(static_cast<BoxId>(id));
  }
}

void BoxStore::setProperties(std::span<const BoxId> ids, std::span<const BoxProperties> properties) {
  if (properties.size() != 1) checkLength(properties.size(), "properties", ids.size());
  check(ids);
  const auto nameOf = [&](std::size_t i) {
    return i < ids.size() ? "the box with the id " + std::to_string(ids[i]) : std::string("no box");
  };
  checkMargins(properties, nameOf);
  reserveResettled(ids.size(), idBound());
  prepare(idBound(), Needs::of(properties));
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const bool wasStatic = isStatic(ids[i]);
    const std::uint32_t world = worldOf(ids[i]);
    if (wasStatic) --m_staticCount;
    assign(ids[i], at(properties, i));
    note(ids[i]);
    if (isStatic(ids[i]) != wasStatic || worldOf(ids[i]) != world) noteResettled(ids[i]);
  }
}

void BoxStore::invalidate(std::span<const BoxId> ids) {
  check(ids);
  for (const BoxId id : ids) note(id);
}

void BoxStore::assign(BoxId id, const BoxProperties& properties) {
  m_filters[id] = {properties.category, properties.mask, properties.group};
  m_filtered = m_filtered || m_filters[id] != FilterRow{};
  if (!m_margins.empty()) {
    m_margins[id] = properties.margin;
    m_setIsCurrent = false;
  }
  if (!m_worlds.empty()) m_worlds[id] = properties.world;
  m_flags[id] &= static_cast<std::uint8_t>(~Static);
  if (properties.isStatic) {
    m_flags[id] |= Static;
    ++m_staticCount;
  }
}

Box BoxStore::box(BoxId id) const noexcept {
  const std::size_t row = std::size_t{6} * id;
  return m_isFloat64 ? readBounds(&m_rows64[row]) : readBounds(&m_rows32[row]);
}

BoxProperties BoxStore::properties(BoxId id) const noexcept {
  const FilterRow& row = m_filters[id];
  return {row.category, row.mask, row.group, margin(id), isStatic(id), worldOf(id)};
}

const BoxView& BoxStore::set() {
  if (m_setIsCurrent) return m_set;
  m_set = m_isFloat64 ? BoxView::fromRows(std::span<const double>(m_rows64))
                      : BoxView::fromRows(std::span<const float>(m_rows32));
  m_set.setMargins(m_margins);
  m_setIsCurrent = true;
  return m_set;
}

void BoxStore::noteResettled(BoxId id) {
  note(id);
  ++m_membership;
  if ((m_marks[id] & Resettled) == 0) m_resettled.push_back(id);
  m_marks[id] |= Resettled;
}

void BoxStore::settle() noexcept {
  if (m_staleCount * kShareOfChange > idBound()) {
    std::fill(m_marks.begin(), m_marks.end(), std::uint8_t{0});
  } else {
    for (const BoxId id : stale()) m_marks[id] = 0;
  }
  m_staleCount = 0;
  m_resettled.clear();
}

void BoxStore::endStep() noexcept {
  static_assert(Stepped == Live << 4U);
  // All current boxes have now been part of a step.
  const auto ended = [](std::uint8_t flags) {
    return static_cast<std::uint8_t>((flags & ~Touched) | ((flags & Live) << 4U));
  };
  if (m_touchedCount * kShareOfChange > idBound()) {
    for (std::uint8_t& flags : m_flags) flags = ended(flags);
  } else {
    for (const BoxId id : touched()) m_flags[id] = ended(m_flags[id]);
  }
  m_touchedCount = 0;
  m_free.insert(m_free.end(), m_removed.begin(), m_removed.end());
  m_removed.clear();
}

}  // namespace allpairs::engine
