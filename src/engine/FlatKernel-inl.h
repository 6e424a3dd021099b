// SPDX-License-Identifier: MIT
// The exhaustive search: every row against its columns.

#if defined(ALLPAIRS_FLAT_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_FLAT_KERNEL_INL_H
#undef ALLPAIRS_FLAT_KERNEL_INL_H
#else
#define ALLPAIRS_FLAT_KERNEL_INL_H
#endif

#include <algorithm>

#include "FlatSearch.h"
#include "RowKernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// One row against the columns [begin, end), in stretches that the buffer of hits has room for.
template <class Taker>
HWY_INLINE void searchRow(const FlatSearch& search, std::size_t row, std::size_t begin, std::size_t end, Hits& hits) {
  const Query q = spread(search.rows.get(row));
  while (begin < end) {
    const std::size_t stop = std::min(end, begin + hits.capacity);
    if (!hits.countOnly) hits.require(stop - begin);
    Taker taker(hits, search.rows.id[row]);
    takeRow(q, search.columns, begin, stop, taker);
    taker.finish();
    begin = stop;
  }
}

template <class Taker>
void searchRows(const FlatSearch& search, Hits& hits) {
  for (std::size_t row = search.rowBegin; row < search.rowEnd; ++row) {
    const std::size_t begin = search.tested == Columns::Following ? row + 1 : 0;
    const std::size_t end = search.tested == Columns::Preceding ? row : search.columns.size;
    searchRow<Taker>(search, row, begin, end, hits);
    hits.boxTests += end - std::min(begin, end);
  }
}

void searchFlat(const FlatSearch& search, Hits& hits) {
  if (hits.countOnly) {
    searchRows<HitCounter>(search, hits);
  } else {
    searchRows<HitWriter>(search, hits);
  }
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_FLAT_KERNEL_INL_H
