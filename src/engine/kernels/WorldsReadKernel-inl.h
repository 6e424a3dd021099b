// SPDX-License-Identifier: MIT
// The boxes of a small world from the caller's memory to a row for each bound, as they are or, of float64, as the
// nearest float32.

#if defined(ALLPAIRS_WORLDS_READ_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_WORLDS_READ_KERNEL_INL_H
#undef ALLPAIRS_WORLDS_READ_KERNEL_INL_H
#else
#define ALLPAIRS_WORLDS_READ_KERNEL_INL_H
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "hwy/cache_control.h"
#include "kernels/LaneTest-inl.h"
#include "kernels/WorldsRun.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// Boxes that a row is tested against at once: as many as hits make a byte.
constexpr std::size_t kColumnsAtOnce = 8;

/// Of float32 vectors of 32 bytes, although AVX-512 has longer ones: a processor that cuts those in two spends units on
/// broadcasts to them that it does not on these, and fewer of the boxes tested precede the row (worlds_benchmark).
template <class T>
using WorldTag = hn::CappedTag<T, kColumnsAtOnce>;
using WorldFloats = hn::Vec<WorldTag<float>>;

/// What boxes are tested as first: without vectors float32 takes no less time than float64.
template <class T>
using LaneOf = std::conditional_t<HWY_TARGET == HWY_SCALAR, T, float>;

/// Whether empty boxes are marked when they are read, so that minima can be compared with the others' maxima: six
/// comparisons, none of which waits for another. With AVX-512, where fewer comparisons are made at a time but combine
/// masks as well, and everywhere where hits that are certain are told apart, the greater minima are compared with the
/// lesser maxima, which takes three and needs no marks (few_benchmark, worlds_benchmark).
constexpr bool kMarksEmpty = HWY_TARGET > HWY_AVX3;

/// Vectors that boxes are read by: float64 by no more than are stored as a vector of float32.
template <class T>
using ReadTag = hn::CappedTag<T, 32 / sizeof(T)>;
using DoublesRead = ReadTag<double>;

#if HWY_TARGET != HWY_SCALAR

/// The 16 bytes of a box of a row of six, and if there are lanes for them those of a later box, as many boxes after it
/// as 16 bytes have values.
template <class D>
HWY_INLINE hn::Vec<D> blockOfBoxes(D d, const hn::TFromD<D>* values) {
  if constexpr (sizeof(hn::TFromD<D>) * hn::MaxLanes(D()) == 16) {
    return hn::LoadU(d, values);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, hn::LoadU(half, values + 6 * hn::Lanes(half)), hn::LoadU(half, values));
  }
}

#endif

/// As many boxes as a vector has lanes, from rows of six that follow each other.
HWY_INLINE void readRowsOfSix(const float* rows, WorldTile<float>& tile, std::size_t at) {
  const WorldTag<float> d;
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t bound = 0; bound < 6; ++bound) hn::StoreU(hn::LoadU(d, rows + bound), d, &tile[bound][at]);
#else
  const auto load = [&](std::size_t box, std::size_t bound)
                        HWY_ATTR { return blockOfBoxes(d, rows + 6 * box + bound); };
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

/// As many values of float64 as a vector has lanes, as they are or as the nearest float32, which is finite: what is
/// larger would signal an overflow.
template <class D>
HWY_INLINE void storeAs(D d, hn::Vec<D> values, hn::TFromD<D>* to) {
  hn::StoreU(values, d, to);
}
HWY_INLINE void storeAs(DoublesRead /*d*/, hn::Vec<DoublesRead> values, float* to) {
  const DoublesRead d;
  const hn::Rebind<float, DoublesRead> floats;
  const auto most = hn::Set(d, static_cast<double>(hwy::HighestValue<float>()));
#if HWY_TARGET <= HWY_AVX3
  const hn::Vec<DoublesRead> finite{_mm256_range_pd(values.raw, most.raw, 2)};  // The lesser one, without its sign.
#else
  const auto finite = hn::Max(hn::Min(values, most), hn::Neg(most));
#endif
  hn::StoreU(hn::DemoteTo(floats, finite), floats, to);
}

template <class Lane>
HWY_INLINE void readRowsOfSix(const double* rows, WorldTile<Lane>& tile, std::size_t at) {
  const DoublesRead d;
  for (std::size_t end = at + hn::Lanes(WorldTag<Lane>()); at < end; at += hn::Lanes(d), rows += 6 * hn::Lanes(d)) {
    for (std::size_t bound = 0; bound < 6; bound += 2) {
#if HWY_TARGET == HWY_SCALAR
      storeAs(d, hn::LoadU(d, rows + bound), &tile[bound][at]);
      storeAs(d, hn::LoadU(d, rows + bound + 1), &tile[bound + 1][at]);
#else
      const auto even = blockOfBoxes(d, rows + bound);
      const auto odd = blockOfBoxes(d, rows + 6 + bound);
      storeAs(d, hn::InterleaveLower(d, even, odd), &tile[bound][at]);
      storeAs(d, hn::InterleaveUpper(d, even, odd), &tile[bound + 1][at]);
#endif
    }
  }
}

/// The same of corners in an array of their own.
template <class T, class Lane>
HWY_INLINE void readCornersOfThree(const T* corners, WorldTile<Lane>& tile, std::size_t bound, std::size_t at) {
  const ReadTag<T> d;
  for (std::size_t end = at + hn::Lanes(WorldTag<Lane>()); at < end; at += hn::Lanes(d), corners += 3 * hn::Lanes(d)) {
#if HWY_TARGET == HWY_SCALAR
    for (std::size_t axis = 0; axis < 3; ++axis) storeAs(d, hn::LoadU(d, corners + axis), &tile[bound + axis][at]);
#else
    hn::Vec<ReadTag<T>> corner[3];
    hn::LoadInterleaved3(d, corners, corner[0], corner[1], corner[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) storeAs(d, corner[axis], &tile[bound + axis][at]);
#endif
  }
}

/// As many boxes as a vector has lanes, as they are, to places from `at` on.
template <class T, class Lane>
HWY_INLINE void readCorners(const T* min, const T* max, std::size_t stride, WorldTile<Lane>& tile, std::size_t at) {
  if (stride == 6) {
    readRowsOfSix(min, tile, at);
  } else {
    readCornersOfThree(min, tile, 0, at);
    readCornersOfThree(max, tile, 3, at);
  }
}

/// The same of fewer boxes than a vector has lanes, to the last of its places; zeros to those in front.
template <class T, class Lane>
HWY_INLINE void readFewCorners(const BoxRun<T>& boxes, WorldTile<Lane>& tile, std::size_t at) {
  std::array<T, 6 * kColumnsAtOnce> copy{};
  T* const max = copy.data() + (boxes.stride == 3 ? 3 * kColumnsAtOnce : 3);
  const std::size_t first = (hn::Lanes(WorldTag<Lane>()) - boxes.size) * boxes.stride;
  std::copy_n(boxes.min, boxes.size * boxes.stride, copy.data() + first);
  if (boxes.stride == 3) std::copy_n(boxes.max, boxes.size * 3, max + first);
  readCorners(copy.data(), max, boxes.stride, tile, at);
}

/// Gives empty boxes a minimum of which no comparison with a maximum is true: infinity where bounds were rounded, and
/// so are finite; else NaN, since a maximum may be infinite.
template <class T, class Lane>
HWY_INLINE void markEmpty(WorldTile<Lane>& tile, std::size_t begin, std::size_t end) {
  using Limits = std::numeric_limits<Lane>;
  const WorldTag<Lane> d;
  const auto mark = hn::Set(d, std::is_same_v<T, Lane> ? Limits::quiet_NaN() : Limits::infinity());
  for (std::size_t at = begin; at < end; at += hn::Lanes(d)) {
    const auto isEmptyOn = [&](std::size_t axis) HWY_ATTR {
      return hn::Gt(hn::Load(d, &tile[axis][at]), hn::Load(d, &tile[axis + 3][at]));
    };
    const auto isEmpty = hn::Or(hn::Or(isEmptyOn(0), isEmptyOn(1)), isEmptyOn(2));
    hn::Store(hn::IfThenElse(isEmpty, mark, hn::Load(d, &tile[0][at])), d, &tile[0][at]);
  }
}

/// A world's boxes. What is in front of them in memory comes along, or where there is too little what follows its first
/// box.
template <class T, class Lane>
HWY_INLINE void readWorld(const BoxRun<T>& boxes, std::size_t firstBox, const WorldPlaces& places,
                          WorldTile<Lane>& tile) {
  const std::size_t lanes = hn::Lanes(WorldTag<Lane>());
  const auto read = [&](std::size_t box, std::size_t at) HWY_ATTR {
    const std::size_t from = box * boxes.stride;
    readCorners(boxes.min + from, boxes.max + from, boxes.stride, tile, at);
  };
  const std::size_t begin = places.first / lanes * lanes;
  std::size_t at = begin;
  if (firstBox < places.first - begin) {
    if (boxes.size - firstBox < lanes) {
      readFewCorners(boxes.part(firstBox, places.boxes()), tile, begin);
    } else {
      read(firstBox, begin);
      read(firstBox, places.first);
    }
    at += lanes;
  }
  for (; at < places.end(); at += lanes) read(firstBox + at - places.first, at);
  if (kMarksEmpty) markEmpty<T>(tile, begin, places.end());
}

/// Prefetches, line by line, what is read a page later: the processor's own prefetching ends with a page.
template <class T>
HWY_INLINE void prefetchAfter(const WorldsRun<T>& run, std::size_t box, std::size_t boxes) {
  const std::size_t begin = box * run.boxes.stride + 4096 / sizeof(T);
  const std::size_t end = std::min(begin + boxes * run.boxes.stride, run.worlds->begin(run.end) * run.boxes.stride);
  for (std::size_t i = begin; i < end; i += 64 / sizeof(T)) {
    hwy::Prefetch(run.boxes.min + i);
    if (run.boxes.stride == 3) hwy::Prefetch(run.boxes.max + i);
  }
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_WORLDS_READ_KERNEL_INL_H
