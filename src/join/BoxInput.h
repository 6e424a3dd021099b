// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "BoxBlock.h"
#include "RecordType.h"
#include "allpairs/Filter.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/join/Join.h"
#include "allpairs/scene/BoxRows.h"
#include "allpairs/scene/BoxValues.h"

namespace allpairs::join {

/// What the boxes of a set have beside their bounds, read a part at a time.
class SetValues {
 public:
  /// None.
  SetValues() = default;

  /// Bad input: files that are not of so many boxes throw FileError.
  SetValues(const scene::BoxValueFiles& files, std::uint64_t boxes);

  [[nodiscard]] bool hasMargins() const noexcept { return m_marginFiles.has_value(); }

  /// Adds what there is to the type of a join's records.
  void addTo(RecordType& type) const noexcept;

  /// Reads what belongs to some boxes; margins() and bits() are valid until the next time.
  void read(std::uint64_t begin, std::size_t count);
  void readMargins(std::uint64_t begin, std::size_t count);

  [[nodiscard]] std::span<const double> margins() const noexcept { return m_margins; }
  [[nodiscard]] FilterBits bits() const noexcept {
    return {.categories = m_categories, .masks = m_masks, .groups = m_groups};
  }

 private:
  std::optional<scene::BoxValues> m_marginFiles;
  std::optional<scene::BoxValues> m_groupFiles;
  std::optional<scene::BoxValues> m_categoryFiles;
  std::optional<scene::BoxValues> m_maskFiles;
  std::vector<double> m_margins;
  std::vector<std::uint32_t> m_groups;
  std::vector<std::uint32_t> m_categories;
  std::vector<std::uint32_t> m_masks;
};

/// A file of what boxes have, and which that is: the kind, and 4 more for those of the second set.
struct ValuePath {
  std::uint64_t kind = 0;
  std::filesystem::path path{};
};

/// One or two sets of boxes, each in several files, and numbered from the first box of its first file on. One file is
/// open at a time.
class BoxInput {
 public:
  /// Receives boxes, which are valid during the call.
  using Visitor = FunctionRef<void(const BoxBlock& block)>;

  /// The first set, and what the options name: a second one if it has files, and what boxes have.
  BoxInput(std::span<const std::filesystem::path> first, const JoinOptions& options);

  [[nodiscard]] std::size_t sets() const noexcept { return m_firstFiles == m_paths.size() ? 1 : 2; }

  /// Boxes of all sets.
  [[nodiscard]] std::uint64_t size() const noexcept { return m_setSizes[0] + m_setSizes[1]; }
  [[nodiscard]] std::uint64_t size(std::size_t set) const noexcept { return m_setSizes[set]; }

  /// Of the larger set: one more than the greatest number of a box.
  [[nodiscard]] std::uint64_t largestSize() const noexcept { return std::max(m_setSizes[0], m_setSizes[1]); }

  /// What a box of either set is on disk. If any file is float64, all are read as that, which holds both exactly.
  [[nodiscard]] const RecordType& recordType() const noexcept { return m_type; }

  /// Those of the first set, and then those of the second.
  [[nodiscard]] std::span<const std::filesystem::path> paths() const noexcept { return m_paths; }
  [[nodiscard]] std::size_t secondFiles() const noexcept { return m_paths.size() - m_firstFiles; }
  [[nodiscard]] std::span<const ValuePath> valuePaths() const noexcept { return m_valuePaths; }

  /// Reads all boxes in order, some thousands at a time: the first set, and then the second.
  ///
  /// Bad input: a NaN throws FileError, which names file, box and bound; so does a file that has become longer or shorter.
  void forEachBlock(Visitor visit);

  /// About `count` boxes with their margins, spread over the files; all boxes if there are fewer.
  /// Those before a bad one, for which forEachBlock() throws; likewise of probes.
  [[nodiscard]] BoxSample sample(std::size_t count);

  /// Visits `count` boxes of each set one by one, with all they have; all of a set if there are fewer. Each is
  /// somewhere in one of as many equal parts, so that in a grid they are not all of one row or plane.
  void forEachProbe(std::size_t count, Visitor visit);

  [[nodiscard]] bool hasMargins(std::size_t set) const noexcept { return m_values[set].hasMargins(); }

  /// The margins of some thousand boxes of a set that has them, from `begin` on; none at the end.
  [[nodiscard]] std::span<const double> margins(std::size_t set, std::uint64_t begin);

 private:
  /// Reads up to `most` boxes from each place in a file that is a multiple of `step`.
  void readEach(std::uint64_t step, std::uint64_t most, Visitor visit);
  template <class Number>
  void readEachAs(std::uint64_t step, std::uint64_t most, Visitor visit);
  template <class Number>
  void readProbesAs(std::uint64_t count, Visitor visit);

  /// Where boxes lie: from box `begin` of a file on, before which there are `before` boxes of its set.
  struct Place {
    std::size_t set = 0;
    std::uint64_t before = 0;
    std::uint64_t begin = 0;
  };
  template <class Number>
  BoxBlock readBlock(scene::BoxRows& file, const Place& place, std::vector<Number>& rows);

  void takeValues(std::size_t set, const scene::BoxValueFiles& files);
  [[nodiscard]] scene::BoxRows open(std::size_t file) const;
  [[nodiscard]] std::size_t setOf(std::size_t file) const noexcept { return file < m_firstFiles ? 0 : 1; }

  std::vector<std::filesystem::path> m_paths;
  std::vector<std::uint64_t> m_sizes;
  std::size_t m_firstFiles = 0;
  std::array<std::uint64_t, 2> m_setSizes{};
  RecordType m_type{};
  std::array<SetValues, 2> m_values;
  std::vector<ValuePath> m_valuePaths;
};

}  // namespace allpairs::join
