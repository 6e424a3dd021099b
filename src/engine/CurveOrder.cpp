// SPDX-License-Identifier: MIT
#include "CurveOrder.h"

#include <algorithm>
#include <array>
#include <utility>

#include "CurveGrid.h"

namespace allpairs::engine {
namespace {

/// Digits of a pass: 2^11 write positions still fit the caches; small sets are better off with fewer.
constexpr unsigned kMaxDigitBits = 11;

/// A chunk smaller than this is not worth a task.
constexpr std::size_t kMinChunk = std::size_t{1} << 14;

struct Digits {
  unsigned bits;
  unsigned passes;
};

/// As few passes as there can be, and then as few bits a pass as will do.
Digits digitsFor(unsigned keyBits, std::size_t size) {
  const unsigned most = size < 4096 ? 8 : kMaxDigitBits;
  const unsigned passes = (keyBits + most - 1) / most;
  return {(keyBits + passes - 1) / passes, passes};
}

}  // namespace

void CurveOrder::cut(std::size_t size, std::size_t pieces) {
  const std::size_t count = std::clamp<std::size_t>(std::min(pieces, size / kMinChunk), 1, 256);
  if (m_chunks.size() != count) m_chunks.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    m_chunks[i].begin = size * i / count;
    m_chunks[i].end = size * (i + 1) / count;
  }
}

OrderedBoxes CurveOrder::sort(const LaneReader& reader, std::span<KeyedBox> spare, Executor& executor) {
  const std::size_t size = reader.size();
  const CurveGrid grid(reader);
  const Digits digits = digitsFor(grid.bits(), size);
  m_boxes.require(size);
  KeyedBox* from = m_boxes.data();
  KeyedBox* to = spare.data();
  if (digits.passes % 2 != 0) std::swap(from, to);

  const std::size_t pieces = executor.concurrency() == 1 ? 1 : 4 * executor.concurrency();
  cut(size, pieces);
  executor.run(m_chunks.size(), [&](std::size_t c) {
    Chunk& chunk = m_chunks[c];
    KeyedBox* out = from + chunk.begin;
    chunk.exact = reader.read(
        chunk.begin, chunk.end,
        [&](std::size_t i, const LaneBox& box) {
          *out++ = {grid.key(box), static_cast<std::uint32_t>(i)};
        },
        [](std::size_t) {});
    chunk.used = static_cast<std::size_t>(out - (from + chunk.begin));
  });
  OrderedBoxes result;
  std::size_t used = 0;
  for (const Chunk& chunk : m_chunks) {
    result.exact &= chunk.exact;
    if (used != chunk.begin) std::copy_n(from + chunk.begin, chunk.used, from + used);
    used += chunk.used;
  }

  cut(used, pieces);
  for (unsigned pass = 0; pass < digits.passes; ++pass) {
    const unsigned shift = pass * digits.bits;
    const std::uint32_t mask = (1U << digits.bits) - 1;
    executor.run(m_chunks.size(), [&](std::size_t c) {
      Chunk& chunk = m_chunks[c];
      chunk.offsets.assign(std::size_t{mask} + 1, 0);
      for (std::size_t i = chunk.begin; i < chunk.end; ++i) ++chunk.offsets[(from[i].key >> shift) & mask];
    });
    std::uint32_t place = 0;
    for (std::uint32_t digit = 0; digit <= mask; ++digit) {
      for (Chunk& chunk : m_chunks) place += std::exchange(chunk.offsets[digit], place);
    }
    executor.run(m_chunks.size(), [&](std::size_t c) {
      Chunk& chunk = m_chunks[c];
      for (std::size_t i = chunk.begin; i < chunk.end; ++i) {
        const KeyedBox box = from[i];
        to[chunk.offsets[(box.key >> shift) & mask]++] = box;
      }
    });
    std::swap(from, to);
  }
  result.boxes = {from, used};
  return result;
}

}  // namespace allpairs::engine
