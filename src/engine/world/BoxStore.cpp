// SPDX-License-Identifier: MIT
#include "world/BoxStore.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "allpairs/Error.h"

namespace allpairs::engine {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// If one id in so many is in a list, going through all of them is faster than through the list.
constexpr std::size_t kShareOfIds = 16;

[[noreturn]] void throwUnknown(std::size_t index, BoxId id) {
  throw InvalidBox(
      index, "there is no box with the id " + std::to_string(id) + ", entry " + std::to_string(index) + " of the ids");
}

void checkLength(std::size_t values, const char* what, std::size_t boxes) {
  if (values == boxes) return;
  throw InvalidArgument(std::to_string(values) + ' ' + what + " for " + std::to_string(boxes) + " boxes");
}

void checkProperties(std::span<const BoxProperties> properties, std::size_t boxes, bool mayBeNone) {
  if (properties.size() != 1 && !(properties.empty() && mayBeNone)) {
    checkLength(properties.size(), "properties", boxes);
  }
  for (std::size_t i = 0; i < properties.size(); ++i) {
    if (std::isnan(properties[i].margin) || properties[i].margin == -kInfinity) {
      throw InvalidBox(i, "box " + std::to_string(i) + " of the batch: its margin is NaN or -infinity");
    }
  }
}

/// Entry i of as many properties as boxes, or of one for all; the defaults where there are none.
const BoxProperties& at(std::span<const BoxProperties> properties, std::size_t i) {
  static constexpr BoxProperties kDefaults;
  return properties.empty() ? kDefaults : properties[properties.size() == 1 ? 0 : i];
}

bool isFloat32(double value) {
  if (std::abs(value) > static_cast<double>(kLaneMax)) return std::isinf(value);
  return static_cast<double>(static_cast<float>(value)) == value;
}

bool isFloat32(const Box& box) {
  bool result = true;
  for (std::size_t axis = 0; axis < 3; ++axis) result = result && isFloat32(box.min[axis]) && isFloat32(box.max[axis]);
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

}  // namespace

void BoxStore::reserve(std::size_t boxes) {
  if (m_isFloat64) {
    m_rows64.reserve(6 * boxes);
  } else {
    m_rows32.reserve(6 * boxes);
  }
  m_filters.reserve(boxes);
  m_flags.reserve(boxes);
}

void BoxStore::check(std::span<const BoxId> ids) const {
  bool known = true;
  for (const BoxId id : ids) known = known && contains(id);
  if (known) return;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!contains(ids[i])) throwUnknown(i, ids[i]);
  }
}

void BoxStore::add(const BoxSet& boxes, std::span<const BoxProperties> properties, std::span<BoxId> ids) {
  checkLength(ids.size(), "ids", boxes.size());
  checkProperties(properties, boxes.size(), true);
  const std::size_t fresh = boxes.size() - std::min(boxes.size(), m_free.size());
  if (fresh > kNoBox - idBound()) {
    throw InvalidArgument(std::to_string(boxes.size()) + " more boxes; at most 4294967295 can be numbered");
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const BoxId id = takeId();
    ids[i] = id;
    m_flags[id] |= kLive;
    assign(id, at(properties, i));
    write(id, boxes[i]);
    noteResettled(id);
  }
  m_size += boxes.size();
}

BoxId BoxStore::takeId() {
  if (m_free.empty()) {
    grow(idBound() + 1);
    return static_cast<BoxId>(idBound() - 1);
  }
  const BoxId id = m_free.back();
  m_free.pop_back();
  return id;
}

void BoxStore::grow(std::size_t bound) {
  m_flags.resize(bound, 0);
  m_filters.resize(bound);
  m_touched.resize(bound + 1);
  m_stale.resize(bound + 1);
  if (!m_margins.empty()) m_margins.resize(bound, 0.0);
  if (m_isFloat64) {
    m_rows64.resize(6 * bound, 0.0);
  } else {
    m_rows32.resize(6 * bound, 0.0F);
  }
  m_setIsCurrent = false;
}

void BoxStore::widenToDouble() {
  m_rows64.assign(m_rows32.begin(), m_rows32.end());
  m_rows32 = {};
  m_isFloat64 = true;
  m_setIsCurrent = false;
}

void BoxStore::write(BoxId id, const Box& box) {
  if (!m_isFloat64 && !isFloat32(box)) widenToDouble();
  const std::size_t row = std::size_t{6} * id;
  const bool changed = m_isFloat64 ? copyBounds(box, &m_rows64[row]) : copyBounds(box, &m_rows32[row]);
  if (changed) note(id);
}

void BoxStore::writeEmpty(BoxId id) { write(id, kEmptyBox); }

void BoxStore::move(BoxId id, const Box& box) {
  if (!contains(id)) throwUnknown(0, id);
  if (hasNan(box)) throw InvalidBox(0, "the box with the id " + std::to_string(id) + " has a NaN");
  write(id, box);
}

void BoxStore::move(std::span<const BoxId> ids, const BoxSet& boxes) {
  checkLength(boxes.size(), "boxes", ids.size());
  check(ids);
  if (!m_isFloat64 && !boxes.isFloat64() && boxes.float32().isPacked()) {
    copyRows(ids, boxes.float32().min.data, m_rows32.data());
  } else if (m_isFloat64 && boxes.isFloat64() && boxes.float64().isPacked()) {
    copyRows(ids, boxes.float64().min.data, m_rows64.data());
  } else {
    for (std::size_t i = 0; i < ids.size(); ++i) write(ids[i], boxes[i]);
  }
}

/// Rows of six to rows of six, of the same kind. The lists' ends are kept in registers: flags are bytes, and a byte that is
/// written may be of anything.
template <class T>
void BoxStore::copyRows(std::span<const BoxId> ids, const T* from, T* to) {
  ListEnds ends = listEnds();
  std::uint8_t* const flags = m_flags.data();
  for (const BoxId id : ids) {
    T* const row = to + std::size_t{6} * id;
    // Not the bytes: 0 and -0 are the same bound.
    const bool changed = !std::equal(from, from + 6, row);
    std::copy_n(from, 6, row);
    from += 6;
    if (changed) ends.note(id, flags[id]);
  }
  setListEnds(ends);
}

void BoxStore::remove(std::span<const BoxId> ids) {
  std::size_t known = 0;
  while (known < ids.size() && contains(ids[known]) && (m_flags[ids[known]] & kLeaving) == 0) {
    m_flags[ids[known++]] |= kLeaving;
  }
  for (std::size_t i = 0; i < known; ++i) m_flags[ids[i]] &= static_cast<std::uint8_t>(~kLeaving);
  // Unknown, or there twice.
  if (known < ids.size()) throwUnknown(known, ids[known]);
  for (const BoxId id : ids) removeOne(id);
}

void BoxStore::removeOne(BoxId id) {
  noteResettled(id);
  writeEmpty(id);
  const bool stepped = (m_flags[id] & kStepped) != 0;
  if (isStatic(id)) --m_staticCount;
  assign(id, {});
  m_flags[id] &= static_cast<std::uint8_t>(~(kLive | kStepped));
  --m_size;
  (stepped ? m_removed : m_free).push_back(id);
}

void BoxStore::clear() {
  for (std::size_t id = 0; id < idBound(); ++id) {
    if (contains(static_cast<BoxId>(id))) removeOne(static_cast<BoxId>(id));
  }
}

void BoxStore::setProperties(std::span<const BoxId> ids, std::span<const BoxProperties> properties) {
  checkProperties(properties, ids.size(), false);
  check(ids);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const bool wasStatic = isStatic(ids[i]);
    if (wasStatic) --m_staticCount;
    assign(ids[i], at(properties, i));
    note(ids[i]);
    if (isStatic(ids[i]) != wasStatic) noteResettled(ids[i]);
  }
}

void BoxStore::touch(std::span<const BoxId> ids) {
  check(ids);
  for (const BoxId id : ids) note(id);
}

void BoxStore::assign(BoxId id, const BoxProperties& properties) {
  m_filters[id] = {properties.category, properties.mask, properties.group, properties.owner};
  m_filtered = m_filtered || m_filters[id] != FilterRow{};
  if (properties.margin != 0.0 && m_margins.empty()) m_margins.assign(idBound(), 0.0);
  if (!m_margins.empty()) {
    m_margins[id] = properties.margin;
    m_setIsCurrent = false;
  }
  m_flags[id] &= static_cast<std::uint8_t>(~kStatic);
  if (properties.isStatic) {
    m_flags[id] |= kStatic;
    ++m_staticCount;
  }
}

Box BoxStore::box(BoxId id) const noexcept {
  const std::size_t row = std::size_t{6} * id;
  return m_isFloat64 ? readBounds(&m_rows64[row]) : readBounds(&m_rows32[row]);
}

BoxProperties BoxStore::properties(BoxId id) const noexcept {
  const FilterRow& row = m_filters[id];
  return {row.category, row.mask, row.group, row.owner, margin(id), isStatic(id)};
}

const BoxSet& BoxStore::set() {
  if (m_setIsCurrent) return m_set;
  m_set = m_isFloat64 ? BoxSet::fromRows(std::span<const double>(m_rows64))
                      : BoxSet::fromRows(std::span<const float>(m_rows32));
  m_set.setMargins(m_margins);
  m_setIsCurrent = true;
  return m_set;
}

void BoxStore::noteResettled(BoxId id) {
  note(id);
  if ((m_flags[id] & kResettled) == 0) m_resettled.push_back(id);
  m_flags[id] |= kResettled;
}

void BoxStore::settle() noexcept {
  constexpr auto kKept = static_cast<std::uint8_t>(~(kStale | kResettled));
  if (m_staleCount * kShareOfIds > idBound()) {
    for (std::uint8_t& flags : m_flags) flags &= kKept;
  } else {
    for (const BoxId id : stale()) m_flags[id] &= kKept;
  }
  m_staleCount = 0;
  m_resettled.clear();
}

void BoxStore::endStep() {
  static_assert(kStepped == kLive << 4U);
  // All boxes that there are have been part of a step now.
  const auto ended = [](std::uint8_t flags) {
    return static_cast<std::uint8_t>((flags & ~kTouched) | ((flags & kLive) << 4U));
  };
  if (m_touchedCount * kShareOfIds > idBound()) {
    for (std::uint8_t& flags : m_flags) flags = ended(flags);
  } else {
    for (const BoxId id : touched()) m_flags[id] = ended(m_flags[id]);
  }
  m_touchedCount = 0;
  m_free.insert(m_free.end(), m_removed.begin(), m_removed.end());
  m_removed.clear();
}

}  // namespace allpairs::engine
