// SPDX-License-Identifier: MIT
#include "world/KeptHierarchy.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "RadixRun.h"

namespace allpairs::engine {
namespace {

/// An order has room for a share of its boxes that come later, and leaves as much empty before it is made anew.
constexpr std::size_t kShareOfChange = 8;
constexpr std::size_t kLeastRoom = 64;

/// If one box in so many has moved, all blocks are read anew.
constexpr std::size_t kShareOfMoved = 8;

constexpr std::size_t kKeptBlocksPerTask = 256;

/// How many blocks ahead the boxes of a block are asked for.
constexpr std::size_t kPrefetchBlocks = 2;

std::size_t roomFor(std::size_t boxes) { return boxes / kShareOfChange + kLeastRoom; }

}  // namespace

bool KeptHierarchy::update(const BoxStore& store, const UpdateTools& tools) {
  sortOut(store);
  const bool due = isRebuildDue();
  if (due) {
    rebuild(store, tools);
  } else {
    placeFresh(tools);
    refit(tools);
  }
  m_fresh.clear();
  m_dirtyBoxes = 0;
  return due;
}

/// Finds out what happened to the boxes that changed: new here, gone, or moved.
void KeptHierarchy::sortOut(const BoxStore& store) {
  if (store.stale().empty()) return;
  if (m_places.size() < store.idBound()) m_places.resize(store.idBound(), kNowhere);
  for (const BoxId id : store.resettled()) {
    const bool here = m_places[id] != kNowhere;
    const bool belongsHere = belongs(store, id);
    if (belongsHere && !here) m_fresh.push_back(id);
    if (!belongsHere && here) leave(id);
  }
  if (m_size == 0) return;
  // If many have moved, all blocks are read anew, without asking which.
  if (store.stale().size() * kShareOfMoved > store.size()) {
    m_dirtyBoxes = m_size;
    return;
  }
  for (const BoxId id : store.stale()) {
    if (m_places[id] != kNowhere) markBlock(m_places[id] / kFanOut);
  }
}

void KeptHierarchy::leave(BoxId id) {
  const std::size_t place = m_places[id];
  m_places[id] = kNowhere;
  m_used[place / kFanOut] &= static_cast<std::uint16_t>(~(1U << (place % kFanOut)));
  markBlock(place / kFanOut);
  --m_size;
}

void KeptHierarchy::markBlock(std::size_t block) {
  m_dirty[block / 64] |= std::uint64_t{1} << (block % 64);
  ++m_dirtyBoxes;
}

bool KeptHierarchy::isRebuildDue() const noexcept {
  if (m_levels.places() + m_fresh.size() > m_levels.capacity()) return true;
  if (m_levels.places() - m_size > roomFor(m_levels.places())) return true;
  return m_rule.isDue(m_size) && m_dirtyBoxes != 0;
}

void KeptHierarchy::rebuild(const BoxStore& store, const UpdateTools& tools) {
  m_fresh.clear();
  for (BoxId id = 0; id < store.idBound(); ++id) {
    if (belongs(store, id)) m_fresh.push_back(id);
  }
  const std::size_t capacity = m_fresh.size() + roomFor(m_fresh.size());
  m_levels.reset(capacity);
  m_levels.resize(0);
  const std::size_t blocks = (capacity + kFanOut - 1) / kFanOut;
  m_used.assign(blocks, 0);
  m_inexact.assign(blocks, 0);
  m_dirty.assign((blocks + 63) / 64, 0);
  m_inexactBlocks = 0;
  m_size = 0;
  m_rule.start();
  m_grid = CurveGrid::fit(tools.reader);
  if (!m_fresh.empty()) {
    orderByCurve(m_fresh, tools);
    append({m_keyed.data(), m_fresh.size()});
  }
  refitAll(tools);
}

void KeptHierarchy::placeFresh(const UpdateTools& tools) {
  if (m_fresh.empty()) return;
  orderByCurve(m_fresh, tools);
  append({m_keyed.data(), m_fresh.size()});
}

/// Sorts boxes along the curve into m_keyed.
void KeptHierarchy::orderByCurve(std::span<const BoxId> ids, const UpdateTools& tools) {
  m_keyed.require(ids.size() + ids.size() / kShareOfChange);
  m_spare.require(ids.size() + ids.size() / kShareOfChange);
  constexpr std::size_t kBoxesPerTask = kKeptBlocksPerTask * kFanOut;
  tools.executor.run((ids.size() + kBoxesPerTask - 1) / kBoxesPerTask, [&](std::size_t task) {
    const std::size_t begin = task * kBoxesPerTask;
    const std::size_t size = std::min(kBoxesPerTask, ids.size() - begin);
    writeKeys(ids.subspan(begin, size), tools, m_spare.data() + begin);
  });
  KeyedBox all = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) all |= m_spare[i];
  const unsigned bits = std::max(kIndexBits, static_cast<unsigned>(std::bit_width(all)));
  sortRun(m_spare.data(), m_keyed.data(), ids.size(), bits, kIndexBits);
  m_crowds.refine({m_keyed.data(), ids.size()}, m_spare.data(), tools.reader, tools.kernels, tools.executor);
}

void KeptHierarchy::writeKeys(std::span<const BoxId> ids, const UpdateTools& tools, KeyedBox* to) const {
  constexpr std::size_t kBlocks = 4;
  constexpr std::size_t kBoxes = kBlocks * kFanOut;
  const BlockReader reader(tools.reader, tools.kernels);
  std::array<LaneBlock, kBlocks> blocks;
  std::array<std::uint32_t, kBoxes> keys;
  for (std::size_t i = 0; i < ids.size(); i += kBoxes) {
    const std::span<const BoxId> some = ids.subspan(i, std::min(kBoxes, ids.size() - i));
    for (std::size_t b = 0; b * kFanOut < some.size(); ++b) {
      readBoxes(some.subspan(b * kFanOut, std::min(kFanOut, some.size() - b * kFanOut)), reader, tools.reader,
                blocks[b]);
    }
    tools.kernels.curveKeys({blocks.data(), (some.size() + kFanOut - 1) / kFanOut}, m_grid, keys.data());
    for (std::size_t k = 0; k < some.size(); ++k) *to++ = (std::uint64_t{keys[k]} << kIndexBits) | some[k];
  }
}

/// Reads up to sixteen boxes; the other lanes hold some box, too.
void KeptHierarchy::readBoxes(std::span<const BoxId> ids, const BlockReader& blocks, const LaneReader& reader,
                              LaneBlock& block) {
  if (blocks.isUsable() && ids.size() == kFanOut) {
    std::array<std::int32_t, kFanOut> offsets;
    for (std::size_t lane = 0; lane < kFanOut; ++lane) offsets[lane] = static_cast<std::int32_t>(6 * ids[lane]);
    static_cast<void>(blocks.readAt(offsets, block));
    return;
  }
  reader.withLanes([&](const auto& lanesOf) {
    LaneBox lanes = kEverythingLanes;
    for (std::size_t lane = 0; lane < kFanOut; ++lane) {
      if (lane < ids.size()) static_cast<void>(lanesOf(ids[lane], lanes));
      block.set(lane, lanes);
    }
  });
}

/// Gives boxes the next places.
void KeptHierarchy::append(std::span<const KeyedBox> order) {
  const std::size_t begin = m_levels.places();
  m_levels.resize(begin + order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t place = begin + i;
    const BoxId id = indexOf(order[i]);
    m_levels.id(place) = id;
    m_places[id] = static_cast<std::uint32_t>(place);
    m_used[place / kFanOut] |= static_cast<std::uint16_t>(1U << (place % kFanOut));
    markBlock(place / kFanOut);
  }
  m_size += order.size();
}

void KeptHierarchy::refit(const UpdateTools& tools) {
  if (m_dirtyBoxes == 0) return;
  if (m_dirtyBoxes * kShareOfMoved >= m_size) {
    refitAll(tools);
    return;
  }
  const BlockReader blocks(tools.reader, tools.kernels);
  m_blockList.clear();
  for (std::size_t word = 0; word < m_dirty.size(); ++word) {
    for (std::uint64_t bits = m_dirty[word]; bits != 0; bits &= bits - 1) {
      const std::size_t block = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      gather(block, blocks, tools.reader);
      m_blockList.push_back(static_cast<std::uint32_t>(block));
    }
    m_dirty[word] = 0;
  }
  m_inexactBlocks = static_cast<std::size_t>(std::count(m_inexact.begin(), m_inexact.end(), std::uint8_t{1}));
  m_levels.boundSome(m_blockList, tools.kernels, tools.executor);
}

void KeptHierarchy::refitAll(const UpdateTools& tools) {
  const BlockReader blocks(tools.reader, tools.kernels);
  const std::size_t count = m_levels.blockCount();
  tools.executor.run((count + kKeptBlocksPerTask - 1) / kKeptBlocksPerTask, [&](std::size_t task) {
    const std::size_t end = std::min(count, (task + 1) * kKeptBlocksPerTask);
    for (std::size_t b = task * kKeptBlocksPerTask; b < end; ++b) {
      const std::size_t ahead = std::min(b + kPrefetchBlocks, count - 1) * kFanOut;
      for (std::size_t lane = 0; lane < kFanOut; ++lane) tools.reader.prefetch(m_levels.id(ahead + lane));
      gather(b, blocks, tools.reader);
    }
  });
  std::fill(m_dirty.begin(), m_dirty.end(), std::uint64_t{0});
  m_inexactBlocks = static_cast<std::size_t>(std::count(m_inexact.begin(), m_inexact.end(), std::uint8_t{1}));
  m_levels.boundAll(tools.kernels, tools.executor);
}

void KeptHierarchy::gather(std::size_t block, const BlockReader& blocks, const LaneReader& reader) {
  const bool exact = blocks.isUsable() ? gatherPlain(block, blocks, reader) : gatherAny(block, reader);
  m_inexact[block] = exact ? 0 : 1;
}

bool KeptHierarchy::gatherPlain(std::size_t block, const BlockReader& blocks, const LaneReader& reader) {
  std::array<std::int32_t, kFanOut> offsets;
  for (std::size_t lane = 0; lane < kFanOut; ++lane) {
    offsets[lane] = static_cast<std::int32_t>(6 * m_levels.id(block * kFanOut + lane));
  }
  LaneBlock& lanes = m_levels.block(block);
  const RowBlockResult read = blocks.readAt(offsets, lanes);
  const std::uint32_t unused = read.emptyLanes | (~std::uint32_t{m_used[block]} & 0xFFFFU);
  // Empty boxes have infinite bounds, which no lane holds; that is not for the others to suffer from.
  if (unused != 0 && !read.exact) return gatherAny(block, reader);
  for (std::uint32_t bits = unused; bits != 0; bits &= bits - 1) {
    lanes.set(static_cast<std::size_t>(std::countr_zero(bits)), kNeverLanes);
  }
  return read.exact;
}

bool KeptHierarchy::gatherAny(std::size_t block, const LaneReader& reader) {
  return reader.withLanes([&](const auto& lanesOf) {
    bool exact = true;
    for (std::size_t lane = 0; lane < kFanOut; ++lane) {
      LaneBox lanes = kNeverLanes;
      const BoxId id = m_levels.id(block * kFanOut + lane);
      if ((m_used[block] >> lane & 1U) != 0 && !lanesOf.isEmpty(id)) exact &= lanesOf(id, lanes);
      m_levels.block(block).set(lane, lanes);
    }
    return exact;
  });
}

}  // namespace allpairs::engine
