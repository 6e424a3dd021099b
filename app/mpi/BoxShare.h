// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "allpairs/BoxView.h"
#include "allpairs/Error.h"
#include "allpairs/Filter.h"
#include "allpairs/scene/BoxValues.h"
#include "allpairs/scene/EmptyBoxes.h"

namespace allpairs::app {

/// The files of a set.
struct BoxFiles {
  std::vector<std::filesystem::path> paths{};
  scene::BoxValueFiles values{};
};

/// One rank's share of the boxes of .npy files, which are one set numbered on from file to file: as float32 where all
/// files are, else as float64. Disjoint shares are read with ordinary reads, so that any file system that all ranks see
/// will do.
class BoxShare {
 public:
  /// Bad input: throws FileError.
  BoxShare(const BoxFiles& files, int rank, int ranks);

  /// With their margins.
  ///
  /// Bad input: a NaN throws FileError, which names file, box and bound.
  [[nodiscard]] BoxView view() const;

  [[nodiscard]] FilterBits bits() const;

  /// Those of this rank, by their numbers in the set.
  [[nodiscard]] scene::EmptyBoxes empty() const;

  /// Of all files.
  [[nodiscard]] std::uint64_t allBoxes() const noexcept { return m_allBoxes; }

 private:
  template <class Number>
  void read(std::vector<Number>& rows);
  template <class Number>
  [[nodiscard]] std::vector<Number> valuesOf(std::span<const std::filesystem::path> paths, scene::BoxValue kind) const;
  [[noreturn]] void fail(const InvalidBox& problem) const;

  std::span<const std::filesystem::path> m_paths;
  std::vector<std::uint64_t> m_ends;  ///< Of each file, behind the number of its last box.
  std::uint64_t m_allBoxes = 0;
  std::uint64_t m_begin = 0;
  std::uint64_t m_end = 0;
  bool m_isFloat64 = false;
  std::vector<float> m_float32;
  std::vector<double> m_float64;
  std::vector<double> m_margins;
  std::vector<std::uint32_t> m_groups;
  std::vector<std::uint32_t> m_categories;
  std::vector<std::uint32_t> m_masks;
};

}  // namespace allpairs::app
