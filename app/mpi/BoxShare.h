// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "allpairs/BoxView.h"

namespace allpairs::app {

/// One rank's share of the boxes of .npy files, which are one set numbered on from file to file: as float32 where all
/// files are, else as float64. Disjoint shares are read with ordinary reads, so that any file system that all ranks see
/// will do.
class BoxShare {
 public:
  /// Bad input: throws FileError.
  BoxShare(std::span<const std::filesystem::path> paths, int rank, int ranks);

  /// Bad input: a NaN throws FileError, which names file and box.
  [[nodiscard]] BoxView view() const;

  /// Of all files.
  [[nodiscard]] std::uint64_t allBoxes() const noexcept { return m_allBoxes; }

 private:
  template <class Number>
  void read(std::vector<Number>& rows);
  [[noreturn]] void failAt(std::uint64_t box) const;

  std::span<const std::filesystem::path> m_paths;
  std::vector<std::uint64_t> m_ends;  ///< Of each file, behind the number of its last box.
  std::uint64_t m_allBoxes = 0;
  std::uint64_t m_begin = 0;
  std::uint64_t m_end = 0;
  bool m_isFloat64 = false;
  std::vector<float> m_float32;
  std::vector<double> m_float64;
};

}  // namespace allpairs::app
