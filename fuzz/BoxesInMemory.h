// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "Choices.h"
#include "allpairs/BoxView.h"

namespace allpairs::fuzz {

/// Boxes as numbers of one type in one of the layouts that a BoxView can view.
template <class T>
class BoxesInMemory {
 public:
  static constexpr std::size_t kLayouts = 5;

  BoxesInMemory(const std::vector<Box>& boxes, std::size_t layout) : m_boxes(boxes), m_layout(layout) {}

  /// A view of the numbers, valid as long as this is.
  BoxView view() {
    const auto n = static_cast<std::ptrdiff_t>(m_boxes.size());
    switch (m_layout) {
      case 0:
        return viewOfBoxes();
      case 1:
        write(0, 6, 1, 3);
        return BoxView::fromRows(std::span<const T>(m_numbers));
      case 2:
        write(0, 3, 1, 3 * n);
        return BoxView::fromCorners(std::span<const T>(m_numbers).first(m_boxes.size() * 3),
                                    std::span<const T>(m_numbers).subspan(m_boxes.size() * 3));
      case 3:  // six columns
        return strided(0, 1, n, 3 * n);
      default:  // from the last row to the first, each with its numbers backwards
        return strided(6 * n - 1, -6, -1, -3);
    }
  }

 private:
  BoxView viewOfBoxes() {
    for (const Box& box : m_boxes) {
      BasicBox<T>& copy = m_copies.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        copy.min[axis] = static_cast<T>(box.min[axis]);
        copy.max[axis] = static_cast<T>(box.max[axis]);
      }
    }
    return {m_copies};
  }

  /// Puts min of box i, axis a at start + i * boxStride + a * axisStride, and max `toMax` further.
  void write(std::ptrdiff_t start, std::ptrdiff_t boxStride, std::ptrdiff_t axisStride, std::ptrdiff_t toMax) {
    m_numbers.assign(m_boxes.size() * 6, T{});
    for (std::size_t i = 0; i < m_boxes.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at =
            start + static_cast<std::ptrdiff_t>(i) * boxStride + static_cast<std::ptrdiff_t>(axis) * axisStride;
        m_numbers.at(static_cast<std::size_t>(at)) = static_cast<T>(m_boxes[i].min[axis]);
        m_numbers.at(static_cast<std::size_t>(at + toMax)) = static_cast<T>(m_boxes[i].max[axis]);
      }
    }
  }

  BoxView strided(std::ptrdiff_t start, std::ptrdiff_t boxStride, std::ptrdiff_t axisStride, std::ptrdiff_t toMax) {
    write(start, boxStride, axisStride, toMax);
    if (m_boxes.empty()) return BoxView::fromRows(std::span<const T>());
    const T* first = m_numbers.data() + start;
    return BoxView::fromStrided(m_boxes.size(), CornerView<T>{first, boxStride, axisStride},
                                CornerView<T>{first + toMax, boxStride, axisStride});
  }

  std::vector<Box> m_boxes;
  std::size_t m_layout;
  std::vector<T> m_numbers;
  std::vector<BasicBox<T>> m_copies;
};

}  // namespace allpairs::fuzz
