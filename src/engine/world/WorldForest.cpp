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

/// In worlds of up to this many boxes, eight blocks, most blocks overlap each other in any order (moving_benchmark).
constexpr std::size_t kFewInAnyOrder = 8 * kFanOut;

/// If the blocks of a world have become this many times as wide as when its boxes were last ordered, ordering the boxes again and
/// joining the blocks takes less time than joining them as they are.
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
  const bool plants = !std::exchange(m_isWhole, false) || m_membership != store.membership();
  if (plants) {
    plant(store, members);
  } else {
    findDirty(store, members);
  }
  cutIntoRuns(
      m_dirty, [this](std::uint32_t world) { return m_trees[world].size; }, m_runs);
  std::atomic<std::uint64_t> orders = 0;
  executor.run(m_runs.size(), [&](std::size_t run) {
    for (std::size_t i = run == 0 ? 0 : m_runs[run - 1]; i < m_runs[run]; ++i) {
      if (refresh(m_dirty[i], reader, plants)) ++orders;
    }
  });
  m_inexactWorlds = static_cast<std::size_t>(std::count(m_inexact.begin(), m_inexact.end(), std::uint8_t{1}));
  m_isWhole = true;
  return orders;
}

/// Assigns places to all boxes, in the order of their ids.
void WorldForest::plant(const BoxStore& store, const WorldMembers& members) {
  m_membership = store.membership();
  const std::size_t worlds = members.everyWorld() + 1;
  m_trees.assign(worlds, {});
  m_inexact.assign(worlds, 0);
  m_marked.assign(worlds, 0);
  m_dirty.resize(worlds);
  std::iota(m_dirty.begin(), m_dirty.end(), 0U);
  std::size_t blocks = 0;
  std::size_t leaves = 0;
  std::size_t largest = 0;
  for (std::size_t world = 0; world < worlds; ++world) {
    const std::span<const BoxId> boxes = members.boxes(world);
    const auto isMine = [&](BoxId id) { return belongs(store, id); };
    const auto size = static_cast<std::size_t>(std::count_if(boxes.begin(), boxes.end(), isMine));
    m_trees[world].firstBlock = blocks;
    m_trees[world].firstLeaf = leaves;
    m_trees[world].size = size;
    blocks += allBlocksFor(size);
    leaves += blockCountFor(size);
    largest = std::max(largest, size);
  }
  m_blocks.require(blocks);
  m_ids.require(leaves * kFanOut);
  if (largest > kFewInAnyOrder) {
    m_keyed.require(leaves * kFanOut);
    m_spare.require(leaves * kFanOut);
  }
  std::fill_n(m_ids.data(), leaves * kFanOut, 0U);
  for (std::size_t world = 0; world < worlds; ++world) {
    std::uint32_t* to = m_ids.data() + m_trees[world].firstLeaf * kFanOut;
    for (const BoxId id : members.boxes(world)) {
      if (belongs(store, id)) *to++ = id;
    }
  }
}

/// Lists the worlds with boxes that have changed.
void WorldForest::findDirty(const BoxStore& store, const WorldMembers& members) {
  for (const std::uint32_t world : m_dirty) m_marked[world] = 0;
  m_dirty.clear();
  for (const BoxId id : store.stale()) {
    if (!store.contains(id)) continue;  // Removed before the last update, if what came after that update threw.
    const std::size_t world = members.worldOf(id);
    if (m_marked[world] != 0 || !belongs(store, id)) continue;
    m_dirty.push_back(static_cast<std::uint32_t>(world));
    m_marked[world] = 1;
  }
}

/// Reads a world's boxes; returns whether they were put in order.
bool WorldForest::refresh(std::size_t world, const BoxReader& reader, bool planted) {
  Tree& tree = m_trees[world];
  const bool hasOrder = tree.size > kFewInAnyOrder;
  bool isDue = hasOrder && (planted || tree.rule.isDue(tree.size));
  if (!isDue) {
    gather(world, reader);
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
  const Tree& tree = m_trees[world];
  LaneBlock* blocks = m_blocks.data() + tree.firstBlock;
  const std::uint32_t* const ids = m_ids.data() + tree.firstLeaf * kFanOut;
  bool exact = true;
  std::size_t count = blockCountFor(tree.size);
  for (std::size_t b = 0; b < count; ++b) {
    const std::size_t fill = std::min(kFanOut, tree.size - b * kFanOut);
    exact &= gatherLanes(reader, ids + b * kFanOut, (1U << fill) - 1U, blocks[b]);
  }
  while (count > 1) {
    LaneBlock* const parents = blocks + count;
    emptyBlock(parents[blockCountFor(count) - 1]);
    reader.kernels().boundBlocks(blocks, 0, count, parents);
    blocks = parents;
    count = blockCountFor(count);
  }
  m_inexact[world] = exact ? 0 : 1;
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
