// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "CurveGrid.h"
#include "FlatSearch.h"
#include "Hits.h"
#include "Join.h"
#include "Lanes.h"
#include "PackedBucket.h"
#include "QueryLanes.h"
#include "RowBlock.h"
#include "allpairs/Pair.h"

namespace allpairs::engine {

/// What is compiled once for each instruction set. The results do not depend on which one runs.
struct Kernels {
  std::string_view name;

  /// Tests rows of a list against a range of columns each, without any hierarchy.
  void (*searchFlat)(const FlatSearch& search, Hits& hits);

  /// Joins part of one hierarchy with another, or with itself.
  void (*join)(const JoinTask& task, Hits& hits);

  /// Bounds of blocks [begin, end), each written as one lane of `parents`.
  void (*boundBlocks)(const LaneBlock* blocks, std::size_t begin, std::size_t end, LaneBlock* parents);

  /// Turns hits into pairs.
  void (*writePairs)(const Hits& hits, PairSide side, Pair* pairs);

  /// Puts the numbers of a bucket in order and writes them as pairs. Keys with more pairs than a network takes must be in
  /// order.
  void (*finishBucket)(const PackedBucket& bucket);

  /// The keys of the boxes of some blocks, sixteen of each.
  void (*curveKeys)(std::span<const LaneBlock> blocks, const CurveGrid& grid, std::uint32_t* keys);

  /// Reads sixteen boxes, or the first boxes of a tile, from rows that follow each other.
  RowBlockResult (*readRun32)(const float* rows, LaneBlock& block);
  bool (*readTile32)(const float* rows, std::size_t size, std::uint32_t firstId, LaneTile& tile);

  /// Reads sixteen boxes, those that start `offsets` values after `rows`, as lanes that are no smaller.
  RowBlockResult (*readFloat32)(const float* rows, const std::int32_t* offsets, LaneBlock& block);
  RowBlockResult (*readFloat64)(const double* rows, const std::int32_t* offsets, LaneBlock& block);

  /// Which of sixteen boxes a query may meet, as bits: all that it does, and few others. Where a number is asked for, it
  /// is no more than what the query comes to, for each of them: the time of meeting, the square of the distance.
  std::uint32_t (*touchingLanes)(const LaneBlock& block, const LaneBox& box);
  std::uint32_t (*meetingLanes)(const LaneBlock& block, const SweepLanes& sweep, float limit, float* times);
  std::uint32_t (*nearLanes)(const LaneBlock& block, const PointLanes& point, float limit, float* squares);
};

/// The kernels for the instruction set of that name, or the best one for an empty name; null if there is none.
[[nodiscard]] const Kernels* findKernels(std::string_view instructionSet);

/// The names of the instruction sets that this processor has, best first.
[[nodiscard]] std::span<const std::string_view> kernelNames();

/// The kernels with one lane, compiled without vector instructions.
[[nodiscard]] const Kernels& scalarKernels();

}  // namespace allpairs::engine
