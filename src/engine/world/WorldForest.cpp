// SPDX-License-Identifier: MIT
#include "world/WorldForest.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <utility>

#include "bvh/BvhLevels.h"
#include "bvh/HilbertSort.h"
#include "world/DynamicBvh.h"

namespace allpairs::engine {
namespace {

/// In worlds of up to this many boxes, eight blocks, most blocks overlap each other in any order (worlds_benchmark, whose worlds
/// of 64 boxes have none and of 200 have one).
constexpr std::size_t kFewInAnyOrder = 8 * kFanOut;

/// If the blocks of a world have become this many times as wide as when its boxes were last ordered, there is no order left: so
/// much wider are eight blocks in any order. Ordering the boxes and joining them then takes less time than joining them.
constexpr double kMostSpread = 2.0;

/// The blocks of all levels of a hierarchy.
std::size_t allBlocksFor(std::size_t boxes) {
  std::size_t blocks = 0;
  for (std::size_t count = blockCountFor(boxes); count > 0; count = count == 1 ? 0 : blockCountFor(count)) {
    blocks += count;
  }
  return blocks;
}

}  // namespace

std::uint64_t WorldForest::update(const BoxStore& store, const WorldMembers& members, const BoxReader& reader,
                                  Executor& executor) {
  const bool wasWhole = std::exchange(m_isWhole, false);
  for (const std::uint32_t world : m_dirty) m_marked[world] = 0;
  m_dirty.clear();
  if (wasWhole && (m_membership == store.membership() || follow(store, members))) {
    findDirty(store);
  } else {
    plant(store, members);
  }
  m_membership = store.membership();
  cutIntoRuns(
      m_dirty, [this](std::uint32_t world) { return m_trees[world].size; }, m_runs);
  std::atomic<std::uint64_t> orders = 0;
  executor.run(m_runs.size(), [&](std::size_t run) {
    for (std::size_t i = run == 0 ? 0 : m_runs[run - 1]; i < m_runs[run]; ++i) {
      if (refresh(m_dirty[i], store, reader)) ++orders;
    }
  });
  m_isExact = std::none_of(m_trees.begin(), m_trees.end(), [](const Tree& tree) { return tree.isInexact; });
  m_isWhole = true;
  return orders;
}

/// Gives a tree room at the end; it may have had some.
void WorldForest::giveRoom(Tree& tree) {
  m_wasted += tree.room;
  const bool hasOrder = tree.size > kFewInAnyOrder;
  tree.room = blockCountFor(tree.size + (hasOrder ? tree.size / kShareOfChange : 0));
  tree.firstBlock = m_endBlock;
  tree.firstLeaf = m_endLeaf;
  m_endBlock += allBlocksFor(tree.room * kFanOut);
  m_endLeaf += tree.room;
}

/// Allocates the room that trees have been given, the largest of which has so many boxes.
void WorldForest::requireRoom(std::size_t largest) {
  m_blocks.grow(m_endBlock);
  m_ids.grow(m_endLeaf * kFanOut);
  if (largest <= kFewInAnyOrder) return;
  m_keyed.require(m_ids.capacity());
  m_spare.require(m_ids.capacity());
}

void WorldForest::markDirty(std::size_t world) {
  if (std::exchange(m_marked[world], std::uint8_t{1}) == 0) m_dirty.push_back(static_cast<std::uint32_t>(world));
}

/// Lists all boxes, in the order of their ids.
void WorldForest::plant(const BoxStore& store, const WorldMembers& members) {
  const std::size_t worlds = members.everyWorld() + 1;
  m_trees.assign(worlds, {});
  m_marked.assign(worlds, 1);
  m_dirty.resize(worlds);
  std::iota(m_dirty.begin(), m_dirty.end(), 0U);
  m_home.assign(store.idBound(), WorldMembers::kNoWorld);
  m_endBlock = 0;
  m_endLeaf = 0;
  std::size_t largest = 0;
  for (std::size_t world = 0; world < worlds; ++world) {
    Tree& tree = m_trees[world];
    const std::span<const BoxId> boxes = members.boxes(world);
    const auto isMine = [&](BoxId id) { return belongs(store, id); };
    tree.number = members.numberOf(world);
    tree.size = static_cast<std::size_t>(std::count_if(boxes.begin(), boxes.end(), isMine));
    tree.listed = tree.size;
    giveRoom(tree);
    largest = std::max(largest, tree.size);
  }
  m_wasted = 0;
  requireRoom(largest);
  std::fill_n(m_ids.data(), m_endLeaf * kFanOut, 0U);
  for (std::size_t world = 0; world < worlds; ++world) {
    std::uint32_t* to = m_ids.data() + m_trees[world].firstLeaf * kFanOut;
    for (const BoxId id : members.boxes(world)) {
      if (!belongs(store, id)) continue;
      *to++ = id;
      m_home[id] = static_cast<std::uint32_t>(world);
    }
  }
}

/// Removes boxes that have gone from the trees, and appends those that have come. Returns false if it is better to build all
/// trees again: because many boxes came or went, or because trees that moved have left much memory unused.
bool WorldForest::follow(const BoxStore& store, const WorldMembers& members) {
  if (store.resettled().size() * kShareOfChange > store.size()) return false;
  m_home.resize(std::max(m_home.size(), store.idBound()), WorldMembers::kNoWorld);
  for (const BoxId id : store.resettled()) {
    if (m_home[id] == WorldMembers::kNoWorld) continue;
    Tree& tree = m_trees[m_home[id]];
    if (belongs(store, id) && tree.number == store.worldOf(id)) continue;
    m_home[id] = WorldMembers::kNoWorld;
    tree.isChanged = true;
    --tree.size;
  }
  renumber(members);
  const auto isNew = [&](BoxId id) { return m_home[id] == WorldMembers::kNoWorld && belongs(store, id); };
  for (const BoxId id : store.resettled()) {
    if (!isNew(id)) continue;
    Tree& tree = m_trees[members.worldOf(id)];
    tree.isChanged = true;
    ++tree.size;
  }
  std::size_t largest = 0;
  for (std::size_t world = 0; world < m_trees.size(); ++world) {
    Tree& tree = m_trees[world];
    largest = std::max(largest, tree.size);
    if (!tree.isChanged) continue;
    markDirty(world);
    const std::size_t before = tree.firstLeaf * kFanOut;
    if (blockCountFor(tree.size) > tree.room) {
      giveRoom(tree);
      m_ids.grow(m_endLeaf * kFanOut);
    }
    const std::span<const std::uint32_t> ids(m_ids.data() + before, tree.listed);
    std::uint32_t* const to = m_ids.data() + tree.firstLeaf * kFanOut;
    tree.listed = 0;
    for (const BoxId id : ids) {  // which may be where they go
      if (m_home[id] == world) to[tree.listed++] = id;
    }
    std::fill_n(to + tree.listed, tree.room * kFanOut - tree.listed, 0U);
  }
  requireRoom(largest);
  for (const BoxId id : store.resettled()) {
    if (!isNew(id)) continue;
    const std::size_t world = members.worldOf(id);
    Tree& tree = m_trees[world];
    m_ids[tree.firstLeaf * kFanOut + tree.listed++] = id;
    m_home[id] = static_cast<std::uint32_t>(world);
    ++tree.appended;
  }
  return m_wasted <= m_endLeaf / 2;
}

/// Has the trees follow the worlds, of which some may have come and others, without boxes now, gone.
void WorldForest::renumber(const WorldMembers& members) {
  const std::size_t worlds = members.everyWorld() + 1;
  const auto isSame = [&](const Tree& tree) {
    return tree.number == members.numberOf(static_cast<std::size_t>(&tree - m_trees.data()));
  };
  if (m_trees.size() == worlds && std::all_of(m_trees.begin(), m_trees.end(), isSame)) return;
  m_nextTrees.assign(worlds, {});
  std::size_t world = 0;
  for (std::size_t old = 0; old < m_trees.size(); ++old) {
    const Tree& tree = m_trees[old];
    for (; world < worlds && members.numberOf(world) < tree.number; ++world) {
      m_nextTrees[world].number = members.numberOf(world);
    }
    if (world == worlds || members.numberOf(world) != tree.number) {
      m_wasted += tree.room;
      continue;
    }
    m_nextTrees[world] = tree;
    const std::span<const std::uint32_t> ids(m_ids.data() + tree.firstLeaf * kFanOut, tree.listed);
    for (const BoxId id : ids) {
      if (m_home[id] != WorldMembers::kNoWorld) m_home[id] = static_cast<std::uint32_t>(world);
    }
    ++world;
  }
  std::swap(m_trees, m_nextTrees);
  m_marked.assign(worlds, 0);
}

/// Lists the worlds with boxes that have changed.
void WorldForest::findDirty(const BoxStore& store) {
  for (const BoxId id : store.stale()) {
    if (id >= m_home.size() || m_home[id] == WorldMembers::kNoWorld) continue;
    markDirty(m_home[id]);
    ++m_trees[m_home[id]].moved;
  }
}

/// Reads a world's boxes; returns whether they were put in order.
bool WorldForest::refresh(std::size_t world, const BoxStore& store, const BoxReader& reader) {
  Tree& tree = m_trees[world];
  const bool isSame = !std::exchange(tree.isChanged, false);
  const bool isFew = std::exchange(tree.moved, 0) * kShareOfMoved < tree.size && isSame && tree.isOrdered;
  const bool hasOrder = tree.size > kFewInAnyOrder;
  const bool hasMany = tree.appended * kShareOfChange > tree.size;
  bool isDue = hasOrder && (!tree.isOrdered || hasMany || tree.rule.isDue(tree.size));
  if (!isDue) {
    isFew ? gatherStale(tree, store, reader) : gather(world, reader);
    isDue = hasOrder && spreadOf(tree) > kMostSpread * tree.spread;
  }
  if (!isDue) return false;
  orderByCurve(tree, reader);
  gather(world, reader);
  tree.spread = spreadOf(tree);
  return true;
}

void WorldForest::orderByCurve(Tree& tree, const BoxReader& reader) {
  tree.rule.start();
  tree.isOrdered = true;
  tree.appended = 0;
  const std::size_t first = tree.firstLeaf * kFanOut;
  const std::span<CurveKey> keyed(m_keyed.data() + first, tree.size);
  std::uint32_t* const ids = m_ids.data() + first;
  std::sort(ids, ids + tree.size);  // So that the order does not depend on the one before.
  std::copy_n(ids, tree.size, keyed.begin());
  sortAlongCurve(keyed, m_spare.data() + first, reader);
  for (std::size_t i = 0; i < tree.size; ++i) ids[i] = indexOf(keyed[i]);
}

/// Reads a world's boxes, and bounds them.
void WorldForest::gather(std::size_t world, const BoxReader& reader) {
  Tree& tree = m_trees[world];
  LaneBlock* blocks = m_blocks.data() + tree.firstBlock;
  const std::uint32_t* const ids = m_ids.data() + tree.firstLeaf * kFanOut;
  bool exact = true;
  std::size_t count = blockCountFor(tree.size);
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t fill = std::min(kFanOut, tree.size - b * kFanOut);
    exact &= gatherLanes(reader, ids + b * kFanOut, (1U << fill) - 1U, blocks[b]);
  }
  boundAbove(blocks, count, reader);
  tree.isInexact = !exact;
}

/// Reads the blocks again that have boxes which have changed, of a tree that has the same boxes as before.
void WorldForest::gatherStale(Tree& tree, const BoxStore& store, const BoxReader& reader) {
  LaneBlock* const blocks = m_blocks.data() + tree.firstBlock;
  const std::uint32_t* const ids = m_ids.data() + tree.firstLeaf * kFanOut;
  const std::size_t count = blockCountFor(tree.size);
  for (std::size_t b = 0; b < count; ++b) {
    const std::uint32_t* const first = ids + b * kFanOut;
    const std::size_t fill = std::min(kFanOut, tree.size - b * kFanOut);
    if (std::none_of(first, first + fill, [&](BoxId id) { return store.isStale(id); })) continue;
    const bool exact = gatherLanes(reader, first, (1U << fill) - 1U, blocks[b]);
    tree.isInexact = tree.isInexact || !exact;  // Until all are read again.
    reader.kernels().boundBlocks(blocks, b, b + 1, blocks + count);
  }
  boundAbove(blocks + count, blockCountFor(count), reader);
}

/// Bounds so many blocks of a level, and all levels above.
void WorldForest::boundAbove(LaneBlock* blocks, std::size_t count, const BoxReader& reader) const {
  while (count > 1) {
    LaneBlock* const parents = blocks + count;
    emptyBlock(parents[blockCountFor(count) - 1]);
    reader.kernels().boundBlocks(blocks, 0, count, parents);
    blocks = parents;
    count = blockCountFor(count);
  }
}

/// The sum of the sides of a world's blocks of boxes.
double WorldForest::spreadOf(const Tree& tree) const noexcept {
  const LaneBlock* const bounds = m_blocks.data() + tree.firstBlock + blockCountFor(tree.size);
  double spread = 0.0;
  for (std::size_t b = 0; b < blockCountFor(tree.size); ++b) {
    const LaneBox box = bounds[b / kFanOut].get(b % kFanOut);
    if (box.bound[0] > box.bound[3]) continue;  // All its boxes are empty.
    for (std::size_t axis = 0; axis < 3; ++axis) {
      spread += static_cast<double>(box.bound[axis + 3]) - static_cast<double>(box.bound[axis]);
    }
  }
  return spread;
}

BvhView WorldForest::view(std::size_t world) const noexcept {
  BvhView result;
  if (world >= m_trees.size()) return result;
  const Tree& tree = m_trees[world];
  result.ids = m_ids.data() + tree.firstLeaf * kFanOut;
  const LaneBlock* blocks = m_blocks.data() + tree.firstBlock;
  for (std::size_t size = tree.size; size > 0; ++result.depth) {
    result.level[result.depth] = {blocks, size};
    const std::size_t count = blockCountFor(size);
    blocks += count;
    size = count == 1 ? 0 : count;
  }
  return result;
}

}  // namespace allpairs::engine
