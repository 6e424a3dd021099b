// SPDX-License-Identifier: MIT
// The exhaustive search of many small worlds: hits of each box as bits, and then pairs of bits. Vectors do the one,
// other units of the processor the other, so that they overlap.

#if defined(ALLPAIRS_WORLDS_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_WORLDS_KERNEL_INL_H
#undef ALLPAIRS_WORLDS_KERNEL_INL_H
#else
#define ALLPAIRS_WORLDS_KERNEL_INL_H
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "kernels/Kernels.h"
#include "kernels/LaneTest-inl.h"
#include "kernels/LoadKernel-inl.h"
#include "kernels/NearestKernel-inl.h"
#include "kernels/WorldsReadKernel-inl.h"
#include "kernels/WorldsRun.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

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

/// Boxes against each other: exact, and empty boxes hit nothing. Of float64 boxes as the nearest float32 a hit is
/// certain if no bounds that are compared are equal.
template <class T, bool kMarksCertain = false>
class BoundsTest {
 public:
  HWY_INLINE explicit BoundsTest(const WorldTile<T>& tile) : m_tile(tile) {}

  /// The boxes that rows are tested against.
  HWY_INLINE void setColumns(std::size_t place) {
    for (std::size_t vector = 0; vector < kVectors; ++vector) {
      const std::size_t from = place + vector * hn::Lanes(D());
      for (std::size_t bound = 0; bound < 6; ++bound) m_columns[vector][bound] = hn::LoadU(D(), &m_tile[bound][from]);
    }
  }

  /// Stores the hits of a row as a byte, and those that are certain.
  HWY_INLINE void storeHits(std::size_t row, std::uint8_t* byte) const {
    hn::Vec<D> box[6];
    for (std::size_t bound = 0; bound < 6; ++bound) box[bound] = hn::Set(D(), m_tile[bound][row]);
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
    const auto from = [&](std::size_t axis) HWY_ATTR { return hn::Max(columns[axis], box[axis]); };
    const auto to = [&](std::size_t axis) HWY_ATTR { return hn::Min(columns[axis + 3], box[axis + 3]); };
    const auto xy = notAboveAlso<T>(hn::Le(from(0), to(0)), from(1), to(1));
    return notAboveAlso<T>(xy, from(2), to(2));
  }

  [[nodiscard]] static HWY_INLINE hn::Mask<D> certainHits(const hn::Vec<D>* box, const hn::Vec<D>* columns) {
    const auto isBelow = [&](std::size_t axis) HWY_ATTR {
      return hn::Lt(hn::Max(columns[axis], box[axis]), hn::Min(columns[axis + 3], box[axis + 3]));
    };
    return hn::And(hn::And(isBelow(0), isBelow(1)), isBelow(2));
  }

  const WorldTile<T>& m_tile;
  hn::Vec<D> m_columns[kVectors][6];
};

/// Boxes of float64 as the nearest float32, whose hits are tested in double: all of them where pairs are few; where
/// they are many only those of rows of which some are not certain, and telling these makes each test longer.
template <bool kMany>
class NearestTest : public BoundsTest<float, kMany> {
 public:
  HWY_INLINE NearestTest(const WorldTile<float>& tile, const RowsTest& exact)
      : BoundsTest<float, kMany>(tile), m_exact(exact) {}

  /// Of the hits of a box with those of a word the ones that overlap it.
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
template <bool kPreceding>
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
    return kPreceding ? hn::Add(hn::Add(given, other), own) : hn::Add(hn::Add(given, own), other);
  }

  const WideWorld& m_world;
  std::size_t m_place = 0;
};

/// The hits of the rows of a word from the one of `begin` on, by place, with the boxes that follow, or precede them.
/// Hits with others are stored too, or what was there before, and so are those of a few rows before.
template <bool kPreceding, class Test>
HWY_INLINE void testRows(Test test, const WorldPlaces& places, std::size_t begin, WorldHits& hits) {
  const std::size_t firstOfWord = begin / kWordBoxes * kWordBoxes;
  const std::size_t end = firstOfWord + kWordBoxes;
  const std::size_t stop = kPreceding ? end : places.end;
  const std::size_t rowBytes = places.words * sizeof(std::uint64_t);
  auto* const words = reinterpret_cast<std::uint8_t*>(&hits);
  for (std::size_t columns = (kPreceding ? places.first : begin) / kColumnsAtOnce * kColumnsAtOnce; columns < stop;
       columns += kColumnsAtOnce) {
    test.setColumns(columns);
    std::size_t row = (kPreceding ? std::max(begin, columns) : begin) / kRowsAtOnce * kRowsAtOnce;
    const std::size_t endRow = kPreceding ? end : std::min(end, columns + kColumnsAtOnce);
    std::uint8_t* bytes = words + (row - firstOfWord) * rowBytes + columns / 8;
    for (; row < endRow; row += kRowsAtOnce, bytes += kRowsAtOnce * rowBytes) {
      test.storeHits(row, bytes);
      test.storeHits(row + 1, bytes + rowBytes);
      test.storeHits(row + 2, bytes + 2 * rowBytes);
      test.storeHits(row + 3, bytes + 3 * rowBytes);
    }
  }
}

/// The position of the lowest bit; any number if there is none.
HWY_INLINE std::uint32_t lowestBit(std::uint64_t bits) {
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86_64
  return static_cast<std::uint32_t>(_tzcnt_u64(bits));
#else
  return static_cast<std::uint32_t>(std::countr_zero(bits | std::uint64_t{1} << 63));  // spares a test for no bits
#endif
}

/// Writes a box's pairs with the lowest so many bits of a word, and clears these. A function, not a lambda: GCC does
/// not inline a lambda that is called several times.
template <bool kPreceding, std::size_t kCount>
HWY_INLINE void writeLowest(std::uint64_t& bits, std::uint32_t box, std::uint32_t firstOfWord, Pair* to) {
  if constexpr (kCount != 0) {
    const std::uint32_t other = firstOfWord + lowestBit(bits);
    // Without the fences, which cost no instruction, compilers combine both into one number, or several pairs into a
    // vector, and either takes longer.
    to->first = kPreceding ? other : box;
    std::atomic_signal_fence(std::memory_order_acq_rel);
    to->second = kPreceding ? box : other;
    std::atomic_signal_fence(std::memory_order_acq_rel);
    bits &= bits - 1;
    writeLowest<kPreceding, kCount - 1>(bits, box, firstOfWord, to + 1);
  }
}

/// Writes the pairs of a box with those of a word: the first few without asking whether there are as many, which would
/// be mispredicted too often. Returns how many there are.
template <bool kPreceding, std::size_t kUnasked>
HWY_INLINE std::size_t writeBits(std::uint64_t bits, std::uint32_t box, std::uint32_t firstOfWord, Pair* pairs) {
  // Of the others: where there are many, a tenth of the time of all (few_benchmark).
  constexpr std::size_t kAtOnce = 4;
  static_assert(std::max(kUnasked, kAtOnce) <= kVectorSlack);
  const auto count = static_cast<std::size_t>(std::popcount(bits));
  writeLowest<kPreceding, kUnasked>(bits, box, firstOfWord, pairs);
  for (std::size_t i = kUnasked; i < count; i += kAtOnce) {
    writeLowest<kPreceding, kAtOnce>(bits, box, firstOfWord, pairs + i);
  }
  return count;
}

/// The bits of a row's word that are other boxes.
template <bool kPreceding>
HWY_INLINE std::uint64_t bitsOfRow(std::uint64_t bits, std::size_t word, std::size_t row, const WorldPlaces& places) {
  if (kPreceding) {
    if (word == row / kWordBoxes) bits &= ~(~std::uint64_t{0} << (row % kWordBoxes));
    if (word == 0) bits &= ~std::uint64_t{0} << places.first;
  } else if (word == row / kWordBoxes) {
    bits &= ~std::uint64_t{1} << (row % kWordBoxes);
  }
  return bits;
}

/// Which boxes may be paired with each of a world.
struct Partners {
  WorldPlaces places;
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
template <bool kPreceding, bool kCount, std::size_t kUnasked, class Test>
HWY_INLINE void takeRows(const Test& test, const WorldHits& hits, std::size_t begin, std::size_t end,
                         const Partners partners, WorldSink& sink) {
  static_assert(!kCount || !std::is_same_v<Test, NearestTest<false>>);
  const WorldPlaces& places = partners.places;
  [[maybe_unused]] std::uint64_t doubts = std::is_same_v<Test, NearestTest<false>> ? 1 : 0;
  const std::uint64_t* words = hits.all.data() + begin % kWordBoxes * places.words;
  const std::uint64_t* certain = hits.certain.data() + begin % kWordBoxes * places.words;
  std::uint64_t size = sink.size;
  for (std::size_t row = begin; row < end; ++row, words += places.words, certain += places.words) {
    const auto box = static_cast<std::uint32_t>(row - places.first);
    const std::size_t firstWord = kPreceding ? 0 : row / kWordBoxes;
    const std::size_t endWord = kPreceding ? row / kWordBoxes + 1 : places.words;
    for (std::size_t word = firstWord; word < endWord; ++word) {
      const auto firstOfWord = static_cast<std::uint32_t>(word * kWordBoxes - places.first);
      std::uint64_t bits = bitsOfRow<kPreceding>(words[word], word, row, places) & partners.of(row, word);
      if constexpr (kCount) {
        if constexpr (std::is_same_v<Test, NearestTest<true>>)
          bits = test.exactOf(bits, certain[word], box, firstOfWord);
        size += static_cast<std::size_t>(std::popcount(bits));
      } else {
        if constexpr (std::is_same_v<Test, NearestTest<true>>) doubts |= bits & ~certain[word];
        size += writeBits<kPreceding, kUnasked>(bits, box, firstOfWord, sink.pairs + size);
      }
    }
  }
  if constexpr (requires { test.select(sink.pairs, size); }) {
    if (doubts != 0) size = sink.size + test.select(sink.pairs + sink.size, size - sink.size);
  }
  sink.size = size;
}

/// The pairs of the rows of a word from the one of `begin` on. Of worlds of one word most rows have hits in it; of
/// larger ones few words have more than two.
template <bool kPreceding, bool kCount, class Test>
HWY_INLINE void searchWord(const Test& test, std::size_t begin, const Partners& partners, WorldSink& sink) {
  const WorldPlaces& places = partners.places;
  WorldHits hits;
  if (places.words == 1) {
    const Partners inOne{{places.first, kWordBoxes, 1}, partners.allowed, partners.alive};
    testRows<kPreceding>(test, inOne.places, places.first, hits);
    takeRows<kPreceding, kCount, 4>(test, hits, places.first, kWordBoxes, inOne, sink);
    return;
  }
  testRows<kPreceding>(test, places, begin, hits);
  const std::size_t end = WorldPlaces::endOfWord(begin);
  for (std::size_t row = begin; row < end;) {
    const std::size_t next = std::min(end, row + sink.makeRoomForRows(places.boxes()));
    takeRows<kPreceding, kCount, 2>(test, hits, row, next, partners, sink);
    row = next;
  }
}

/// The same, for what is known of all worlds only now.
template <bool kPreceding, class Test>
HWY_INLINE void searchSome(const Test& test, std::size_t begin, const Partners& partners, WorldSink& sink) {
  sink.countOnly ? searchWord<kPreceding, true>(test, begin, partners, sink)
                 : searchWord<kPreceding, false>(test, begin, partners, sink);
}

/// The same of boxes as a test has them. Worlds without a filter whose pairs are wanted by their first boxes have a
/// loop of their own. Pairs that are tested one by one are not counted only.
template <bool kPreceding, bool kPlain, class Test>
HWY_INLINE void searchRead(const Test& test, const WorldPlaces& places, std::size_t begin, WorldSink& sink) {
  if constexpr (kPlain) {
    searchWord<kPreceding, false>(test, begin, {places}, sink);
  } else if constexpr (std::is_same_v<Test, NearestTest<false>>) {
    searchWord<kPreceding, false>(test, begin, {places, sink.allowed}, sink);
  } else {
    searchSome<kPreceding>(test, begin, {places, sink.allowed}, sink);
  }
}

/// The same with a test that is made here. A function of its own: what is inlined into the loop over worlds compilers
/// keep in memory, not in registers.
template <class Test, bool kPreceding, bool kPlain, class... Of>
HWY_NOINLINE void searchBy(const WorldPlaces& places, std::size_t begin, WorldSink& sink, const Of&... of) {
  searchRead<kPreceding, kPlain>(Test(of...), places, begin, sink);
}

/// All pairs of one world, of boxes as they are.
template <bool kPreceding, bool kPlain, class T>
HWY_INLINE void searchExactly(const WorldsRun<T>& run, std::size_t first, const WorldPlaces& places, WorldSink& sink) {
  alignas(64) WorldTile<T> tile;
  readWorld(run, first, places, tile);
  if (places.words == 1) {
    searchRead<kPreceding, kPlain>(BoundsTest<T>(tile), {places.first, kWordBoxes, 1}, places.first, sink);
    return;
  }
  for (std::size_t begin = places.first; begin < places.end; begin = WorldPlaces::endOfWord(begin))
    searchBy<BoundsTest<T>, kPreceding, kPlain>(places, begin, sink, tile);
}

/// The same of boxes of float64 as the nearest float32.
template <bool kPreceding, bool kPlain>
HWY_INLINE void searchNearest(WorldsRun<double>& run, std::size_t first, const WorldPlaces& places, WorldSink& sink) {
  alignas(64) WorldTile<float> tile;
  readWorld(run, first, places, tile);
  const RowsTest exact(run.boxes.part(first, run.boxes.size));
  for (std::size_t begin = places.first; begin < places.end; begin = WorldPlaces::endOfWord(begin)) {
    const std::uint64_t before = sink.found();
    run.hadMany || sink.countOnly ? searchBy<NearestTest<true>, kPreceding, kPlain>(places, begin, sink, tile, exact)
                                  : searchBy<NearestTest<false>, kPreceding, kPlain>(places, begin, sink, tile, exact);
    // A pair tested alone takes as long as some 16 boxes together with AVX-512, some 32 with AVX2 (worlds_benchmark).
    run.hadMany = (sink.found() - before) * 24 > places.pairsFrom(begin, kPreceding);
  }
}

template <bool kPreceding, bool kPlain, class T>
HWY_INLINE void searchRun(WorldsRun<T>& run) {
  WorldSink sink = run.sink;
  for (; run.world < run.end; ++run.world) {
    const std::size_t first = run.worlds->begin(run.world);
    const std::size_t boxes = run.worlds->begin(run.world + 1) - first;
    if (boxes > run.mostBoxes || !sink.takes(boxes)) break;
    prefetchAfter(run, first + boxes, boxes);
    // Without vectors float32 takes no less time than float64.
    if constexpr (std::is_same_v<T, float> || HWY_TARGET == HWY_SCALAR) {
      searchExactly<kPreceding, kPlain>(run, first, WorldPlaces::of(boxes), sink);
    } else {
      searchNearest<kPreceding, kPlain>(run, first, WorldPlaces::of(boxes), sink);
    }
    run.pairEnd[run.world] = sink.size;
    run.boxTests += WorldSink::pairsOf(boxes);
  }
  run.sink = sink;
}

template <class T>
void searchWorlds(WorldsRun<T>& run) {
  if (run.sink.bySecond) {
    searchRun<true, false>(run);
  } else if (run.sink.allowed != nullptr || run.sink.countOnly) {
    searchRun<false, false>(run);
  } else {
    searchRun<false, true>(run);
  }
}

template <bool kPreceding>
HWY_INLINE void searchWide(const WideWorld& world, WorldSink& sink) {
  const WorldPlaces places = WorldPlaces::of(world.boxes);
  const Partners partners{places, sink.allowed, world.alive.data()};
  for (std::size_t begin = places.first; begin < places.end; begin = WorldPlaces::endOfWord(begin)) {
    if (!world.hasMargins && world.distance == 0.0) {
      searchSome<kPreceding>(BoundsTest<double>(world.tile), begin, partners, sink);
    } else {
      searchSome<kPreceding>(WideTest<kPreceding>(world), begin, partners, sink);
    }
  }
}

void searchWideWorld(const WideWorld& world, WorldSink& sink) {
  sink.bySecond ? searchWide<true>(world, sink) : searchWide<false>(world, sink);
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_WORLDS_KERNEL_INL_H
