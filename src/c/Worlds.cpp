// SPDX-License-Identifier: MIT
#include "allpairs/Worlds.h"

#include <algorithm>
#include <limits>

#include "Handles.h"

namespace allpairs::c {
namespace {

Worlds worldsOf(const BoxView& boxes, const allpairs_worlds& given) {
  if (given.count == std::numeric_limits<std::size_t>::max()) throw InvalidArgument("too many worlds");
  Worlds worlds = given.begin == nullptr ? Worlds::ofEqualSize(boxes, given.count)
                                         : Worlds(boxes, std::span(given.begin, given.count + 1));
  const std::span<const allpairs_pair> ignored = requiredSpan(given.ignored, given.ignored_count, "worlds.ignored");
  worlds.setIgnoredPairs({reinterpret_cast<const Pair*>(ignored.data()), ignored.size()});
  return worlds;
}

/// A call of a search of worlds, with its arguments.
class WorldsCall {
 public:
  WorldsCall(allpairs_search* search, const allpairs_worlds* given)
      : WorldsCall(search, c::known(&required(given, "worlds"))) {}

  [[nodiscard]] std::size_t size() const { return m_worlds.size(); }

  [[nodiscard]] WorldPairsView find() {
    return m_shared != nullptr ? search().find(m_worlds, *m_shared) : search().find(m_worlds);
  }
  [[nodiscard]] std::span<const std::uint64_t> count() {
    return m_shared != nullptr ? search().count(m_worlds, *m_shared) : search().count(m_worlds);
  }
  void list(std::span<const std::uint64_t> begin, std::span<Pair> pairs) {
    m_shared != nullptr ? search().list(m_worlds, *m_shared, begin, pairs) : search().list(m_worlds, begin, pairs);
  }

 private:
  WorldsCall(allpairs_search* search, const allpairs_worlds& known)
      : m_call(search),
        m_worlds(worldsOf(required(known.boxes, "worlds.boxes").boxes, known)),
        m_shared(known.shared != nullptr ? &known.shared->boxes : nullptr) {
    if (known.filter_is_of_one && !m_worlds.hasEqualSizes()) {
      throw InvalidArgument("a filter of one world for worlds that are not of equal size");
    }
    allpairs_search& handle = m_call.handle();
    const std::size_t boxes = m_worlds.boxes().size();
    OverlapOptions options = handle.overlaps.options();
    options.filter.first = bitsOf(handle.first, known.filter_is_of_one ? m_worlds.eachSize() : boxes);
    // Of one set they are an error, which their lengths do not change.
    options.filter.second = bitsOf(handle.second, m_shared != nullptr ? m_shared->size() : boxes);
    if (handle.worlds) {
      handle.worlds->setOptions(std::move(options));
    } else {
      handle.worlds.emplace(std::move(options));
    }
    m_noted.emplace(handle, *handle.worlds);
  }

  [[nodiscard]] WorldsSearch& search() const { return *m_call.handle().worlds; }

  SearchCall m_call;
  Worlds m_worlds;
  const BoxView* m_shared;
  std::optional<NotedSearch<WorldsSearch>> m_noted;
};

}  // namespace
}  // namespace allpairs::c

// NOLINTBEGIN(readability-identifier-naming): names are C's.
using namespace allpairs::c;

allpairs_status allpairs_find_in_worlds(allpairs_search* search, const allpairs_worlds* worlds,
                                        allpairs_world_pairs* pairs) {
  return guarded([&] {
    allpairs_world_pairs& result = required(pairs, "pairs");
    const allpairs::WorldPairsView found = WorldsCall(search, worlds).find();
    result = {toC(found.pairs), found.begin.data()};
  });
}

allpairs_status allpairs_count_in_worlds(allpairs_search* search, const allpairs_worlds* worlds, uint64_t* begin) {
  return guarded([&] {
    uint64_t* const to = &required(begin, "begin");
    const std::span<const std::uint64_t> counted = WorldsCall(search, worlds).count();
    std::copy(counted.begin(), counted.end(), to);
  });
}

allpairs_status allpairs_list_in_worlds(allpairs_search* search, const allpairs_worlds* worlds, const uint64_t* begin,
                                        allpairs_pair* pairs) {
  return guarded([&] {
    const uint64_t* const from = &required(begin, "begin");
    WorldsCall call(search, worlds);
    const std::span<const std::uint64_t> offsets(from, call.size() + 1);
    const auto to = requiredSpan(pairs, static_cast<std::size_t>(offsets.back()), "pairs");
    call.list(offsets, {reinterpret_cast<allpairs::Pair*>(to.data()), to.size()});
  });
}

// NOLINTEND(readability-identifier-naming)
