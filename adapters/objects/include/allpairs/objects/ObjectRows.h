// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/Error.h"
#include "allpairs/Pair.h"
#include "allpairs/Span.h"
#include "allpairs/objects/ObjectNumbers.h"

namespace allpairs {

/// Objects of a host by number, and their boxes as they were last read, one after the other in memory: objects lie
/// wherever their owner put them. Object has getAABB(), a box with min_ and max_, as FCL and Coal have it.
template <class HostObject>
class ObjectRows {
 public:
  using Object = HostObject;
  using Bounds = std::decay_t<decltype(std::declval<const Object&>().getAABB())>;
  using S = std::decay_t<decltype(std::declval<const Bounds&>().min_[0])>;

  /// The number of an object; kNoBox if it has none.
  [[nodiscard]] BoxId numberOf(Object* object) const { return m_numbers.find(object); }

  /// Makes room for so many objects; often, a few more each time, too.
  void reserve(std::size_t objects) {
    m_numbers.reserve(objects);
    if (objects > m_objects.capacity()) objects = std::max(objects, 2 * m_objects.capacity());
    m_objects.reserve(objects);
    m_rows.reserve(6 * objects);
    m_free.reserve(objects);  // so that remove() needs no memory
  }

  /// Gives an object a number, or finds the one that it has.
  BoxId add(Object* object) {
    const BoxId known = m_numbers.find(object);
    if (known != kNoBox) return known;
    const BoxId next = m_free.empty() ? static_cast<BoxId>(m_objects.size()) : m_free.back();
    reserve(m_free.empty() ? m_objects.size() + 1 : m_objects.size());
    if (m_free.empty()) {
      m_rows.insert(m_rows.end(), kNothing.begin(), kNothing.end());
      m_objects.push_back(object);
    } else {
      m_free.pop_back();
      m_objects[next] = object;
    }
    m_numbers.insert(object, next);
    return next;
  }

  /// Takes an object out, and returns the number that it had; its box becomes empty.
  BoxId remove(Object* object) {
    const BoxId number = m_numbers.find(object);
    if (number == kNoBox) return kNoBox;
    m_free.push_back(number);
    m_numbers.erase(object);
    m_objects[number] = nullptr;
    std::copy(kNothing.begin(), kNothing.end(), m_rows.begin() + std::ptrdiff_t{6} * number);
    return number;
  }

  void clear() { *this = {}; }

  /// Reads the box of the object with this number, if there is one, and says whether it has changed.
  ///
  /// Bad input: a NaN throws InvalidBox with the number; the box stays what it was.
  bool read(BoxId number) {
    const Object* const object = m_objects[number];
    if (object == nullptr) return false;
    const Bounds& now = object->getAABB();
    S* const row = m_rows.data() + std::size_t{6} * number;
    bool isSame = true;
    bool isBox = true;
    for (int axis = 0; axis < 3; ++axis) {
      isSame &= row[axis] == now.min_[axis];
      isSame &= row[3 + axis] == now.max_[axis];
      isBox &= now.min_[axis] <= now.max_[axis];
    }
    if (isSame) return false;
    if (!isBox) return readEmpty(number, now);
    for (int axis = 0; axis < 3; ++axis) {
      row[axis] = now.min_[axis];
      row[3 + axis] = now.max_[axis];
      m_hull.min_[axis] = std::min(m_hull.min_[axis], now.min_[axis]);
      m_hull.max_[axis] = std::max(m_hull.max_[axis], now.max_[axis]);
    }
    return true;
  }

  /// The object with this number; null where it has left.
  [[nodiscard]] Object* operator[](BoxId number) const { return m_objects[number]; }

  /// The objects, in the order of their numbers.
  void copyTo(std::vector<Object*>& objects) const {
    objects.clear();
    objects.reserve(size());
    for (Object* object : m_objects) {
      if (object != nullptr) objects.push_back(object);
    }
  }

  /// The box of an object as it was last read.
  [[nodiscard]] Bounds bounds(BoxId number) const {
    const S* const row = m_rows.data() + std::size_t{6} * number;
    Bounds bounds;
    bounds.min_ = {row[0], row[1], row[2]};
    bounds.max_ = {row[3], row[4], row[5]};
    return bounds;
  }

  /// Whether there is an object with this number whose box was not empty when it was last read.
  [[nodiscard]] bool hasBox(BoxId number) const {
    const S* const row = m_rows.data() + std::size_t{6} * number;
    return row[0] <= row[3];
  }

  /// Whether the box of the object with this number, if there is one, overlaps another that is not empty.
  [[nodiscard]] bool overlaps(BoxId number, const Bounds& other) const {
    const S* const row = m_rows.data() + std::size_t{6} * number;
    for (int axis = 0; axis < 3; ++axis) {
      if (row[axis] > other.max_[axis] || other.min_[axis] > row[3 + axis]) return false;
    }
    return hasBox(number);
  }

  /// Whether a box that is not empty overlaps the box around all that were read since the last clear(): else it
  /// overlaps none.
  [[nodiscard]] bool mayOverlap(const Bounds& other) const { return m_hull.overlap(other); }

  /// No bound that was read since the last clear() is further from 0.
  [[nodiscard]] double magnitude() const {
    double most = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      most = std::max(
          {most, std::abs(static_cast<double>(m_hull.min_[axis])), std::abs(static_cast<double>(m_hull.max_[axis]))});
    }
    return most;
  }

  /// The lower corner of the box around all that were read since the last clear(), and its greatest extent.
  [[nodiscard]] std::array<double, 3> origin() const {
    return {static_cast<double>(m_hull.min_[0]), static_cast<double>(m_hull.min_[1]),
            static_cast<double>(m_hull.min_[2])};
  }
  [[nodiscard]] double extent() const {
    double most = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      most = std::max(most, static_cast<double>(m_hull.max_[axis]) - static_cast<double>(m_hull.min_[axis]));
    }
    return most;
  }

  /// All boxes by number: minx miny minz maxx maxy maxz. Where an object has left it is an empty one.
  [[nodiscard]] Span<const S> rows() const { return m_rows; }

  /// How many objects there are; all their numbers are below bound().
  [[nodiscard]] std::size_t size() const { return m_numbers.size(); }
  [[nodiscard]] BoxId bound() const { return static_cast<BoxId>(m_objects.size()); }

 private:
  static constexpr S kMost = std::numeric_limits<S>::max();
  static constexpr std::array<S, 6> kNothing{kMost, kMost, kMost, -kMost, -kMost, -kMost};

  /// All empty boxes are one, of which nothing is left when it is rounded.
  bool readEmpty(BoxId number, const Bounds& now) {
    if (!(now.min_ == now.min_) || !(now.max_ == now.max_)) {
      throw InvalidBox(number, "the box of object " + std::to_string(number) + " has a NaN");
    }
    const auto row = m_rows.begin() + std::ptrdiff_t{6} * number;
    if (std::equal(kNothing.begin(), kNothing.end(), row)) return false;
    std::copy(kNothing.begin(), kNothing.end(), row);
    return true;
  }

  std::vector<Object*> m_objects;
  std::vector<S> m_rows;
  Bounds m_hull;  // empty without any
  ObjectNumbers m_numbers;
  std::vector<BoxId> m_free;
};

}  // namespace allpairs
