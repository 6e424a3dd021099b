// SPDX-License-Identifier: MIT
#include "world/DynamicBvh.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "input/Parts.h"

namespace allpairs::engine {
namespace {

/// Up to this many boxes, four blocks, most blocks overlap each other in any order (moving_benchmark --boxes 100, and
/// 64).
constexpr std::size_t kFewInAnyOrder = 4 * kFanOut;

/// If the blocks have become this many times as wide as when the boxes were last ordered, there is no order left, as
/// after the reset of a simulation: so much wider are eight blocks in any order, and fewer lose little by it. Ordering
/// the boxes and joining them then takes less time than joining them.
constexpr double kMostSpread = 2.0;

/// A block counts as no wider than this many times the geometric mean of all. A few reach far, to infinity or to boxes
/// that are kept far away until they are used; they say nothing about the order of the others.
constexpr double kFarReaching = 16.0;

/// If one box in this many has changed, the blocks may have become so wide: where those boxes have gone elsewhere, joining
/// them with all takes at least as long as a join after ordering all. Of fewer, RebuildRule counts the losses.
constexpr std::size_t kShareThatWidens = 256;

/// Reads sixteen boxes, of which those with a bit in `used` exist, and are not empty, into lanes; the others become
/// lanes that overlap nothing. Returns whether the lanes are exactly the boxes.
bool readLanes(const BoxReader& reader, const std::uint32_t* ids, std::uint32_t used, LaneBlock& lanes) {
  BlockRead read = reader.read({ids, 0, kFanOut}, lanes);
  const std::uint32_t unused = read.emptyLanes | (~used & 0xFFFFU);
  lanes.clear(unused);
  // Empty boxes have infinite bounds, which no lane can represent; they must not make the whole block inexact.
  if (unused != 0 && !read.exact) {
    read.exact = true;
    LaneBlock one;
    forEachBit(~unused & 0xFFFFU, [&](std::size_t i) { read.exact &= reader.read({ids + i, 0, 1}, one).exact; });
  }
  return read.exact;
}

/// The sum of the sides of a block of boxes; 0 if all of these are empty.
double widthOf(const Level& bounds, std::size_t block) {
  const LaneBox box = bounds.blocks[block / kFanOut].get(block % kFanOut);
  if (box.bound[0] > box.bound[3]) return 0.0;
  double width = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    width += static_cast<double>(box.bound[axis + 3]) - static_cast<double>(box.bound[axis]);
  }
  return width;
}

/// The most that a block counts as wide, from the geometric mean of all, which a few hardly change.
double mostWidthOf(const Level& bounds) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t b = 0; b < bounds.size; ++b) {
    const double width = widthOf(bounds, b);
    if (!(width > 0.0) || !std::isfinite(width)) continue;
    sum += std::log2(width);
    ++count;
  }
  if (count == 0) return std::numeric_limits<double>::infinity();
  return kFarReaching * std::exp2(sum / static_cast<double>(count));
}

}  // namespace

void DynamicBvh::clear() noexcept {
  m_size = 0;
  m_isExact = true;
  m_fresh.clear();
}

void DynamicBvh::remove(std::size_t place) noexcept {
  m_used[place / kFanOut] &= static_cast<std::uint16_t>(~(1U << (place % kFanOut)));
  note(place);
  --m_size;
}

void DynamicBvh::note(std::size_t place) noexcept {
  const std::size_t block = place / kFanOut;
  m_dirty[block / 64] |= std::uint64_t{1} << (block % 64);
  ++m_dirtyBoxes;
}

bool DynamicBvh::isBuildDue() const noexcept {
  if (m_size == 0 || places() + m_fresh.size() > m_levels.capacity()) return true;
  if (places() - m_size > places() / kShareOfChange + kFanOut) return true;  // Of few boxes it costs nothing.
  return m_rule.isDue(m_size) && m_dirtyBoxes != 0;
}

void DynamicBvh::build(std::span<BoxHome> homes, const BoxReader& reader, Executor& executor) {
  const std::size_t blocks = blockCountFor(m_fresh.size() + m_fresh.size() / kShareOfChange);
  m_isOrdered = m_fresh.size() > kFewInAnyOrder;
  m_levels.reset(blocks * kFanOut);
  m_levels.resize(0);
  m_used.assign(blocks, 0);
  m_dirty.assign((blocks + 63) / 64, 0);
  m_rule.start();
  placeFresh(homes, reader, executor);
  readAll(reader, executor);
  if (m_isOrdered) m_mostWidth = mostWidthOf(view().level[1]);
  m_spread = spread();
}

bool DynamicBvh::refit(std::span<BoxHome> homes, const BoxReader& reader, Executor& executor) {
  if (!m_fresh.empty()) placeFresh(homes, reader, executor);
  const bool haveManyChanged = m_dirtyBoxes * kShareOfChange >= m_size;
  const bool mayBeWide = m_dirtyBoxes * kShareThatWidens >= m_size;
  haveManyChanged ? readAll(reader, executor) : readDirty(reader, executor);
  return !mayBeWide || !m_isOrdered || spread() <= kMostSpread * m_spread;
}

/// Gives the boxes without a place the next ones, in curve order.
void DynamicBvh::placeFresh(std::span<BoxHome> homes, const BoxReader& reader, Executor& executor) {
  std::span<const CurveKey> order;
  if (m_isOrdered) {
    BoxReader fresh = reader;
    fresh.restrictTo(m_fresh);
    m_spare.requireAmply(m_fresh.size());
    order = m_order.sort(fresh, {m_spare.data(), m_spare.capacity()}, executor, true);
  }
  std::size_t place = places();
  m_levels.resize(place + m_fresh.size());
  for (std::size_t i = 0; i < m_fresh.size(); ++i) {
    const BoxId id = m_fresh[m_isOrdered ? indexOf(order[i]) : i];
    m_levels.id(place) = id;
    homes[id].place = static_cast<std::uint32_t>(place);
    m_used[place / kFanOut] |= static_cast<std::uint16_t>(1U << (place % kFanOut));
    note(place++);
  }
  m_size += m_fresh.size();
  m_fresh.clear();
}

/// Reads the blocks whose boxes have changed.
void DynamicBvh::readDirty(const BoxReader& reader, Executor& executor) {
  m_blockList.clear();
  forEachBit(m_dirty, [&](std::size_t block) {
    m_isExact = read(block, reader) && m_isExact;  // If a box was not exact, until all are read again.
    m_blockList.push_back(static_cast<std::uint32_t>(block));
  });
  std::fill(m_dirty.begin(), m_dirty.end(), std::uint64_t{0});
  m_dirtyBoxes = 0;
  m_levels.boundSome(m_blockList, reader.kernels(), executor);
}

void DynamicBvh::readAll(const BoxReader& reader, Executor& executor) {
  const std::size_t count = m_levels.blockCount();
  std::atomic<bool> isExact = true;
  runInParts(count, kPartSize / kFanOut, executor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const std::size_t ahead = b * kFanOut + kPrefetchBoxes;
      for (std::size_t place = ahead; place < ahead + kFanOut && place < places(); ++place) {
        reader.prefetch(m_levels.id(place));
      }
      if (!read(b, reader)) isExact.store(false, std::memory_order_relaxed);
    }
  });
  std::fill(m_dirty.begin(), m_dirty.end(), std::uint64_t{0});
  m_dirtyBoxes = 0;
  m_isExact = isExact;
  m_levels.boundAll(reader.kernels(), executor);
}

/// Reads the boxes of a block; returns whether the lanes are exactly the boxes.
bool DynamicBvh::read(std::size_t block, const BoxReader& reader) {
  return readLanes(reader, &m_levels.id(block * kFanOut), m_used[block], m_levels.block(block));
}

/// The sum of the sides of all blocks of boxes, if these are in order.
double DynamicBvh::spread() const noexcept {
  if (!m_isOrdered) return 0.0;
  const Level& bounds = view().level[1];
  double sum = 0.0;
  for (std::size_t b = 0; b < bounds.size; ++b) sum += std::min(m_mostWidth, widthOf(bounds, b));  // NaN is the most.
  return sum;
}

}  // namespace allpairs::engine
