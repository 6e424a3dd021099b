// SPDX-License-Identifier: MIT
// Searches whose result is put into memory of the caller.
#include <algorithm>
#include <string>

#include "allpairs/Error.h"
#include "search/FewBoxes.h"
#include "search/Search.h"

namespace allpairs::engine {
namespace {

/// Throws unless there is room for what was found.
void checkRoom(std::uint64_t found, std::size_t room, const char* what) {
  if (found <= room) return;
  throw LimitExceeded(
      found, "memory for " + std::to_string(room) + ' ' + what + ", but there are " + std::to_string(found), true);
}

}  // namespace

/// Where pairs come in order they are copied as they are found; those that there is no room for are only counted.
std::span<Pair> Search::findInto(const Sets& sets, const OverlapOptions& options, std::span<Pair> memory) {
  std::uint64_t size = 0;
  const auto copy = [&](std::span<const Pair> pairs) {
    if (size + pairs.size() <= memory.size()) std::copy(pairs.begin(), pairs.end(), memory.data() + size);
    size += pairs.size();
  };
  if (areFew(sets, options)) {
    forget();
    m_statistics = findFew(sets, options, options.order, copy);
  } else {
    Plan plan = planOf(sets, options, options.order);
    if (!comeInOrder(plan)) return findPlannedInto(plan, memory);
    runInto(plan, copy);
  }
  checkRoom(size, memory.size(), "pairs");
  return memory.first(size);
}

std::span<Pair> Search::findPlannedInto(Plan& plan, std::span<Pair> memory) {
  const auto checked = [&](std::uint64_t pairs) {
    checkRoom(pairs, memory.size(), "pairs");
    return memory.first(pairs);
  };
  const PairRoom room(checked);
  const std::span<const Pair> found = findPlanned(plan, &room);
  checkRoom(found.size(), memory.size(), "pairs");
  if (found.data() != memory.data()) std::copy(found.begin(), found.end(), memory.begin());
  m_pairs = {};
  return memory.first(found.size());
}

NeighborsView Search::findNeighborsInto(const Sets& sets, const OverlapOptions& options, NeighborRows kind,
                                        const NeighborsMemory& memory) {
  if (memory.offsets.size() <= sets.first.size()) {
    throw InvalidArgument("memory for " + std::to_string(memory.offsets.size()) +
                          " offsets: there is one more than the " + std::to_string(sets.first.size()) + " boxes");
  }
  const auto checked = [&](std::size_t rows, std::uint64_t indices) -> NeighborsMemory {
    checkRoom(indices, memory.indices.size(), "indices");
    return {memory.offsets.first(rows + 1), memory.indices.first(indices)};
  };
  const RowRoom room(checked);
  const NeighborsView found = findNeighbors(sets, options, kind, &room);
  m_rowsFound = {};
  return found;
}

}  // namespace allpairs::engine
