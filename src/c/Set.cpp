// SPDX-License-Identifier: MIT
#include <cstdint>
#include <limits>

#include "Handles.h"

namespace allpairs::c {
namespace {

/// Makes a handle of what `make` gives.
template <class Make>
allpairs_status createSet(allpairs_set** set, const Make& make) noexcept {
  return guarded([&] {
    allpairs_set*& result = required(set, "set");
    result = std::make_unique<allpairs_set>(allpairs_set{make()}).release();
  });
}

template <class T>
BoxView rowsOf(const T* rows, std::size_t count) {
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max();  // keeps the product below from wrapping too
  if (count > kMost)
    throw InvalidArgument("a set of " + std::to_string(count) + " boxes; at most 4294967295 can be numbered");
  return BoxView::fromRows(requiredSpan(rows, 6 * count, "rows"));
}

template <class T, class Corner>
BoxView stridedOf(std::size_t count, const Corner& min, const Corner& max) {
  if (count != 0) {
    static_cast<void>(required(min.data, "min.data"));
    static_cast<void>(required(max.data, "max.data"));
  }
  return BoxView::fromStrided(count, CornerView<T>{min.data, min.box_stride, min.axis_stride},
                              CornerView<T>{max.data, max.box_stride, max.axis_stride});
}

}  // namespace
}  // namespace allpairs::c

// NOLINTBEGIN(readability-identifier-naming): names are C's.
using namespace allpairs::c;

allpairs_status allpairs_set_create_f32(const float* rows, size_t count, allpairs_set** set) {
  return createSet(set, [&] { return rowsOf(rows, count); });
}

allpairs_status allpairs_set_create_f64(const double* rows, size_t count, allpairs_set** set) {
  return createSet(set, [&] { return rowsOf(rows, count); });
}

allpairs_status allpairs_set_create_strided_f32(size_t count, allpairs_corner_f32 min, allpairs_corner_f32 max,
                                                allpairs_set** set) {
  return createSet(set, [&] { return stridedOf<float>(count, min, max); });
}

allpairs_status allpairs_set_create_strided_f64(size_t count, allpairs_corner_f64 min, allpairs_corner_f64 max,
                                                allpairs_set** set) {
  return createSet(set, [&] { return stridedOf<double>(count, min, max); });
}

void allpairs_set_destroy(allpairs_set* set) { delete set; }  // NOLINT(cppcoreguidelines-owning-memory): C's handle

size_t allpairs_set_size(const allpairs_set* set) { return set == nullptr ? 0 : set->boxes.size(); }

allpairs_status allpairs_set_margin(allpairs_set* set, double margin) {
  return guarded([&] { required(set, "set").boxes.setMargin(margin); });
}

allpairs_status allpairs_set_margins(allpairs_set* set, const double* margins) {
  return guarded([&] {
    allpairs::BoxView& boxes = required(set, "set").boxes;
    boxes.setMargins({margins, margins == nullptr ? 0 : boxes.size()});
  });
}

// NOLINTEND(readability-identifier-naming)
