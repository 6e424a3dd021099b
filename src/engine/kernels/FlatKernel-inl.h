// SPDX-License-Identifier: MIT
// The exhaustive search: every row against its columns.

#if defined(ALLPAIRS_FLAT_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_FLAT_KERNEL_INL_H
#undef ALLPAIRS_FLAT_KERNEL_INL_H
#else
#define ALLPAIRS_FLAT_KERNEL_INL_H
#endif

#include <algorithm>
#include <array>

#include "hwy/cache_control.h"
#include "kernels/Kernels.h"
#include "kernels/RowKernel-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// Up to this many columns a branch around vectors without hits costs more than it saves (few_benchmark).
constexpr std::size_t kDenseColumns = 512;

/// A row is dense if at least one in this many columns is a hit: its pairs are written at once (allpairs bench
/// all-overlap, in which all are; uniform, in which few are).
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

/// Calls use(tile, columns of it) for each tile of some columns.
template <class Use>
HWY_INLINE void forEachTile(const LaneList& list, Range columns, const Use& use) {
  for (std::size_t begin = columns.begin; begin < columns.end;) {
    const std::size_t first = begin / LaneTile::kCapacity * LaneTile::kCapacity;
    const std::size_t stop = std::min(columns.end, first + LaneTile::kCapacity);
    use(list.tileOf(begin), Range{begin - first, stop - first});
    begin = stop;
  }
}

/// One row against the columns [begin, end) of a tile.
template <Density kDensity, class Emitter>
HWY_INLINE void searchTile(const Query& q, std::uint32_t id, const LaneTile& tile, Range columns, Hits& hits) {
  Emitter emitter = Emitter::ofRow(hits, id);
  emitRow<kDensity>(q, tile, columns.begin, columns.end, emitter);
  emitter.finish(
      hits, [&](std::size_t i) HWY_ATTR { return overlappingForCertain(q, hits.slack, vectorsAt(tile.bound, i)); });
}

/// One row against the columns [begin, end), tile by tile.
template <Density kDensity, class Emitter>
HWY_INLINE void searchRow(const FlatSearch& search, std::size_t row, std::size_t begin, std::size_t end, Hits& hits) {
  const Query q = broadcast(search.rows.get(row));
  const std::uint32_t id = search.rows.id(row);
  forEachTile(search.columns, {begin, end}, [&](const LaneTile& tile, Range columns) HWY_ATTR {
    if (!hits.countOnly) hits.require(LaneTile::kCapacity);
    searchTile<kDensity, Emitter>(q, id, tile, columns, hits);
  });
}

/// Some rows against the whole vectors of a tile within [begin, end); returns the number of hits.
HWY_INLINE std::size_t countVectors(const std::array<Query, kRowsAtOnce>& rows, const LaneTile& columns,
                                    std::size_t begin, std::size_t end) {
  const FloatTag d;
  std::size_t count = 0;
  for (std::size_t i = begin; i < end; i += hn::Lanes(d)) {
    const FloatMask m0 = overlapping(rows[0], columns.bound, i);
    const FloatMask m1 = overlapping(rows[1], columns.bound, i);
    const FloatMask m2 = overlapping(rows[2], columns.bound, i);
    const FloatMask m3 = overlapping(rows[3], columns.bound, i);
    if (hn::AllFalse(d, hn::Or(hn::Or(m0, m1), hn::Or(m2, m3)))) continue;
    count += hn::CountTrue(d, m0) + hn::CountTrue(d, m1) + hn::CountTrue(d, m2) + hn::CountTrue(d, m3);
  }
  return count;
}

/// Those rows from `row` on against columns that all of them are tested against.
void countColumns(const FlatSearch& search, std::size_t row, Range columns, Hits& hits) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  // Not filled in a loop: GCC 12 makes the constructor that a loop needs for the baseline, and refuses it on ARM.
  const std::array<Query, kRowsAtOnce> queries{broadcast(search.rows.get(row)), broadcast(search.rows.get(row + 1)),
                                               broadcast(search.rows.get(row + 2)),
                                               broadcast(search.rows.get(row + 3))};
  forEachTile(search.columns, columns, [&](const LaneTile& tile, Range part) HWY_ATTR {
    const std::size_t whole = std::min((part.begin + lanes - 1) / lanes * lanes, part.end);
    const std::size_t wholeEnd = std::max(part.end / lanes * lanes, whole);
    HitCounter counter;
    for (const Query& q : queries) {
      emitRow<Density::Dense>(q, tile, part.begin, whole, counter);
      emitRow<Density::Dense>(q, tile, wholeEnd, part.end, counter);
    }
    hits.count += counter.size;
    hits.count += countVectors(queries, tile, whole, wholeEnd);
  });
}

/// Counts several rows at a time while enough are left, and returns the first remaining one.
std::size_t countRows(const FlatSearch& search, Hits& hits) {
  std::size_t row = search.rowBegin;
  for (; row + kRowsAtOnce <= search.rowEnd; row += kRowsAtOnce) {
    const Range first = columnsOf(search, row);
    const Range last = columnsOf(search, row + kRowsAtOnce - 1);
    const Range common{std::max(first.begin, last.begin), std::min(first.end, last.end)};
    countColumns(search, row, common, hits);
    for (std::size_t r = row; r < row + kRowsAtOnce; ++r) {
      const Range columns = columnsOf(search, r);
      searchRow<Density::Dense, HitCounter>(search, r, columns.begin, std::min(columns.end, common.begin), hits);
      searchRow<Density::Dense, HitCounter>(search, r, std::max(columns.begin, common.end), columns.end, hits);
      hits.boxTests += columns.size();
    }
  }
  return row;
}

/// From this many pairs, 2 MiB, on a result exceeds the caches near a core (docs/decisions/0014, allpairs bench
/// all-overlap).
constexpr std::size_t kCachedPairs = std::size_t{1} << 18;

/// Gathers pairs into whole cache lines and writes them with streaming stores, which bypass the caches: a normal store
/// first reads the line. Lines continue across rows, since a row ends anywhere within a line.
class PairStream {
 public:
  /// Writes to `to`, which `before` pairs precede.
  HWY_INLINE void begin(Pair* to, std::size_t before) {
    if (!m_started) {
      m_started = before >= kCachedPairs;
      m_size = m_started ? before % kLinePairs : 0;
      std::copy_n(to - m_size, m_size, reinterpret_cast<Pair*>(m_pairs.data()));
    }
    m_line = reinterpret_cast<std::uint32_t*>(to - m_size);
  }

  /// The destination of the next vector of pairs.
  [[nodiscard]] HWY_INLINE std::uint32_t* next() { return (m_started ? m_pairs.data() : m_line) + 2 * m_size; }

  HWY_INLINE void add(std::size_t count) {
    m_size += count;
    if (m_started && m_size >= kBatch) flush();
  }

  /// Flushes the rest.
  HWY_INLINE void finish() {
    if (!m_started) return;
    flush();
    std::copy_n(m_pairs.data(), 2 * m_size, m_line);
    hwy::FlushStream();
  }

 private:
  static constexpr std::size_t kBatch = 256;  ///< Pairs that are gathered, so that lines are written several at a time.

  HWY_INLINE void flush() {
    const IdTag d;
    const std::size_t whole = m_size / kLinePairs * kLinePairs;
    for (std::size_t i = 0; i < 2 * whole; i += hn::Lanes(d)) hn::Stream(hn::Load(d, &m_pairs[i]), d, m_line + i);
    m_line += 2 * whole;
    m_size -= whole;
    std::copy_n(&m_pairs[2 * whole], 2 * m_size, m_pairs.data());
  }

  alignas(64) std::array<std::uint32_t, 2 * (kBatch + kVectorSlack)> m_pairs;
  std::uint32_t* m_line = nullptr;
  std::size_t m_size = 0;  // behind m_line
  bool m_started = false;
};

/// Writes the hits of one row as pairs to their final place.
struct PairWriter {
  PairStream& stream;
  hn::Vec<IdTag> rowIds;
  bool rowSecond;
  std::size_t size = 0;

  HWY_INLINE void emit(FloatMask mask, hn::Vec<IdTag> partners, std::uint32_t /*test*/) {
    const IdTag d;
    if (!hn::AllTrue(FloatTag(), mask)) partners = selectedLanes(d, partners, hn::RebindMask(d, mask));
    if (rowSecond) {
      hn::StoreInterleaved2(partners, rowIds, d, stream.next());
    } else {
      hn::StoreInterleaved2(rowIds, partners, d, stream.next());
    }
    const std::size_t count = hn::CountTrue(FloatTag(), mask);
    stream.add(count);
    size += count;
  }
};

/// The hits of a query among the columns [begin, end), tile by tile.
template <class Emitter>
HWY_INLINE void emitColumns(const Query& q, const LaneList& columns, Range range, Emitter& emitter) {
  forEachTile(columns, range, [&](const LaneTile& tile, Range part) HWY_ATTR {
    emitRow<Density::Dense>(q, tile, part.begin, part.end, emitter);
  });
}

/// One row that is expected to have many pairs; returns their number.
HWY_INLINE std::size_t writeRow(const FlatSearch& search, std::size_t row, Range columns, PairStream& stream,
                                Hits& hits) {
  const Query q = broadcast(search.rows.get(row));
  Pair* const to = hits.roomForPairs(hits.receiver, hits, columns.size());
  stream.begin(to, hits.pairsBefore);
  PairWriter writer{stream, hn::Set(IdTag(), search.rows.id(row)), hits.rowSecond};
  emitColumns(q, search.columns, columns, writer);
  hits.takePairs(hits.receiver, writer.size);
  return writer.size;
}

/// Rows of which most columns are hits: writes their pairs directly. Returns the first row that is not dense.
std::size_t writeRows(const FlatSearch& search, std::size_t row, Hits& hits) {
  PairStream stream;
  for (bool dense = true; dense && row < search.rowEnd; ++row) {
    const Range columns = columnsOf(search, row);
    dense = columns.size() != 0 && kDenseRow * writeRow(search, row, columns, stream, hits) > columns.size();
    hits.boxTests += columns.size();
  }
  stream.finish();
  return row;
}

template <Density kDensity, class Emitter>
void searchRows(const FlatSearch& search, std::size_t rowBegin, Hits& hits) {
  for (std::size_t row = rowBegin; row < search.rowEnd; ++row) {
    const Range columns = columnsOf(search, row);
    const std::size_t size = hits.size;
    searchRow<kDensity, Emitter>(search, row, columns.begin, columns.end, hits);
    hits.boxTests += columns.size();
    if (hits.roomForPairs != nullptr && hits.size > size + kDenseColumns / kDenseRow &&
        kDenseRow * (hits.size - size) > columns.size()) {
      row = writeRows(search, row + 1, hits) - 1;
    }
  }
}

/// Lists the partners of one row.
void listRow(const FlatSearch& search, std::size_t row) {
  NeighborLists& lists = *search.lists;
  const Query q = broadcast(search.rows.get(row));
  const std::uint32_t id = search.rows.id(row);
  const bool others = search.tested == Columns::Others;
  const Range range = columnsOf(search, row);
  const std::array<Range, 2> ranges{others ? Range{0, row} : range,
                                    others ? Range{row + 1, search.columns.size} : Range{0, 0}};
  lists.require(range.size() + kVectorSlack);
  std::uint32_t* const to = lists.partners + lists.size;
  PartnerWriter writer{to, 0};
  for (const Range& part : ranges) emitColumns(q, search.columns, part, writer);
  std::size_t size = writer.size;
  bool areDoubtful = lists.tested == NeighborLists::Tested::All;
  if (lists.tested == NeighborLists::Tested::InDoubt) {
    HitCounter certain;  // By the test of lanes that were rounded either way.
    for (const Range& part : ranges) emitColumns(inward(q, lists.slack.most), search.columns, part, certain);
    areDoubtful = certain.size != size;
  }
  if (size != 0 && (areDoubtful || lists.filtered)) size = lists.select(lists, id, {to, size}, areDoubtful);
  lists.begin[id] = lists.base + lists.size;
  lists.length[id] = static_cast<std::uint32_t>(size);
  lists.size += size;
}

void listRows(const FlatSearch& search, Hits& hits) {
  for (std::size_t row = search.rowBegin; row < search.rowEnd; ++row) {
    listRow(search, row);
    hits.boxTests += columnsOf(search, row).size();
  }
}

void searchFlat(const FlatSearch& search, Hits& hits) {
  if (search.lists != nullptr) {
    listRows(search, hits);
    return;
  }
  // Few boxes overlap a larger share of each other, unless their volume shrinks as their number grows.
  const bool dense = search.columns.size <= kDenseColumns;
  const std::size_t begin = search.rowBegin;
  if (hits.countOnly) {
    dense ? searchRows<Density::Dense, HitCounter>(search, begin, hits)
          : searchRows<Density::Sparse, HitCounter>(search, countRows(search, hits), hits);
  } else if (hits.doubt != nullptr) {
    dense ? searchRows<Density::Dense, DoubtWriter>(search, begin, hits)
          : searchRows<Density::Sparse, DoubtWriter>(search, begin, hits);
  } else {
    dense ? searchRows<Density::Dense, HitWriter>(search, begin, hits)
          : searchRows<Density::Sparse, HitWriter>(search, begin, hits);
  }
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_FLAT_KERNEL_INL_H
