// SPDX-License-Identifier: MIT
#include "world/DynamicBvh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "input/Parts.h"

namespace allpairs::engine {
namespace {

/// Some more than the share, for worlds of few boxes.
std::size_t roomFor(std::size_t boxes) { return boxes / kShareOfChange + 64; }

}  // namespace

bool DynamicBvh::update(const BoxStore& store, const BoxReader& reader, Executor& executor) {
  const bool isWhole = std::exchange(m_isWhole, false);
  if (isWhole) {
    sortOut(store);
  } else {
    m_places.assign(store.idBound(), kNowhere);
  }
  const bool due = !isWhole || isRebuildDue();
  if (due) {
    rebuild(store, reader, executor);
  } else {
    placeFresh(reader, executor);
    refit(reader, executor);
  }
  m_fresh.clear();
  m_dirtyBoxes = 0;
  m_isWhole = true;
  return due;
}

void DynamicBvh::release() noexcept {
  *this = DynamicBvh(m_places.get_allocator().resource(), m_ofStatic);
  m_isWhole = false;
}

/// Classifies the changed boxes: added, removed, or moved.
void DynamicBvh::sortOut(const BoxStore& store) {
  if (store.stale().empty()) return;
  if (m_places.size() < store.idBound()) m_places.resize(store.idBound(), kNowhere);
  for (const BoxId id : store.resettled()) {
    const bool here = m_places[id] != kNowhere;
    const bool belongsHere = belongs(store, id);
    if (belongsHere && !here) m_fresh.push_back(id);
    if (!belongsHere && here) leave(id);
  }
  if (m_size == 0) return;
  // If many have moved, all blocks are read again, without checking which.
  if (store.stale().size() * kShareOfMoved > store.size()) {
    m_dirtyBoxes = m_size;
    return;
  }
  for (const BoxId id : store.stale()) {
    if (m_places[id] != kNowhere) markBlock(m_places[id] / kFanOut);
  }
}

void DynamicBvh::leave(BoxId id) {
  const std::size_t place = m_places[id];
  m_places[id] = kNowhere;
  m_used[place / kFanOut] &= static_cast<std::uint16_t>(~(1U << (place % kFanOut)));
  markBlock(place / kFanOut);
  --m_size;
}

void DynamicBvh::markBlock(std::size_t block) {
  m_dirty[block / 64] |= std::uint64_t{1} << (block % 64);
  ++m_dirtyBoxes;
}

bool DynamicBvh::isRebuildDue() const noexcept {
  if (m_levels.places() + m_fresh.size() > m_levels.capacity()) return true;
  if (m_levels.places() - m_size > roomFor(m_levels.places())) return true;
  return m_rule.isDue(m_size) && m_dirtyBoxes != 0;
}

void DynamicBvh::rebuild(const BoxStore& store, const BoxReader& reader, Executor& executor) {
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
  m_grid = fitCurveGrid(reader);
  if (!m_fresh.empty()) {
    orderByCurve(m_fresh, reader, executor);
    append({m_keyed.data(), m_fresh.size()});
  }
  refitAll(reader, executor);
}

void DynamicBvh::placeFresh(const BoxReader& reader, Executor& executor) {
  if (m_fresh.empty()) return;
  orderByCurve(m_fresh, reader, executor);
  append({m_keyed.data(), m_fresh.size()});
}

/// Sorts boxes along the curve into m_keyed.
void DynamicBvh::orderByCurve(std::span<const BoxId> ids, const BoxReader& reader, Executor& executor) {
  m_keyed.require(ids.size() + ids.size() / kShareOfChange);
  m_spare.require(ids.size() + ids.size() / kShareOfChange);
  runInParts(ids.size(), kPartSize, executor, [&](std::size_t begin, std::size_t end) {
    KeyRun run{m_spare.data() + begin};
    writeKeys(reader, m_grid, {ids.data() + begin, 0, end - begin}, true, run);
  });
  m_radix.sort(m_spare.data(), m_keyed.data(), ids.size(), kIndexBits, kIndexBits + m_grid.keyBits(), executor);
  sortDenseCells({m_keyed.data(), ids.size()}, m_spare.data(), reader, executor, m_denseCells);
}

/// Assigns the next places to boxes.
void DynamicBvh::append(std::span<const CurveKey> order) {
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

void DynamicBvh::refit(const BoxReader& reader, Executor& executor) {
  if (m_dirtyBoxes == 0) return;
  if (m_dirtyBoxes * kShareOfMoved >= m_size) {
    refitAll(reader, executor);
    return;
  }
  m_blockList.clear();
  for (std::size_t word = 0; word < m_dirty.size(); ++word) {
    for (std::uint64_t bits = m_dirty[word]; bits != 0; bits &= bits - 1) {
      const std::size_t block = word * 64 + static_cast<std::size_t>(std::countr_zero(bits));
      gather(block, reader);
      m_blockList.push_back(static_cast<std::uint32_t>(block));
    }
    m_dirty[word] = 0;
  }
  m_inexactBlocks = static_cast<std::size_t>(std::count(m_inexact.begin(), m_inexact.end(), std::uint8_t{1}));
  m_levels.boundSome(m_blockList, reader.kernels(), executor);
}

void DynamicBvh::refitAll(const BoxReader& reader, Executor& executor) {
  const std::size_t count = m_levels.blockCount();
  runInParts(count, kPartSize / kFanOut, executor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const std::size_t ahead = std::min(b + kPrefetchBoxes / kFanOut, count - 1) * kFanOut;
      for (std::size_t lane = 0; lane < kFanOut; ++lane) reader.prefetch(m_levels.id(ahead + lane));
      gather(b, reader);
    }
  });
  std::fill(m_dirty.begin(), m_dirty.end(), std::uint64_t{0});
  m_inexactBlocks = static_cast<std::size_t>(std::count(m_inexact.begin(), m_inexact.end(), std::uint8_t{1}));
  m_levels.boundAll(reader.kernels(), executor);
}

void DynamicBvh::gather(std::size_t block, const BoxReader& reader) {
  m_inexact[block] = gatherLanes(reader, &m_levels.id(block * kFanOut), m_used[block], m_levels.block(block)) ? 0 : 1;
}

bool gatherLanes(const BoxReader& reader, const std::uint32_t* ids, std::uint32_t used, LaneBlock& lanes) {
  BlockRead read = reader.read({ids, 0, kFanOut}, lanes);
  const std::uint32_t unused = read.emptyLanes | (~used & 0xFFFFU);
  for (std::uint32_t bits = unused; bits != 0; bits &= bits - 1) {
    lanes.set(static_cast<std::size_t>(std::countr_zero(bits)), kNeverLanes);
  }
  // Empty boxes have infinite bounds, which no lane can represent; they must not make the whole block inexact.
  if (unused != 0 && !read.exact) {
    read.exact = true;
    LaneBlock one;
    for (std::uint32_t bits = ~unused & 0xFFFFU; bits != 0; bits &= bits - 1) {
      read.exact &= reader.read({ids + std::countr_zero(bits), 0, 1}, one).exact;
    }
  }
  return read.exact;
}

void ChangedBoxes::start(std::size_t boxes) {
  m_levels.reset(std::max(m_levels.capacity(), kFanOut * (boxes + boxes / 4)));
  m_levels.resize(0);
  m_size = boxes;
  m_next = 0;
  m_sourceBlock = static_cast<std::size_t>(-1);
}

/// Copies a box; those of a block of the source are copied one after the other.
void ChangedBoxes::append(const BvhView& source, std::size_t place) {
  if (place / kFanOut != std::exchange(m_sourceBlock, place / kFanOut)) {
    m_next = m_levels.blockCount() * kFanOut;
    m_levels.resize(m_next + kFanOut);
  }
  const LaneBox box = source.level[0].blocks[place / kFanOut].get(place % kFanOut);
  m_levels.block(m_next / kFanOut).set(m_next % kFanOut, box);
  m_levels.id(m_next++) = source.ids[place];
}

void ChangedBoxes::gather(std::span<const BoxId> changed, DynamicBvh& from, const Kernels& kernels,
                          Executor& executor) {
  const BvhView source = from.levels().view();
  const std::size_t words = (from.levels().places() + 63) / 64;
  // Marks left by a call that threw.
  if (std::exchange(m_marking, true)) std::fill(m_marked.begin(), m_marked.end(), std::uint64_t{0});
  if (m_marked.size() < words) m_marked.resize(words + words / 4, 0);
  std::size_t count = 0;
  for (const BoxId id : changed) {
    const std::uint32_t place = from.placeOf(id);
    if (place == DynamicBvh::kNowhere) continue;
    m_marked[place / 64] |= std::uint64_t{1} << (place % 64);
    ++count;
  }
  start(count);
  for (std::size_t word = 0; word < words; ++word) {
    for (std::uint64_t bits = std::exchange(m_marked[word], 0); bits != 0; bits &= bits - 1) {
      append(source, word * 64 + static_cast<std::size_t>(std::countr_zero(bits)));
    }
  }
  m_marking = false;
  m_levels.boundAll(kernels, executor);
}

void ChangedBoxes::gather(const BoxStore& store, const BvhView& from, const Kernels& kernels, Executor& executor) {
  const std::span<const std::uint32_t> ids(from.ids, from.depth == 0 ? 0 : from.level[0].size);
  const auto isChanged = [&](BoxId id) { return store.isTouched(id); };
  start(static_cast<std::size_t>(std::count_if(ids.begin(), ids.end(), isChanged)));
  for (std::size_t place = 0; place < ids.size(); ++place) {
    if (isChanged(ids[place])) append(from, place);
  }
  m_levels.boundAll(kernels, executor);
}

}  // namespace allpairs::engine
