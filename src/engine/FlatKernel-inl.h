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

/// A row is dense if one of so many columns is a hit.
constexpr std::size_t kDenseRow = 3;

/// The columns that a row is tested against.
struct Range {
  std::size_t begin;
  std::size_t end;

  [[nodiscard]] HWY_INLINE std::size_t size() const { return end - std::min(begin, end); }
};

HWY_INLINE Range columnsOf(const FlatSearch& search, std::size_t row) {
  return {search.tested == Columns::Following ? row + 1 : 0,
          search.tested == Columns::Preceding ? row : search.columns.size};
}

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

/// Takes the hits of one row as pairs, to where they stay.
struct PairWriter {
  std::uint32_t* to;
  hn::Vec<IdTag> rowIds;
  bool rowSecond;
  std::size_t size = 0;

  HWY_INLINE void take(FloatMask mask, const std::uint32_t* ids) {
    const IdTag d;
    auto partners = hn::LoadU(d, ids);
    if (!hn::AllTrue(FloatTag(), mask)) partners = hn::Compress(partners, hn::RebindMask(d, mask));
    if (rowSecond) {
      hn::StoreInterleaved2(partners, rowIds, d, to + 2 * size);
    } else {
      hn::StoreInterleaved2(rowIds, partners, d, to + 2 * size);
    }
    size += hn::CountTrue(FloatTag(), mask);
  }
};

/// One row whose pairs are expected to be many; returns how many there are.
HWY_INLINE std::size_t writeRow(const FlatSearch& search, std::size_t row, std::size_t begin, std::size_t end,
                                Hits& hits) {
  constexpr std::size_t kTile = LaneTile::kCapacity;
  const Query q = spread(search.rows.get(row));
  Pair* pairs = hits.roomForPairs(hits.receiver, hits, end - begin);
  PairWriter writer{reinterpret_cast<std::uint32_t*>(pairs), hn::Set(IdTag(), search.rows.id(row)), hits.rowSecond};
  while (begin < end) {
    const std::size_t first = begin / kTile * kTile;
    const std::size_t stop = std::min(end, first + kTile);
    takeRow<Density::Dense>(q, search.columns.tileOf(begin), begin - first, stop - first, writer);
    begin = stop;
  }
  hits.takePairs(hits.receiver, writer.size);
  return writer.size;
}

/// Rows of which most columns are hits: their pairs are written at once. Returns where rows are no longer like that.
std::size_t writeRows(const FlatSearch& search, std::size_t row, Hits& hits) {
  for (bool dense = true; dense && row < search.rowEnd; ++row) {
    const Range columns = columnsOf(search, row);
    dense = columns.size() != 0 && kDenseRow * writeRow(search, row, columns.begin, columns.end, hits) > columns.size();
    hits.boxTests += columns.size();
  }
  return row;
}

template <Density kDensity, class Taker>
void searchRows(const FlatSearch& search, Hits& hits) {
  for (std::size_t row = search.rowBegin; row < search.rowEnd; ++row) {
    const Range columns = columnsOf(search, row);
    const std::size_t size = hits.size;
    searchRow<kDensity, Taker>(search, row, columns.begin, columns.end, hits);
    hits.boxTests += columns.size();
    if (hits.roomForPairs != nullptr && hits.size > size + kDenseColumns / kDenseRow &&
        kDenseRow * (hits.size - size) > columns.size()) {
      row = writeRows(search, row + 1, hits) - 1;
    }
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
