// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>

#include "allpairs/BoxView.h"
#include "kernels/Kernels.h"

namespace allpairs::engine {

template <class T>
[[nodiscard]] const BoxView::Corners<T>& cornersOf(const BoxView& boxes) noexcept {
  if constexpr (std::is_same_v<T, double>) {
    return boxes.float64();
  } else {
    return boxes.float32();
  }
}

/// Whether boxes lie one after the other, as rows of six or of three.
[[nodiscard]] inline bool isRun(const BoxView& boxes) noexcept {
  const auto isRow = [](const auto& corner) { return corner.boxStride == 3 && corner.axisStride == 1; };
  const auto areRows = [&](const auto& corners) {
    return corners.isPacked() || (isRow(corners.min) && isRow(corners.max));
  };
  return boxes.isFloat64() ? areRows(boxes.float64()) : areRows(boxes.float32());
}

/// Whether the boxes of two sets do, in the same precision.
[[nodiscard]] inline bool areRuns(const BoxView& a, const BoxView& b) noexcept {
  return a.isFloat64() == b.isFloat64() && isRun(a) && isRun(b);
}

/// Those boxes.
template <class T>
[[nodiscard]] BoxRun<T> runOf(const BoxView& boxes) noexcept {
  const BoxView::Corners<T>& corners = cornersOf<T>(boxes);
  return {corners.min.data, corners.max.data, static_cast<std::size_t>(corners.min.boxStride), boxes.size()};
}

}  // namespace allpairs::engine
