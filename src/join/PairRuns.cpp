// SPDX-License-Identifier: MIT
#include "PairRuns.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "Checksum.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::join {

KeyRanges KeyRanges::of(std::uint64_t begin, std::uint64_t end, bool isBySecond, std::size_t most) {
  KeyRanges ranges{begin, end, 0, isBySecond};
  while (ranges.count() > most) ++ranges.shift;
  return ranges;
}

template <class Id>
RunWriter<Id>::RunWriter(const KeyRanges& ranges, std::size_t bufferPairs, RunFile& file, const StopFlag* stop)
    : m_ranges(ranges), m_capacity(std::max<std::size_t>(bufferPairs, 1)), m_file(file), m_stop(stop) {
  m_found.reserve(m_capacity);  // never moved; pages that are not written to are no memory
  m_grouped.reserve(m_capacity);
}

template <class Id>
std::vector<Run> RunWriter<Id>::finish() {
  if (!m_found.empty()) flush();
  return std::exchange(m_runs, {});
}

template <class Id>
void RunWriter<Id>::flush() {
  m_begins.assign(m_ranges.count() + 1, 0);
  m_grouped.clear();
  inBatches(m_found.size(), m_stop, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const StoredPair<Id>& pair = m_found[i];
      const std::uint64_t key = m_ranges.isBySecond ? pair.second : pair.first;
      if (key < m_ranges.begin || key >= m_ranges.end) throw FileError(m_file.file.path(), kForeignBox);
      ++m_begins[m_ranges.rangeOf(pair.first, pair.second)];
    }
    m_grouped.resize(end);
  });
  std::exclusive_scan(m_begins.begin(), m_begins.end(), m_begins.begin(), std::uint64_t{0});
  inBatches(m_found.size(), m_stop, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      m_grouped[m_begins[m_ranges.rangeOf(m_found[i].first, m_found[i].second)]++] = m_found[i];
    }
  });
  // Each begin has become the end of its range, which is the next one's begin.
  std::rotate(m_begins.begin(), m_begins.end() - 1, m_begins.end());
  m_begins.front() = 0;
  m_begins.back() = m_grouped.size();
  const std::size_t pairBytes = m_grouped.size() * sizeof(StoredPair<Id>);
  const std::size_t beginBytes = m_begins.size() * sizeof(std::uint64_t);
  const std::uint64_t position = m_file.end.fetch_add(pairBytes + beginBytes);
  Checksum checksum;
  inBatches(m_found.size(), m_stop, [&](std::size_t begin, std::size_t end) {
    const std::size_t bytes = (end - begin) * sizeof(StoredPair<Id>);
    checksum.add(&m_grouped[begin], bytes);
    m_file.file.write(position + begin * sizeof(StoredPair<Id>), &m_grouped[begin], bytes);
  });
  checksum.add(m_begins.data(), beginBytes);
  m_file.file.write(position + pairBytes, m_begins.data(), beginBytes);
  m_runs.push_back({position, m_grouped.size(), checksum.value()});
  m_found.clear();
}

template class RunWriter<std::uint32_t>;
template class RunWriter<std::uint64_t>;

}  // namespace allpairs::join
