// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "Budget.h"
#include "DiskJoin.h"
#include "Manifest.h"
#include "allpairs/join/Join.h"
#include "support/Boxes.h"
#include "support/Npy.h"
#include "support/Oracle.h"
#include "support/TempFolder.h"

namespace allpairs::test {

/// So little that everything is cut, divided and done in parts.
inline join::Budget tinyBudget() {
  return {.workers = 1, .cellBoxes = 60, .bufferPairs = 50, .bufferBytes = 1, .sampleBoxes = 300, .mergeBytes = 40'000};
}

/// Pairs as the bytes of the file that they must be.
inline std::string bytesOfPairs(const std::vector<Pair>& pairs) {
  std::string bytes =
      npyHeaderBytes("{'descr': '<u4', 'fortran_order': False, 'shape': (" + std::to_string(pairs.size()) + ", 2), }");
  for (const Pair pair : pairs) {
    appendNumber(bytes, pair.first, false);
    appendNumber(bytes, pair.second, false);
  }
  return bytes;
}

/// Those of the double loop.
inline std::string expectedBytes(const std::vector<Box>& boxes, double distance = 0.0) {
  return bytesOfPairs(oracle(boxes, distance));
}

inline std::string bytesOfFile(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The boxes a third as large and moved, so that only float64 holds them.
inline std::vector<Box> farFromTheOrigin(std::vector<Box> boxes) {
  for (Box& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = box.min[axis] / 3.0 + 1e9;
      box.max[axis] = box.max[axis] / 3.0 + 1e9;
    }
  }
  return boxes;
}

/// A join of some files in a folder of its own.
class JoinCase {
 public:
  JoinCase() = default;
  explicit JoinCase(const std::vector<Box>& boxes, const NpyStyle& style = {.descr = "<f4"}) { add(boxes, style); }

  void add(const std::vector<Box>& boxes, const NpyStyle& style = {.descr = "<f4"}) {
    const std::string name = "boxes" + std::to_string(paths.size()) + ".npy";
    paths.push_back(folder.write(name, npyBytes(boxes, style)));
  }

  void addSecond(const std::vector<Box>& boxes, const NpyStyle& style = {.descr = "<f4"}) {
    const std::string name = "second" + std::to_string(second.size()) + ".npy";
    second.push_back(folder.write(name, npyBytes(boxes, style)));
  }

  [[nodiscard]] join::JoinOptions options() const {
    join::JoinOptions options;
    options.work = folder.path() / "work";
    options.second = second;
    options.distance = distance;
    options.region = region;
    options.values = values;
    options.secondValues = secondValues;
    return options;
  }

  /// The result's bytes, in the budget.
  std::string run(const join::JoinOptions& options, const join::Budget& budget = tinyBudget()) {
    join::BoxInput input(paths, options);
    std::string bytes;
    const auto append = [&bytes](std::string_view part) { bytes += part; };
    const join::ResultSink sink(append);
    summary = join::DiskJoin(input, options, budget, false).run(&sink);
    return bytes;
  }

  std::uint64_t count(const join::JoinOptions& options, const join::Budget& budget = tinyBudget()) {
    join::BoxInput input(paths, options);
    summary = join::DiskJoin(input, options, budget, true).run(nullptr);
    return summary.pairs;
  }

  TempFolder folder;
  std::vector<std::filesystem::path> paths;
  std::vector<std::filesystem::path> second;
  double distance = 0.0;
  std::optional<Box> region{};
  scene::BoxValueFiles values{};
  scene::BoxValueFiles secondValues{};
  join::JoinSummary summary{};
};

}  // namespace allpairs::test
