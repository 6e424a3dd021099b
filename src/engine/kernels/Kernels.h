// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "allpairs/OverlapOptions.h"
#include "allpairs/Pair.h"
#include "kernels/CurveGrid.h"
#include "kernels/Hits.h"
#include "kernels/Lanes.h"
#include "kernels/WorldsRun.h"
#include "memory/Memory.h"

namespace allpairs::engine {

/// Every row against its columns, row after row: the exhaustive search, or a part of it.
struct FlatSearch {
  LaneList rows;
  LaneList columns;
  std::size_t rowBegin = 0;
  std::size_t rowEnd = 0;
  Columns tested = Columns::All;

  /// If set, the partners are listed here, row by row, and not as hits.
  NeighborLists* lists = nullptr;
};

/// So many boxes of each set are searched on the stack: at least as many as any instruction set tests exhaustively in
/// one set.
inline constexpr std::size_t kMostFew = 384;
static_assert(kMostFew <= LaneTile::kCapacity);

/// A box with its id, at one place in memory.
struct alignas(32) NumberedBox {
  LaneBox box;
  std::uint32_t id;
};

/// Working memory of a join, one per running task: at each level the candidates of the current node. Where neighbors
/// are listed, also the boxes near a node, one after the other, and in an array for each bound.
struct JoinScratch {
  explicit JoinScratch(std::pmr::memory_resource* memory)
      : level(makeArray<PerLevel, kMaxLevels>(memory)),
        keys(memory),
        boxes(memory),
        bounds(memory),
        near(memory),
        hitBits(memory),
        hitIds(memory) {}

  struct PerLevel {
    explicit PerLevel(std::pmr::memory_resource* memory) : tiles(memory), sizes(memory), partners(memory) {}

    std::pmr::vector<Buffer<LaneTile>> tiles;
    std::pmr::vector<std::size_t> sizes;  ///< How many candidates are in each tile.
    std::size_t tileCount = 0;
    Buffer<std::uint32_t> partners;

    /// Memory for the partners of a node; over-allocates, so that moving scenes do not reallocate repeatedly.
    std::uint32_t* roomFor(std::size_t count) {
      if (count > partners.capacity()) partners.require(2 * count);
      return partners.data();
    }

    LaneTile& nextTile() {
      if (tileCount == tiles.size()) tiles.emplace_back(tiles.get_allocator().resource());
      if (sizes.size() < tiles.size()) sizes.resize(tiles.size());
      tiles[tileCount].require(1);  // There, unless it is new or there was no memory for it.
      return tiles[tileCount++][0];
    }
  };
  std::array<PerLevel, kMaxLevels> level;

  /// Room for so many boxes near a node and for whole vectors after them; the contents are lost.
  void requireNear(std::size_t count) {
    if (count + kVectorSlack > stride) {
      // Not a multiple of many boxes, which would bring the arrays to the same offset in their pages.
      const std::size_t larger = 2 * count / kFanOut * kFanOut + kVectorSlack + 2 * kFanOut;
      stride = 0;
      bounds.require(6 * larger);
      boxes.require(larger);
      for (Buffer<std::uint32_t>* numbers : {&near, &hitBits, &hitIds}) numbers->require(larger);
      stride = larger;
    }
    for (std::size_t row = 0; row < 6; ++row) bound[row] = bounds.data() + row * stride;
    size = count;
  }

  Buffer<std::uint64_t> keys;  ///< An id above a position, twice.
  Buffer<NumberedBox> boxes;   ///< Those near the node, `size` of them,
  Buffer<float> bounds;        ///< and their bounds, in rows of `stride` that begin at `bound`.
  std::array<float*, 6> bound{};
  std::size_t size = 0;
  std::size_t stride = 0;
  Buffer<std::uint32_t> near;     ///< The boxes that are near a leaf too.
  Buffer<std::uint32_t> hitBits;  ///< By box with a hit: a bit for each box of the leaf that it overlaps.
  Buffer<std::uint32_t> hitIds;
};

/// The part of a join that starts from some leaf blocks of `first`.
///
/// Each node of `first` is tested, from the top down and from left to right, against the list of the nodes of `second`
/// on its level that overlap it; in a self-join, those from the node itself on.
struct JoinTask {
  const BvhView* first = nullptr;
  const BvhView* second = nullptr;
  bool withItself = false;
  std::size_t leafBegin = 0;
  std::size_t leafEnd = 0;
  JoinScratch* scratch = nullptr;

  /// If set, the partners are listed here, box by box, and not as hits. The hierarchies have more than one level then.
  NeighborLists* lists = nullptr;
};

/// Pairs as numbers, the key that orders them above the other index, in a row for each key. There is room for a vector
/// after the last one.
struct NumberRows {
  std::uint32_t* numbers = nullptr;  ///< Of 31 bits.
  std::size_t size = 0;
  const std::uint32_t* begin = nullptr;  ///< By key, and where the last row ends.
  unsigned otherBits = 0;
  std::uint32_t firstKey = 0;  ///< Added to all keys.
  bool bySecond = false;       ///< Whether the key is second in its pair.
};

/// Where sixteen boxes lie: bound k of box i, of minx miny minz maxx maxy maxz, at bound[k][offset[i]].
template <class T>
struct BoxPlaces {
  std::array<const T*, 6> bound;
  std::array<std::int32_t, kFanOut> offset;
};

/// What is done to bounds before they are rounded to lanes.
struct Widening {
  std::array<double, 3> origin{};  ///< Lanes are relative to it.
  bool widens = false;             ///< By `half`, and by the margin of each box.
  double half = 0.0;
  const double* margins = nullptr;  ///< Of the sixteen boxes.
  bool toNearest = false;           ///< Whether bounds that are not widened are rounded to the nearest, not outward.
};

/// Properties of sixteen boxes that were read.
struct BlockRead {
  bool exact = true;             ///< Their lanes are exactly the boxes.
  std::uint32_t emptyLanes = 0;  ///< A bit for each that is empty.
};

/// The most boxes that others are compared with together: each takes a pass over the others, and up to so many take
/// less time than reading the others for the search of any two sets (few_benchmark).
inline constexpr std::size_t kMostOthers = 8;

/// Which of some boxes touch each of a few others, as touchBoxes() writes it.
struct TouchedBoxes {
  std::array<const std::uint64_t*, kMostOthers> words{};
  std::size_t size = 0;
  std::size_t others = 0;
  std::uint32_t first = 0;       ///< The number of the first box.
  std::uint32_t firstOther = 0;  ///< And of the first of the others.
};

/// Cubic cells over some boxes. A cell is marked if one of the boxes touches it, or the cell after it on some axes: a
/// box of two cells on each axis, or one, can touch one of the boxes only if its first cell is marked.
struct MarkedCells {
  std::array<float, 3> origin{};
  float scale = 0.0F;                    ///< Cells per unit of length, a normal number.
  std::array<std::int32_t, 3> count{};   ///< On an axis with one cell, bounds are not looked at.
  const std::uint32_t* marks = nullptr;  ///< A bit for each cell, those along x next to each other, then along y.

  [[nodiscard]] std::size_t size() const noexcept {
    return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]);
  }

  /// The cell of a bound; it never decreases from one bound to a greater one, however it is rounded.
  [[nodiscard]] std::int32_t cellOf(float bound, std::size_t axis) const noexcept {
    const float cell = (bound - origin[axis]) * scale;
    return static_cast<std::int32_t>(std::min(std::max(cell, 0.0F), static_cast<float>(count[axis] - 1)));
  }
};

/// Boxes that descend a hierarchy together, at one level of it: visit i tests box boxOf[i] with block blockOf[i].
struct BlockVisits {
  const LaneBox* boxes = nullptr;
  const LaneBlock* blocks = nullptr;
  const std::uint32_t* boxOf = nullptr;
  const std::uint32_t* blockOf = nullptr;
  std::size_t size = 0;
};

/// The functions for boxes as they lie in memory. The searches round float64 to the nearest float32, where there are
/// vectors, and test what they find exactly.
template <class T>
struct PlainKernels {
  /// Writes, as bits of words, which boxes of a run are not empty and touch a box, which is not empty either.
  void (*touchBoxes)(const BoxRun<T>& run, const std::array<T, 6>& box, std::uint64_t* words);

  /// Whether any value is a NaN.
  bool (*anyNan)(const T* values, std::size_t size);

  /// All pairs of each of many worlds of few boxes.
  void (*searchWorlds)(WorldsRun<T>& run);

  /// All pairs of two sets of few boxes.
  void (*searchBetween)(BetweenRun<T>& run);
};

/// The functions compiled once per instruction set. The results do not depend on which one runs.
struct Kernels {
  std::string_view name;

  /// Up to this many boxes of one set, testing all pairs takes less time than a hierarchy (docs/decisions/0009).
  std::size_t flatBoxes;

  /// The same of boxes that are compared as they lie in memory, in order.
  std::size_t plainBoxes;

  /// Up to this many boxes of one world, testing all pairs in double takes less time than rounding boxes to lanes.
  std::size_t wideBoxes;

  /// So many tests of a join take as long as putting a pair in order by buckets (docs/decisions/0025).
  double testsForPair;

  /// Tests rows of a list against a range of columns each, without any hierarchy; against all but their own only for
  /// lists.
  void (*searchFlat)(const FlatSearch& search, Hits& hits);

  PlainKernels<float> plain32;
  PlainKernels<double> plain64;

  template <class T>
  [[nodiscard]] const PlainKernels<T>& plain() const noexcept {
    if constexpr (std::is_same_v<T, float>) {
      return plain32;
    } else {
      return plain64;
    }
  }

  /// Writes the pairs of boxes that touch others, in the order of the boxes and then of the others, and up to
  /// kVectorSlack past the last one. Returns how many there are.
  std::size_t (*writeTouching)(const TouchedBoxes& touched, bool othersSecond, Pair* pairs);

  /// All pairs of one of them whose boxes need the test with margins and a distance.
  void (*searchWideWorld)(const WideWorld& world, WorldSink& sink);

  /// Joins part of one hierarchy with another, or with itself.
  void (*join)(const JoinTask& task, Hits& hits);

  /// Bounds of blocks [begin, end), each written as one lane of `parents`.
  void (*boundBlocks)(const LaneBlock* blocks, std::size_t begin, std::size_t end, LaneBlock* parents);

  /// Turns hits into pairs.
  void (*writePairs)(const Hits& hits, PairSide side, Pair* pairs);

  /// Writes each row as pairs in order, or only the other index of each.
  void (*orderRows)(const NumberRows& rows, Pair* to);
  void (*orderPartners)(const NumberRows& rows, std::uint32_t* to);

  /// The keys of the boxes of some blocks, sixteen of each.
  void (*curveKeys)(std::span<const LaneBlock> blocks, const CurveGrid& grid, std::uint32_t* keys);

  /// Reads sixteen boxes from rows that follow each other.
  BlockRead (*readRun32)(const float* rows, LaneBlock& block);

  /// Reads sixteen boxes from anywhere, as lanes that contain them.
  BlockRead (*readFloat32)(const BoxPlaces<float>& places, LaneBlock& block);

  /// The same in double, widened, relative to an origin, or rounded to the nearest.
  BlockRead (*readWide32)(const BoxPlaces<float>& places, const Widening& widening, LaneBlock& block);
  BlockRead (*readWide64)(const BoxPlaces<double>& places, const Widening& widening, LaneBlock& block);

  /// Which of sixteen boxes a query may hit, as bits: a superset of the hits. If a number is requested, it is a lower
  /// bound for each of them: of the time of the hit, or of the squared distance. A point
  /// or a box is given as lanes that contain it.
  std::uint32_t (*touchingLanes)(const LaneBlock& block, const LaneBox& box);
  std::uint32_t (*markedLanes)(const LaneBlock& block, const MarkedCells& cells);
  std::uint32_t (*meetingLanes)(const LaneBlock& block, const SweepLanes& sweep, float limit, float* times);
  std::uint32_t (*nearLanes)(const LaneBlock& block, const LaneBox& box, float limit, float* squares);

  /// The cheapest of some lanes, of which there is one, by such numbers; the first of several.
  std::size_t (*cheapestLane)(std::uint32_t lanes, const float* costs);

  /// The same as touchingLanes() for each visit, in their order: writes the places of the lanes in the level, and the
  /// box beside each, and up to kVectorSlack past the last one. Returns how many there are.
  std::size_t (*touchingPlaces)(const BlockVisits& visits, std::uint32_t* boxOf, std::uint32_t* places);
};

/// The kernels for the instruction set of that name, or the best one for an empty name; null if there is none.
[[nodiscard]] const Kernels* findKernels(std::string_view instructionSet);

/// The names of the instruction sets that this processor has, best first.
[[nodiscard]] std::span<const std::string_view> kernelNames();

/// The kernels with one lane, compiled without vector instructions.
[[nodiscard]] const Kernels& scalarKernels();

}  // namespace allpairs::engine
