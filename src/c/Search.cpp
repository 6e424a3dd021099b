// SPDX-License-Identifier: MIT
#include "Handles.h"

namespace allpairs::c {
namespace {

Strategy strategyOf(int strategy) {
  switch (strategy) {
    case ALLPAIRS_AUTOMATIC:
      return Strategy::Automatic;
    case ALLPAIRS_EXHAUSTIVE:
      return Strategy::Exhaustive;
    case ALLPAIRS_BVH:
      return Strategy::Bvh;
  }
  throw InvalidArgument("no strategy " + std::to_string(strategy));
}

OverlapOptions optionsOf(const allpairs_options& given, Executor* executor, const StopFlag* stop) {
  OverlapOptions options;
  options.strategy = strategyOf(numberIn(given.strategy));
  options.order = orderOf(numberIn(given.order));
  options.distance = given.distance;
  if (given.region != nullptr) options.region = boxOf(given.region);
  if (given.accept != nullptr) {
    options.filter.accept = [accept = given.accept, context = given.accept_context](std::uint32_t a, std::uint32_t b) {
      return accept(context, a, b);
    };
  }
  options.executor = executor;
  options.stop = stop;
  options.instructionSet = instructionSetOf(given.instruction_set);
  if (given.max_pairs != 0) options.maxPairs = given.max_pairs;
  return options;
}

void setOptions(allpairs_search& search, const allpairs_options* options) {
  const allpairs_options given = known(options);
  const bool hasMemory = given.memory.allocate != nullptr || given.memory.deallocate != nullptr;
  if (hasMemory && (search.memory == nullptr || !search.memory->is(given.memory))) {
    throw InvalidArgument("a search keeps the memory that it was made with; make another one");
  }
  std::unique_ptr<Executor> executor = executorFor(given.threads);
  std::unique_ptr<CallerStop> stop = stopOf(given);
  search.overlaps.setOptions(optionsOf(given, executor.get(), flagOf(stop)));
  search.executor = std::move(executor);
  search.stop = std::move(stop);
  search.first = given.first;
  search.second = given.second;
}

NeighborRows rowsOf(int kind) {
  switch (kind) {
    case ALLPAIRS_FULL_ROWS:
      return NeighborRows::Full;
    case ALLPAIRS_HALF_ROWS:
      return NeighborRows::Half;
  }
  throw InvalidArgument("no kind of rows " + std::to_string(kind));
}

/// Calls find(span) with memory of the caller, for `count` of which it gives how much it has put there.
template <class T, class Find>
void findInto(T* data, std::size_t capacity, std::size_t& count, const Find& find) {
  count = 0;
  const std::span<T> memory = requiredSpan(data, capacity, "memory");
  try {
    count = find(memory);
  } catch (const LimitExceeded& error) {
    if (error.isTotal()) count = static_cast<std::size_t>(error.count());
    throw;
  }
}

std::span<Pair> pairsIn(std::span<allpairs_pair> memory) {
  return {reinterpret_cast<Pair*>(memory.data()), memory.size()};
}

std::span<std::uint64_t> offsetsIn(const allpairs_rows_memory& memory, const allpairs_set* set) {
  return {&required(memory.offsets, "memory.offsets"), required(set, "set").boxes.size() + 1};
}

allpairs_rows toC(const NeighborsView& found) { return {found.offsets.data(), found.indices.data(), found.size()}; }

/// A call of the search, with its filters as long as the sets that it is about to look at.
class PreparedCall {
 public:
  PreparedCall(allpairs_search* search, const allpairs_set* first, const allpairs_set* second) : m_call(search) {
    const allpairs_search& handle = m_call.handle();
    OverlapOptions options = handle.overlaps.options();
    options.filter.first = bitsOf(handle.first, required(first, second == nullptr ? "set" : "first").boxes.size());
    options.filter.second = bitsOf(handle.second, (second == nullptr ? first : second)->boxes.size());
    m_call.handle().overlaps.setOptions(std::move(options));
    m_noted.emplace(m_call.handle(), m_call.handle().overlaps);
  }

  OverlapSearch* operator->() const noexcept { return &m_call.handle().overlaps; }

 private:
  SearchCall m_call;
  std::optional<NotedSearch<OverlapSearch>> m_noted;
};

}  // namespace

FilterBits bitsOf(const allpairs_filter& filter, std::size_t boxes) {
  const auto labelsOf = [boxes](const std::uint32_t* data) {
    return std::span<const std::uint32_t>(data, data == nullptr ? 0 : boxes);
  };
  return {labelsOf(filter.categories), labelsOf(filter.masks), labelsOf(filter.groups)};
}

}  // namespace allpairs::c

// NOLINTBEGIN(readability-identifier-naming): names are C's.
using namespace allpairs::c;

allpairs_status allpairs_search_create(const allpairs_options* options, allpairs_search** search) {
  return guarded([&] {
    allpairs_search*& result = required(search, "search");
    allpairs::OverlapOptions memoryOnly;
    std::unique_ptr<CallerMemory> memory = memoryOf(known(options).memory);
    memoryOnly.memory = memory.get();
    // An atomic does not move: made where it stays.
    std::unique_ptr<allpairs_search> handle(
        new allpairs_search{std::move(memory), nullptr, nullptr, allpairs::OverlapSearch(std::move(memoryOnly))});
    setOptions(*handle, options);
    result = handle.release();
  });
}

allpairs_status allpairs_search_set_options(allpairs_search* search, const allpairs_options* options) {
  return guarded([&] {
    const SearchCall call(search);
    setOptions(call.handle(), options);
  });
}

void allpairs_search_destroy(allpairs_search* search) {
  delete search;  // NOLINT(cppcoreguidelines-owning-memory): C's handle
}

allpairs_status allpairs_search_shrink(allpairs_search* search) {
  return guarded([&] {
    const SearchCall call(search);
    call.handle().overlaps.shrink();
    call.handle().worlds.reset();
  });
}

allpairs_status allpairs_search_statistics(const allpairs_search* search, allpairs_overlap_statistics* statistics) {
  return guarded([&] {
    const allpairs::OverlapStatistics& last = required(search, "search").statistics;
    write({0, last.pairs, last.boxTests, last.groupTests, last.exactTests}, statistics, "statistics");
  });
}

allpairs_status allpairs_find(allpairs_search* search, const allpairs_set* set, allpairs_pairs* pairs) {
  return guarded([&] {
    allpairs_pairs& to = required(pairs, "pairs");
    to = toC(PreparedCall(search, set, nullptr)->find(set->boxes));
  });
}

allpairs_status allpairs_find_between(allpairs_search* search, const allpairs_set* first, const allpairs_set* second,
                                      allpairs_pairs* pairs) {
  return guarded([&] {
    const allpairs::BoxView& others = required(second, "second").boxes;
    allpairs_pairs& to = required(pairs, "pairs");
    to = toC(PreparedCall(search, first, second)->find(first->boxes, others));
  });
}

allpairs_status allpairs_find_into(allpairs_search* search, const allpairs_set* set, allpairs_pair_memory* memory) {
  return guarded([&] {
    allpairs_pair_memory& to = required(memory, "memory");
    findInto(to.data, to.capacity, to.count, [&](std::span<allpairs_pair> room) {
      return PreparedCall(search, set, nullptr)->findInto(set->boxes, pairsIn(room)).size();
    });
  });
}

allpairs_status allpairs_find_between_into(allpairs_search* search, const allpairs_set* first,
                                           const allpairs_set* second, allpairs_pair_memory* memory) {
  return guarded([&] {
    allpairs_pair_memory& to = required(memory, "memory");
    findInto(to.data, to.capacity, to.count, [&](std::span<allpairs_pair> room) {
      const allpairs::BoxView& others = required(second, "second").boxes;
      return PreparedCall(search, first, second)->findInto(first->boxes, others, pairsIn(room)).size();
    });
  });
}

allpairs_status allpairs_find_neighbors_into(allpairs_search* search, const allpairs_set* set, allpairs_rows_kind kind,
                                             allpairs_rows_memory* memory) {
  return guarded([&] {
    allpairs_rows_memory& to = required(memory, "memory");
    findInto(to.indices, to.capacity, to.count, [&](std::span<std::uint32_t> room) {
      const allpairs::NeighborRows known = rowsOf(numberIn(kind));
      const PreparedCall overlaps(search, set, nullptr);
      return overlaps->findNeighborsInto(set->boxes, known, {offsetsIn(to, set), room}).indices.size();
    });
  });
}

allpairs_status allpairs_find_neighbors_between_into(allpairs_search* search, const allpairs_set* first,
                                                     const allpairs_set* second, allpairs_rows_memory* memory) {
  return guarded([&] {
    allpairs_rows_memory& to = required(memory, "memory");
    findInto(to.indices, to.capacity, to.count, [&](std::span<std::uint32_t> room) {
      const allpairs::BoxView& others = required(second, "second").boxes;
      const PreparedCall overlaps(search, first, second);
      return overlaps->findNeighborsInto(first->boxes, others, {offsetsIn(to, first), room}).indices.size();
    });
  });
}

allpairs_status allpairs_find_neighbors(allpairs_search* search, const allpairs_set* set, allpairs_rows_kind kind,
                                        allpairs_rows* rows) {
  return guarded([&] {
    const allpairs::NeighborRows known = rowsOf(numberIn(kind));
    allpairs_rows& to = required(rows, "rows");
    to = toC(PreparedCall(search, set, nullptr)->findNeighbors(set->boxes, known));
  });
}

allpairs_status allpairs_find_neighbors_between(allpairs_search* search, const allpairs_set* first,
                                                const allpairs_set* second, allpairs_rows* rows) {
  return guarded([&] {
    const allpairs::BoxView& others = required(second, "second").boxes;
    allpairs_rows& to = required(rows, "rows");
    to = toC(PreparedCall(search, first, second)->findNeighbors(first->boxes, others));
  });
}

allpairs_status allpairs_count(allpairs_search* search, const allpairs_set* set, uint64_t* count) {
  return guarded([&] {
    std::uint64_t& to = required(count, "count");
    to = PreparedCall(search, set, nullptr)->count(set->boxes);
  });
}

allpairs_status allpairs_count_between(allpairs_search* search, const allpairs_set* first, const allpairs_set* second,
                                       uint64_t* count) {
  return guarded([&] {
    const allpairs::BoxView& others = required(second, "second").boxes;
    std::uint64_t& to = required(count, "count");
    to = PreparedCall(search, first, second)->count(first->boxes, others);
  });
}

allpairs_status allpairs_stream(allpairs_search* search, const allpairs_set* set, allpairs_visitor visitor) {
  return guarded([&] {
    Visitor asking(visitor);
    PreparedCall(search, set, nullptr)->stream(set->boxes, asking, asking.batchSize());
  });
}

allpairs_status allpairs_stream_between(allpairs_search* search, const allpairs_set* first, const allpairs_set* second,
                                        allpairs_visitor visitor) {
  return guarded([&] {
    Visitor asking(visitor);
    const allpairs::BoxView& others = required(second, "second").boxes;
    PreparedCall(search, first, second)->stream(first->boxes, others, asking, asking.batchSize());
  });
}

// NOLINTEND(readability-identifier-naming)
