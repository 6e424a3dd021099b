// SPDX-License-Identifier: MIT
#include "PairMerge.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <system_error>
#include <utility>

#include "FreedMemory.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::join {
namespace {

constexpr std::size_t kBetweenLooks = std::size_t{1} << 16;         // pairs between two looks for a stop
constexpr const char* kOtherRanges = "is damaged: a run's ranges";  // from one reading to the next, also

template <class T>
void release(std::vector<T>& values) {
  std::vector<T>().swap(values);
}

/// Of a range that is divided: so many that one key seldom shares its part, and that what says where they begin takes
/// little of the memory.
std::size_t partsFor(std::size_t memory) { return std::max(memory / 512, std::size_t{1} << 8); }

/// Whether pairs can be put in order at once, by rows. Pairs as they are read and their seconds in order take three
/// fourths of the memory, where each row begins the rest: one group may have the most pairs and another the most rows.
bool fitByRows(std::uint64_t pairs, std::uint64_t begins, std::size_t pairSize, std::size_t memory) {
  return pairs <= (memory - memory / 4) / (pairSize + pairSize / 2) && begins <= memory / 4 / sizeof(std::uint64_t);
}

/// Looks for a stop now and then where that takes long: all values may be the partners of one box.
template <class Values, class Less>
void sortUntil(const StopFlag* stop, const Values& values, const Less& less) {
  if (values.size() < kBetweenLooks) {
    std::sort(values.begin(), values.end(), less);
    return;
  }
  std::size_t compared = 0;
  std::sort(values.begin(), values.end(), [&](const auto& a, const auto& b) {
    if (++compared % kBetweenLooks == 0) checkStop(stop);
    return less(a, b);
  });
}

/// Removes a file in the end, also after an error: its room may be what was wanting. What stays goes with the folder.
struct RemovedAfter {
  const std::filesystem::path& path;

  explicit RemovedAfter(const std::filesystem::path& file) : path(file) {}
  RemovedAfter(const RemovedAfter&) = delete;
  RemovedAfter& operator=(const RemovedAfter&) = delete;
  ~RemovedAfter() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

}  // namespace

/// As PairMerge divides, which passes over a range without pairs.
std::uint64_t scratchBytesFor(const KeyLoad& range, std::size_t pairSize, std::size_t memory) {
  if (range.pairs == 0) return 0;
  const std::uint64_t most = partsFor(memory);
  std::uint64_t bytes = 0;
  for (KeyLoad part = range; !fitByRows(part.pairs, part.keys + 1, pairSize, memory);) {
    const std::uint64_t runs = part.pairs / std::max<std::size_t>(memory / 2 / pairSize, 1) + 1;
    const std::uint64_t parts = part.keys <= 1 ? most : std::min(part.keys, most);
    bytes += part.pairs * pairSize + runs * (parts + 1) * sizeof(std::uint64_t);
    if (part.keys <= 1) break;  // its partners are all different, and fit when they are divided
    part.keys = std::uint64_t{1} << KeyRanges::of(0, part.keys, false, most).shift;
    part.pairs = std::min(part.pairs, part.longestRow * part.keys);
  }
  return bytes;
}

template <class Id>
PairMerge<Id>::PairMerge(const KeyRanges& ranges, std::uint64_t boxes, std::size_t memory, const WorkFile& file,
                         std::filesystem::path scratch, const StopFlag* stop)
    : m_ranges(ranges), m_boxes(boxes), m_memory(memory), m_file(file), m_scratch(std::move(scratch)), m_stop(stop) {}

template <class Id>
void PairMerge<Id>::merge(std::span<const Run> runs, Receiver receive) {
  const std::vector<std::uint64_t> pairs = pairsPerRange(runs);
  const std::vector<Group> groups = groupsOf(pairs);
  for (const Group& group : groups) {
    if (group.pairs == 0) continue;
    if (!fits(group)) {
      divideRange(runs, group.begin, receive);
      releaseFreedMemory();
      continue;
    }
    reserve(groups);
    mergeGroup(runs, group, receive);
  }
}

/// As many ranges in a group as fit, at least one.
template <class Id>
auto PairMerge<Id>::groupsOf(std::span<const std::uint64_t> pairs) const -> std::vector<Group> {
  std::vector<Group> groups;
  for (std::size_t range = 0; range < pairs.size(); ++range) {
    if (!groups.empty()) {
      const Group longer{groups.back().begin, range + 1, groups.back().pairs + pairs[range]};
      if (fits(longer)) {
        groups.back() = longer;
        continue;
      }
    }
    groups.push_back({range, range + 1, pairs[range]});
  }
  return groups;
}

/// Once for all groups: memory that grows leaves holes.
template <class Id>
void PairMerge<Id>::reserve(std::span<const Group> groups) {
  Group most;
  std::uint64_t rows = 0;
  for (const Group& group : groups) {
    if (!fits(group)) continue;
    most.pairs = std::max(most.pairs, group.pairs);
    rows = std::max(rows, rowsOf(group));
  }
  m_pairs.reserve(static_cast<std::size_t>(most.pairs));
  if (m_ranges.isBySecond) return;
  m_seconds.reserve(static_cast<std::size_t>(most.pairs));
  m_begins.reserve(static_cast<std::size_t>(rows));
}

template <class Id>
std::vector<std::uint64_t> PairMerge<Id>::pairsPerRange(std::span<const Run> runs) const {
  std::vector<std::uint64_t> begins(m_ranges.count() + 1);
  std::vector<std::uint64_t> pairs(m_ranges.count());
  for (const Run& run : runs) {
    const std::uint64_t position = run.position + run.pairs * sizeof(StoredPair<Id>);
    m_file.read(position, begins.data(), begins.size() * sizeof(std::uint64_t));
    for (std::size_t range = 0; range < pairs.size(); ++range) pairs[range] += begins[range + 1] - begins[range];
  }
  return pairs;
}

/// The numbers that say where rows begin.
template <class Id>
std::uint64_t PairMerge<Id>::rowsOf(const Group& group) const {
  return m_ranges.isBySecond ? 0 : m_ranges.beginOf(group.end) - m_ranges.beginOf(group.begin) + 1;
}

template <class Id>
bool PairMerge<Id>::fits(const Group& group) const {
  if (m_ranges.isBySecond) return group.pairs <= m_memory / (sizeof(StoredPair<Id>) + sizeof(Id));
  return fitByRows(group.pairs, rowsOf(group), sizeof(StoredPair<Id>), m_memory);
}

template <class Id>
void PairMerge<Id>::mergeGroup(std::span<const Run> runs, const Group& group, Receiver receive) {
  readGroup(runs, group);
  if (m_ranges.isBySecond) {
    giveOneRow(receive);
  } else {
    giveRows(m_ranges.beginOf(group.begin), m_ranges.beginOf(group.end), receive);
  }
}

template <class Id>
template <class Use>
void PairMerge<Id>::forEachPart(std::span<const Run> runs, std::size_t begin, std::size_t end, const Use& use) const {
  for (const Run& run : runs) {
    const std::uint64_t begins = run.position + run.pairs * sizeof(StoredPair<Id>);
    std::array<std::uint64_t, 2> bounds{};
    m_file.read(begins + begin * sizeof(std::uint64_t), &bounds[0], sizeof(std::uint64_t));
    m_file.read(begins + end * sizeof(std::uint64_t), &bounds[1], sizeof(std::uint64_t));
    if (bounds[0] > bounds[1] || bounds[1] > run.pairs) throw FileError(m_file.path(), kOtherRanges);
    use(run.position + bounds[0] * sizeof(StoredPair<Id>), bounds[1] - bounds[0]);
  }
}

template <class Id>
void PairMerge<Id>::readGroup(std::span<const Run> runs, const Group& group) {
  m_pairs.clear();
  forEachPart(runs, group.begin, group.end, [&](std::uint64_t position, std::uint64_t count) {
    if (count > group.pairs - m_pairs.size()) throw FileError(m_file.path(), kOtherRanges);
    inBatches(static_cast<std::size_t>(count), m_stop, [&](std::size_t begin, std::size_t end) {
      const std::size_t before = m_pairs.size();
      m_pairs.resize(before + (end - begin));
      m_file.read(position + begin * sizeof(StoredPair<Id>), &m_pairs[before], (end - begin) * sizeof(StoredPair<Id>));
    });
  });
  if (m_pairs.size() != group.pairs) throw FileError(m_file.path(), kOtherRanges);
}

/// Some at a time, so that it soon ends where it is to stop.
template <class Id>
template <class Use>
void PairMerge<Id>::forEachBatch(const Use& use) const {
  inBatches(m_pairs.size(), m_stop,
            [&](std::size_t begin, std::size_t end) { use(std::span(m_pairs).subspan(begin, end - begin)); });
}

/// Rows by counting; each row is sorted by itself.
template <class Id>
void PairMerge<Id>::giveRows(std::uint64_t firstKey, std::uint64_t endKey, Receiver receive) {
  const auto rows = static_cast<std::size_t>(endKey - firstKey);
  m_begins.assign(rows + 1, 0);
  m_seconds.clear();
  forEachBatch([&](std::span<const StoredPair<Id>> pairs) {
    m_seconds.resize(m_seconds.size() + pairs.size());
    for (const auto& pair : pairs) {
      if (pair.first < firstKey || pair.first >= endKey) throw FileError(m_file.path(), kForeignBox);
      ++m_begins[static_cast<std::size_t>(pair.first - firstKey)];
    }
  });
  std::exclusive_scan(m_begins.begin(), m_begins.end(), m_begins.begin(), std::uint64_t{0});
  forEachBatch([&](std::span<const StoredPair<Id>> pairs) {
    for (const auto& pair : pairs) m_seconds[m_begins[static_cast<std::size_t>(pair.first - firstKey)]++] = pair.second;
  });
  std::size_t begin = 0;  // each begin has become the end of its row
  std::size_t next = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    if (begin >= next) {
      checkStop(m_stop);
      next = begin + kBetweenLooks;
    }
    const auto end = static_cast<std::size_t>(m_begins[row]);
    sortUntil(m_stop, std::span(m_seconds).subspan(begin, end - begin), std::less<>());
    for (std::size_t i = begin; i < end; ++i) m_pairs[i] = {static_cast<Id>(firstKey + row), m_seconds[i]};
    begin = end;
  }
  forEachBatch(receive);
}

/// All pairs have the same first.
template <class Id>
void PairMerge<Id>::giveOneRow(Receiver receive) {
  sortUntil(m_stop, std::span(m_pairs), [](const auto& a, const auto& b) { return a.second < b.second; });
  forEachBatch(receive);
}

template <class Id>
void PairMerge<Id>::divideRange(std::span<const Run> runs, std::size_t range, Receiver receive) {
  const std::uint64_t begin = m_ranges.beginOf(range);
  const std::uint64_t end = m_ranges.beginOf(range + 1);
  const bool isOneKey = end - begin == 1;
  const std::size_t most = partsFor(m_memory);
  const KeyRanges parts = isOneKey && !m_ranges.isBySecond ? KeyRanges::of(0, m_boxes, true, most)
                                                           : KeyRanges::of(begin, end, m_ranges.isBySecond, most);
  release(m_pairs);
  release(m_seconds);
  release(m_begins);
  releaseFreedMemory();
  const RemovedAfter removed{m_scratch};
  RunFile file{WorkFile(m_scratch, WorkFile::Mode::Create)};
  std::vector<Run> divided;
  {
    RunWriter<Id> writer(parts, m_memory / (2 * sizeof(StoredPair<Id>)), file, m_stop);
    forEachPart(runs, range, range + 1, [&](std::uint64_t position, std::uint64_t count) {
      inBatches(static_cast<std::size_t>(count), m_stop, [&](std::size_t from, std::size_t to) {
        m_batch.resize(to - from);
        m_file.read(position + from * sizeof(StoredPair<Id>), m_batch.data(), m_batch.size() * sizeof(StoredPair<Id>));
        for (const StoredPair<Id>& pair : m_batch) writer.add(pair.first, pair.second);
      });
    });
    divided = writer.finish();
  }
  releaseFreedMemory();
  PairMerge inner(parts, m_boxes, m_memory, file.file, m_scratch.string() + "-", m_stop);
  inner.merge(divided, receive);
}

template class PairMerge<std::uint32_t>;
template class PairMerge<std::uint64_t>;

}  // namespace allpairs::join
