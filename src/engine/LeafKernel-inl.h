// SPDX-License-Identifier: MIT
// The last step of a join: single boxes against the sixteen of a leaf block.

#if defined(ALLPAIRS_LEAF_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_LEAF_KERNEL_INL_H
#undef ALLPAIRS_LEAF_KERNEL_INL_H
#else
#define ALLPAIRS_LEAF_KERNEL_INL_H
#endif

#include <algorithm>
#include <array>
#include <span>

#include "Hits.h"
#include "Join.h"
#include "LaneTest-inl.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// A leaf block with the caller's ids of its boxes.
struct Leaf {
  const LaneBlock& block;
  const std::uint32_t* ids;
  std::size_t fill;
};

/// The bounds and ids of a leaf's boxes as vectors, to be held in registers.
struct LeafVectors {
  static constexpr std::size_t kLanes = hn::MaxLanes(FloatTag());
  static constexpr std::size_t kVectors = kFanOut / kLanes;

  FloatVector bound[6][kVectors];
  hn::Vec<IdTag> id[kVectors];

  HWY_INLINE explicit LeafVectors(const Leaf& leaf) {
    const FloatTag d;
    for (std::size_t v = 0; v < kVectors; ++v) {
      for (std::size_t row = 0; row < 6; ++row) bound[row][v] = hn::Load(d, &leaf.block.bound[row][v * kLanes]);
      id[v] = hn::LoadU(IdTag(), leaf.ids + v * kLanes);
    }
  }

  /// The boxes of vector v that overlap box `lane` of another block.
  [[nodiscard]] HWY_INLINE FloatMask overlappingWith(const LaneBlock& block, std::size_t lane, std::size_t v) const {
    const FloatTag d;
    const auto spread = [&](std::size_t row) HWY_ATTR { return hn::Set(d, block.bound[row][lane]); };
    const FloatMask x = meets(spread(0), spread(3), bound[0][v], bound[3][v]);
    const FloatMask xy = meetsAlso(x, spread(1), spread(4), bound[1][v], bound[4][v]);
    return meetsAlso(xy, spread(2), spread(5), bound[2][v], bound[5][v]);
  }
};

/// Stores hits as ids; writes whole vectors.
struct LeafHitWriter {
  std::uint32_t* HWY_RESTRICT rows;
  std::uint32_t* HWY_RESTRICT partners;
  std::size_t size;

  HWY_INLINE explicit LeafHitWriter(const Hits& hits) : rows(hits.row), partners(hits.partner), size(hits.size) {}
  HWY_INLINE void take(FloatMask mask, hn::Vec<IdTag> ids, std::uint32_t partner) {
    const IdTag d;
    const auto selected = hn::RebindMask(d, mask);
    hn::StoreU(hn::Set(d, partner), d, partners + size);
    hn::StoreU(hn::Compress(ids, selected), d, rows + size);
    size += hn::CountTrue(d, selected);
  }
  HWY_INLINE void finish(Hits& hits) const { hits.size = size; }
};

/// Counts hits.
struct LeafHitCounter {
  std::size_t size = 0;

  HWY_INLINE explicit LeafHitCounter(const Hits& /*hits*/) {}
  HWY_INLINE void take(FloatMask mask, hn::Vec<IdTag> /*ids*/, std::uint32_t /*partner*/) {
    size += hn::CountTrue(FloatTag(), mask);
  }
  HWY_INLINE void finish(Hits& hits) const { hits.count += size; }
};

/// The pairs within a leaf, each once: a box against those after it.
template <class Taker>
HWY_INLINE void meetItself(const Leaf& leaf, const LeafVectors& vectors, Hits& hits) {
  const FloatTag d;
  if (!hits.countOnly) hits.require(kFanOut * kFanOut);
  Taker taker(hits);
  for (std::size_t lane = 0; lane + 1 < leaf.fill; ++lane) {
    for (std::size_t v = 0; v < LeafVectors::kVectors; ++v) {
      const std::size_t first = v * LeafVectors::kLanes;
      const std::size_t before = lane + 1 > first ? std::min(lane + 1 - first, LeafVectors::kLanes) : 0;
      const FloatMask mask = hn::AndNot(hn::FirstN(d, before), vectors.overlappingWith(leaf.block, lane, v));
      taker.take(mask, vectors.id[v], leaf.ids[lane]);
    }
  }
  taker.finish(hits);
}

/// The boxes of a leaf, which stay in registers, against the boxes at some places of another hierarchy, one by one.
///
/// The other way round, rows of the leaf against a list of candidates, the candidates' bounds would have to be gathered
/// first.
template <class Taker>
HWY_INLINE void meetOthers(const LeafVectors& vectors, const Hierarchy& other, std::span<const std::uint32_t> places,
                           Hits& hits) {
  constexpr std::size_t kStretch = 64;
  const LaneBlock* blocks = other.level[0].blocks;
  const std::uint32_t* ids = other.ids;
  for (std::size_t i = 0; i < places.size();) {
    const std::size_t stop = std::min(places.size(), i + kStretch);
    if (!hits.countOnly) hits.require(kStretch * kFanOut);
    Taker taker(hits);
    for (; i < stop; ++i) {
      const std::size_t place = places[i];
      for (std::size_t v = 0; v < LeafVectors::kVectors; ++v) {
        taker.take(vectors.overlappingWith(blocks[place / kFanOut], place % kFanOut, v), vectors.id[v], ids[place]);
      }
    }
    taker.finish(hits);
  }
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_LEAF_KERNEL_INL_H
