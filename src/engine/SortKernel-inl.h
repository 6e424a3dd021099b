// SPDX-License-Identifier: MIT
// Puts pairs that are grouped by key in order.

#if defined(ALLPAIRS_SORT_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_SORT_KERNEL_INL_H
#undef ALLPAIRS_SORT_KERNEL_INL_H
#else
#define ALLPAIRS_SORT_KERNEL_INL_H
#endif

#include <algorithm>

#include "LaneTest-inl.h"
#include "PackedBucket.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

using IdVector = hn::Vec<IdTag>;

#if HWY_TARGET == HWY_SCALAR

void orderRows(const PackedBucket& bucket) { std::sort(bucket.values, bucket.values + bucket.size); }

#else

/// Exchanges neighbours that are in the wrong order, often enough for every key that has few pairs. No branches, and
/// numbers of different keys are in order already.
HWY_INLINE void exchangeNeighbours(const PackedBucket& bucket) {
  const IdTag d;
  const auto last = hn::Set(d, ~std::uint32_t{0});
  for (std::size_t i = 0; i < kMostInNetwork; i += hn::Lanes(d)) hn::StoreU(last, d, bucket.values + bucket.size + i);
  for (std::size_t pass = 0; pass < kMostExchanged; ++pass) {
    for (std::size_t i = pass % 2; i < bucket.size; i += hn::Lanes(d)) {
      const auto values = hn::LoadU(d, bucket.values + i);
      const auto others = hn::Shuffle2301(values);
      hn::StoreU(hn::OddEven(hn::Max(values, others), hn::Min(values, others)), d, bucket.values + i);
    }
  }
}

/// Lane i of the result is lane i ^ kDistance.
template <std::size_t kDistance>
HWY_INLINE IdVector exchanged(IdVector values) {
  const IdTag d;
  if constexpr (kDistance == 1) return hn::Shuffle2301(values);
  if constexpr (kDistance == 2) return hn::Shuffle1032(values);
  const auto lanes = hn::Xor(numbersFrom(0), hn::Set(d, static_cast<std::uint32_t>(kDistance)));
  return hn::TableLookupLanes(values, hn::IndicesFromVec(d, lanes));
}

/// Batcher's bitonic network over kSize numbers.
///
/// Reference: K. E. Batcher, "Sorting networks and their applications", AFIPS 1968.
template <std::size_t kSize>
class Network {
 public:
  /// Sorts `size` numbers of a row in place; those behind it may be read, and stay.
  static HWY_INLINE void sort(std::uint32_t* values, std::size_t size) {
    const IdTag d;
    IdVector lanes[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) {
      lanes[v] = hn::IfThenElse(ofRow(v, size), hn::LoadU(d, values + v * kLanes), hn::Set(d, ~std::uint32_t{0}));
    }
    merge<2, 1>(lanes);
    for (std::size_t v = 0; v < kVectors && v * kLanes < size; ++v) {
      const auto behind = hn::LoadU(d, values + v * kLanes);
      hn::StoreU(hn::IfThenElse(ofRow(v, size), lanes[v], behind), d, values + v * kLanes);
    }
  }

 private:
  static constexpr std::size_t kLanes = hn::MaxLanes(IdTag());
  static constexpr std::size_t kVectors = kSize / kLanes;

  static HWY_INLINE hn::Mask<IdTag> ofRow(std::size_t v, std::size_t size) {
    return hn::FirstN(IdTag(), size - std::min(size, v * kLanes));
  }

  /// Compares numbers kDistance apart; runs of kRun numbers ascend and descend in turns.
  template <std::size_t kRun, std::size_t kDistance>
  static HWY_INLINE void merge(IdVector (&lanes)[kVectors]) {
    for (std::size_t v = 0; v < kVectors; ++v) {
      if constexpr (kDistance >= kLanes) {
        const std::size_t w = v ^ (kDistance / kLanes);
        if (w > v) exchangeVectors(lanes[v], lanes[w], (v * kLanes & kRun) != 0);
      } else {
        lanes[v] = exchangeLanes<kRun, kDistance>(lanes[v], (v * kLanes & kRun) != 0);
      }
    }
    if constexpr (kDistance > 1) {
      merge<kRun, kDistance / 2>(lanes);
    } else if constexpr (kRun < kSize) {
      merge<2 * kRun, kRun>(lanes);
    }
  }

  static HWY_INLINE void exchangeVectors(IdVector& first, IdVector& second, bool descends) {
    const auto least = hn::Min(first, second);
    const auto greatest = hn::Max(first, second);
    first = descends ? greatest : least;
    second = descends ? least : greatest;
  }

  template <std::size_t kRun, std::size_t kDistance>
  static HWY_INLINE IdVector exchangeLanes(IdVector values, bool descends) {
    const IdTag d;
    const auto others = exchanged<kDistance>(values);
    const auto upper = hn::TestBit(numbersFrom(0), hn::Set(d, static_cast<std::uint32_t>(kDistance)));
    const auto least = hn::Min(values, others);
    const auto greatest = hn::Max(values, others);
    if constexpr (kRun >= kLanes) {
      return descends ? hn::IfThenElse(upper, least, greatest) : hn::IfThenElse(upper, greatest, least);
    } else {
      const auto turned = hn::TestBit(numbersFrom(0), hn::Set(d, static_cast<std::uint32_t>(kRun)));
      return hn::IfThenElse(hn::Xor(upper, turned), greatest, least);
    }
  }
};

void orderRows(const PackedBucket& bucket) {
  exchangeNeighbours(bucket);
  for (const PackedBucket::Row& row : bucket.rows) {
    std::uint32_t* values = bucket.values + row.begin;
    if (row.size <= 16) {
      Network<16>::sort(values, row.size);
    } else if (row.size <= 32) {
      Network<32>::sort(values, row.size);
    } else {
      Network<kMostInNetwork>::sort(values, row.size);
    }
  }
}

#endif

/// The numbers as pairs, from the last to the first: a pair may lie where its number and a later one have been.
void unpack(const PackedBucket& bucket) {
  const IdTag d;
  const std::size_t lanes = hn::Lanes(d);
  auto* to = reinterpret_cast<std::uint32_t*>(bucket.pairs);
  const std::uint32_t otherMask = (std::uint32_t{1} << bucket.otherBits) - 1;
  std::size_t i = bucket.size;
  for (; i % lanes != 0; --i) {
    const std::uint32_t value = bucket.values[i - 1];
    const std::uint32_t key = bucket.firstKey + (value >> bucket.otherBits);
    const std::uint32_t other = value & otherMask;
    bucket.pairs[i - 1] = bucket.bySecond ? Pair{other, key} : Pair{key, other};
  }
  const auto firstKey = hn::Set(d, bucket.firstKey);
  while (i > 0) {
    i -= lanes;
    const auto values = hn::LoadU(d, bucket.values + i);
    const auto keys = hn::Add(firstKey, hn::ShiftRightSame(values, static_cast<int>(bucket.otherBits)));
    const auto others = hn::And(values, hn::Set(d, otherMask));
    if (bucket.bySecond) {
      hn::StoreInterleaved2(others, keys, d, to + 2 * i);
    } else {
      hn::StoreInterleaved2(keys, others, d, to + 2 * i);
    }
  }
}

void finishBucket(const PackedBucket& bucket) {
  if (!bucket.isOrdered) orderRows(bucket);
  unpack(bucket);
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_SORT_KERNEL_INL_H
