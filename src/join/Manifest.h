// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "BoxInput.h"
#include "BoxSpill.h"
#include "PairRuns.h"
#include "allpairs/Box.h"
#include "allpairs/partition/Partition.h"
#include "allpairs/scene/EmptyBoxes.h"

namespace allpairs::join {

/// An input as it was when the join began.
struct InputState {
  std::uint64_t path = 0;  ///< The checksum of its name, which need not be text.
  std::uint64_t bytes = 0;
  std::int64_t changed = 0;  ///< The time of its last change, in the file system's unit.

  friend bool operator==(const InputState&, const InputState&) = default;
};

/// A file of what boxes have, as it was then, and which that is; see ValuePath.
struct ValueState {
  std::uint64_t kind = 0;
  InputState file{};

  friend bool operator==(const ValueState&, const ValueState&) = default;
};

/// The pairs of a cell that was searched.
struct CellResult {
  std::uint64_t pairs = 0;
  std::vector<Run> runs{};
};

/// What is complete of a join: enough to go on with it.
struct Manifest {
  std::vector<InputState> inputs{};
  std::size_t secondFiles = 0;  ///< How many of them, the last ones, are the second of two sets.
  double distance = 0.0;
  std::vector<ValueState> values{};
  std::optional<Box> region{};
  bool isCount = false;
  std::uint64_t outside = 0;  ///< Boxes that are empty, or that the region leaves out.
  std::array<scene::EmptyBoxes, 2> empty{};
  std::vector<partition::Cut> cuts{};
  std::vector<Extent> extents{};              ///< Of each part of the boxes; see partOf().
  std::map<std::size_t, CellResult> cells{};  ///< Those that were searched.

  /// Replaces the file: whoever reads it finds the one before or this one, whole.
  void write(const std::filesystem::path& path) const;

  /// Bad input: parts that do not fit each other throw InvalidArgument. What checksums cover is not looked at. read()
  /// checks.
  void check() const;

  /// None if there is no file.
  ///
  /// Bad input: a file that is not what was written throws FileError.
  [[nodiscard]] static std::optional<Manifest> read(const std::filesystem::path& path);
};

/// The state of inputs, to compare with that of a manifest.
[[nodiscard]] std::vector<InputState> statesOf(std::span<const std::filesystem::path> paths);
[[nodiscard]] std::vector<ValueState> statesOf(std::span<const ValuePath> paths);

}  // namespace allpairs::join
