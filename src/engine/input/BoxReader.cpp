// SPDX-License-Identifier: MIT
#include "input/BoxReader.h"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>

namespace allpairs::engine {
namespace {

/// Whether the distance in memory from the first box to any other is an offset that the kernels take, of 32 bits.
template <class T>
bool areInPlace(const BoxView::Corners<T>& corners, std::size_t size) noexcept {
  const std::ptrdiff_t stride = corners.min.boxStride;
  const std::uint64_t step = stride < 0 ? 0U - static_cast<std::uint64_t>(stride) : static_cast<std::uint64_t>(stride);
  return stride == corners.max.boxStride &&
         step <= std::numeric_limits<std::int32_t>::max() / std::max<std::size_t>(size, 1);
}

/// Where the boxes of a list are; of fewer than sixteen the last one is read again for each that is missing.
template <class T>
BoxPlaces<T> placesOf(const BoxView::Corners<T>& corners, const BoxList& boxes) noexcept {
  BoxPlaces<T> places;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::ptrdiff_t>(axis);
    places.bound[axis] = corners.min.data + k * corners.min.axisStride;
    places.bound[axis + 3] = corners.max.data + k * corners.max.axisStride;
  }
  const auto stride = static_cast<std::int32_t>(corners.min.boxStride);
  for (std::size_t lane = 0; lane < kFanOut; ++lane) {
    places.offset[lane] = stride * static_cast<std::int32_t>(boxes[std::min(lane, boxes.size - 1)]);
  }
  return places;
}

/// The same as rows of six, which the kernels can read wherever the boxes are.
template <class T>
std::array<std::array<T, 6>, kFanOut> copyOf(const BoxView::Corners<T>& corners, const BoxList& boxes) noexcept {
  std::array<std::array<T, 6>, kFanOut> rows;
  for (std::size_t lane = 0; lane < boxes.size; ++lane) {
    const auto i = static_cast<std::ptrdiff_t>(boxes[lane]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::ptrdiff_t>(axis);
      rows[lane][axis] = corners.min.data[i * corners.min.boxStride + k * corners.min.axisStride];
      rows[lane][axis + 3] = corners.max.data[i * corners.max.boxStride + k * corners.max.axisStride];
    }
  }
  return rows;
}

}  // namespace

BoxReader::BoxReader(const BoxView& boxes, const OverlapOptions& options, const Kernels& kernels)
    : m_boxes(&boxes),
      m_size(boxes.size()),
      m_kernels(&kernels),
      m_distance(options.distance),
      m_region(options.region),
      m_isInPlace(boxes.isFloat64() ? areInPlace(boxes.float64(), m_size) : areInPlace(boxes.float32(), m_size)) {
  m_widening.widens = m_distance != 0.0 || boxes.hasMargins();
  m_widening.half = 0.5 * m_distance;
  const bool areBounds = !boxes.isFloat64() && !m_widening.widens;
  if (areBounds && m_isInPlace && boxes.float32().isPacked()) m_run = boxes.float32().min.data;
}

void BoxReader::setOrigin(const std::array<double, 3>& origin) noexcept {
  m_widening.origin = origin;
  m_isMoved = origin[0] != 0.0 || origin[1] != 0.0 || origin[2] != 0.0;
  if (m_isMoved) m_run = nullptr;
}

BlockRead BoxReader::read(const BoxList& boxes, LaneBlock& block) const {
  if (boxes.size == 0) return {};
  if (m_ids == nullptr) return readBoxes(boxes, block);
  if (boxes.ids == nullptr) return readBoxes({m_ids + boxes.begin, 0, boxes.size}, block);
  std::array<std::uint32_t, kFanOut> ids;
  for (std::size_t lane = 0; lane < boxes.size; ++lane) ids[lane] = m_ids[boxes[lane]];
  return readBoxes({ids.data(), 0, boxes.size}, block);
}

bool BoxReader::readAll(const LaneList& list) const {
  bool exact = true;
  const BoxList all{nullptr, 0, m_size};
  for (std::size_t begin = 0; begin < m_size; begin += kFanOut) {
    const BoxList boxes = all.part(begin, kFanOut);
    LaneBlock block;
    const BlockRead result = read(boxes, block);
    exact &= result.exact;
    LaneTile& tile = list.tileOf(begin);
    const std::size_t place = begin % LaneTile::kCapacity;
    block.clear(result.emptyLanes);
    for (std::size_t row = 0; row < 6; ++row) std::copy_n(block.bound[row].data(), kFanOut, &tile.bound[row][place]);
    for (std::size_t lane = 0; lane < boxes.size; ++lane) tile.id[place + lane] = idOf(boxes[lane]);
  }
  return exact;
}

BlockRead BoxReader::readBoxes(const BoxList& boxes, LaneBlock& block) const {
  LaneBlock all;
  LaneBlock& target = boxes.size == kFanOut ? block : all;
  BlockRead result;
  if (m_run != nullptr && boxes.ids == nullptr && boxes.size == kFanOut) {
    result = m_kernels->readRun32(m_run + 6 * boxes.begin, block);
  } else {
    result = m_boxes->isFloat64() ? readSixteen(m_boxes->float64(), boxes, target)
                                  : readSixteen(m_boxes->float32(), boxes, target);
  }
  if (boxes.size < kFanOut) {
    for (std::size_t row = 0; row < 6; ++row) std::copy_n(all.bound[row].data(), boxes.size, block.bound[row].data());
    result.emptyLanes &= (1U << boxes.size) - 1U;
  }
  if (m_region) result.emptyLanes |= outsideRegion(boxes);
  result.exact &= !m_isMoved;
  return result;
}

template <class T>
BlockRead BoxReader::readSixteen(const BoxView::Corners<T>& corners, const BoxList& boxes, LaneBlock& block) const {
  if (m_isInPlace) return callKernel(placesOf(corners, boxes), boxes, block);
  const auto rows = copyOf(corners, boxes);
  const T* const first = rows.front().data();
  const BoxList all{nullptr, 0, boxes.size};
  return callKernel(placesOf<T>({{first, 6, 1}, {first + 3, 6, 1}}, all), boxes, block);
}

template <class T>
BlockRead BoxReader::callKernel(const BoxPlaces<T>& places, const BoxList& boxes, LaneBlock& block) const {
  if constexpr (std::is_same_v<T, float>) {
    if (!m_widening.widens && !m_isMoved) return m_kernels->readFloat32(places, block);
  }
  Widening widening = m_widening;
  std::array<double, kFanOut> margins;
  if (m_boxes->hasMargins()) {
    for (std::size_t lane = 0; lane < kFanOut; ++lane) {
      margins[lane] = m_boxes->margin(boxes[std::min(lane, boxes.size - 1)]);
    }
    widening.margins = margins.data();
  }
  if constexpr (std::is_same_v<T, float>) {
    return m_kernels->readWide32(places, widening, block);
  } else {
    return m_kernels->readWide64(places, widening, block);
  }
}

std::uint32_t BoxReader::outsideRegion(const BoxList& boxes) const {
  std::uint32_t bits = 0;
  for (std::size_t lane = 0; lane < boxes.size; ++lane) {
    const std::size_t i = boxes[lane];
    if (!overlap((*m_boxes)[i], *m_region, m_distance + m_boxes->margin(i))) bits |= std::uint32_t{1} << lane;
  }
  return bits;
}

bool BoxReader::areAll(std::size_t axis, double point) const noexcept {
  const auto areAt = [&](const auto& corners) {
    using Number = std::remove_cv_t<std::remove_pointer_t<decltype(corners.min.data)>>;
    const auto* const min = corners.min.data + static_cast<std::ptrdiff_t>(axis) * corners.min.axisStride;
    const auto* const max = corners.max.data + static_cast<std::ptrdiff_t>(axis) * corners.max.axisStride;
    const auto isPoint = [point](Number value) { return static_cast<double>(value) == point; };
    for (std::size_t i = 0; i < m_size; ++i) {
      const auto row = static_cast<std::ptrdiff_t>(idOf(i));
      if (!isPoint(min[row * corners.min.boxStride]) || !isPoint(max[row * corners.max.boxStride])) return false;
    }
    return true;
  };
  return m_boxes->isFloat64() ? areAt(m_boxes->float64()) : areAt(m_boxes->float32());
}

}  // namespace allpairs::engine
