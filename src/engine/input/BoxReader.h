// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "allpairs/Box.h"
#include "allpairs/BoxView.h"
#include "allpairs/OverlapOptions.h"
#include "kernels/Kernels.h"
#include "kernels/Lanes.h"
#include "memory/Platform.h"

namespace allpairs::engine {

/// Some boxes of a set: those with the ids, or a run from `begin` on.
struct BoxList {
  const std::uint32_t* ids = nullptr;
  std::size_t begin = 0;
  std::size_t size = 0;

  [[nodiscard]] std::uint32_t operator[](std::size_t i) const noexcept {
    return ids != nullptr ? ids[i] : static_cast<std::uint32_t>(begin + i);
  }

  /// From position `first` on, at most as many as requested.
  [[nodiscard]] BoxList part(std::size_t first, std::size_t most) const noexcept {
    return {ids != nullptr ? ids + first : nullptr, begin + first, std::min(most, size - first)};
  }
};

/// Prefetches the memory of a box; of one in columns that of two of its six bounds.
inline void prefetchBox(const BoxView& boxes, std::uint32_t id) noexcept {
  const auto row = static_cast<std::ptrdiff_t>(id);
  const auto ask = [&](const auto& corners) {
    prefetchLine(corners.min.data + row * corners.min.boxStride);
    prefetchLine(corners.max.data + row * corners.max.boxStride + 2 * corners.max.axisStride);
  };
  boxes.isFloat64() ? ask(boxes.float64()) : ask(boxes.float32());
}

/// Reads the boxes of a set as float32 lanes that are never smaller than the boxes, with half the distance of the
/// search and the box's own margin added on each side; or where nothing is added as the nearest float32.
///
/// Reports boxes that can overlap nothing, because they are empty or outside the region.
class BoxReader {
 public:
  BoxReader(const BoxView& boxes, const OverlapOptions& options, const Kernels& kernels);

  /// From now on box i is the one of the set with the id ids[i]. The memory stays the caller's.
  void restrictTo(std::span<const std::uint32_t> ids) noexcept {
    m_ids = ids.data();
    m_size = ids.size();
  }

  /// From now on lanes are relative to a point: the farther from the origin float64 boxes are, the coarser their lanes.
  /// Boxes that are compared need the same one. Rounded lanes keep the order of what they were rounded from.
  void setOrigin(const std::array<double, 3>& origin) noexcept;

  [[nodiscard]] const std::array<double, 3>& origin() const noexcept { return m_widening.origin; }

  /// Whether a distance or margins are added to bounds.
  [[nodiscard]] bool widens() const noexcept { return m_widening.widens; }

  /// From now on lanes are the nearest float32, so that which of them overlap for certain takes less time to tell. They
  /// may be smaller than the boxes, but keep the order of all bounds, those of the other set too, if it has such lanes.
  void roundToNearest() noexcept { m_widening.toNearest = true; }
  [[nodiscard]] bool roundsToNearest() const noexcept { return m_widening.toNearest; }

  [[nodiscard]] std::size_t size() const noexcept { return m_size; }
  [[nodiscard]] std::uint32_t idOf(std::size_t i) const noexcept {
    return m_ids != nullptr ? m_ids[i] : static_cast<std::uint32_t>(i);
  }
  [[nodiscard]] const BoxView& boxes() const noexcept { return *m_boxes; }

  /// Whether these are all boxes of a set, and their own bounds decide.
  [[nodiscard]] bool areAllByBounds() const noexcept { return m_ids == nullptr && !widens(); }

  /// Whether all boxes are one point on an axis, empty ones too.
  [[nodiscard]] bool areAll(std::size_t axis, double point) const noexcept;

  [[nodiscard]] const Kernels& kernels() const noexcept { return *m_kernels; }

  /// Reads up to sixteen boxes into the first lanes of a block; the others stay as they are.
  BlockRead read(const BoxList& boxes, LaneBlock& block) const;

  /// Reads all boxes, in their order, into a list that is as long, with their ids; boxes that can overlap nothing
  /// become lanes that never overlap. Returns whether the lanes are exactly the boxes.
  bool readAll(const LaneList& list) const;

  /// Prefetches the memory of box i.
  void prefetch(std::size_t i) const noexcept { prefetchBox(*m_boxes, idOf(i)); }

 private:
  BlockRead readBoxes(const BoxList& boxes, LaneBlock& block) const;
  template <class T>
  BlockRead readSixteen(const BoxView::Corners<T>& corners, const BoxList& boxes, LaneBlock& block) const;
  template <class T>
  BlockRead callKernel(const BoxPlaces<T>& places, const BoxList& boxes, LaneBlock& block) const;
  [[nodiscard]] std::uint32_t outsideRegion(const BoxList& boxes) const;

  const BoxView* m_boxes;
  std::size_t m_size;
  const std::uint32_t* m_ids = nullptr;  ///< Of the boxes that the reader is restricted to.
  const Kernels* m_kernels;
  double m_distance;
  std::optional<Box> m_region;
  Widening m_widening;
  bool m_isMoved = false;        ///< The origin is not zero.
  bool m_isInPlace = false;      ///< The kernels can read the boxes where they are.
  const float* m_run = nullptr;  ///< Rows of six whose lanes are their bounds.
};

}  // namespace allpairs::engine
