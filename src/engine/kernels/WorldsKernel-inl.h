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

#include "hwy/cache_control.h"
#include "kernels/Kernels.h"
#include "kernels/LaneTest-inl.h"
#include "kernels/ReadKernel-inl.h"
#include "kernels/WorldsRun.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// The hits of up to a word of rows, in words by row. Masks may be stored as whole words.
using WorldHits = std::array<std::uint64_t, kMostInWorld + 1>;

/// Boxes that a row is tested against at once: as many as hits make a byte.
constexpr std::size_t kColumnsAtOnce = 8;

/// Vectors of 32 bytes, although AVX-512 has longer ones: a processor that cuts those in two spends units on broadcasts
/// to them that it does not on these, and fewer of the boxes tested precede the row (worlds_benchmark).
template <class T>
using WorldTag = hn::CappedTag<T, 32 / sizeof(T)>;
using WorldFloats = hn::Vec<WorldTag<float>>;

/// The lanes of a mask in which one value is not above another.
template <class T, class Mask, class Vector>
HWY_INLINE Mask notAboveAlso(Mask also, Vector value, Vector other) {
#if HWY_TARGET <= HWY_AVX3
  // A masked comparison, where compilers combine two masks: a tenth of the time (worlds_benchmark).
  if constexpr (sizeof(T) == sizeof(float)) {
    return Mask{_mm256_mask_cmp_ps_mask(also.raw, value.raw, other.raw, _CMP_LE_OQ)};
  } else {
    return Mask{_mm256_mask_cmp_pd_mask(also.raw, value.raw, other.raw, _CMP_LE_OQ)};
  }
#else
  return hn::And(also, hn::Le(value, other));
#endif
}

/// Boxes of float32, or of float64, against each other: exact, and empty boxes hit nothing.
template <class T>
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

  /// Stores the hits of a row as a byte.
  HWY_INLINE void storeHits(std::size_t row, std::uint8_t* byte) const {
    hn::Vec<D> box[6];
    for (std::size_t bound = 0; bound < 6; ++bound) box[bound] = hn::Set(D(), m_tile[bound][row]);
    if constexpr (kVectors == 1) {
      hn::StoreMaskBits(D(), hits(box, m_columns[0]), byte);
    } else {
      std::uint32_t bits = 0;
      for (std::size_t vector = 0; vector < kVectors; ++vector) {
        std::uint8_t part = 0;
        hn::StoreMaskBits(D(), hits(box, m_columns[vector]), &part);
        bits |= std::uint32_t{part} << (vector * hn::Lanes(D()));
      }
      *byte = static_cast<std::uint8_t>(bits);
    }
  }

 private:
  using D = WorldTag<T>;
  static constexpr std::size_t kVectors = kColumnsAtOnce / hn::MaxLanes(D());

  [[nodiscard]] static HWY_INLINE hn::Mask<D> hits(const hn::Vec<D>* box, const hn::Vec<D>* columns) {
    const auto from = [&](std::size_t axis) HWY_ATTR { return hn::Max(columns[axis], box[axis]); };
    const auto to = [&](std::size_t axis) HWY_ATTR { return hn::Min(columns[axis + 3], box[axis + 3]); };
    const auto xy = notAboveAlso<T>(hn::Le(from(0), to(0)), from(1), to(1));
    return notAboveAlso<T>(xy, from(2), to(2));
  }

  const WorldTile<T>& m_tile;
  hn::Vec<D> m_columns[kVectors][6];
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
      std::uint8_t part = 0;
      hn::StoreMaskBits(D(), hits(row, m_place + i), &part);
      bits |= std::uint32_t{part} << i;
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
  auto* const words = reinterpret_cast<std::uint8_t*>(hits.data());
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

/// The hits of rows in [begin, end) as pairs. With kUnasked pairs of a word that are written unasked; 0 counts pairs
/// only.
template <bool kPreceding, std::size_t kUnasked>
HWY_INLINE void takeRows(const WorldHits& hits, const WorldPlaces places, std::size_t begin, std::size_t end,
                         const Partners partners, WorldSink& sink) {
  const std::uint64_t* words = hits.data() + begin % kWordBoxes * places.words;
  std::uint64_t size = sink.size;
  for (std::size_t row = begin; row < end; ++row, words += places.words) {
    const auto box = static_cast<std::uint32_t>(row - places.first);
    const std::size_t firstWord = kPreceding ? 0 : row / kWordBoxes;
    const std::size_t endWord = kPreceding ? row / kWordBoxes + 1 : places.words;
    for (std::size_t word = firstWord; word < endWord; ++word) {
      const std::uint64_t bits = bitsOfRow<kPreceding>(words[word], word, row, places) & partners.of(row, word);
      if constexpr (kUnasked == 0) {
        size += static_cast<std::size_t>(std::popcount(bits));
      } else {
        const auto firstOfWord = static_cast<std::uint32_t>(word * kWordBoxes - places.first);
        size += writeBits<kPreceding, kUnasked>(bits, box, firstOfWord, sink.pairs + size);
      }
    }
  }
  sink.size = size;
}

/// All pairs of one world. Of worlds of one word most rows have hits in it; of larger ones few words have more than
/// two.
template <bool kPreceding, bool kCount, class Test>
HWY_INLINE void searchWorld(const Test& test, const WorldPlaces& places, const Partners& partners, WorldSink& sink) {
  WorldHits hits;
  if (places.words == 1) {
    testRows<kPreceding>(test, {places.first, kWordBoxes, 1}, places.first, hits);
    takeRows<kPreceding, kCount ? 0 : 4>(hits, {places.first, kWordBoxes, 1}, places.first, kWordBoxes, partners, sink);
    return;
  }
  for (std::size_t begin = places.first; begin < places.end;) {
    const std::size_t end = begin / kWordBoxes * kWordBoxes + kWordBoxes;
    testRows<kPreceding>(test, places, begin, hits);
    takeRows<kPreceding, kCount ? 0 : 2>(hits, places, begin, end, partners, sink);
    begin = end;
  }
}

/// The same, for what is known of all worlds only now.
template <bool kPreceding, class Test>
HWY_INLINE void searchSome(const Test& test, const WorldPlaces& places, const Partners& partners, WorldSink& sink) {
  sink.countOnly ? searchWorld<kPreceding, true>(test, places, partners, sink)
                 : searchWorld<kPreceding, false>(test, places, partners, sink);
}

#if HWY_TARGET != HWY_SCALAR

/// Four values of a box of a row of six, and if there are lanes for them those of the fourth box after it.
template <class D>
HWY_INLINE hn::Vec<D> fourOfBoxes(D d, const float* values) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::LoadU(d, values);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, hn::LoadU(half, values + std::size_t{6} * 4), hn::LoadU(half, values));
  }
}

#endif

/// As many boxes as a vector has lanes, from rows of six that follow each other.
HWY_INLINE void readRowsOfSix(const float* rows, WorldTile<float>& tile, std::size_t at) {
  const WorldTag<float> d;
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t bound = 0; bound < 6; ++bound) hn::StoreU(hn::LoadU(d, rows + bound), d, &tile[bound][at]);
#else
  const auto load = [&](std::size_t box, std::size_t bound) HWY_ATTR { return fourOfBoxes(d, rows + 6 * box + bound); };
  const hn::Repartition<std::uint64_t, WorldTag<float>> twos;
  // Two bounds of boxes 0 and 1, and of 2 and 3.
  const auto store = [&](WorldFloats first, WorldFloats last, std::size_t bound) HWY_ATTR {
    const auto lower = hn::InterleaveLower(twos, hn::BitCast(twos, first), hn::BitCast(twos, last));
    const auto upper = hn::InterleaveUpper(twos, hn::BitCast(twos, first), hn::BitCast(twos, last));
    hn::StoreU(hn::BitCast(d, lower), d, &tile[bound][at]);
    hn::StoreU(hn::BitCast(d, upper), d, &tile[bound + 1][at]);
  };
  const WorldFloats fromFirst[4] = {load(0, 0), load(1, 0), load(2, 0), load(3, 0)};
  const WorldFloats toLast[4] = {load(0, 2), load(1, 2), load(2, 2), load(3, 2)};
  const auto lower = [&](const WorldFloats* boxes) HWY_ATTR { return hn::InterleaveLower(d, boxes[0], boxes[1]); };
  const auto upper = [&](const WorldFloats* boxes) HWY_ATTR { return hn::InterleaveUpper(d, boxes[0], boxes[1]); };
  store(lower(fromFirst), lower(fromFirst + 2), 0);
  store(upper(fromFirst), upper(fromFirst + 2), 2);
  store(upper(toLast), upper(toLast + 2), 4);
#endif
}

/// The same of corners in an array of their own.
HWY_INLINE void readCornersOfThree(const float* corners, WorldTile<float>& tile, std::size_t bound, std::size_t at) {
  const WorldTag<float> d;
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t axis = 0; axis < 3; ++axis) hn::StoreU(hn::LoadU(d, corners + axis), d, &tile[bound + axis][at]);
#else
  WorldFloats corner[3];
  hn::LoadInterleaved3(d, corners, corner[0], corner[1], corner[2]);
  for (std::size_t axis = 0; axis < 3; ++axis) hn::StoreU(corner[axis], d, &tile[bound + axis][at]);
#endif
}

/// As many boxes as a vector has lanes, as they are, to places from `at` on.
HWY_INLINE void readCorners(const float* min, const float* max, std::size_t stride, WorldTile<float>& tile,
                            std::size_t at) {
  if (stride == 6) {
    readRowsOfSix(min, tile, at);
  } else {
    readCornersOfThree(min, tile, 0, at);
    readCornersOfThree(max, tile, 3, at);
  }
}

/// The same for a world's first vector, of which the places before `skipped` lie before all boxes in memory.
HWY_INLINE void readFirstCorners(const WorldsRun& run, std::size_t skipped, std::size_t boxes, WorldTile<float>& tile,
                                 std::size_t at) {
  std::array<float, 6 * kFanOut> copy{};
  float* const min = copy.data();
  float* const max = run.boxes.stride == 3 ? min + 3 * kFanOut : min + 3;
  for (std::size_t i = 0; i < boxes; ++i) {
    std::copy_n(run.boxes.min + i * run.boxes.stride, 3, min + (skipped + i) * run.boxes.stride);
    std::copy_n(run.boxes.max + i * run.boxes.stride, 3, max + (skipped + i) * run.boxes.stride);
  }
  readCorners(min, max, run.boxes.stride, tile, at);
}

/// A world's boxes; what is in front of them in memory comes along.
HWY_INLINE void readWorld(const WorldsRun& run, std::size_t firstBox, const WorldPlaces& places,
                          WorldTile<float>& tile) {
  const std::size_t lanes = hn::Lanes(WorldTag<float>());
  std::size_t at = places.first / lanes * lanes;
  const std::size_t skipped = places.first - at;
  if (firstBox < skipped) {
    // Boxes that precede the world are in the vector too, but not as many as it has room for.
    readFirstCorners(run, skipped - firstBox, firstBox + lanes - skipped, tile, at);
    at += lanes;
  }
  for (; at < places.end; at += lanes) {
    const std::size_t from = (firstBox + at - places.first) * run.boxes.stride;
    readCorners(run.boxes.min + from, run.boxes.max + from, run.boxes.stride, tile, at);
  }
}

/// Prefetches, line by line, what is read a page later: the processor's own prefetching ends with a page.
HWY_INLINE void prefetchAfter(const WorldsRun& run, std::size_t box, std::size_t boxes) {
  const std::size_t begin = box * run.boxes.stride + 4096 / sizeof(float);
  const std::size_t end = std::min(begin + boxes * run.boxes.stride, run.worlds->begin(run.end) * run.boxes.stride);
  for (std::size_t i = begin; i < end; i += 64 / sizeof(float)) {
    hwy::Prefetch(run.boxes.min + i);
    if (run.boxes.stride == 3) hwy::Prefetch(run.boxes.max + i);
  }
}

/// Worlds without a filter whose pairs are wanted by their first boxes have a loop of their own.
template <bool kPreceding, bool kPlain>
HWY_INLINE void searchRun(WorldsRun& run) {
  alignas(64) WorldTile<float> tile;
  WorldSink sink = run.sink;
  for (; run.world < run.end; ++run.world) {
    const std::size_t first = run.worlds->begin(run.world);
    const std::size_t boxes = run.worlds->begin(run.world + 1) - first;
    if (boxes > run.mostBoxes || !sink.takes(boxes)) break;
    const WorldPlaces places = WorldPlaces::of(boxes);
    prefetchAfter(run, first + boxes, boxes);
    readWorld(run, first, places, tile);
    const BoundsTest<float> test(tile);
    if constexpr (kPlain) {
      searchWorld<kPreceding, false>(test, places, {places}, sink);
    } else {
      searchSome<kPreceding>(test, places, {places, run.sink.allowed, nullptr}, sink);
    }
    run.pairEnd[run.world] = sink.size;
    run.boxTests += WorldSink::pairsOf(boxes);
  }
  run.sink = sink;
}

void searchWorlds(WorldsRun& run) {
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
  if (!world.hasMargins && world.distance == 0.0) {
    searchSome<kPreceding>(BoundsTest<double>(world.tile), places, partners, sink);
  } else {
    searchSome<kPreceding>(WideTest<kPreceding>(world), places, partners, sink);
  }
}

void searchWideWorld(const WideWorld& world, WorldSink& sink) {
  sink.bySecond ? searchWide<true>(world, sink) : searchWide<false>(world, sink);
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_WORLDS_KERNEL_INL_H
