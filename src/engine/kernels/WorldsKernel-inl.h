// SPDX-License-Identifier: MIT
// The exhaustive search of small worlds and of two small sets: hits of each box as bits, and then pairs of bits.
// Vectors do the one, other units of the processor the other, so that they overlap.

#if defined(ALLPAIRS_WORLDS_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_WORLDS_KERNEL_INL_H
#undef ALLPAIRS_WORLDS_KERNEL_INL_H
#else
#define ALLPAIRS_WORLDS_KERNEL_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernels/BitsKernel-inl.h"
#include "kernels/LaneTest-inl.h"
#include "kernels/LoadKernel-inl.h"
#include "kernels/NearestKernel-inl.h"
#include "kernels/WorldsReadKernel-inl.h"
#include "kernels/WorldsRun.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// The boxes that a row is paired with.
enum class With : std::uint8_t {
  Following,  ///< Of one set: those after it.
  Preceding,  ///< Of one set: those before it.
  SecondSet,  ///< All of the second set; the row is of the first one.
  FirstSet,   ///< All of the first set; the row is of the second one.
};

constexpr bool areOneSet(With with) { return with == With::Following || with == With::Preceding; }
constexpr bool isRowSecond(With with) { return with == With::Preceding || with == With::FirstSet; }

/// The hits of up to a word of rows, in words by row, and then those of them that are certain.
struct WorldHits {
  std::array<std::uint64_t, kMostInWorld> all;
  std::array<std::uint64_t, kMostInWorld> certain;
};

/// The lanes of a mask in which one value is not above another.
template <class T, class Mask, class Vector>
HWY_INLINE Mask notAboveAlso(Mask also, Vector value, Vector other) {
#if HWY_TARGET <= HWY_AVX3
  // A masked comparison, where compilers combine two masks: a tenth of the time (worlds_benchmark).
  if constexpr (sizeof(T) == sizeof(float)) {
    return Mask{_mm256_mask_cmp_ps_mask(also.raw, value.raw, other.raw, _CMP_LE_OQ)};
  } else {
    return Mask{_mm512_mask_cmp_pd_mask(also.raw, value.raw, other.raw, _CMP_LE_OQ)};
  }
#else
  return hn::And(also, hn::Le(value, other));
#endif
}

/// Boxes against each other: exact. Empty ones hit nothing, if they are marked where kMarksEmpty says so. Of float64
/// boxes as the nearest float32 a hit is certain if no bounds that are compared are equal.
template <class T, bool kMarksCertain = false>
class BoundsTest {
 public:
  HWY_INLINE BoundsTest(const WorldTile<T>& rows, const WorldTile<T>& columns) : m_rows(rows), m_columnsOf(columns) {}

  /// The boxes that rows are tested against.
  HWY_INLINE void setColumns(std::size_t place) {
    for (std::size_t vector = 0; vector < kVectors; ++vector) {
      const std::size_t from = place + vector * hn::Lanes(D());
      for (std::size_t bound = 0; bound < 6; ++bound)
        m_columns[vector][bound] = hn::LoadU(D(), &m_columnsOf[bound][from]);
    }
  }

  /// Stores the hits of a row as a byte, and those that are certain.
  HWY_INLINE void storeHits(std::size_t row, std::uint8_t* byte) const {
    hn::Vec<D> box[6];
    for (std::size_t bound = 0; bound < 6; ++bound) box[bound] = hn::Set(D(), m_rows[bound][row]);
    if constexpr (kVectors == 1) {
      hn::StoreMaskBits(D(), hits(box, m_columns[0]), byte);
      if constexpr (kMarksCertain) hn::StoreMaskBits(D(), certainHits(box, m_columns[0]), certainOf(byte));
    } else {
      std::uint32_t all = 0;
      std::uint32_t certain = 0;
      for (std::size_t vector = 0; vector < kVectors; ++vector) {
        all |= allBitsOf(D(), hits(box, m_columns[vector])) << (vector * hn::Lanes(D()));
        if constexpr (kMarksCertain)
          certain |= allBitsOf(D(), certainHits(box, m_columns[vector])) << (vector * hn::Lanes(D()));
      }
      byte[0] = static_cast<std::uint8_t>(all);
      if constexpr (kMarksCertain) *certainOf(byte) = static_cast<std::uint8_t>(certain);
    }
  }

 private:
  using D = WorldTag<T>;
  static constexpr std::size_t kVectors = kColumnsAtOnce / hn::MaxLanes(D());

  /// Where those of the hits at a byte are stored that are certain.
  static HWY_INLINE std::uint8_t* certainOf(std::uint8_t* byte) { return byte + offsetof(WorldHits, certain); }

  [[nodiscard]] static HWY_INLINE hn::Mask<D> hits(const hn::Vec<D>* box, const hn::Vec<D>* columns) {
    if constexpr (kMarksEmpty && !kMarksCertain) {
      const auto meetOn = [&](std::size_t axis) HWY_ATTR {
        return hn::And(hn::Le(box[axis], columns[axis + 3]), hn::Le(columns[axis], box[axis + 3]));
      };
      return hn::And(hn::And(meetOn(0), meetOn(1)), meetOn(2));
    } else {
      const auto from = [&](std::size_t axis) HWY_ATTR { return hn::Max(columns[axis], box[axis]); };
      const auto to = [&](std::size_t axis) HWY_ATTR { return hn::Min(columns[axis + 3], box[axis + 3]); };
      const auto xy = notAboveAlso<T>(hn::Le(from(0), to(0)), from(1), to(1));
      return notAboveAlso<T>(xy, from(2), to(2));
    }
  }

  [[nodiscard]] static HWY_INLINE hn::Mask<D> certainHits(const hn::Vec<D>* box, const hn::Vec<D>* columns) {
    const auto isBelow = [&](std::size_t axis) HWY_ATTR {
      return hn::Lt(hn::Max(columns[axis], box[axis]), hn::Min(columns[axis + 3], box[axis + 3]));
    };
    return hn::And(hn::And(isBelow(0), isBelow(1)), isBelow(2));
  }

  const WorldTile<T>& m_rows;
  const WorldTile<T>& m_columnsOf;
  hn::Vec<D> m_columns[kVectors][6];
};

/// Boxes of float64 as the nearest float32, whose hits are tested in double: all of them where pairs are few; where
/// they are many only those of rows of which some are not certain, and telling these makes each test longer.
template <bool kMany>
class NearestTest : public BoundsTest<float, kMany> {
 public:
  HWY_INLINE NearestTest(const WorldTile<float>& rows, const WorldTile<float>& columns, const RowsTest& exact)
      : BoundsTest<float, kMany>(rows, columns), m_exact(exact) {}

  /// Of the hits of a box with those of a word of one set the ones that overlap it.
  [[nodiscard]] HWY_INLINE std::uint64_t exactOf(std::uint64_t bits, std::uint64_t certain, std::uint32_t box,
                                                 std::uint32_t firstOfWord) const {
    const std::uint64_t doubts = bits & ~certain;
    return HWY_LIKELY(doubts == 0) ? bits : bits ^ doubts ^ m_exact.hitsOf(doubts, box, firstOfWord);
  }

  /// Moves the pairs that overlap to the front; returns their number.
  [[nodiscard]] HWY_INLINE std::size_t select(Pair* pairs, std::size_t count) const {
    return m_exact.select(pairs, count);
  }

 private:
  const RowsTest& m_exact;
};

/// Boxes in double, apart as the contract says it: if a minimum exceeds the other's maximum plus the distance of the
/// two. Where that sum is NaN they are not apart. Whether a box is empty is the caller's to say.
template <With kWith>
class WideTest {
 public:
  HWY_INLINE explicit WideTest(const WideWorld& world) : m_world(world) {}

  HWY_INLINE void setColumns(std::size_t place) { m_place = place; }

  /// Stores the hits of a row as a byte.
  HWY_INLINE void storeHits(std::size_t row, std::uint8_t* byte) const {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < kColumnsAtOnce; i += hn::MaxLanes(D())) {
      bits |= allBitsOf(D(), hits(row, m_place + i)) << i;
    }
    *byte = static_cast<std::uint8_t>(bits);
  }

 private:
  using D = DoubleTag;

  [[nodiscard]] HWY_INLINE hn::Mask<D> hits(std::size_t row, std::size_t place) const {
    const D d;
    const auto far = distance(row, place);
    const auto apartOn = [&](std::size_t axis) HWY_ATTR {
      const WorldTile<double>& bound = m_world.tile;
      const auto min = hn::LoadU(d, &bound[axis][place]);
      const auto max = hn::LoadU(d, &bound[axis + 3][place]);
      return hn::Or(hn::Gt(hn::Set(d, bound[axis][row]), hn::Add(max, far)),
                    hn::Gt(min, hn::Add(hn::Set(d, bound[axis + 3][row]), far)));
    };
    return hn::Not(hn::Or(hn::Or(apartOn(0), apartOn(1)), apartOn(2)));
  }

  /// The distance of the row and each column, margins added from the first box to the second.
  [[nodiscard]] HWY_INLINE hn::Vec<D> distance(std::size_t row, std::size_t place) const {
    const D d;
    const auto given = hn::Set(d, m_world.distance);
    if (!m_world.hasMargins) return given;
    const auto own = hn::Set(d, m_world.margins[row]);
    const auto other = hn::LoadU(d, &m_world.margins[place]);
    return isRowSecond(kWith) ? hn::Add(hn::Add(given, other), own) : hn::Add(hn::Add(given, own), other);
  }

  const WideWorld& m_world;
  std::size_t m_place = 0;
};

/// The hits of the rows of a word from the one of `begin` on, by place, with the boxes that they are paired with, whose
/// places are given. Hits with others are stored too, or what was there before, and so are those of a few rows before.
template <With kWith, class Test>
HWY_INLINE void testRows(Test test, const WorldPlaces& places, std::size_t begin, WorldHits& hits) {
  const std::size_t firstOfWord = begin / kWordBoxes * kWordBoxes;
  const std::size_t end = firstOfWord + kWordBoxes;
  const std::size_t stop = kWith == With::Preceding ? end : places.end();
  const std::size_t rowBytes = places.words * sizeof(std::uint64_t);
  auto* const words = reinterpret_cast<std::uint8_t*>(&hits);
  for (std::size_t columns = (kWith == With::Following ? begin : places.first) / kColumnsAtOnce * kColumnsAtOnce;
       columns < stop; columns += kColumnsAtOnce) {
    test.setColumns(columns);
    std::size_t row = (kWith == With::Preceding ? std::max(begin, columns) : begin) / kRowsAtOnce * kRowsAtOnce;
    const std::size_t endRow = kWith == With::Following ? std::min(end, columns + kColumnsAtOnce) : end;
    std::uint8_t* bytes = words + (row - firstOfWord) * rowBytes + columns / 8;
    for (; row < endRow; row += kRowsAtOnce, bytes += kRowsAtOnce * rowBytes) {
      test.storeHits(row, bytes);
      test.storeHits(row + 1, bytes + rowBytes);
      test.storeHits(row + 2, bytes + 2 * rowBytes);
      test.storeHits(row + 3, bytes + 3 * rowBytes);
    }
  }
}

/// The bits of a row's word that are boxes that it is paired with.
template <With kWith>
HWY_INLINE std::uint64_t bitsOfRow(std::uint64_t bits, std::size_t word, std::size_t row, const WorldPlaces& places) {
  if (kWith != With::Following && word == 0) bits &= ~std::uint64_t{0} << places.first;
  if (!areOneSet(kWith) || word != row / kWordBoxes) return bits;
  return bits & (kWith == With::Preceding ? lowBits(row % kWordBoxes) : ~std::uint64_t{1} << (row % kWordBoxes));
}

/// Which boxes may be paired with each row.
struct Partners {
  WorldPlaces places;
  std::size_t firstRow;                    ///< The place of the first row.
  const std::uint64_t* allowed = nullptr;  ///< Rows of words; null means all.
  const std::uint64_t* alive = nullptr;    ///< A bit for each place; null means all.

  [[nodiscard]] HWY_INLINE std::uint64_t of(std::size_t row, std::size_t word) const {
    std::uint64_t bits = ~std::uint64_t{0};
    if (allowed != nullptr) bits = allowed[(row - places.first) * places.words + word];
    if (alive == nullptr) return bits;
    return (alive[row / kWordBoxes] >> (row % kWordBoxes) & 1) != 0 ? bits & alive[word] : 0;
  }
};

/// The hits of rows in [begin, end) as pairs, or counted only. With kUnasked pairs of a word that are written unasked.
template <With kWith, bool kCount, std::size_t kUnasked, class Test>
HWY_INLINE void takeRows(const Test& test, const WorldHits& hits, std::size_t begin, std::size_t end,
                         const Partners partners, WorldSink& sink) {
  static_assert(!kCount || (areOneSet(kWith) && !std::is_same_v<Test, NearestTest<false>>));
  const WorldPlaces& places = partners.places;
  [[maybe_unused]] std::uint64_t doubts = std::is_same_v<Test, NearestTest<false>> ? 1 : 0;
  const std::uint64_t* words = hits.all.data() + begin % kWordBoxes * places.words;
  const std::uint64_t* certain = hits.certain.data() + begin % kWordBoxes * places.words;
  std::uint64_t size = sink.size;
  for (std::size_t row = begin; row < end; ++row, words += places.words, certain += places.words) {
    const auto box = static_cast<std::uint32_t>(row - partners.firstRow);
    const std::size_t firstWord = kWith == With::Following ? row / kWordBoxes : 0;
    const std::size_t endWord = kWith == With::Preceding ? row / kWordBoxes + 1 : places.words;
    for (std::size_t word = firstWord; word < endWord; ++word) {
      const auto firstOfWord = static_cast<std::uint32_t>(word * kWordBoxes - places.first);
      std::uint64_t bits = bitsOfRow<kWith>(words[word], word, row, places) & partners.of(row, word);
      if constexpr (kCount) {
        if constexpr (std::is_same_v<Test, NearestTest<true>>)
          bits = test.exactOf(bits, certain[word], box, firstOfWord);
        size += static_cast<std::size_t>(std::popcount(bits));
      } else {
        if constexpr (std::is_same_v<Test, NearestTest<true>>) doubts |= bits & ~certain[word];
        size += writeBits<isRowSecond(kWith), kUnasked>(bits, box, firstOfWord, sink.pairs + size);
      }
    }
  }
  if constexpr (requires { test.select(sink.pairs, size); }) {
    if (doubts != 0) size = sink.size + test.select(sink.pairs + sink.size, size - sink.size);
  }
  sink.size = size;
}

/// The same of the rows of a word from the one of `begin` on, where there is room for them.
template <With kWith, bool kCount, std::size_t kUnasked, class Test>
HWY_INLINE void takeWord(const Test& test, const WorldHits& hits, std::size_t begin, const Partners& partners,
                         WorldSink& sink) {
  const std::size_t end = WorldPlaces::endOfWord(begin);
  for (std::size_t row = begin; row < end;) {
    const std::size_t next = std::min(end, row + sink.makeRoomForRows(partners.places.boxes()));
    takeRows<kWith, kCount, kUnasked>(test, hits, row, next, partners, sink);
    row = next;
  }
}

/// The pairs of the rows of a word from the one of `begin` on. With boxes of one word most rows have hits in it; with
/// more few words have more than two.
template <With kWith, bool kCount, class Test>
HWY_INLINE void searchWord(const Test& test, std::size_t begin, const Partners& partners, WorldSink& sink) {
  const WorldPlaces& places = partners.places;
  WorldHits hits;
  if (places.words == 1) {
    const Partners inOne{{places.first, 1}, partners.firstRow, partners.allowed, partners.alive};
    testRows<kWith>(test, inOne.places, begin, hits);
    if constexpr (areOneSet(kWith)) {
      takeRows<kWith, kCount, 4>(test, hits, begin, kWordBoxes, inOne, sink);
    } else {
      takeWord<kWith, kCount, 4>(test, hits, begin, inOne, sink);
    }
    return;
  }
  testRows<kWith>(test, places, begin, hits);
  takeWord<kWith, kCount, 2>(test, hits, begin, partners, sink);
}

/// The same, for what is known of all worlds only now.
template <With kWith, class Test>
HWY_INLINE void searchSome(const Test& test, std::size_t begin, const Partners& partners, WorldSink& sink) {
  sink.countOnly ? searchWord<kWith, true>(test, begin, partners, sink)
                 : searchWord<kWith, false>(test, begin, partners, sink);
}

/// The same of boxes as a test has them. Worlds without a filter whose pairs are wanted by their first boxes have a
/// loop of their own. Pairs that are tested one by one are not counted only.
template <With kWith, bool kPlain, class Test>
HWY_INLINE void searchRead(const Test& test, const WorldPlaces& places, std::size_t begin, WorldSink& sink) {
  if constexpr (kPlain) {
    searchWord<kWith, false>(test, begin, {places, places.first}, sink);
  } else if constexpr (std::is_same_v<Test, NearestTest<false>>) {
    searchWord<kWith, false>(test, begin, {places, places.first, sink.allowed}, sink);
  } else {
    searchSome<kWith>(test, begin, {places, places.first, sink.allowed}, sink);
  }
}

/// The same with a test that is made here. A function of its own: what is inlined into the loop over worlds compilers
/// keep in memory, not in registers.
template <class Test, With kWith, bool kPlain, class... Of>
HWY_NOINLINE void searchBy(const WorldPlaces& places, std::size_t begin, WorldSink& sink, const Of&... of) {
  searchRead<kWith, kPlain>(Test(of...), places, begin, sink);
}

/// All pairs of one world, of boxes as they are.
template <With kWith, bool kPlain, class T>
HWY_INLINE void searchExactly(const WorldsRun<T>& run, std::size_t first, const WorldPlaces& places, WorldSink& sink) {
  alignas(64) WorldTile<T> tile;
  readWorld(run.boxes, first, places, tile);
  if (places.words == 1) {
    searchRead<kWith, kPlain>(BoundsTest<T>(tile, tile), {places.first, 1}, places.first, sink);
    return;
  }
  for (std::size_t begin = places.first; begin < places.end(); begin = WorldPlaces::endOfWord(begin))
    searchBy<BoundsTest<T>, kWith, kPlain>(places, begin, sink, tile, tile);
}

/// Whether so many of all pairs are tested sooner together than one by one: alone a pair takes as long as some 16 boxes
/// together with AVX-512, some 32 with AVX2 (worlds_benchmark).
HWY_INLINE bool areMany(std::uint64_t found, std::size_t pairs) { return found * 24 > pairs; }

/// The same of boxes of float64 as the nearest float32.
template <With kWith, bool kPlain>
HWY_INLINE void searchNearest(WorldsRun<double>& run, std::size_t first, const WorldPlaces& places, WorldSink& sink) {
  alignas(64) WorldTile<float> tile;
  readWorld(run.boxes, first, places, tile);
  const BoxRun<double> boxes = run.boxes.part(first, run.boxes.size);
  const RowsTest exact(boxes, boxes);
  for (std::size_t begin = places.first; begin < places.end(); begin = WorldPlaces::endOfWord(begin)) {
    const std::uint64_t before = sink.found();
    run.hadMany || sink.countOnly ? searchBy<NearestTest<true>, kWith, kPlain>(places, begin, sink, tile, tile, exact)
                                  : searchBy<NearestTest<false>, kWith, kPlain>(places, begin, sink, tile, tile, exact);
    run.hadMany = areMany(sink.found() - before, places.pairsFrom(begin, isRowSecond(kWith)));
  }
}

template <With kWith, bool kPlain, class T>
HWY_INLINE void searchRun(WorldsRun<T>& run) {
  WorldSink sink = run.sink;
  for (; run.world < run.end; ++run.world) {
    const std::size_t first = run.worlds->begin(run.world);
    const std::size_t boxes = run.worlds->begin(run.world + 1) - first;
    if (boxes > run.mostBoxes || !sink.takes(boxes)) break;
    prefetchAfter(run, first + boxes, boxes);
    if constexpr (std::is_same_v<T, LaneOf<T>>) {
      searchExactly<kWith, kPlain>(run, first, WorldPlaces::of(boxes), sink);
    } else {
      searchNearest<kWith, kPlain>(run, first, WorldPlaces::of(boxes), sink);
    }
    run.pairEnd[run.world] = sink.size;
    run.boxTests += WorldSink::pairsOf(boxes);
  }
  run.sink = sink;
}

template <class T>
void searchWorlds(WorldsRun<T>& run) {
  if (run.sink.bySecond) {
    searchRun<With::Preceding, false>(run);
  } else if (run.sink.allowed != nullptr || run.sink.countOnly) {
    searchRun<With::Following, false>(run);
  } else {
    searchRun<With::Following, true>(run);
  }
}

template <With kWith>
HWY_INLINE void searchWide(const WideWorld& world, WorldSink& sink) {
  const WorldPlaces places = WorldPlaces::of(world.boxes);
  const Partners partners{places, places.first, sink.allowed, world.alive.data()};
  for (std::size_t begin = places.first; begin < places.end(); begin = WorldPlaces::endOfWord(begin)) {
    if (!world.hasMargins && world.distance == 0.0) {
      searchSome<kWith>(BoundsTest<double>(world.tile, world.tile), begin, partners, sink);
    } else {
      searchSome<kWith>(WideTest<kWith>(world), begin, partners, sink);
    }
  }
}

void searchWideWorld(const WideWorld& world, WorldSink& sink) {
  sink.bySecond ? searchWide<With::Preceding>(world, sink) : searchWide<With::Following>(world, sink);
}

/// The pairs of the rows of a word from the one of `begin` on with all of another set; see searchBy().
template <class Test, With kWith, class... Of>
HWY_NOINLINE void searchRowsBy(const Partners& columns, std::size_t begin, WorldSink& sink, const Of&... of) {
  searchWord<kWith, false>(Test(of...), begin, columns, sink);
}

template <With kWith, class T>
HWY_INLINE void searchBetween(BetweenRun<T>& run) {
  using Lane = LaneOf<T>;
  const WorldPlaces rows = WorldPlaces::of(run.rows.size);
  const WorldPlaces columns = WorldPlaces::of(run.columns.size);
  alignas(64) WorldTile<Lane> rowTile;
  alignas(64) WorldTile<Lane> columnTile;
  readWorld(run.rows, 0, rows, rowTile);
  readWorld(run.columns, 0, columns, columnTile);
  const Partners partners{columns, rows.first};
  bool hadMany = true;
  for (std::size_t begin = rows.first; begin < rows.end(); begin = WorldPlaces::endOfWord(begin)) {
    if constexpr (std::is_same_v<T, Lane>) {
      searchRowsBy<BoundsTest<Lane>, kWith>(partners, begin, run.sink, rowTile, columnTile);
    } else {
      const RowsTest exact = isRowSecond(kWith) ? RowsTest(run.columns, run.rows) : RowsTest(run.rows, run.columns);
      const std::uint64_t before = run.sink.found();
      hadMany ? searchRowsBy<NearestTest<true>, kWith>(partners, begin, run.sink, rowTile, columnTile, exact)
              : searchRowsBy<NearestTest<false>, kWith>(partners, begin, run.sink, rowTile, columnTile, exact);
      hadMany = areMany(run.sink.found() - before, (WorldPlaces::endOfWord(begin) - begin) * columns.boxes());
    }
  }
}

template <class T>
void searchBetween(BetweenRun<T>& run) {
  run.sink.bySecond ? searchBetween<With::FirstSet>(run) : searchBetween<With::SecondSet>(run);
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_WORLDS_KERNEL_INL_H
