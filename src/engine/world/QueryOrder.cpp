// SPDX-License-Identifier: MIT
#include "world/QueryOrder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bvh/CurveKey.h"
#include "bvh/RadixSort.h"
#include "kernels/Lanes.h"

namespace allpairs::engine {
namespace {

/// Fewer queries are answered in the given order.
constexpr std::size_t kFewQueries = 64;

constexpr unsigned kBitsPerAxis = 9;

/// Spreads nine bits so that each is followed by two others.
std::uint32_t spreadBits(std::uint32_t bits) noexcept {
  bits = (bits | bits << 16U) & 0x030000FFU;
  bits = (bits | bits << 8U) & 0x0300F00FU;
  bits = (bits | bits << 4U) & 0x030C30C3U;
  return (bits | bits << 2U) & 0x09249249U;
}

/// The beginning of the cells of one axis, and their number per unit.
std::pair<float, float> cellsOf(std::span<const std::array<float, 3>> points, std::size_t axis) {
  float least = kNever;
  float greatest = -kNever;
  for (const auto& point : points) {
    if (!(std::abs(point[axis]) < 1e30F)) continue;
    least = std::min(least, point[axis]);
    greatest = std::max(greatest, point[axis]);
  }
  if (!(least < greatest)) return {};
  return {least, static_cast<float>(1U << kBitsPerAxis) / (greatest - least)};
}

std::uint32_t cellOf(float value, std::pair<float, float> cells) noexcept {
  const float cell = (value - cells.first) * cells.second;
  const auto last = static_cast<float>((1U << kBitsPerAxis) - 1U);
  return cell > 0.0F ? static_cast<std::uint32_t>(std::min(cell, last)) : 0U;  // a NaN is in the first
}

}  // namespace

void QueryOrder::sort(std::span<const std::array<float, 3>> points) {
  m_keys.require(points.size());
  if (points.size() < kFewQueries) {
    for (std::size_t i = 0; i < points.size(); ++i) m_keys[i] = i;
    return;
  }
  m_spare.require(points.size());
  const std::array<std::pair<float, float>, 3> cells{cellsOf(points, 0), cellsOf(points, 1), cellsOf(points, 2)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint64_t key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) key |= spreadBits(cellOf(points[i][axis], cells[axis])) << axis;
    m_spare[i] = key << kIndexBits | i;
  }
  if (radixSort(m_spare.data(), m_keys.data(), points.size(), kIndexBits, kIndexBits + 3 * kBitsPerAxis) !=
      m_keys.data()) {
    std::swap(m_spare, m_keys);
  }
}

}  // namespace allpairs::engine
