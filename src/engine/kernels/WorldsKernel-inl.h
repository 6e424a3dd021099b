// SPDX-License-Identifier: MIT
// The exhaustive search of many small worlds: hits of each box as bits, and then pairs of bits. Vectors do the one, other
// units of the processor the other, so that they overlap.

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
#include <cstring>
#include <utility>

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

/// Boxes of float32, or of float64, against each other: exact, and empty boxes hit nothing.
template <class T>
class BoundsTest {
 public:
  using D = hn::CappedTag<T, kFanOut>;

  HWY_INLINE explicit BoundsTest(const WorldTile<T>& tile) : m_tile(tile) {}

  /// The boxes that rows are tested against.
  HWY_INLINE void setColumns(std::size_t place) {
    for (std::size_t bound = 0; bound < 6; ++bound) m_columns[bound] = hn::LoadU(D(), &m_tile[bound][place]);
  }

  [[nodiscard]] HWY_INLINE hn::Mask<D> hits(std::size_t row) const {
    const auto at = [&](std::size_t bound) HWY_ATTR { return hn::Set(D(), m_tile[bound][row]); };
    const auto x = hn::Le(hn::Max(m_columns[0], at(0)), hn::Min(m_columns[3], at(3)));
    const auto xy = meetsAlso(x, m_columns[1], m_columns[4], at(1), at(4));
    return meetsAlso(xy, m_columns[2], m_columns[5], at(2), at(5));
  }

 private:
  const WorldTile<T>& m_tile;
  hn::Vec<D> m_columns[6];
};

/// Boxes in double, apart as the contract says it: if a minimum exceeds the other's maximum plus the distance of the two.
/// Where that sum is NaN they are not apart. Whether a box is empty is the caller's to say.
template <bool kPreceding>
class WideTest {
 public:
  using D = DoubleTag;

  HWY_INLINE explicit WideTest(const WideWorld& world) : m_world(world) {}

  HWY_INLINE void setColumns(std::size_t place) { m_place = place; }

  [[nodiscard]] HWY_INLINE hn::Mask<D> hits(std::size_t row) const {
    const D d;
    const auto far = distance(row);
    const auto apartOn = [&](std::size_t axis) HWY_ATTR {
      const WorldTile<double>& bound = m_world.tile;
      const auto min = hn::LoadU(d, &bound[axis][m_place]);
      const auto max = hn::LoadU(d, &bound[axis + 3][m_place]);
      return hn::Or(hn::Gt(hn::Set(d, bound[axis][row]), hn::Add(max, far)),
                    hn::Gt(min, hn::Add(hn::Set(d, bound[axis + 3][row]), far)));
    };
    return hn::Not(hn::Or(hn::Or(apartOn(0), apartOn(1)), apartOn(2)));
  }

 private:
  /// The distance of the row and each column, margins added from the first box to the second.
  [[nodiscard]] HWY_INLINE hn::Vec<D> distance(std::size_t row) const {
    const D d;
    const auto given = hn::Set(d, m_world.distance);
    if (!m_world.hasMargins) return given;
    const auto own = hn::Set(d, m_world.margins[row]);
    const auto other = hn::LoadU(d, &m_world.margins[m_place]);
    return kPreceding ? hn::Add(hn::Add(given, other), own) : hn::Add(hn::Add(given, own), other);
  }

  const WideWorld& m_world;
  std::size_t m_place = 0;
};

/// Stores the hits of a row among these columns, of a wide vector.
template <class Test>
HWY_INLINE void storeHits(Test& test, std::size_t row, std::size_t columns, std::uint8_t* bytes) {
  using D = typename Test::D;
  const D d;
  if constexpr (hn::MaxLanes(D()) >= 8) {
    hn::StoreMaskBits(d, test.hits(row), bytes);
  } else {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 8; i += hn::MaxLanes(D())) {
      test.setColumns(columns + i);
      bits |= bitsOf(d, test.hits(row)) << i;
    }
    *bytes = static_cast<std::uint8_t>(bits);
  }
}

/// The hits of the rows of a word from the one of `begin` on, by place, with the boxes that follow, or precede them. Hits
/// with others are stored too, or what was there before, and so are those of a few rows before.
template <bool kPreceding, class Test>
HWY_INLINE void testRows(Test test, const WorldPlaces& places, std::size_t begin, WorldHits& hits) {
  // Columns that a row is tested against at once: as many as a vector has, and no fewer than hits make a byte.
  constexpr std::size_t kStep = std::max<std::size_t>(8, hn::MaxLanes(typename Test::D()));
  const std::size_t firstOfWord = begin / kWordBoxes * kWordBoxes;
  const std::size_t end = firstOfWord + kWordBoxes;
  const std::size_t stop = kPreceding ? end : places.end;
  const std::size_t rowBytes = places.words * sizeof(std::uint64_t);
  auto* const words = reinterpret_cast<std::uint8_t*>(hits.data());
  for (std::size_t columns = (kPreceding ? places.first : begin) / kStep * kStep; columns < stop; columns += kStep) {
    test.setColumns(columns);
    std::size_t row = (kPreceding ? std::max(begin, columns) : begin) / kRowsAtOnce * kRowsAtOnce;
    const std::size_t endRow = kPreceding ? end : std::min(end, columns + kStep);
    std::uint8_t* bytes = words + (row - firstOfWord) * rowBytes + columns / 8;
    for (; row < endRow; row += kRowsAtOnce, bytes += kRowsAtOnce * rowBytes) {
      storeHits(test, row, columns, bytes);
      storeHits(test, row + 1, columns, bytes + rowBytes);
      storeHits(test, row + 2, columns, bytes + 2 * rowBytes);
      storeHits(test, row + 3, columns, bytes + 3 * rowBytes);
    }
  }
}

/// A pair as one number, so that it is written at once.
HWY_INLINE std::uint64_t packed(std::uint32_t first, std::uint32_t second) {
  if (std::endian::native != std::endian::little) std::swap(first, second);
  return std::uint64_t{second} << 32 | first;
}

/// The position of the lowest bit; any number if there is none.
HWY_INLINE std::uint32_t lowestBit(std::uint64_t bits) {
#if HWY_TARGET <= HWY_AVX2 && HWY_ARCH_X86_64
  return static_cast<std::uint32_t>(_tzcnt_u64(bits));
#else
  return static_cast<std::uint32_t>(std::countr_zero(bits | std::uint64_t{1} << 63));  // spares a test for no bits
#endif
}

/// Writes the pairs of a box with those of a word: the first few without asking whether there are as many, which would be
/// mispredicted too often. Returns how many there are.
template <bool kPreceding, std::size_t kUnasked>
HWY_INLINE std::size_t writeBits(std::uint64_t bits, std::uint32_t box, std::uint32_t firstOfWord, Pair* pairs) {
  // Of the others: where there are many, a tenth of the time of all (few_benchmark).
  constexpr std::size_t kAtOnce = 4;
  static_assert(std::max(kUnasked, kAtOnce) <= WorldSink::kSlack && sizeof(Pair) == sizeof(std::uint64_t));
  const auto count = static_cast<std::size_t>(std::popcount(bits));
  const auto writeNext = [&](std::size_t i) HWY_ATTR {
    const std::uint32_t other = firstOfWord + lowestBit(bits);
    const std::uint64_t both = kPreceding ? packed(other, box) : packed(box, other);
    std::memcpy(static_cast<void*>(pairs + i), &both, sizeof(both));
    // Compilers would collect several in a vector, which takes longer; not across this, which is no instruction.
    std::atomic_signal_fence(std::memory_order_acq_rel);
    bits &= bits - 1;
  };
  const auto writeSeveral = [&]<std::size_t... kIndex>(std::size_t begin, std::index_sequence<kIndex...>) HWY_ATTR {
    (writeNext(begin + kIndex), ...);
  };
  writeSeveral(0, std::make_index_sequence<kUnasked>());
  for (std::size_t i = kUnasked; i < count; i += kAtOnce) writeSeveral(i, std::make_index_sequence<kAtOnce>());
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

/// The hits of rows in [begin, end) as pairs. With kUnasked pairs of a word that are written unasked; 0 counts pairs only.
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

/// All pairs of one world. Of worlds of one word most rows have hits in it; of larger ones few words have more than two.
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

/// As many boxes as a vector has lanes, from corners that follow each other, as they are, to places from `at` on.
HWY_INLINE void readCorners(const float* min, const float* max, std::size_t stride, WorldTile<float>& tile,
                            std::size_t at) {
  const FloatTag d;
  FloatVector lower[3];
  FloatVector upper[3];
#if HWY_TARGET == HWY_SCALAR
  static_cast<void>(stride);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lower[axis] = hn::LoadU(d, min + axis);
    upper[axis] = hn::LoadU(d, max + axis);
  }
#else
  if (stride == 3) {
    hn::LoadInterleaved3(d, min, lower[0], lower[1], lower[2]);
    hn::LoadInterleaved3(d, max, upper[0], upper[1], upper[2]);
  } else {
    // Corners alternate between minimum and maximum.
    FloatVector first[3];
    FloatVector last[3];
    hn::LoadInterleaved3(d, min, first[0], first[1], first[2]);
    hn::LoadInterleaved3(d, min + 3 * hn::Lanes(d), last[0], last[1], last[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = hn::ConcatEven(d, last[axis], first[axis]);
      upper[axis] = hn::ConcatOdd(d, last[axis], first[axis]);
    }
  }
#endif
  for (std::size_t axis = 0; axis < 3; ++axis) {
    hn::StoreU(lower[axis], d, &tile[axis][at]);
    hn::StoreU(upper[axis], d, &tile[axis + 3][at]);
  }
}

/// The same for a world's first vector, of which the places before `skipped` lie before all boxes in memory.
HWY_INLINE void readFirstCorners(const WorldsRun& run, std::size_t skipped, std::size_t boxes, WorldTile<float>& tile,
                                 std::size_t at) {
  std::array<float, 6 * kFanOut> copy{};
  float* const min = copy.data();
  float* const max = run.stride == 3 ? min + 3 * kFanOut : min + 3;
  for (std::size_t i = 0; i < boxes; ++i) {
    std::copy_n(run.min + i * run.stride, 3, min + (skipped + i) * run.stride);
    std::copy_n(run.max + i * run.stride, 3, max + (skipped + i) * run.stride);
  }
  readCorners(min, max, run.stride, tile, at);
}

/// A world's boxes; what is in front of them in memory comes along.
HWY_INLINE void readWorld(const WorldsRun& run, std::size_t firstBox, const WorldPlaces& places,
                          WorldTile<float>& tile) {
  const std::size_t lanes = hn::Lanes(FloatTag());
  std::size_t at = places.first / lanes * lanes;
  const std::size_t skipped = places.first - at;
  if (firstBox < skipped) {
    // Boxes that precede the world are in the vector too, but not as many as it has room for.
    readFirstCorners(run, skipped - firstBox, firstBox + lanes - skipped, tile, at);
    at += lanes;
  }
  for (; at < places.end; at += lanes) {
    const std::size_t from = (firstBox + at - places.first) * run.stride;
    readCorners(run.min + from, run.max + from, run.stride, tile, at);
  }
}

/// Prefetches, line by line, what is read a page later: the processor's own prefetching ends with a page.
HWY_INLINE void prefetchAfter(const WorldsRun& run, std::size_t box, std::size_t boxes) {
  const std::size_t begin = box * run.stride + 4096 / sizeof(float);
  const std::size_t end = std::min(begin + boxes * run.stride, run.worlds->begin(run.end) * run.stride);
  for (std::size_t i = begin; i < end; i += 64 / sizeof(float)) {
    hwy::Prefetch(run.min + i);
    if (run.stride == 3) hwy::Prefetch(run.max + i);
  }
}

/// Worlds without a filter whose pairs are wanted by their first boxes have a loop of their own.
template <bool kPreceding, bool kPlain>
HWY_INLINE void searchRun(WorldsRun& run) {
  alignas(64) WorldTile<float> tile;
  const BoundsTest<float> test(tile);
  WorldSink sink = run.sink;
  for (; run.world < run.end; ++run.world) {
    const std::size_t first = run.worlds->begin(run.world);
    const std::size_t boxes = run.worlds->begin(run.world + 1) - first;
    if (boxes > run.mostBoxes || !sink.takes(boxes)) break;
    const WorldPlaces places = WorldPlaces::of(boxes);
    prefetchAfter(run, first + boxes, boxes);
    readWorld(run, first, places, tile);
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
