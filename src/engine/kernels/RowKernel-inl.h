// SPDX-License-Identifier: MIT
// One row against a stretch of columns: the loop in which the engine spends its time.

#if defined(ALLPAIRS_ROW_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_ROW_KERNEL_INL_H
#undef ALLPAIRS_ROW_KERNEL_INL_H
#else
#define ALLPAIRS_ROW_KERNEL_INL_H
#endif

#include <bit>

#include "allpairs/Pair.h"
#include "kernels/Hits.h"
#include "kernels/LaneTest-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// Emits hits as two ids each: one that all hits of a vector share, and the partner's; writes whole vectors.
struct HitWriter {
  std::uint32_t* HWY_RESTRICT shared;
  std::uint32_t* HWY_RESTRICT own;
  std::size_t size;
  std::uint32_t sharedId = 0;

  /// A row against its columns, or the boxes of a leaf against a partner.
  static HWY_INLINE HitWriter ofRow(const Hits& hits, std::uint32_t row) {
    return {hits.row, hits.partner, hits.size, row};
  }
  static HWY_INLINE HitWriter ofLeaf(const Hits& hits) { return {hits.partner, hits.row, hits.size}; }

  /// certain() has the lanes that overlap whatever the rounding was; called only where that matters.
  template <class Certain>
  HWY_INLINE void emit(FloatMask mask, hn::Vec<IdTag> ids, const Certain& /*certain*/) {
    const IdTag d;
    const auto selected = hn::RebindMask(d, mask);
    hn::StoreU(hn::Set(d, sharedId), d, shared + size);
    hn::StoreU(hn::Compress(ids, selected), d, own + size);
    size += hn::CountTrue(d, selected);
  }
  HWY_INLINE void finish(Hits& hits) const { hits.size = size; }
};

/// Emits hits, and notes which of them need a test in double.
struct DoubtWriter : HitWriter {
  std::uint32_t* HWY_RESTRICT doubt;
  std::size_t doubts;

  static HWY_INLINE DoubtWriter ofRow(const Hits& hits, std::uint32_t row) {
    return {HitWriter::ofRow(hits, row), hits.doubt, hits.doubts};
  }
  static HWY_INLINE DoubtWriter ofLeaf(const Hits& hits) { return {HitWriter::ofLeaf(hits), hits.doubt, hits.doubts}; }

  template <class Certain>
  HWY_INLINE void emit(FloatMask mask, hn::Vec<IdTag> ids, const Certain& certain) {
    const FloatTag d;
    if (hn::AllFalse(d, mask)) return;
    const FloatMask doubtful = hn::AndNot(certain(), mask);
    if (!hn::AllFalse(d, doubtful)) note(bitsOf(d, mask), bitsOf(d, doubtful));
    HitWriter::emit(mask, ids, certain);
  }
  HWY_INLINE void finish(Hits& hits) const {
    HitWriter::finish(hits);
    hits.doubts = doubts;
  }

 private:
  void note(std::uint32_t lanes, std::uint32_t doubtful) {
    for (; doubtful != 0; doubtful &= doubtful - 1) {
      const std::uint32_t before = lanes & ((doubtful & (0U - doubtful)) - 1U);
      doubt[doubts++] = static_cast<std::uint32_t>(size) + static_cast<std::uint32_t>(std::popcount(before));
    }
  }
};

/// Counts hits.
struct HitCounter {
  std::size_t size = 0;
  std::uint32_t sharedId = 0;

  static HWY_INLINE HitCounter ofRow(const Hits& /*hits*/, std::uint32_t /*row*/) { return {}; }
  static HWY_INLINE HitCounter ofLeaf(const Hits& /*hits*/) { return {}; }
  template <class Certain>
  HWY_INLINE void emit(FloatMask mask, hn::Vec<IdTag> /*ids*/, const Certain& /*certain*/) {
    size += hn::CountTrue(FloatTag(), mask);
  }
  HWY_INLINE void finish(Hits& hits) const { hits.count += size; }
};

/// Emits the partners only, into a list of its own.
struct PartnerWriter {
  std::uint32_t* partners;
  std::size_t size;

  template <class Certain>
  HWY_INLINE void emit(FloatMask mask, hn::Vec<IdTag> ids, const Certain& /*certain*/) {
    const IdTag d;
    const auto selected = hn::RebindMask(d, mask);
    hn::StoreU(hn::Compress(ids, selected), d, partners + size);
    size += hn::CountTrue(d, selected);
  }
};

/// Emits the hits of a query in the vector at i.
template <class Tile, class Emitter>
HWY_INLINE void emitHits(const Query& q, const Tile& columns, std::size_t i, FloatMask mask, Emitter& emitter) {
  emitter.emit(mask, hn::LoadU(IdTag(), &columns.id[i]),
               [&]() HWY_ATTR { return overlapping(inward(q), columns.bound, i); });
}

/// The hits of a query in the vector at i, of which only the columns in [begin, end) count.
template <class Tile, class Emitter>
HWY_INLINE void emitPart(const Query& q, const Tile& columns, std::size_t i, std::size_t begin, std::size_t end,
                         Emitter& emitter) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  FloatMask mask = overlapping(q, columns.bound, i);
  if (begin > i) mask = hn::AndNot(hn::FirstN(d, begin - i), mask);
  if (end < i + lanes) mask = hn::And(hn::FirstN(d, end - i), mask);
  emitHits(q, columns, i, mask, emitter);
}

/// Four whole vectors from i on, with one branch for the four of them, since most often none has a hit.
template <class Tile, class Emitter>
HWY_INLINE void emitFour(const Query& q, const Tile& columns, std::size_t i, Emitter& emitter) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  const FloatMask m0 = overlapping(q, columns.bound, i);
  const FloatMask m1 = overlapping(q, columns.bound, i + lanes);
  const FloatMask m2 = overlapping(q, columns.bound, i + 2 * lanes);
  const FloatMask m3 = overlapping(q, columns.bound, i + 3 * lanes);
  if (hn::AllFalse(d, hn::Or(hn::Or(m0, m1), hn::Or(m2, m3)))) return;
  emitHits(q, columns, i, m0, emitter);
  emitHits(q, columns, i + lanes, m1, emitter);
  emitHits(q, columns, i + 2 * lanes, m2, emitter);
  emitHits(q, columns, i + 3 * lanes, m3, emitter);
}

/// How likely a vector is to have a hit.
enum class Density { Sparse, Dense };

/// All hits of a query among the columns [begin, end) of a tile, in order.
template <Density kDensity, class Tile, class Emitter>
HWY_INLINE void emitRow(const Query& q, const Tile& columns, std::size_t begin, std::size_t end, Emitter& emitter) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = begin / lanes * lanes;
  if (i < begin) {
    emitPart(q, columns, i, begin, end, emitter);
    i += lanes;
  }
  if constexpr (kDensity == Density::Sparse) {
    for (; i + 4 * lanes <= end; i += 4 * lanes) emitFour(q, columns, i, emitter);
  }
  for (; i + lanes <= end; i += lanes) emitHits(q, columns, i, overlapping(q, columns.bound, i), emitter);
  if (i < end) emitPart(q, columns, i, begin, end, emitter);
}

/// Pairs are written a vector at a time, up to Hits::kSlack pairs past the end.
void writePairs(const Hits& hits, PairSide side, Pair* pairs) {
  static_assert(sizeof(Pair) == 2 * sizeof(std::uint32_t));
  const IdTag d;
  auto* to = reinterpret_cast<std::uint32_t*>(pairs);
  for (std::size_t i = 0; i < hits.size; i += hn::Lanes(d)) {
    const auto row = hn::LoadU(d, hits.row + i);
    const auto partner = hn::LoadU(d, hits.partner + i);
    switch (side) {
      case PairSide::RowFirst:
        hn::StoreInterleaved2(row, partner, d, to + 2 * i);
        break;
      case PairSide::RowSecond:
        hn::StoreInterleaved2(partner, row, d, to + 2 * i);
        break;
      case PairSide::SmallerFirst:
        hn::StoreInterleaved2(hn::Min(row, partner), hn::Max(row, partner), d, to + 2 * i);
        break;
    }
  }
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_ROW_KERNEL_INL_H
