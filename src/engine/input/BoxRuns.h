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

/// Whether boxes of this precision lie one after the other, as rows of six or of three.
template <class T>
[[nodiscard]] bool areRun(const BoxView& boxes) noexcept {
  const auto isRow = [](const CornerView<T>& corner) { return corner.boxStride == 3 && corner.axisStride == 1; };
  if (boxes.isFloat64() != std::is_same_v<T, double>) return false;
  const BoxView::Corners<T>& corners = cornersOf<T>(boxes);
  return corners.isPacked() || (isRow(corners.min) && isRow(corners.max));
}

/// Those boxes.
template <class T>
[[nodiscard]] BoxRun<T> runOf(const BoxView& boxes) noexcept {
  const BoxView::Corners<T>& corners = cornersOf<T>(boxes);
  return {corners.min.data, corners.max.data, static_cast<std::size_t>(corners.min.boxStride), boxes.size()};
}

}  // namespace allpairs::engine
