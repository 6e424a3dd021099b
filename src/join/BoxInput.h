// SPDX-License-Identifier: MIT
#pragma once

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

/// Several files of boxes as one set, numbered from the first box of the first file on. One of them is open at a time.
class BoxInput {
 public:
  /// Receives boxes, the first of which has the number `begin`; both are valid during the call.
  using Visitor = FunctionRef<void(std::uint64_t begin, const BoxView& boxes)>;

  explicit BoxInput(std::span<const std::filesystem::path> paths);

  [[nodiscard]] std::uint64_t size() const noexcept { return m_size; }

  /// Whether any file is float64: then all are read as that, which holds both exactly.
  [[nodiscard]] bool isFloat64() const noexcept { return m_isFloat64; }

  [[nodiscard]] std::span<const std::filesystem::path> paths() const noexcept { return m_paths; }

  /// Reads all boxes in order, some thousands at a time.
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

  std::vector<std::filesystem::path> m_paths;
  std::vector<std::uint64_t> m_sizes;
  std::uint64_t m_size = 0;
  bool m_isFloat64 = false;
};

}  // namespace allpairs::join
