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

/// Up to this many columns a branch around vectors without hits costs more than it saves.
constexpr std::size_t kDenseColumns = 512;

/// One row against the columns [begin, end), tile by tile.
template <Density kDensity, class Taker>
HWY_INLINE void searchRow(const FlatSearch& search, std::size_t row, std::size_t begin, std::size_t end, Hits& hits) {
  constexpr std::size_t kTile = LaneTile::kCapacity;
  const Query q = spread(search.rows.get(row));
  const std::uint32_t id = search.rows.id(row);
  while (begin < end) {
    const std::size_t first = begin / kTile * kTile;
    const std::size_t stop = std::min(end, first + kTile);
    if (!hits.countOnly) hits.require(kTile);
    Taker taker(hits, id);
    takeRow<kDensity>(q, search.columns.tileOf(begin), begin - first, stop - first, taker);
    taker.finish();
    begin = stop;
  }
}

template <Density kDensity, class Taker>
void searchRows(const FlatSearch& search, Hits& hits) {
  for (std::size_t row = search.rowBegin; row < search.rowEnd; ++row) {
    const std::size_t begin = search.tested == Columns::Following ? row + 1 : 0;
    const std::size_t end = search.tested == Columns::Preceding ? row : search.columns.size;
    searchRow<kDensity, Taker>(search, row, begin, end, hits);
    hits.boxTests += end - std::min(begin, end);
  }
}

void searchFlat(const FlatSearch& search, Hits& hits) {
  // Few boxes overlap a larger share of each other, unless their volume shrinks as their number grows.
  const bool dense = search.columns.size <= kDenseColumns;
  if (hits.countOnly) {
    dense ? searchRows<Density::Dense, HitCounter>(search, hits)
          : searchRows<Density::Sparse, HitCounter>(search, hits);
  } else {
    dense ? searchRows<Density::Dense, HitWriter>(search, hits) : searchRows<Density::Sparse, HitWriter>(search, hits);
  }
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_FLAT_KERNEL_INL_H
