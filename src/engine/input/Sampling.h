// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "input/BoxReader.h"

namespace allpairs::engine {

/// Boxes of a sample that a choice is made by: 1,128 pairs, by which a share of a tenth is told from one of a fifth,
/// and which vectors test in less than half a microsecond.
inline constexpr std::size_t kSample = 3 * kFanOut;

/// One index from each of `count` equal parts of [0, size), of which each has at least one, at a pseudo-random but
/// fixed position.
///
/// Not equidistant: input is often periodic, and a sample with the same period would see only one kind of box.
[[nodiscard]] inline std::size_t sampleIndex(std::size_t part, std::size_t count, std::size_t size) noexcept {
  const std::size_t begin = size / count * part + std::min(part, size % count);
  const std::size_t length = size / count + (part < size % count ? 1 : 0);
  // The finaliser of splitmix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
  std::uint64_t bits = (part + 1) * 0x9E3779B97F4A7C15ULL;
  bits = (bits ^ (bits >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27U)) * 0x94D049BB133111EBULL;
  return begin + (bits ^ (bits >> 31U)) % std::max<std::size_t>(length, 1);
}

/// Calls take(lanes, index, isEmpty) for `count` boxes, of which indexOf(part) says the index.
template <class IndexOf, class Take>
void readSample(const BoxReader& reader, std::size_t count, const IndexOf& indexOf, const Take& take) {
  std::array<std::uint32_t, kFanOut> indices;
  LaneBlock block;
  for (std::size_t part = 0; part < count; part += kFanOut) {
    const std::size_t size = std::min(kFanOut, count - part);
    for (std::size_t lane = 0; lane < size; ++lane) indices[lane] = indexOf(part + lane);
    const std::uint32_t empty = reader.read({indices.data(), 0, size}, block).emptyLanes;
    for (std::size_t lane = 0; lane < size; ++lane) take(block.get(lane), indices[lane], (empty >> lane & 1U) != 0);
  }
}

/// Calls take(lanes) for about `count` boxes that may overlap something: instead of a sampled box that cannot, it takes
/// the next one that may, if there is one within a hundred.
template <class Take>
void sampleBoxes(const BoxReader& reader, std::size_t count, const Take& take) {
  const auto indexOf = [&](std::size_t part) {
    return static_cast<std::uint32_t>(sampleIndex(part, count, reader.size()));
  };
  readSample(reader, count, indexOf, [&](const LaneBox& box, std::size_t index, bool isEmpty) {
    if (!isEmpty) {
      take(box);
      return;
    }
    LaneBlock block;
    const std::size_t end = std::min(reader.size(), index + 100);
    std::size_t next = index + 1;
    while (next < end && reader.read({nullptr, next, 1}, block).emptyLanes != 0) ++next;
    if (next < end) take(block.get(0));
  });
}

}  // namespace allpairs::engine
