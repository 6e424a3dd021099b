// SPDX-License-Identifier: MIT
// One row against a stretch of columns: the loop in which the engine spends its time.

#if defined(ALLPAIRS_ROW_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_ROW_KERNEL_INL_H
#undef ALLPAIRS_ROW_KERNEL_INL_H
#else
#define ALLPAIRS_ROW_KERNEL_INL_H
#endif

#include "LaneTest-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// Takes the hits of one row as ids of row and partner.
struct HitWriter {
  Hits& hits;
  std::uint32_t* HWY_RESTRICT rows;
  std::uint32_t* HWY_RESTRICT partners;
  std::uint32_t rowId;
  std::size_t size;

  HWY_INLINE HitWriter(Hits& target, std::uint32_t id)
      : hits(target), rows(target.row), partners(target.partner), rowId(id), size(target.size) {}
  HWY_INLINE void take(FloatMask mask, const std::uint32_t* ids) {
    const IdTag d;
    hn::StoreU(hn::Set(d, rowId), d, rows + size);
    size += storeSelected(mask, ids, partners + size);
  }
  HWY_INLINE void finish() { hits.size = size; }
};

/// Takes the number of hits only.
struct HitCounter {
  Hits& hits;
  std::size_t size = 0;

  HWY_INLINE HitCounter(Hits& target, std::uint32_t /*id*/) : hits(target) {}
  HWY_INLINE void take(FloatMask mask, const std::uint32_t* /*ids*/) { size += hn::CountTrue(FloatTag(), mask); }
  HWY_INLINE void finish() { hits.count += size; }
};

/// Takes the partners only, into a list of its own.
struct PartnerWriter {
  std::uint32_t* partners;
  std::size_t size;

  HWY_INLINE void take(FloatMask mask, const std::uint32_t* ids) { size += storeSelected(mask, ids, partners + size); }
};

/// The hits of a query in the vector at i, of which only the columns in [begin, end) count.
template <class Tile, class Taker>
HWY_INLINE void takePart(const Query& q, const Tile& columns, std::size_t i, std::size_t begin, std::size_t end,
                         Taker& taker) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  FloatMask mask = overlapping(q, columns.bound, i);
  if (begin > i) mask = hn::AndNot(hn::FirstN(d, begin - i), mask);
  if (end < i + lanes) mask = hn::And(hn::FirstN(d, end - i), mask);
  taker.take(mask, &columns.id[i]);
}

/// Four whole vectors from i on, with one branch for the four of them, since most often none has a hit.
template <class Tile, class Taker>
HWY_INLINE void takeFour(const Query& q, const Tile& columns, std::size_t i, Taker& taker) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  const FloatMask m0 = overlapping(q, columns.bound, i);
  const FloatMask m1 = overlapping(q, columns.bound, i + lanes);
  const FloatMask m2 = overlapping(q, columns.bound, i + 2 * lanes);
  const FloatMask m3 = overlapping(q, columns.bound, i + 3 * lanes);
  if (hn::AllFalse(d, hn::Or(hn::Or(m0, m1), hn::Or(m2, m3)))) return;
  taker.take(m0, &columns.id[i]);
  taker.take(m1, &columns.id[i + lanes]);
  taker.take(m2, &columns.id[i + 2 * lanes]);
  taker.take(m3, &columns.id[i + 3 * lanes]);
}

/// How likely a vector is to have a hit.
enum class Density { Sparse, Dense };

/// All hits of a query among the columns [begin, end) of a tile, in order.
template <Density kDensity, class Tile, class Taker>
HWY_INLINE void takeRow(const Query& q, const Tile& columns, std::size_t begin, std::size_t end, Taker& taker) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = begin / lanes * lanes;
  if (i < begin) {
    takePart(q, columns, i, begin, end, taker);
    i += lanes;
  }
  if constexpr (kDensity == Density::Sparse) {
    for (; i + 4 * lanes <= end; i += 4 * lanes) takeFour(q, columns, i, taker);
  }
  for (; i + lanes <= end; i += lanes) taker.take(overlapping(q, columns.bound, i), &columns.id[i]);
  if (i < end) takePart(q, columns, i, begin, end, taker);
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_ROW_KERNEL_INL_H
