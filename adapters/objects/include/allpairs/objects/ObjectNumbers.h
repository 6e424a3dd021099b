// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "allpairs/WorldTypes.h"

namespace allpairs {

/// The numbers of objects by their addresses: one table, so that a manager that is made for one query allocates little.
///
/// A place is empty, or has an object that belongs there or at a place before, without an empty one between. At most
/// half of the places are taken.
class ObjectNumbers {
 public:
  /// The number of an object; kNoBox if it has none.
  [[nodiscard]] BoxId find(const void* object) const {
    if (m_places.empty() || object == nullptr) return kNoBox;
    for (std::size_t at = homeOf(object);; at = next(at)) {
      if (m_places[at].object == object) return m_places[at].number;
      if (m_places[at].object == nullptr) return kNoBox;
    }
  }

  /// Makes room for so many objects.
  void reserve(std::size_t count) {
    std::size_t places = kLeast;
    while (places < 2 * count) places *= 2;
    if (places > m_places.size()) rehash(places);
  }

  /// Gives an object a number that has none; null gets none.
  void insert(const void* object, BoxId number) {
    if (object == nullptr) return;
    reserve(m_size + 1);
    put({object, number});
    ++m_size;
  }

  /// Takes the number of an object that has one.
  void erase(const void* object) {
    std::size_t hole = homeOf(object);
    while (m_places[hole].object != object) hole = next(hole);
    // What follows moves up where else an empty place would lie before it.
    for (std::size_t at = next(hole); m_places[at].object != nullptr; at = next(at)) {
      const std::size_t home = homeOf(m_places[at].object);
      if (distance(home, at) < distance(hole, at)) continue;
      m_places[hole] = m_places[at];
      hole = at;
    }
    m_places[hole] = {};
    --m_size;
  }

  [[nodiscard]] std::size_t size() const { return m_size; }

 private:
  struct Place {
    const void* object = nullptr;
    BoxId number = kNoBox;
  };

  static constexpr std::size_t kLeast = 16;  ///< Places, a power of two.

  [[nodiscard]] std::size_t next(std::size_t at) const { return (at + 1) & (m_places.size() - 1); }
  [[nodiscard]] std::size_t distance(std::size_t from, std::size_t to) const {
    return (to - from) & (m_places.size() - 1);
  }

  /// Two rounds of Fibonacci hashing: with one, objects that were allocated one after the other share places.
  [[nodiscard]] std::size_t homeOf(const void* object) const {
    constexpr std::uint64_t kOdd = 0x9E3779B97F4A7C15U;
    std::uint64_t product = std::uint64_t{reinterpret_cast<std::uintptr_t>(object)} * kOdd;
    product = (product ^ (product >> 32U)) * kOdd;
    return static_cast<std::size_t>(product >> 32U) & (m_places.size() - 1);
  }

  void put(const Place& place) {
    std::size_t at = homeOf(place.object);
    while (m_places[at].object != nullptr) at = next(at);
    m_places[at] = place;
  }

  void rehash(std::size_t places) {
    std::vector<Place> before(places);
    before.swap(m_places);
    for (const Place& place : before) {
      if (place.object != nullptr) put(place);
    }
  }

  std::vector<Place> m_places;  // as many as a power of two, or none
  std::size_t m_size = 0;
};

}  // namespace allpairs
