// SPDX-License-Identifier: MIT
#include "input/BoxCull.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "input/BoxRuns.h"
#include "input/Parts.h"
#include "input/Sampling.h"

namespace allpairs::engine {
namespace {

/// Fewer boxes are not worth a pass that leaves some out (docs/decisions/0022).
constexpr std::size_t kLeastBoxes = 1024;

/// Up to one box in this many of the other set, what takes another pass over a set pays off (docs/decisions/0022).
constexpr std::size_t kTimesLarger = 32;

/// Cells for each box whose cells are marked: so many that few are marked, of boxes much smaller than the space between
/// them (docs/decisions/0022).
constexpr std::size_t kCellsPerBox = 1024;

/// The bounds of all boxes that may overlap something.
LaneBox boundsOf(const BoxReader& reader) {
  LaneBlock bounds;
  bounds.clear();
  LaneBlock block = bounds;
  const BoxList all{nullptr, 0, reader.size()};
  for (std::size_t begin = 0; begin < all.size; begin += kFanOut) {
    const BoxList boxes = all.part(begin, kFanOut);
    block.clear(reader.read(boxes, block).emptyLanes);
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

/// Boxes of a set, or lanes that touch nothing.
using Sample = std::array<LaneBlock, kSample / kFanOut>;

Sample sampleOf(const BoxReader& reader) {
  Sample sample;
  for (LaneBlock& block : sample) block.clear();
  std::size_t size = 0;
  sampleBoxes(reader, kSample, [&](const LaneBox& box) {
    sample[size / kFanOut].set(size % kFanOut, box);
    ++size;
  });
  return sample;
}

/// How many boxes of a sample are near, which near(block) says of lanes.
template <class Near>
std::size_t countNear(const Sample& sample, const Near& near) {
  std::size_t count = 0;
  for (const LaneBlock& block : sample) count += static_cast<std::size_t>(std::popcount(near(block)));
  return count;
}

/// A length that nine in ten boxes of a sample do not exceed on any axis.
double usualLength(const Sample& sample) {
  std::array<float, kSample> longest;
  for (std::size_t i = 0; i < kSample; ++i) longest[i] = longestSide(sample[i / kFanOut].get(i % kFanOut));
  const auto most = longest.begin() + kSample * 9 / 10;
  std::nth_element(longest.begin(), most, longest.end());
  return static_cast<double>(*most);
}

/// Writes the ids of those of some boxes that are near, which near(block) says of lanes; returns the end of what it
/// wrote.
template <class Near>
std::uint32_t* chooseNear(const BoxReader& reader, const BoxList& boxes, const Near& near, std::uint32_t* ids) {
  LaneBlock block;
  block.clear();
  for (std::size_t i = 0; i < boxes.size; i += kFanOut) {
    const BoxList some = boxes.part(i, kFanOut);
    const std::uint32_t empty = reader.read(some, block).emptyLanes;
    const std::uint32_t lanes = near(block) & ~empty & ((1U << some.size) - 1U);
    forEachBit(lanes, [&](std::size_t lane) { *ids++ = reader.idOf(some[lane]); });
  }
  return ids;
}

/// The bounds of all boxes of a set that are not empty, in the precision of the boxes.
template <class T>
std::array<T, 6> exactBoundsOf(const BoxReader& reader) {
  Box bounds = kEmptyBox;
  for (std::size_t i = 0; i < reader.size(); ++i) {
    bounds = merge(bounds, reader.boxes()[reader.idOf(i)]);
  }
  std::array<T, 6> result;
  std::transform(bounds.min.begin(), bounds.min.end(), result.begin(), [](double v) { return static_cast<T>(v); });
  std::transform(bounds.max.begin(), bounds.max.end(), result.begin() + 3, [](double v) { return static_cast<T>(v); });
  return result;
}

/// Cubic cells over the bounds, so many at most and of so long a side at least. The scale is 0 if the bounds are
/// shorter than a side on all axes, or are those of no box.
MarkedCells cellsOver(const LaneBox& bounds, std::size_t most, double leastSide) {
  MarkedCells cells;
  cells.count = {1, 1, 1};
  std::array<double, 3> width;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cells.origin[axis] = bounds.bound[axis];
    width[axis] = static_cast<double>(bounds.bound[axis + 3]) - static_cast<double>(bounds.bound[axis]);
  }
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](std::size_t a, std::size_t b) { return width[a] > width[b]; });
  // An axis on which the boxes are narrower than a cell has one cell, and the others have more.
  for (std::size_t used = 3; used > 0; --used) {
    double volume = 1.0;
    for (std::size_t k = 0; k < used; ++k) volume *= std::max(width[axes[k]], 0.0);
    const double side =
        std::max(std::pow(volume / static_cast<double>(most), 1.0 / static_cast<double>(used)), leastSide);
    if (!(width[axes[used - 1]] > side)) continue;
    for (std::size_t k = 0; k < used; ++k) cells.count[axes[k]] = static_cast<std::int32_t>(width[axes[k]] / side);
    cells.scale = static_cast<float>(1.0 / side);
    break;
  }
  return cells;
}

/// Marks the cells of a box, and those before them on each axis, unless these are too many; returns how many they are.
std::size_t markBox(const MarkedCells& cells, const LaneBox& box, std::size_t most, std::uint32_t* marks) {
  std::array<std::size_t, 3> begin{};
  std::array<std::size_t, 3> end{};
  std::size_t size = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    begin[axis] = static_cast<std::size_t>(std::max(cells.cellOf(box.bound[axis], axis) - 1, 0));
    end[axis] = static_cast<std::size_t>(cells.cellOf(box.bound[axis + 3], axis)) + 1;
    size *= end[axis] - begin[axis];
  }
  if (size > most) return size;
  const auto rowLength = static_cast<std::size_t>(cells.count[0]);
  for (std::size_t z = begin[2]; z < end[2]; ++z) {
    for (std::size_t y = begin[1]; y < end[1]; ++y) {
      const std::size_t row = (z * static_cast<std::size_t>(cells.count[1]) + y) * rowLength;
      for (std::size_t cell = row + begin[0]; cell < row + end[0]; ++cell) marks[cell / 32] |= 1U << (cell % 32);
    }
  }
  return size;
}

/// The same of a part of the boxes as they lie in memory, `first` being the number of the first.
template <class T>
std::uint32_t* chooseTouching(const BoxRun<T>& part, std::size_t first, const std::array<T, 6>& bounds,
                              const Kernels& kernels, std::uint32_t* ids) {
  std::array<std::uint64_t, kPartSize / kWordBoxes> words;
  kernels.plain<T>().touchBoxes(part, bounds, words.data());
  forEachBit(std::span(words).first((part.size + kWordBoxes - 1) / kWordBoxes),
             [&](std::size_t i) { *ids++ = static_cast<std::uint32_t>(first + i); });
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
  const auto beginOf = [](std::size_t part) { return part * kPartSize; };
  reader.restrictTo(
      {ids.data(), closeGaps(ids.data(), parts, beginOf, [this](std::size_t part) { return m_ends[part]; })});
}

template <class T>
void BoxCull::keepTouching(BoxReader& reader, const BoxReader& other, Ids& ids, Executor& executor) {
  const std::array<T, 6> bounds = exactBoundsOf<T>(other);
  const BoxRun<T> run = runOf<T>(reader.boxes());
  keep(reader, ids, executor, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
    return chooseTouching(run.part(begin, end - begin), begin, bounds, reader.kernels(), to);
  });
}

/// Restricts the reader to the boxes that are near, which isNear(block) says of lanes.
template <class Near>
void BoxCull::keepNear(BoxReader& reader, const Near& isNear, Ids& ids, Executor& executor) {
  keep(reader, ids, executor, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
    return chooseNear(reader, {nullptr, begin, end - begin}, isNear, to);
  });
}

/// Leaves out the boxes outside of the other set's bounds, if these are many of a sample.
void BoxCull::restrictToBounds(BoxReader& reader, const BoxReader& other, const LaneBox& bounds, Ids& ids,
                               Executor& executor) {
  const auto isNear = [&](const LaneBlock& block) { return reader.kernels().touchingLanes(block, bounds); };
  if (2 * countNear(sampleOf(reader), isNear) > kSample) return;
  const bool isLarger = other.size() <= reader.size() / kTimesLarger;
  const bool areRead = isLarger && reader.areAllByBounds() && other.areAllByBounds();
  if (!areRead || !areRuns(reader.boxes(), other.boxes())) {
    keepNear(reader, isNear, ids, executor);
  } else if (reader.boxes().isFloat64()) {
    keepTouching<double>(reader, other, ids, executor);
  } else {
    keepTouching<float>(reader, other, ids, executor);
  }
}

/// Marks the cells of a set's boxes; returns false, soon, if they are many: then they leave out little.
bool BoxCull::mark(const BoxReader& reader, MarkedCells& cells) {
  const std::size_t words = cells.size() / 32 + 1;
  m_marks.require(words);
  std::fill_n(m_marks.data(), words, 0U);
  cells.marks = m_marks.data();
  std::size_t marked = 0;
  LaneBlock block;
  for (std::size_t i = 0; i < reader.size(); i += kFanOut) {
    const std::size_t most = std::min(kCellsPerBox / 16 * (i + kFanOut), cells.size() / 2);
    const BoxList some = BoxList{nullptr, 0, reader.size()}.part(i, kFanOut);
    const std::uint32_t lanes = ~reader.read(some, block).emptyLanes & ((1U << some.size) - 1U);
    forEachBit(lanes, [&](std::size_t lane) { marked += markBox(cells, block.get(lane), most, m_marks.data()); });
    if (marked > most) return false;
  }
  return true;
}

/// Leaves out the boxes that are in no cell with a box of the other set, if these are many of a sample.
void BoxCull::restrictToCells(BoxReader& reader, const BoxReader& other, const LaneBox& bounds, Ids& ids,
                              Executor& executor) {
  if (other.size() > reader.size() / kTimesLarger) return;
  const Sample sample = sampleOf(reader);
  // So many that float32 tells them all apart; with so much smaller a set, no more bytes than ids have.
  const std::size_t mostCells = std::min(kCellsPerBox * other.size(), std::size_t{1} << 24);
  MarkedCells cells = cellsOver(bounds, mostCells, usualLength(sample));
  if (!std::isnormal(cells.scale) || !mark(other, cells)) return;
  const Kernels& kernels = reader.kernels();
  const auto isNear = [&](const LaneBlock& block) {
    return kernels.touchingLanes(block, bounds) & kernels.markedLanes(block, cells);
  };
  if (3 * countNear(sample, isNear) <= kSample) keepNear(reader, isNear, ids, executor);
}

void BoxCull::apply(BoxReader& first, BoxReader& second, Executor& executor) {
  const bool firstIsSmall = first.size() <= second.size();
  BoxReader& small = firstIsSmall ? first : second;
  BoxReader& large = firstIsSmall ? second : first;
  const std::size_t size = large.size();
  if (size < kLeastBoxes) return;
  const LaneBox bounds = boundsOf(small);
  restrictToBounds(large, small, bounds, m_largeIds, executor);
  if (large.size() >= kLeastBoxes) restrictToCells(large, small, bounds, m_largeIds, executor);
  if (large.size() == size || small.size() < kLeastBoxes) return;
  restrictToBounds(small, large, boundsOf(large), m_smallIds, executor);
}

}  // namespace allpairs::engine
