// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "PairRuns.h"
#include "allpairs/FunctionRef.h"
#include "allpairs/StopFlag.h"

namespace allpairs::join {

/// Pairs of some keys that follow one another.
struct KeyLoad {
  std::uint64_t keys = 0;
  std::uint64_t pairs = 0;
  std::uint64_t longestRow = 0;  ///< The most pairs of one key, where that can be more than fit.
};

/// The bytes of the scratch files that a range of first boxes takes at most while it is put in order: none if it fits.
[[nodiscard]] std::uint64_t scratchBytesFor(const KeyLoad& range, std::size_t pairSize, std::size_t memory);

/// Puts the pairs of many runs in order, as many ranges of keys at once as fit in memory.
template <class Id>
class PairMerge {
 public:
  using Receiver = FunctionRef<void(std::span<const StoredPair<Id>>)>;

  /// `file` has the runs; `boxes` is one more than the greatest number of a second box. A range that is too large by
  /// itself is divided again, by way of `scratch`, a file of its size, and what is too large in that by way of one
  /// more: a range, and then one key of it. Where a range has more keys than a 512th of `memory` there is a third in
  /// between, of several keys; see scratchBytesFor(). `stop` soon ends a merge, if it is given.
  PairMerge(const KeyRanges& ranges, std::uint64_t boxes, std::size_t memory, const WorkFile& file,
            std::filesystem::path scratch, const StopFlag* stop = nullptr);

  /// Passes all pairs on, ordered by (first, second), in batches.
  void merge(std::span<const Run> runs, Receiver receive);

 private:
  /// Ranges [begin, end), and how many pairs they have.
  struct Group {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::uint64_t pairs = 0;
  };

  [[nodiscard]] std::vector<std::uint64_t> pairsPerRange(std::span<const Run> runs) const;
  [[nodiscard]] std::vector<Group> groupsOf(std::span<const std::uint64_t> pairs) const;
  [[nodiscard]] std::uint64_t rowsOf(const Group& group) const;
  [[nodiscard]] bool fits(const Group& group) const;
  void reserve(std::span<const Group> groups);
  void mergeGroup(std::span<const Run> runs, const Group& group, Receiver receive);
  void readGroup(std::span<const Run> runs, const Group& group);
  void giveRows(std::uint64_t firstKey, std::uint64_t endKey, Receiver receive);
  void giveOneRow(Receiver receive);
  void divideRange(std::span<const Run> runs, std::size_t range, Receiver receive);

  template <class Use>
  void forEachBatch(const Use& use) const;

  /// Calls use(position, count) for the pairs of ranges [begin, end) in each run.
  template <class Use>
  void forEachPart(std::span<const Run> runs, std::size_t begin, std::size_t end, const Use& use) const;

  KeyRanges m_ranges;
  std::uint64_t m_boxes;
  std::size_t m_memory;
  const WorkFile& m_file;
  std::filesystem::path m_scratch;
  const StopFlag* m_stop;
  std::vector<StoredPair<Id>> m_pairs;
  std::vector<Id> m_seconds;
  std::vector<std::uint64_t> m_begins;
  std::vector<StoredPair<Id>> m_batch;
};

extern template class PairMerge<std::uint32_t>;
extern template class PairMerge<std::uint64_t>;

}  // namespace allpairs::join
