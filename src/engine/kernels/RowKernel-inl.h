// SPDX-License-Identifier: MIT
// One row against a stretch of columns: the loop in which the engine spends its time.

#if defined(ALLPAIRS_ROW_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_ROW_KERNEL_INL_H
#undef ALLPAIRS_ROW_KERNEL_INL_H
#else
#define ALLPAIRS_ROW_KERNEL_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "allpairs/Pair.h"
#include "kernels/Hits.h"
#include "kernels/Kernels.h"
#include "kernels/LaneTest-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// Emits hits as two ids each: one that all hits of a vector share, and the partner's; writes whole vectors.
struct HitWriter {
  std::uint32_t* HWY_RESTRICT shared;
  std::uint32_t* HWY_RESTRICT own;
  std::size_t size;
  std::uint32_t commonId = 0;

  /// A row against its columns, or the boxes of a leaf against a partner.
  static HWY_INLINE HitWriter ofRow(const Hits& hits, std::uint32_t row) {
    return {hits.row, hits.partner, hits.size, row};
  }
  static HWY_INLINE HitWriter ofLeaf(const Hits& hits) { return {hits.partner, hits.row, hits.size}; }

  HWY_INLINE void share(std::uint32_t id) { commonId = id; }

  /// `test` identifies the vector among those since the emitter was made.
  HWY_INLINE void emit(FloatMask mask, hn::Vec<IdTag> ids, std::uint32_t /*test*/) {
    const IdTag d;
    hn::StoreU(hn::Set(d, commonId), d, shared + size);
    size += storeSelected(d, ids, hn::RebindMask(d, mask), own + size);
  }

  /// certainOf(test) has the lanes that overlap whatever the rounding was.
  template <class CertainOf>
  HWY_INLINE void finish(Hits& hits, const CertainOf& /*certainOf*/) const {
    hits.size = size;
  }
};

/// Boxes of a hierarchy that a leaf is compared with at once: their hits fit the buffer.
constexpr std::size_t kStretch = 64;

/// Emits hits, and then the positions of those that need a test in double. It keeps the vectors with hits until the
/// end: a branch for each would be mispredicted too often.
class DoubtWriter {
 public:
  static HWY_INLINE DoubtWriter ofRow(const Hits& hits, std::uint32_t row) { return {HitWriter::ofRow(hits, row)}; }
  static HWY_INLINE DoubtWriter ofLeaf(const Hits& hits) { return {HitWriter::ofLeaf(hits)}; }

  HWY_INLINE void share(std::uint32_t id) { m_writer.share(id); }

  HWY_INLINE void emit(FloatMask mask, hn::Vec<IdTag> ids, std::uint32_t test) {
    const FloatTag d;
    Touched& touched = m_touched[m_count];
    touched = {test, static_cast<std::uint32_t>(m_writer.size), {}};
    hn::StoreMaskBits(d, mask, touched.lanes.data());
    m_count += hn::AllFalse(d, mask) ? 0U : 1U;
    m_writer.emit(mask, ids, test);
  }

  template <class CertainOf>
  HWY_INLINE void finish(Hits& hits, const CertainOf& certainOf) {
    m_writer.finish(hits, certainOf);
    for (std::size_t i = 0; i < m_count; ++i) {
      const std::uint32_t lanes = m_touched[i].lanes[0] | static_cast<std::uint32_t>(m_touched[i].lanes[1]) << 8U;
      std::uint32_t doubtful = lanes & ~bitsOf(FloatTag(), certainOf(m_touched[i].test));
      if (doubtful == lanes) {  // as where the faces of a lattice touch
        hn::StoreU(numbersFrom(m_touched[i].begin), IdTag(), hits.doubt + hits.doubts);
        hits.doubts += static_cast<std::size_t>(std::popcount(lanes));
        continue;
      }
      for (; doubtful != 0; doubtful &= doubtful - 1) {
        const std::uint32_t before = lanes & ((doubtful & (0U - doubtful)) - 1U);
        hits.doubt[hits.doubts++] = m_touched[i].begin + static_cast<std::uint32_t>(std::popcount(before));
      }
    }
  }

 private:
  /// A vector with hits: the position of the first of them, and their lanes as bits.
  struct Touched {
    std::uint32_t test;
    std::uint32_t begin;
    std::array<std::uint8_t, 8> lanes;
  };

  HWY_INLINE DoubtWriter(const HitWriter& writer) : m_writer(writer) {}

  HitWriter m_writer;
  std::size_t m_count = 0;
  /// Not initialised: few are used. At most the columns of a tile, or a leaf against a stretch, in vectors of one lane.
  std::array<Touched, std::max(LaneTile::kCapacity, kStretch* kFanOut) + 1> m_touched;
};

/// Counts hits.
struct HitCounter {
  std::size_t size = 0;

  static HWY_INLINE HitCounter ofRow(const Hits& /*hits*/, std::uint32_t /*row*/) { return {}; }
  static HWY_INLINE HitCounter ofLeaf(const Hits& /*hits*/) { return {}; }
  HWY_INLINE void share(std::uint32_t /*id*/) {}
  HWY_INLINE void emit(FloatMask mask, hn::Vec<IdTag> /*ids*/, std::uint32_t /*test*/) {
    size += hn::CountTrue(FloatTag(), mask);
  }
  template <class CertainOf>
  HWY_INLINE void finish(Hits& hits, const CertainOf& /*certainOf*/) const {
    hits.count += size;
  }
};

/// Emits the partners only, into a list of its own.
struct PartnerWriter {
  std::uint32_t* partners;
  std::size_t size;

  HWY_INLINE void emit(FloatMask mask, hn::Vec<IdTag> ids, std::uint32_t /*test*/) {
    const IdTag d;
    size += storeSelected(d, ids, hn::RebindMask(d, mask), partners + size);
  }
};

/// The hits of a query in the vector at i, of which only the columns in [begin, end) count.
template <class Tile, class Emitter>
HWY_INLINE void emitPart(const Query& q, const Tile& columns, std::size_t i, std::size_t begin, std::size_t end,
                         Emitter& emitter) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  FloatMask mask = overlapping(q, columns.bound, i);
  if (begin > i) mask = hn::AndNot(hn::FirstN(d, begin - i), mask);
  if (end < i + lanes) mask = hn::And(hn::FirstN(d, end - i), mask);
  emitter.emit(mask, hn::LoadU(IdTag(), &columns.id[i]), static_cast<std::uint32_t>(i));
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
  emitter.emit(m0, hn::LoadU(IdTag(), &columns.id[i]), static_cast<std::uint32_t>(i));
  emitter.emit(m1, hn::LoadU(IdTag(), &columns.id[i + lanes]), static_cast<std::uint32_t>(i + lanes));
  emitter.emit(m2, hn::LoadU(IdTag(), &columns.id[i + 2 * lanes]), static_cast<std::uint32_t>(i + 2 * lanes));
  emitter.emit(m3, hn::LoadU(IdTag(), &columns.id[i + 3 * lanes]), static_cast<std::uint32_t>(i + 3 * lanes));
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
  for (; i + lanes <= end; i += lanes) {
    emitter.emit(overlapping(q, columns.bound, i), hn::LoadU(IdTag(), &columns.id[i]), static_cast<std::uint32_t>(i));
  }
  if (i < end) emitPart(q, columns, i, begin, end, emitter);
}

/// Pairs are written a vector at a time, up to kVectorSlack pairs past the end.
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

/// Calls write(place, key, other) for each number. Its place is what its rank says: how many of its row are less. The
/// rows after it are greater, so that whole vectors count.
template <class Write>
HWY_INLINE void placeByRank(const NumberRows& rows, const Write& write) {
  const hn::RebindToSigned<IdTag> d;
  const std::size_t lanes = hn::Lanes(d);
  auto* const numbers = reinterpret_cast<std::int32_t*>(rows.numbers);
  hn::StoreU(hn::Set(d, std::numeric_limits<std::int32_t>::max()), d, numbers + rows.size);
  const std::uint32_t otherMask = (std::uint32_t{1} << rows.otherBits) - 1;
  for (std::size_t i = 0; i < rows.size; ++i) {
    const std::uint32_t number = rows.numbers[i];
    const std::uint32_t key = number >> rows.otherBits;
    const auto compared = hn::Set(d, static_cast<std::int32_t>(number));
    const std::size_t end = rows.begin[key + 1];
    std::size_t at = rows.begin[key];
    std::size_t place = at;
    do {
      place += hn::CountTrue(d, hn::Lt(hn::LoadU(d, numbers + at), compared));
      at += lanes;
    } while (at < end);
    write(place, key, number & otherMask);
  }
}

void orderRows(const NumberRows& rows, Pair* to) {
  const std::uint32_t firstKey = rows.firstKey;
  if (rows.bySecond) {
    placeByRank(rows, [=](std::size_t place, std::uint32_t key, std::uint32_t other) HWY_ATTR {
      to[place] = {other, firstKey + key};
    });
  } else {
    placeByRank(rows, [=](std::size_t place, std::uint32_t key, std::uint32_t other) HWY_ATTR {
      to[place] = {firstKey + key, other};
    });
  }
}

void orderPartners(const NumberRows& rows, std::uint32_t* to) {
  placeByRank(rows, [=](std::size_t place, std::uint32_t /*key*/, std::uint32_t other) HWY_ATTR { to[place] = other; });
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_ROW_KERNEL_INL_H
