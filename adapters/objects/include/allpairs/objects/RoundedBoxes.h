// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "allpairs/WorldTypes.h"

namespace allpairs {

/// Boxes that change, rounded to float32 and by axis, so that a box is compared with several of them at once. Rounding
/// to the nearest never changes which of two numbers is the greater, it only makes them equal: boxes that overlap do so
/// when they are rounded, and few others do.
///
/// Geometry:  boxes are closed. An empty box, whose minima are greater than any number or the greatest, may overlap what
///            is infinite on all sides.
/// Threads:   const members may be called concurrently while no other member runs.
class RoundedBoxes {
 public:
  /// minx miny minz maxx maxy maxz
  using Row = std::array<float, 6>;

  /// So many boxes are a block: those with the numbers from block * kBlock on.
  static constexpr std::size_t kBlock = 64;

  /// Of more boxes nearest() finds none.
  static constexpr std::size_t kMostForNearest = std::size_t{1} << 20;

  /// Numbers too great for float32 become infinity.
  template <class T>
  [[nodiscard]] static Row rounded(const T* row) {
    Row result{};
    for (std::size_t i = 0; i < 6; ++i) result[i] = static_cast<float>(row[i]);
    return result;
  }

  [[nodiscard]] std::size_t size() const { return m_size; }
  [[nodiscard]] std::size_t blocks() const { return (m_size + kBlock - 1) / kBlock; }

  /// Makes room for so many boxes: set() of these needs no memory.
  void reserve(std::size_t boxes) {
    if (boxes > m_room) grow(boxes);
  }

  /// Gives the box with this number its bounds; those before it that have none are empty.
  template <class T>
  void set(BoxId number, const T* row) {
    reserve(std::size_t{number} + 1);
    for (std::size_t i = 0; i < 6; ++i) m_bounds[i * m_room + number] = static_cast<float>(row[i]);
    if (number >= m_size) m_size = std::size_t{number} + 1;
  }

  void clear() { *this = {}; }

  /// Which of the kBlock boxes of one of the blocks(), as bits, may overlap another.
  [[nodiscard]] std::uint64_t mayOverlap(std::size_t block, const Row& box) const;

  /// The number of a box, other than one, that is near to another: none of them is at half its distance, of up to a
  /// million. kNoBox if there is none at a finite distance, or if there are more than kMostForNearest.
  [[nodiscard]] BoxId nearest(const Row& box, BoxId except = kNoBox) const;

 private:
  void grow(std::size_t boxes);

  /// By bound: m_room minx, m_room miny, ... Those behind the last box are of empty ones.
  std::vector<float> m_bounds;
  std::size_t m_room = 0;  ///< A multiple of kBlock.
  std::size_t m_size = 0;
};

}  // namespace allpairs
