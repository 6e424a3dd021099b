// SPDX-License-Identifier: MIT
// The join of two hierarchies: each node of the first is tested against the list of nodes of the second that overlap
// it.

#if defined(ALLPAIRS_JOIN_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ALLPAIRS_JOIN_KERNEL_INL_H
#undef ALLPAIRS_JOIN_KERNEL_INL_H
#else
#define ALLPAIRS_JOIN_KERNEL_INL_H
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <numeric>
#include <span>

#include "kernels/Kernels.h"
#include "kernels/ReadKernel-inl.h"
#include "kernels/RowKernel-inl.h"
#include "memory/Platform.h"

HWY_BEFORE_NAMESPACE();
namespace allpairs::engine::HWY_NAMESPACE {
namespace {  // Each file that compiles the kernels has its own.

/// A leaf block with the caller's ids of its boxes; bounds and ids as vectors too, to be held in registers.
struct Leaf {
  static constexpr std::size_t kVectors = kFanOut / hn::MaxLanes(FloatTag());

  const LaneBlock& block;
  const std::uint32_t* ids;
  std::size_t fill;
  FloatVector bound[6][kVectors];
  hn::Vec<IdTag> id[kVectors];

  HWY_INLINE Leaf(const BvhView& bvh, std::size_t number)
      : block(bvh.level[0].blocks[number]), ids(bvh.ids + number * kFanOut), fill(bvh.level[0].fill(number)) {
    const FloatTag d;
    for (std::size_t v = 0; v < kVectors; ++v) {
      for (std::size_t row = 0; row < 6; ++row) bound[row][v] = hn::Load(d, &block.bound[row][v * hn::Lanes(d)]);
      id[v] = hn::LoadU(IdTag(), ids + v * hn::Lanes(d));
    }
  }

  /// The boxes of vector v, as the tests of lanes take them.
  [[nodiscard]] HWY_INLINE auto vectors(std::size_t v) const {
    return [this, v](std::size_t k) HWY_ATTR { return bound[k][v]; };
  }
};

/// The pairs within a leaf, each once: a box against those after it.
template <class Emitter>
HWY_INLINE void selfJoin(const Leaf& leaf, Hits& hits) {
  const FloatTag d;
  if (!hits.countOnly) hits.require(kFanOut * kFanOut);
  Emitter emitter = Emitter::ofLeaf(hits);
  for (std::size_t lane = 0; lane + 1 < leaf.fill; ++lane) {
    emitter.share(leaf.ids[lane]);
    const Query q = broadcast(leaf.block.get(lane));
    for (std::size_t v = 0; v < Leaf::kVectors; ++v) {
      const std::size_t first = v * hn::Lanes(d);
      const std::size_t before = lane + 1 > first ? std::min(lane + 1 - first, hn::Lanes(d)) : 0;
      const FloatMask mask = hn::AndNot(hn::FirstN(d, before), overlapping(q, leaf.vectors(v)));
      emitter.emit(mask, leaf.id[v], static_cast<std::uint32_t>(lane * Leaf::kVectors + v));
    }
  }
  emitter.finish(hits, [&](std::size_t test) HWY_ATTR {
    const Query q = broadcast(leaf.block.get(test / Leaf::kVectors));
    return overlappingForCertain(q, hits.slack, leaf.vectors(test % Leaf::kVectors));
  });
}

/// The boxes of a leaf, which stay in registers, against the boxes at some positions of another hierarchy, one by one.
///
/// Testing rows of the leaf against a list of candidates would require gathering the candidates' bounds first.
template <class Emitter>
HWY_INLINE void crossJoin(const Leaf& leaf, const BvhView& other, std::span<const std::uint32_t> places, Hits& hits) {
  const LaneBlock* blocks = other.level[0].blocks;
  const auto queryAt = [&](std::size_t place)
                           HWY_ATTR { return broadcast(blocks[place / kFanOut].get(place % kFanOut)); };
  for (std::size_t begin = 0; begin < places.size(); begin += kStretch) {
    const std::size_t size = std::min(places.size() - begin, kStretch);
    if (!hits.countOnly) hits.require(kStretch * kFanOut);
    Emitter emitter = Emitter::ofLeaf(hits);
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t place = places[begin + i];
      emitter.share(other.ids[place]);
      const Query q = queryAt(place);
      for (std::size_t v = 0; v < Leaf::kVectors; ++v) {
        emitter.emit(overlapping(q, leaf.vectors(v)), leaf.id[v], static_cast<std::uint32_t>(i * Leaf::kVectors + v));
      }
    }
    emitter.finish(hits, [&](std::size_t test) HWY_ATTR {
      const Query q = queryAt(places[begin + test / Leaf::kVectors]);
      return overlappingForCertain(q, hits.slack, leaf.vectors(test % Leaf::kVectors));
    });
  }
}

HWY_INLINE void prefetchBlock(const LaneBlock& block) {
  for (const auto& row : block.bound) prefetchLine(row.data());
}

/// Appends the members of block b of a level, in the vector at `lane`, that the mask selects to a tile of so many: as
/// lanes and node numbers, in whole vectors. Returns how many there are now.
HWY_INLINE std::size_t append(const Level& level, std::size_t b, std::size_t lane, FloatMask mask, LaneTile& tile,
                              std::size_t size) {
  const FloatTag d;
  const IdTag di;
  for (std::size_t row = 0; row < 6; ++row) {
    const auto bounds = hn::Load(d, &level.blocks[b].bound[row][lane]);
    hn::StoreU(selectedLanes(d, bounds, mask), d, &tile.bound[row][size]);
  }
  return size + storeSelected(di, numbersFrom(b * kFanOut + lane), hn::RebindMask(di, mask), &tile.id[size]);
}

/// Appends the members of block b that overlap the query.
HWY_INLINE std::size_t appendTouching(const Query& q, const Level& level, std::size_t b, LaneTile& tile,
                                      std::size_t size) {
  for (std::size_t lane = 0; lane < kFanOut; lane += hn::Lanes(FloatTag())) {
    size = append(level, b, lane, overlapping(q, level.blocks[b].bound, lane), tile, size);
  }
  return size;
}

/// Appends all members of block b to an empty tile, so that in a self-join member i of a node is candidate i of its own
/// list.
HWY_INLINE std::size_t appendAll(const Level& level, std::size_t b, LaneTile& tile) {
  const FloatTag d;
  const std::size_t fill = level.fill(b);
  std::size_t size = 0;
  for (std::size_t lane = 0; lane < fill; lane += hn::Lanes(d)) {
    size = append(level, b, lane, hn::FirstN(d, std::min(fill - lane, hn::Lanes(d))), tile, size);
  }
  return size;
}

/// One run of a task: the state that its functions share.
class JoinRun {
 public:
  JoinRun(const JoinTask& task, Hits& hits) : m_task(task), m_hits(hits) {}

  void run() {
    const std::size_t top = m_task.first->depth - 1;
    const std::uint32_t root = 0;
    const LaneBox everything{{-kLaneMax, -kLaneMax, -kLaneMax, kLaneMax, kLaneMax, kLaneMax}};
    descend(top, 0, everything, &root, 1);
  }

 private:
  // Depth is at most kMaxLevels, whatever the input.
  // NOLINTNEXTLINE(misc-no-recursion)
  void descend(std::size_t level, std::size_t node, const LaneBox& bounds, const std::uint32_t* partners,
               std::size_t count) {
    if (level == 0) {
      m_hits.countOnly          ? joinLeaf<HitCounter>(node, bounds, partners, count)
      : m_hits.doubt != nullptr ? joinLeaf<DoubtWriter>(node, bounds, partners, count)
                                : joinLeaf<HitWriter>(node, bounds, partners, count);
      return;
    }
    gather(level, bounds, partners, count);
    if (level == 1 && m_task.lists != nullptr) {
      listNeighbors(node, bounds);
      return;
    }
    const std::size_t span = std::size_t{1} << (4 * (level - 1));
    const Level& children = m_task.first->level[level];
    const std::size_t begin = std::max(node * kFanOut, m_task.leafBegin / span);
    const std::size_t end = std::min(node * kFanOut + children.fill(node), (m_task.leafEnd + span - 1) / span);
    for (std::size_t child = begin; child < end; ++child) meetChild(level, node, child);
  }

  /// The children, on `level`, of the partners of a node that overlap the node, in tiles.
  void gather(std::size_t level, const LaneBox& bounds, const std::uint32_t* partners, std::size_t count) {
    const Level& source = m_task.second->level[level];
    JoinScratch::PerLevel& scratch = m_task.scratch->level[level];
    const Query q = broadcast(bounds);
    scratch.tileCount = 0;
    for (std::size_t i = 0; i < count;) {
      LaneTile& tile = scratch.nextTile();
      std::size_t size = m_task.withItself && i == 0 ? appendAll(source, partners[i++], tile) : 0;
      // A tile is full when another block might not fit.
      for (; i < count && size + kFanOut <= LaneTile::kCapacity; ++i) {
        size = appendTouching(q, source, partners[i], tile, size);
      }
      scratch.sizes[scratch.tileCount - 1] = size;
    }
    m_hits.groupTests += count * kFanOut;
  }

  /// Finds the partners of one child among the candidates of its node, and descends into the child.
  // NOLINTNEXTLINE(misc-no-recursion)
  void meetChild(std::size_t level, std::size_t node, std::size_t child) {
    JoinScratch::PerLevel& scratch = m_task.scratch->level[level];
    const LaneBox bounds = m_task.first->level[level].blocks[node].get(child - node * kFanOut);
    const Query q = broadcast(bounds);
    PartnerWriter partners{scratch.roomFor(scratch.tileCount * LaneTile::kCapacity + 1 + kVectorSlack), 0};
    std::size_t begin = 0;
    if (m_task.withItself) {
      partners.partners[partners.size++] = static_cast<std::uint32_t>(child);
      begin = child - node * kFanOut + 1;
    }
    for (std::size_t t = 0; t < scratch.tileCount; ++t) {
      emitRow<Density::Dense>(q, scratch.tiles[t][0], begin, scratch.sizes[t], partners);
      m_hits.groupTests += scratch.sizes[t] - begin;
      begin = 0;
    }
    if (partners.size != 0) descend(level - 1, child, bounds, partners.partners, partners.size);
  }

  /// The boxes of one leaf block against the boxes of its partners.
  template <class Emitter>
  void joinLeaf(std::size_t node, const LaneBox& bounds, const std::uint32_t* partners, std::size_t count) {
    std::uint32_t* const places = m_task.scratch->level[0].roomFor((count + 1) * kFanOut + kVectorSlack);
    const std::size_t own = m_task.withItself ? 1 : 0;
    const std::size_t size = listTouching(bounds, {partners + own, count - own}, places);
    const Leaf leaf(*m_task.first, node);
    if (m_task.withItself) selfJoin<Emitter>(leaf, m_hits);
    crossJoin<Emitter>(leaf, *m_task.second, {places, size}, m_hits);
    m_hits.groupTests += count * kFanOut;
    m_hits.boxTests += (size + (m_task.withItself ? kFanOut / 2 : 0)) * leaf.fill;
  }

  /// Lists the positions of the boxes, in blocks of the second hierarchy, that overlap the bounds; returns their
  /// number.
  std::size_t listTouching(const LaneBox& bounds, std::span<const std::uint32_t> blocks, std::uint32_t* places) {
    const IdTag d;
    const std::size_t lanes = hn::Lanes(d);
    const LaneBlock* source = m_task.second->level[0].blocks;
    const Query q = broadcast(bounds);
    std::size_t size = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      prefetchBlock(source[blocks[std::min(i + kPrefetchDistance, blocks.size() - 1)]]);
      const std::size_t first = blocks[i] * kFanOut;
      for (std::size_t lane = 0; lane < kFanOut; lane += lanes) {
        const auto touching = hn::RebindMask(d, overlapping(q, source[blocks[i]].bound, lane));
        size += storeSelected(d, numbersFrom(first + lane), touching, places + size);
      }
    }
    return size;
  }

  /// The partners of the boxes of a node on level 1, box by box.
  ///
  /// The boxes near the node are put in the order of their ids once, so that every list is in order.
  void listNeighbors(std::size_t node, const LaneBox& bounds) {
    JoinScratch& scratch = *m_task.scratch;
    const std::span<const std::uint32_t> blocks = gatheredBlocks(scratch.level[1]);
    std::uint32_t* const places = scratch.level[0].roomFor((blocks.size() + 1) * kFanOut + kVectorSlack);
    readInOrder({places, listTouching(bounds, blocks, places)});
    m_hits.groupTests += blocks.size() * kFanOut;
    const Level& leaves = m_task.first->level[1];
    const std::size_t begin = std::max(node * kFanOut, m_task.leafBegin);
    const std::size_t end = std::min(node * kFanOut + leaves.fill(node), m_task.leafEnd);
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      const LaneBox leafBounds = leaves.blocks[node].get(leaf - node * kFanOut);
      m_task.lists->kept == Columns::All         ? listLeaf<Columns::All>(leaf, leafBounds)
      : m_task.lists->kept == Columns::Others    ? listLeaf<Columns::Others>(leaf, leafBounds)
      : m_task.lists->kept == Columns::Following ? listLeaf<Columns::Following>(leaf, leafBounds)
                                                 : listLeaf<Columns::Preceding>(leaf, leafBounds);
    }
  }

  /// The numbers of the blocks in all tiles of a level.
  static std::span<const std::uint32_t> gatheredBlocks(JoinScratch::PerLevel& level) {
    const std::size_t size = std::accumulate(
        level.sizes.begin(), level.sizes.begin() + static_cast<std::ptrdiff_t>(level.tileCount), std::size_t{0});
    std::uint32_t* const blocks = level.roomFor(size);
    std::uint32_t* to = blocks;
    for (std::size_t t = 0; t < level.tileCount; ++t) to = std::copy_n(level.tiles[t][0].id.data(), level.sizes[t], to);
    return {blocks, size};
  }

  /// Reads the boxes at some positions of the second hierarchy, in the order of their ids.
  void readInOrder(std::span<const std::uint32_t> places) {
    const BvhView& second = *m_task.second;
    JoinScratch& near = *m_task.scratch;
    const std::size_t size = places.size();
    if (2 * size > near.keys.capacity()) near.keys.require(4 * size);
    near.requireNear(size);
    std::uint64_t* keys = near.keys.data();
    for (std::size_t i = 0; i < size; ++i) keys[i] = std::uint64_t{second.ids[places[i]]} << 32U | places[i];
    keys = m_task.lists->sort(keys, keys + size, size, 32, 32 + m_task.lists->idBits);
    for (std::size_t i = 0; i < size; ++i) {
      const auto place = static_cast<std::uint32_t>(keys[i]);
      const LaneBox box = second.level[0].blocks[place / kFanOut].get(place % kFanOut);
      setBoxAt(near.bound, i, box);
      near.boxes[i] = {box, static_cast<std::uint32_t>(keys[i] >> 32U)};
    }
  }

  /// The boxes near the node that overlap the bounds of a leaf; returns their number.
  static std::size_t listNear(const LaneBox& bounds, const JoinScratch& near) {
    const FloatTag d;
    const IdTag di;
    const std::size_t lanes = hn::Lanes(d);
    const Query q = broadcast(bounds);
    std::uint32_t* const to = near.near.data();
    const std::array<float*, 6> bound = near.bound;  // In registers: `to` may be of anything.
    const std::size_t all = near.size;
    std::size_t size = 0;
    for (std::size_t i = 0; i < all; i += lanes) {
      FloatMask mask = overlapping(q, bound, i);
      if (all < i + lanes) mask = hn::And(hn::FirstN(d, all - i), mask);
      size += storeSelected(di, numbersFrom(i), hn::RebindMask(di, mask), to + size);
    }
    return size;
  }

  /// The partners of each box of a leaf. First come the hits, a bit for each box of the leaf, of one box near it after
  /// the other; then the lists, since now the room that they take is known.
  template <Columns kKept>
  void listLeaf(std::size_t number, const LaneBox& bounds) {
    const Leaf leaf(*m_task.first, number);
    writeLists(leaf, findHits<kKept>(leaf, bounds));
  }

  /// Notes which boxes of a leaf each box near it overlaps, and makes room for their lists; returns how many boxes near
  /// it overlap some.
  template <Columns kKept>
  HWY_INLINE std::size_t findHits(const Leaf& leaf, const LaneBox& bounds) {
    const IdTag d;
    JoinScratch& near = *m_task.scratch;
    const std::size_t size = listNear(bounds, near);
    const std::uint32_t* const places = near.near.data();
    std::uint32_t* HWY_RESTRICT const hitBits = near.hitBits.data();
    std::uint32_t* HWY_RESTRICT const hitIds = near.hitIds.data();
    const bool notesDoubts = m_task.lists->tested == NeighborLists::Tested::InDoubt;
    const NumberedBox* HWY_RESTRICT const boxes = near.boxes.data();
    Doubts doubts;
    std::size_t hits = 0;
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint32_t id = boxes[places[i]].id;
      const Query q = broadcast(boxes[places[i]].box);
      std::uint32_t bits = 0;
      for (std::size_t v = 0; v < Leaf::kVectors; ++v) {
        auto mask = hn::RebindMask(d, overlapping(q, leaf.vectors(v)));
        if constexpr (kKept == Columns::Others) mask = hn::And(mask, hn::Ne(leaf.id[v], hn::Set(d, id)));
        if constexpr (kKept == Columns::Following) mask = hn::And(mask, hn::Lt(leaf.id[v], hn::Set(d, id)));
        if constexpr (kKept == Columns::Preceding) mask = hn::And(mask, hn::Gt(leaf.id[v], hn::Set(d, id)));
        bits |= allBitsOf(d, mask) << (v * hn::Lanes(d));
      }
      hitBits[hits] = bits;
      hitIds[hits] = id;
      if (notesDoubts) {
        std::uint32_t doubtful = bits & ~certainBits(leaf, q, m_task.lists->slack);
        for (; doubtful != 0; doubtful &= doubtful - 1) {
          if (doubts.size == doubts.pairs.size()) doubts.settle(*m_task.lists, hitBits);
          doubts.add(leaf, hits, id, static_cast<std::uint32_t>(std::countr_zero(doubtful)));
        }
      }
      hits += bits != 0 ? 1U : 0U;
      pairs += static_cast<std::size_t>(std::popcount(bits));
    }
    if (doubts.size != 0) doubts.settle(*m_task.lists, hitBits);
    hn::StoreU(hn::Zero(d), d, hitBits + hits);  // The last vector of bits ends behind them.
    m_task.lists->require(pairs + kVectorSlack);
    m_hits.groupTests += near.size;
    m_hits.boxTests += size * leaf.fill;
    return hits;
  }

  /// Hits that lanes cannot decide, some at a time.
  struct Doubts {
    std::size_t size = 0;
    std::array<Pair, 8 * kFanOut> pairs;  ///< Of a row and a partner; not initialised, as what follows.
    std::array<std::uint32_t, 8 * kFanOut> hit;
    std::array<std::uint8_t, 8 * kFanOut> row;

    HWY_INLINE void add(const Leaf& leaf, std::size_t atHit, std::uint32_t partner, std::uint32_t ofRow) {
      pairs[size] = {leaf.ids[ofRow], partner};
      hit[size] = static_cast<std::uint32_t>(atHit);
      row[size++] = static_cast<std::uint8_t>(ofRow);
    }

    /// Deletes the bits of those that do not touch.
    void settle(NeighborLists& lists, std::uint32_t* hitBits) {
      std::array<std::uint32_t, 8 * kFanOut> found;
      const std::size_t count = lists.findApart(lists, pairs.data(), size, found.data());
      for (std::size_t i = 0; i < count; ++i) {
        hitBits[hit[found[i]]] &= ~(1U << row[found[i]]);
      }
      size = 0;
    }
  };

  /// Which boxes of a leaf overlap the query whatever the rounding was.
  static std::uint32_t certainBits(const Leaf& leaf, const Query& q, const LaneSlack& slack) {
    const FloatTag d;
    std::uint32_t bits = 0;
    for (std::size_t v = 0; v < Leaf::kVectors; ++v) {
      bits |= allBitsOf(d, overlappingForCertain(q, slack, leaf.vectors(v))) << (v * hn::Lanes(d));
    }
    return bits;
  }

  /// Collects the list of each box of a leaf from the hits.
  void writeLists(const Leaf& leaf, std::size_t hits) {
    const IdTag d;
    NeighborLists& lists = *m_task.lists;
    const std::uint32_t* const hitBits = m_task.scratch->hitBits.data();
    const std::uint32_t* const hitIds = m_task.scratch->hitIds.data();
    const bool areDoubtful = lists.tested == NeighborLists::Tested::All;
    for (std::size_t row = 0; row < leaf.fill; ++row) {
      const std::uint32_t id = leaf.ids[row];
      std::uint32_t* const to = lists.partners + lists.size;
      const auto bit = hn::Set(d, 1U << row);
      std::size_t size = 0;
      for (std::size_t i = 0; i < hits; i += hn::Lanes(d)) {
        const auto mask = hn::TestBit(hn::LoadU(d, hitBits + i), bit);
        size += storeSelected(d, hn::LoadU(d, hitIds + i), mask, to + size);
      }
      if (size != 0 && (areDoubtful || lists.filtered)) size = lists.select(lists, id, {to, size}, areDoubtful);
      lists.begin[id] = lists.base + lists.size;
      lists.length[id] = static_cast<std::uint32_t>(size);
      lists.size += size;
    }
  }

  const JoinTask& m_task;
  Hits& m_hits;
};

/// A hierarchy with levels of one node added on top, in other memory, until there are `depth`.
BvhView deepened(const BvhView& view, std::size_t depth, std::array<LaneBlock, kMaxLevels>& tops) {
  BvhView result = view;
  for (; result.depth < depth; ++result.depth) {
    LaneBlock& top = tops[result.depth];
    top.clear();
    boundBlocks(result.level[result.depth - 1].blocks, 0, 1, &top);
    result.level[result.depth] = {&top, 1};
  }
  return result;
}

void join(const JoinTask& task, Hits& hits) {
  if (task.first->depth == task.second->depth) {
    JoinRun(task, hits).run();
    return;
  }
  const bool isFirstLower = task.first->depth < task.second->depth;
  const BvhView& higher = isFirstLower ? *task.second : *task.first;
  std::array<LaneBlock, kMaxLevels> tops;
  const BvhView lower = deepened(isFirstLower ? *task.first : *task.second, higher.depth, tops);
  JoinTask same = task;
  same.first = isFirstLower ? &lower : &higher;
  same.second = isFirstLower ? &higher : &lower;
  JoinRun(same, hits).run();
}

}  // namespace
}  // namespace allpairs::engine::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ALLPAIRS_JOIN_KERNEL_INL_H
