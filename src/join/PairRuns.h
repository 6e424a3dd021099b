// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "WorkFile.h"
#include "allpairs/StopFlag.h"

namespace allpairs::join {

/// A pair as files hold it.
template <class Id>
struct StoredPair {
  Id first;
  Id second;
};

/// The bytes of a pair among so many boxes: their numbers have 32 bits as long as that does.
[[nodiscard]] constexpr std::size_t pairSizeFor(std::uint64_t boxes) noexcept {
  return boxes > (std::uint64_t{1} << 32) ? sizeof(StoredPair<std::uint64_t>) : sizeof(StoredPair<std::uint32_t>);
}

/// What is wrong with a file in which there is another box than those of the join: the disk gave back other bytes.
inline constexpr const char* kForeignBox = "is damaged: it names a box that is not of this join";

inline constexpr std::size_t kMostRanges = 4096;  ///< Of first boxes: pairs are put in order some at a time.

/// Calls use(begin, end) for some of so many pairs at a time, and looks for a stop before each time.
template <class Use>
void inBatches(std::size_t pairs, const StopFlag* stop, const Use& use) {
  constexpr std::size_t kBatch = std::size_t{1} << 16;
  for (std::size_t begin = 0; begin < pairs; begin += kBatch) {
    checkStop(stop);
    use(begin, std::min(begin + kBatch, pairs));
  }
}

/// Which range of keys a pair is put into. The key is the first box, or where a range has only one of them, the second.
struct KeyRanges {
  std::uint64_t begin = 0;  ///< The least key.
  std::uint64_t end = 0;    ///< One more than the greatest.
  unsigned shift = 0;       ///< A range has 2^shift keys.
  bool isBySecond = false;

  /// At most `most` ranges, all of the same length.
  [[nodiscard]] static KeyRanges of(std::uint64_t begin, std::uint64_t end, bool isBySecond, std::size_t most);

  [[nodiscard]] std::size_t count() const noexcept {
    return begin == end ? 0 : static_cast<std::size_t>(((end - begin - 1) >> shift) + 1);
  }
  [[nodiscard]] std::size_t rangeOf(std::uint64_t first, std::uint64_t second) const noexcept {
    return static_cast<std::size_t>(((isBySecond ? second : first) - begin) >> shift);
  }
  [[nodiscard]] std::uint64_t beginOf(std::size_t range) const noexcept {
    const std::uint64_t offset = static_cast<std::uint64_t>(range) << shift;
    return offset < end - begin ? begin + offset : end;
  }
};

/// Pairs that were written at once: grouped by range, and behind them where each range begins (one number for each, and
/// the number of all pairs).
struct Run {
  std::uint64_t position = 0;
  std::uint64_t pairs = 0;
  std::uint64_t checksum = 0;
};

/// A file that several writers add runs to.
struct RunFile {
  WorkFile file{};
  std::atomic<std::uint64_t> end = 0;
};

/// Gathers pairs and writes them as runs. `stop` soon ends that, if it is given: a run may be a hundred megabytes.
///
/// Threads: one thread per writer; several writers of the same file.
template <class Id>
class RunWriter {
 public:
  RunWriter(const KeyRanges& ranges, std::size_t bufferPairs, RunFile& file, const StopFlag* stop = nullptr);

  void add(std::uint64_t first, std::uint64_t second) {
    m_found.push_back({static_cast<Id>(first), static_cast<Id>(second)});
    if (m_found.size() == m_capacity) flush();
  }

  /// Writes what is left, and returns the runs since the last time.
  [[nodiscard]] std::vector<Run> finish();

 private:
  void flush();

  KeyRanges m_ranges;
  std::size_t m_capacity;
  RunFile& m_file;
  const StopFlag* m_stop;
  std::vector<StoredPair<Id>> m_found;
  std::vector<StoredPair<Id>> m_grouped;
  std::vector<std::uint64_t> m_begins;
  std::vector<Run> m_runs;
};

extern template class RunWriter<std::uint32_t>;
extern template class RunWriter<std::uint64_t>;

/// How many bytes of the file a run takes.
[[nodiscard]] inline std::uint64_t bytesOf(const Run& run, const KeyRanges& ranges, std::size_t pairSize) {
  return run.pairs * pairSize + (ranges.count() + 1) * sizeof(std::uint64_t);
}

}  // namespace allpairs::join
