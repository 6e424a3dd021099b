// SPDX-License-Identifier: MIT
#include "input/BoxReader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace allpairs::engine {
namespace {

/// Reads a box of float32 without margins: the lanes are the box, except that infinity becomes the largest finite
/// number. Returns, like the others, whether the lanes are exactly the box.
bool readPlain(const BoxView& boxes, std::size_t i, LaneBox& lanes) noexcept {
  const auto& [min, max] = boxes.float32();
  bool exact = true;
  const auto row = static_cast<std::ptrdiff_t>(i);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::ptrdiff_t>(axis);
    const float lo = min.data[row * min.boxStride + k * min.axisStride];
    const float hi = max.data[row * max.boxStride + k * max.axisStride];
    lanes.bound[axis] = std::clamp(lo, -kLaneMax, kLaneMax);
    lanes.bound[axis + 3] = std::clamp(hi, -kLaneMax, kLaneMax);
    exact &= (lanes.bound[axis] == lo) & (lanes.bound[axis + 3] == hi);
  }
  return exact;
}

Box relativeTo(const std::array<double, 3>& origin, Box box) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] -= origin[axis];
    box.max[axis] -= origin[axis];
  }
  return box;
}

/// A box without margins, rounded outward.
bool readRounded(const Box& box, LaneBox& lanes) noexcept {
  bool exact = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lanes.bound[axis] = roundDown(box.min[axis]);
    lanes.bound[axis + 3] = roundUp(box.max[axis]);
    exact &= (static_cast<double>(lanes.bound[axis]) == box.min[axis]) &
             (static_cast<double>(lanes.bound[axis + 3]) == box.max[axis]);
  }
  return exact;
}

/// A box with a margin or a distance, in double, with a slack that is larger than what all roundings of the exact
/// expression, max + ((distance + margin) + margin), can add up to.
bool readWidened(const BoxView& boxes, double distance, const std::array<double, 3>& origin, std::size_t i,
                 LaneBox& lanes) noexcept {
  constexpr double kSlack = 0x1p-48;  // Sixteen units in the last place of a double.
  const Box box = boxes[i];
  const double margin = boxes.margin(i);
  const double half = 0.5 * distance + margin;
  const double magnitude = 0.5 * std::abs(distance) + std::abs(margin);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double min = box.min[axis] - half - kSlack * (std::abs(box.min[axis]) + magnitude);
    const double max = box.max[axis] + half + kSlack * (std::abs(box.max[axis]) + magnitude);
    const float low = roundDown(min - origin[axis]);
    const float high = roundUp(max - origin[axis]);
    // A negative margin may invert a box, which can still overlap a larger one. Swapping its bounds makes it no
    // smaller.
    lanes.bound[axis] = std::min(low, high);
    lanes.bound[axis + 3] = std::max(low, high);
  }
  return false;
}

}  // namespace

BoxReader::BoxReader(const BoxView& boxes, const OverlapOptions& options, const Kernels& kernels)
    : m_boxes(&boxes),
      m_size(boxes.size()),
      m_kernels(&kernels),
      m_distance(options.distance),
      m_region(options.region) {
  if (m_distance != 0.0 || boxes.hasMargins() || m_region) return;
  // Kernels take offsets of 32 bits, six values a box.
  if (boxes.size() > std::numeric_limits<std::int32_t>::max() / 6) return;
  if (boxes.isFloat64()) {
    if (boxes.float64().isPacked()) m_rows64 = boxes.float64().min.data;
  } else if (boxes.float32().isPacked()) {
    m_rows32 = boxes.float32().min.data;
  }
}

void BoxReader::setOrigin(const std::array<double, 3>& origin) noexcept {
  m_origin = origin;
  m_isMoved = origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0;
  if (m_isMoved) m_rows32 = nullptr;
}

BlockRead BoxReader::read(const BoxList& boxes, LaneBlock& block) const {
  BlockRead result = readListed(boxes, block);
  result.exact &= !m_isMoved;
  return result;
}

BlockRead BoxReader::readListed(const BoxList& boxes, LaneBlock& block) const {
  if (m_ids == nullptr) return readBoxes(boxes, block);
  if (boxes.ids == nullptr) return readBoxes({m_ids + boxes.begin, 0, boxes.size}, block);
  std::array<std::uint32_t, kFanOut> ids;
  for (std::size_t lane = 0; lane < boxes.size; ++lane) ids[lane] = m_ids[boxes[lane]];
  return readBoxes({ids.data(), 0, boxes.size}, block);
}

BlockRead BoxReader::readBoxes(const BoxList& boxes, LaneBlock& block) const {
  if ((m_rows32 != nullptr || m_rows64 != nullptr) && boxes.size != 0) {
    return boxes.size == kFanOut ? readRows(boxes, block) : readFewRows(boxes, block);
  }
  const BoxView& set = *m_boxes;
  if (m_distance != 0.0 || set.hasMargins()) {
    return readEach(
        boxes, [&](std::size_t i, LaneBox& lanes) { return readWidened(set, m_distance, m_origin, i, lanes); }, block);
  }
  if (set.isFloat64() || m_isMoved) {
    return readEach(
        boxes, [&](std::size_t i, LaneBox& lanes) { return readRounded(relativeTo(m_origin, set[i]), lanes); }, block);
  }
  return readEach(
      boxes, [&](std::size_t i, LaneBox& lanes) { return readPlain(set, i, lanes); }, block);
}

BlockRead BoxReader::readRows(const BoxList& boxes, LaneBlock& block) const {
  if (boxes.size == kFanOut && boxes.ids == nullptr && m_rows32 != nullptr) {
    return m_kernels->readRun32(m_rows32 + 6 * boxes.begin, block);
  }
  std::array<std::int32_t, kFanOut> offsets;
  for (std::size_t lane = 0; lane < kFanOut; ++lane) {
    offsets[lane] = static_cast<std::int32_t>(6 * boxes[std::min(lane, boxes.size - 1)]);
  }
  return m_rows32 != nullptr ? m_kernels->readFloat32(m_rows32, offsets.data(), block)
                             : m_kernels->readFloat64(m_rows64, offsets.data(), m_origin, block);
}

/// Fewer than sixteen: the kernels read the last one again for each that is missing.
BlockRead BoxReader::readFewRows(const BoxList& boxes, LaneBlock& block) const {
  LaneBlock all;
  BlockRead result = readRows(boxes, all);
  for (std::size_t row = 0; row < 6; ++row) std::copy_n(all.bound[row].data(), boxes.size, block.bound[row].data());
  result.emptyLanes &= (1U << boxes.size) - 1U;
  return result;
}

template <class LanesOf>
BlockRead BoxReader::readEach(const BoxList& boxes, const LanesOf& lanesOf, LaneBlock& block) const {
  BlockRead result;
  LaneBox lanes;
  for (std::size_t lane = 0; lane < boxes.size; ++lane) {
    const std::size_t i = boxes[lane];
    const bool exact = lanesOf(i, lanes);
    block.set(lane, lanes);
    const Box box = (*m_boxes)[i];
    if (isEmpty(box) || (m_region && !overlap(box, *m_region, m_distance + m_boxes->margin(i)))) {
      result.emptyLanes |= std::uint32_t{1} << lane;
    } else {
      result.exact &= exact;
    }
  }
  return result;
}

}  // namespace allpairs::engine
