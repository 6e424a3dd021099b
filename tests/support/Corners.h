// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/BoxView.h"

namespace allpairs::test {

/// Boxes as two arrays, of their minima and of their maxima.
template <class T>
struct Corners {
  std::vector<T> min;
  std::vector<T> max;

  explicit Corners(const std::vector<BasicBox<T>>& boxes) {
    for (const BasicBox<T>& box : boxes) {
      min.insert(min.end(), box.min.begin(), box.min.end());
      max.insert(max.end(), box.max.begin(), box.max.end());
    }
  }

  /// Of rows of six.
  explicit Corners(const std::vector<T>& rows) {
    for (std::size_t i = 0; i < rows.size(); i += 3)
      std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(i), 3, std::back_inserter(i % 2 == 0 ? min : max));
  }

  [[nodiscard]] BoxView view() const { return BoxView::fromCorners(min, max); }
};

}  // namespace allpairs::test
