// SPDX-License-Identifier: MIT
#include "allpairs/objects/RoundedBoxes.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace allpairs {
namespace {

static_assert(std::numeric_limits<float>::is_iec559);  // too great a number becomes infinity
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// As many numbers as every 64-bit processor compares at once.
constexpr std::size_t kLanes = 4;
using Four [[gnu::vector_size(16)]] = float;
using FourBits [[gnu::vector_size(16)]] = std::int32_t;

/// A bit of an integer lane for each of so many boxes.
constexpr std::size_t kBits = 32;

Four load(const float* numbers) {
  Four vector;
  std::memcpy(&vector, numbers, sizeof(vector));
  return vector;
}

/// The same bits.
template <class Vector, class Other>
Vector as(Other vector) {
  Vector result;
  static_assert(sizeof(result) == sizeof(vector));
  std::memcpy(&result, &vector, sizeof(result));
  return result;
}

Four all(float number) { return Four{number, number, number, number}; }

}  // namespace

void RoundedBoxes::grow(std::size_t boxes) {
  const std::size_t room = (std::max(boxes, 2 * m_room) + kBlock - 1) / kBlock * kBlock;
  std::vector<float> bounds(6 * room, kInfinity);
  std::fill(bounds.begin() + static_cast<std::ptrdiff_t>(3 * room), bounds.end(), -kInfinity);
  for (std::size_t i = 0; i < 6; ++i) std::copy_n(m_bounds.data() + i * m_room, m_size, bounds.data() + i * room);
  m_bounds.swap(bounds);
  m_room = room;
}

std::uint64_t RoundedBoxes::mayOverlap(std::size_t block, const Row& box) const {
  const std::size_t begin = block * kBlock;
  const std::size_t count = std::min(m_size - begin, kBlock);
  const float* const minima = m_bounds.data() + begin;
  const float* const maxima = minima + 3 * m_room;
  std::uint64_t found = 0;
  for (std::size_t i = 0; i < count; i += kBits) {
    FourBits some{};
    FourBits bits{1, 2, 4, 8};
    const std::size_t end = std::min(i + kBits, count);
    for (std::size_t at = i; at < end; at += kLanes, bits <<= kLanes) {
      FourBits overlap = bits;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        overlap &= load(minima + axis * m_room + at) <= all(box[3 + axis]);
        overlap &= load(maxima + axis * m_room + at) >= all(box[axis]);
      }
      some |= overlap;
    }
    found |= std::uint64_t{static_cast<std::uint32_t>(some[0] | some[1] | some[2] | some[3])} << i;
  }
  return count == kBlock ? found : found & ((std::uint64_t{1} << count) - 1);
}

BoxId RoundedBoxes::nearest(const Row& box, BoxId except) const {
  // Numbers that are not negative are in the order of their bits: with its number in place of its last bits the square
  // of a distance needs one comparison, and no branch.
  if (m_size > kMostForNearest) return kNoBox;
  std::int32_t numbers = 1;
  while (static_cast<std::size_t>(numbers) + 1 < m_size) numbers = 2 * numbers + 1;
  FourBits number{0, 1, 2, 3};
  const auto other = static_cast<std::int32_t>(except);
  const FourBits others{other, other, other, other};
  Four least = all(kInfinity);
  for (std::size_t at = 0; at < m_size; at += kLanes, number += static_cast<std::int32_t>(kLanes)) {
    Four square{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Four below = load(m_bounds.data() + axis * m_room + at) - all(box[3 + axis]);
      const Four above = all(box[axis]) - load(m_bounds.data() + (3 + axis) * m_room + at);
      const Four apart = below > above ? below : above;
      const Four gap = apart > Four{} ? apart : Four{};
      square += gap * gap;
    }
    // With other last bits, infinity is a NaN, which is never less; with all bits, any number is. An empty box, as are
    // those behind the last one, may have a gap of 0 to a box that is infinite.
    const FourBits isEmpty = load(m_bounds.data() + at) > load(m_bounds.data() + 3 * m_room + at);
    const auto key = as<Four>((as<FourBits>(square) & ~numbers) | number | FourBits(number == others) | isEmpty);
    least = key < least ? key : least;
  }
  const auto keys = as<FourBits>(least);
  const std::int32_t key = std::min(std::min(keys[0], keys[1]), std::min(keys[2], keys[3]));
  return key == as<FourBits>(all(kInfinity))[0] ? kNoBox : static_cast<BoxId>(key & numbers);
}

}  // namespace allpairs
