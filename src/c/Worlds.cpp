// SPDX-License-Identifier: MIT
#include "allpairs/Worlds.h"

#include <algorithm>
#include <limits>

#include "Handles.h"

namespace allpairs::c {
namespace {

/// A search of worlds with the arguments of a call.
struct Call {
  WorldsSearch& search;
  Worlds worlds;
  const BoxView* shared = nullptr;

  [[nodiscard]] WorldPairsView find() { return shared != nullptr ? search.find(worlds, *shared) : search.find(worlds); }
  [[nodiscard]] std::span<const std::uint64_t> count() {
    return shared != nullptr ? search.count(worlds, *shared) : search.count(worlds);
  }
  void list(std::span<const std::uint64_t> begin, std::span<Pair> pairs) {
    shared != nullptr ? search.list(worlds, *shared, begin, pairs) : search.list(worlds, begin, pairs);
  }
};

Worlds worldsOf(const BoxView& boxes, const allpairs_worlds& given) {
  if (given.count == std::numeric_limits<std::size_t>::max()) throw InvalidArgument("too many worlds");
  Worlds worlds = given.begin == nullptr ? Worlds::ofEqualSize(boxes, given.count)
                                         : Worlds(boxes, std::span(given.begin, given.count + 1));
  const std::span<const allpairs_pair> ignored = requiredSpan(given.ignored, given.ignored_count, "worlds.ignored");
  worlds.setIgnoredPairs({reinterpret_cast<const Pair*>(ignored.data()), ignored.size()});
  return worlds;
}

Call prepared(allpairs_search* search, const allpairs_worlds* given) {
  allpairs_search& handle = required(search, "search");
  const allpairs_worlds known = c::known(&required(given, "worlds"));
  const Worlds worlds = worldsOf(required(known.boxes, "worlds.boxes").boxes, known);
  if (known.filter_is_of_one && !worlds.hasEqualSizes()) {
    throw InvalidArgument("a filter of one world for worlds that are not of equal size");
  }
  OverlapOptions options = handle.overlaps.options();
  options.filter.first = bitsOf(handle.first, known.filter_is_of_one ? worlds.eachSize() : worlds.boxes().size());
  // Of one set they are an error, which their lengths do not change.
  options.filter.second =
      bitsOf(handle.second, known.shared != nullptr ? known.shared->boxes.size() : worlds.boxes().size());
  handle.overlaps.setOptions(handle.overlaps.options());  // an error while it is running
  if (handle.worlds) {
    handle.worlds->setOptions(std::move(options));
  } else {
    handle.worlds.emplace(std::move(options));
  }
  return {*handle.worlds, worlds, known.shared != nullptr ? &known.shared->boxes : nullptr};
}

}  // namespace
}  // namespace allpairs::c

// NOLINTBEGIN(readability-identifier-naming): names are C's.
using namespace allpairs::c;

allpairs_status allpairs_find_in_worlds(allpairs_search* search, const allpairs_worlds* worlds,
                                        allpairs_world_pairs* pairs) {
  return guarded([&] {
    allpairs_world_pairs& result = required(pairs, "pairs");
    const allpairs::WorldPairsView found = prepared(search, worlds).find();
    result = {toC(found.pairs), found.begin.data()};
  });
}

allpairs_status allpairs_count_in_worlds(allpairs_search* search, const allpairs_worlds* worlds, uint64_t* begin) {
  return guarded([&] {
    uint64_t* const to = &required(begin, "begin");
    const std::span<const std::uint64_t> counted = prepared(search, worlds).count();
    std::copy(counted.begin(), counted.end(), to);
  });
}

allpairs_status allpairs_list_in_worlds(allpairs_search* search, const allpairs_worlds* worlds, const uint64_t* begin,
                                        allpairs_pair* pairs) {
  return guarded([&] {
    const uint64_t* const from = &required(begin, "begin");
    Call call = prepared(search, worlds);
    const std::span<const std::uint64_t> offsets(from, call.worlds.size() + 1);
    const auto to = requiredSpan(pairs, static_cast<std::size_t>(offsets.back()), "pairs");
    call.list(offsets, {reinterpret_cast<allpairs::Pair*>(to.data()), to.size()});
  });
}

// NOLINTEND(readability-identifier-naming)
