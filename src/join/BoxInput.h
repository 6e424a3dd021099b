// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "allpairs/Box.h"
#include "allpairs/BoxView.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/scene/BoxRows.h"

namespace allpairs::join {

/// Some boxes of a set that follow one another.
struct BoxBlock {
  std::size_t set = 0;
  std::uint64_t begin = 0;   ///< The number of the first of them in its set.
  std::uint64_t before = 0;  ///< Boxes of all sets that were read before.
  BoxView boxes{};
};

/// One or two sets of boxes, each in several files, and numbered from the first box of its first file on. One file is
/// open at a time.
class BoxInput {
 public:
  /// Receives boxes, which are valid during the call.
  using Visitor = FunctionRef<void(const BoxBlock& block)>;

  /// No files of a second set mean that there is one set.
  explicit BoxInput(std::span<const std::filesystem::path> first, std::span<const std::filesystem::path> second = {});

  [[nodiscard]] std::size_t sets() const noexcept { return m_firstFiles == m_paths.size() ? 1 : 2; }

  /// Boxes of all sets.
  [[nodiscard]] std::uint64_t size() const noexcept { return m_setSizes[0] + m_setSizes[1]; }
  [[nodiscard]] std::uint64_t size(std::size_t set) const noexcept { return m_setSizes[set]; }

  /// Of the larger set: one more than the greatest number of a box.
  [[nodiscard]] std::uint64_t largestSize() const noexcept { return std::max(m_setSizes[0], m_setSizes[1]); }

  /// Whether any file is float64: then all are read as that, which holds both exactly.
  [[nodiscard]] bool isFloat64() const noexcept { return m_isFloat64; }

  /// Those of the first set, and then those of the second.
  [[nodiscard]] std::span<const std::filesystem::path> paths() const noexcept { return m_paths; }
  [[nodiscard]] std::size_t secondFiles() const noexcept { return m_paths.size() - m_firstFiles; }

  /// Reads all boxes in order, some thousands at a time: the first set, and then the second.
  ///
  /// Bad input: a NaN throws FileError, which names file and box; so does a file that has become longer or shorter.
  void forEachBlock(Visitor visit);

  /// About `count` boxes from everywhere in the files: all, if there are no more.
  [[nodiscard]] std::vector<Box> sample(std::size_t count);

 private:
  template <class Number>
  void readBlocks(std::vector<Number>& rows, Visitor visit);
  template <class Number>
  std::vector<Box> sampleAs(std::size_t count);

  [[nodiscard]] scene::BoxRows open(std::size_t file) const;
  [[nodiscard]] std::size_t setOf(std::size_t file) const noexcept { return file < m_firstFiles ? 0 : 1; }

  std::vector<std::filesystem::path> m_paths;
  std::vector<std::uint64_t> m_sizes;
  std::size_t m_firstFiles = 0;
  std::array<std::uint64_t, 2> m_setSizes{};
  bool m_isFloat64 = false;
};

}  // namespace allpairs::join
