// SPDX-License-Identifier: MIT
#include "input/BoxCull.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "input/BoxRuns.h"
#include "input/Parts.h"
#include "input/Sampling.h"

namespace allpairs::engine {
namespace {

/// Fewer boxes are not worth a pass that leaves some out (docs/decisions/0022).
constexpr std::size_t kLeastBoxes = 1024;

/// A set is restricted if at most half of this many sampled boxes touch the other set's bounds.
constexpr std::size_t kSample = 64;

/// The bounds of all boxes that may overlap something.
LaneBox boundsOf(const BoxReader& reader) {
  LaneBlock bounds;
  for (std::size_t lane = 0; lane < kFanOut; ++lane) bounds.set(lane, kNeverLanes);
  LaneBlock block = bounds;
  const BoxList all{nullptr, 0, reader.size()};
  for (std::size_t begin = 0; begin < all.size; begin += kFanOut) {
    const BoxList boxes = all.part(begin, kFanOut);
    std::uint32_t empty = reader.read(boxes, block).emptyLanes;
    for (; empty != 0; empty &= empty - 1) block.set(static_cast<std::size_t>(std::countr_zero(empty)), kNeverLanes);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t lane = 0; lane < kFanOut; ++lane) {
        bounds.bound[axis][lane] = std::min(bounds.bound[axis][lane], block.bound[axis][lane]);
        bounds.bound[axis + 3][lane] = std::max(bounds.bound[axis + 3][lane], block.bound[axis + 3][lane]);
      }
    }
  }
  LaneBox result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.bound[axis] = *std::min_element(bounds.bound[axis].begin(), bounds.bound[axis].end());
    result.bound[axis + 3] = *std::max_element(bounds.bound[axis + 3].begin(), bounds.bound[axis + 3].end());
  }
  return result;
}

bool areMostlyOutside(const BoxReader& reader, const LaneBox& bounds) {
  std::size_t inside = 0;
  sampleBoxes(reader, kSample, [&](const LaneBox& box) { inside += touch(box, bounds) ? 1U : 0U; });
  return 2 * inside <= kSample;
}

/// Writes the ids of those of some boxes that touch the bounds; returns the end of what it wrote.
std::uint32_t* chooseTouching(const BoxReader& reader, const BoxList& boxes, const LaneBox& bounds,
                              std::uint32_t* ids) {
  LaneBlock block;
  for (std::size_t lane = 0; lane < kFanOut; ++lane) block.set(lane, kNeverLanes);
  for (std::size_t i = 0; i < boxes.size; i += kFanOut) {
    const BoxList some = boxes.part(i, kFanOut);
    const std::uint32_t empty = reader.read(some, block).emptyLanes;
    std::uint32_t lanes = reader.kernels().touchingLanes(block, bounds) & ~empty & ((1U << some.size) - 1U);
    for (; lanes != 0; lanes &= lanes - 1) *ids++ = some[static_cast<std::size_t>(std::countr_zero(lanes))];
  }
  return ids;
}

/// Up to one box in this many of the other set, finding the bounds of a set once more, exactly, takes less time than it
/// saves (docs/decisions/0022).
constexpr std::size_t kBoundedAgain = 8;

/// The bounds of all boxes of a set that are not empty, in the precision of the boxes.
template <class T>
std::array<T, 6> exactBoundsOf(const BoxReader& reader) {
  Box bounds = kEmptyBox;
  for (std::size_t i = 0; i < reader.size(); ++i) {
    const Box box = reader.boxes()[reader.idOf(i)];
    if (isEmpty(box)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      bounds.min[axis] = std::min(bounds.min[axis], box.min[axis]);
      bounds.max[axis] = std::max(bounds.max[axis], box.max[axis]);
    }
  }
  std::array<T, 6> result;
  std::transform(bounds.min.begin(), bounds.min.end(), result.begin(), [](double v) { return static_cast<T>(v); });
  std::transform(bounds.max.begin(), bounds.max.end(), result.begin() + 3, [](double v) { return static_cast<T>(v); });
  return result;
}

/// The same of boxes as they lie in memory, `first` being the number of the first.
template <class T>
std::uint32_t* chooseTouching(const BoxRun<T>& boxes, std::size_t first, const std::array<T, 6>& bounds,
                              const Kernels& kernels, std::uint32_t* ids) {
  std::array<std::uint64_t, 16> words;
  constexpr std::size_t kAtOnce = words.size() * kWordBoxes;
  for (std::size_t begin = 0; begin < boxes.size; begin += kAtOnce) {
    const BoxRun<T> part = boxes.part(begin, kAtOnce);
    kernels.plain<T>().touchBoxes(part, bounds, words.data());
    for (std::size_t i = 0; i < part.size; i += kWordBoxes) {
      for (std::uint64_t bits = words[i / kWordBoxes]; bits != 0; bits &= bits - 1) {
        *ids++ = static_cast<std::uint32_t>(first + begin + i + static_cast<std::size_t>(std::countr_zero(bits)));
      }
    }
  }
  return ids;
}

}  // namespace

/// Restricts the reader to the boxes that choose(begin, end, ids) writes the ids of, part by part; it returns the end
/// of what it wrote.
template <class Choose>
void BoxCull::keep(BoxReader& reader, Ids& ids, Executor& executor, const Choose& choose) {
  ids.require(reader.size());
  const std::size_t parts = (reader.size() + kPartSize - 1) / kPartSize;
  m_ends.resize(parts);
  runInParts(reader.size(), kPartSize, executor, [&](std::size_t begin, std::size_t end) {
    m_ends[begin / kPartSize] = static_cast<std::size_t>(choose(begin, end, ids.data() + begin) - ids.data());
  });
  std::size_t size = m_ends[0];
  for (std::size_t part = 1; part < parts; ++part) {
    const std::uint32_t* const begin = ids.data() + part * kPartSize;
    if (begin != ids.data() + size) {
      std::copy<const std::uint32_t*>(begin, ids.data() + m_ends[part], ids.data() + size);
    }
    size += m_ends[part] - part * kPartSize;
  }
  reader.restrictTo({ids.data(), size});
}

template <class T>
void BoxCull::keepTouching(BoxReader& reader, const BoxReader& other, Ids& ids, Executor& executor) {
  const std::array<T, 6> bounds = exactBoundsOf<T>(other);
  const BoxRun<T> run = runOf<T>(reader.boxes());
  keep(reader, ids, executor, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
    return chooseTouching(run.part(begin, end - begin), begin, bounds, reader.kernels(), to);
  });
}

bool BoxCull::restrict(BoxReader& reader, const BoxReader& other, Ids& ids, Executor& executor) {
  if (reader.size() < kLeastBoxes) return false;
  const LaneBox bounds = boundsOf(other);
  if (!areMostlyOutside(reader, bounds)) return false;
  const bool isBoundedAgain = other.size() <= reader.size() / kBoundedAgain;
  if (isBoundedAgain && reader.areBoundsOf<float>() && other.areBoundsOf<float>()) {
    keepTouching<float>(reader, other, ids, executor);
  } else if (isBoundedAgain && reader.areBoundsOf<double>() && other.areBoundsOf<double>()) {
    keepTouching<double>(reader, other, ids, executor);
  } else {
    keep(reader, ids, executor, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
      return chooseTouching(reader, {nullptr, begin, end - begin}, bounds, to);
    });
  }
  return true;
}

void BoxCull::apply(BoxReader& first, BoxReader& second, Executor& executor) {
  const bool firstIsSmall = first.size() <= second.size();
  BoxReader& small = firstIsSmall ? first : second;
  BoxReader& large = firstIsSmall ? second : first;
  if (restrict(large, small, m_largeIds, executor)) restrict(small, large, m_smallIds, executor);
}

}  // namespace allpairs::engine
