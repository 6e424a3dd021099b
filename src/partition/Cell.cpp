// SPDX-License-Identifier: MIT
#include "allpairs/partition/Cell.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "allpairs/Error.h"

namespace allpairs::partition {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool hasAll(const Cell& cell) { return cell == Cell(); }

void checkCell(const Cell& cell) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!std::isnan(cell.min[axis]) && !std::isnan(cell.max[axis])) continue;
    throw InvalidArgument("the cell has a NaN on the " + std::string(1, "xyz"[axis]) + " axis");
  }
}

void checkIds(const BoxView& boxes, std::span<const std::uint64_t> ids) {
  if (ids.size() == boxes.size()) return;
  throw InvalidArgument(std::to_string(ids.size()) + " ids for " + std::to_string(boxes.size()) + " boxes");
}

/// The margins of a pair are added up in the order of its ids.
void checkAscend(const BoxView& boxes, std::span<const std::uint64_t> ids) {
  if (boxes.leastMargin() == boxes.greatestMargin()) return;
  const auto descent = std::is_sorted_until(ids.begin(), ids.end());
  if (descent == ids.end()) return;
  throw InvalidArgument("box " + std::to_string(descent - ids.begin()) +
                        " has a lesser id than the one before; boxes with margins of their own are given in the order "
                        "of their ids");
}

template <class AnyPair>
void orderPairs(std::vector<AnyPair>& pairs, Order order) {
  if (order == Order::ByFirst) std::sort(pairs.begin(), pairs.end());
  if (order != Order::BySecond) return;
  std::sort(pairs.begin(), pairs.end(), [](const AnyPair& a, const AnyPair& b) {
    return std::pair(a.second, a.first) < std::pair(b.second, b.first);
  });
}

/// Pairs in the order of the boxes are then in that of their ids.
bool areAscending(std::span<const std::uint64_t> ids) {
  return std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end();
}

OverlapOptions unordered(OverlapOptions options) {
  options.order = Order::Unordered;
  return options;
}

}  // namespace

bool touches(const Cell& cell, const Box& reach) noexcept {
  if (isEmpty(reach)) return false;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool isBelow = reach.min[axis] < cell.max[axis] || cell.max[axis] == kInfinity;
    if (!isBelow || reach.max[axis] < cell.min[axis]) return false;
  }
  return true;
}

struct CellSearch::State {
  struct Sets {
    const BoxView& first;
    const BoxView* second;  ///< Null where it is one set.
  };

  /// Marks a search as running, of which nothing may change before its own callbacks are refused.
  struct Running {
    explicit Running(State& state) : isRunning(state.isRunning) {
      if (std::exchange(isRunning, true)) refuse();
    }
    ~Running() { isRunning = false; }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    [[noreturn]] static void refuse() {
      throw InvalidArgument("CellSearch is called by its own filter, visitor, stop or task");
    }

    bool& isRunning;
  };

  explicit State(OverlapOptions given) : maxPairs(given.maxPairs), search(std::move(given)) {}

  void setLimit(std::uint64_t limit) {
    if (search.options().maxPairs == limit) return;
    OverlapOptions options = search.options();
    options.maxPairs = limit;
    search.setOptions(std::move(options));
  }

  void setFilter(Filter filter) {
    OverlapOptions options = search.options();
    options.filter = std::move(filter);
    search.setOptions(std::move(options));
  }

  /// Two boxes whose minima are both in the cell need no look at their bounds.
  static void findHome(const BoxView& boxes, const Cell& cell, std::vector<char>& home) {
    home.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) home[i] = cell.holds(boxes[i].min) ? 1 : 0;
  }

  void findHomes(const Sets& sets, const Cell& cell) {
    findHome(sets.first, cell, home);
    secondHome.clear();
    if (sets.second != nullptr) findHome(*sets.second, cell, secondHome);
  }

  void give(std::span<const Pair> pairs, PairVisitor visitor) {
    if (pairs.empty()) return;
    count += pairs.size();
    if (count > maxPairs) {
      throw LimitExceeded(count, "more than " + std::to_string(maxPairs) + " pairs: the limit that was set");
    }
    visitor(pairs);
  }

  /// Keeps those pairs that belong to the cell.
  void filter(std::span<const Pair> pairs, const Sets& sets, const Cell& cell) {
    const std::vector<char>& homeOfSecond = sets.second == nullptr ? home : secondHome;
    const BoxView& second = sets.second == nullptr ? sets.first : *sets.second;
    kept.clear();
    for (const Pair pair : pairs) {
      const bool isHome = (home[pair.first] & homeOfSecond[pair.second]) != 0;
      if (isHome || cell.holds(pairPoint(sets.first[pair.first], second[pair.second]))) kept.push_back(pair);
    }
  }

  /// Pairs of other cells are found too, and do not count.
  void stream(const Sets& sets, const Cell& cell, PairVisitor visitor) {
    checkCell(cell);
    const Running running(*this);
    setLimit(OverlapOptions().maxPairs);
    count = 0;
    const bool isAll = hasAll(cell);
    if (!isAll) findHomes(sets, cell);
    const auto take = [&](std::span<const Pair> batch) {
      if (!isAll) filter(batch, sets, cell);
      give(isAll ? batch : std::span<const Pair>(kept), visitor);
    };
    if (sets.second == nullptr) {
      search.stream(sets.first, take);
    } else {
      search.stream(sets.first, *sets.second, take);
    }
  }

  std::span<const Pair> find(const Sets& sets, const Cell& cell) {
    checkCell(cell);
    if (isRunning) Running::refuse();
    setLimit(maxPairs);
    std::span<const Pair> found;
    try {
      found = sets.second == nullptr ? search.find(sets.first) : search.find(sets.first, *sets.second);
    } catch (const LimitExceeded&) {
      if (hasAll(cell)) throw;
      return findWithinLimit(sets, cell);
    }
    if (hasAll(cell)) return found;
    findHomes(sets, cell);
    filter(found, sets, cell);
    return kept;
  }

  /// Where there are more pairs than allowed, but perhaps not of this cell.
  std::span<const Pair> findWithinLimit(const Sets& sets, const Cell& cell) {
    std::vector<Pair> pairs;
    stream(sets, cell, [&](std::span<const Pair> batch) { pairs.insert(pairs.end(), batch.begin(), batch.end()); });
    orderPairs(pairs, search.options().order);
    kept = std::move(pairs);
    return kept;
  }

  std::uint64_t maxPairs;
  std::uint64_t count = 0;
  bool isRunning = false;
  OverlapSearch search;
  std::vector<char> home;
  std::vector<char> secondHome;
  std::vector<Pair> kept;
};

CellSearch::CellSearch(OverlapOptions options) : m_state(std::make_unique<State>(std::move(options))) {}
CellSearch::~CellSearch() = default;
CellSearch::CellSearch(CellSearch&&) noexcept = default;
CellSearch& CellSearch::operator=(CellSearch&&) noexcept = default;

CellSearch::State& CellSearch::state() {
  if (!m_state) m_state = std::make_unique<State>(OverlapOptions());
  return *m_state;
}

void CellSearch::setFilter(Filter filter) { state().setFilter(std::move(filter)); }

void CellSearch::stream(const BoxView& boxes, const Cell& cell, PairVisitor visitor) {
  state().stream({boxes, nullptr}, cell, visitor);
}

void CellSearch::stream(const BoxView& first, const BoxView& second, const Cell& cell, PairVisitor visitor) {
  state().stream({first, &second}, cell, visitor);
}

Span<const Pair> CellSearch::find(const BoxView& boxes, const Cell& cell) {
  return state().find({boxes, nullptr}, cell);
}

Span<const Pair> CellSearch::find(const BoxView& first, const BoxView& second, const Cell& cell) {
  return state().find({first, &second}, cell);
}

std::vector<IdPair> overlapsInCell(const BoxView& boxes, Span<const std::uint64_t> ids, const Cell& cell,
                                   const OverlapOptions& options) {
  checkIds(boxes, ids);
  checkAscend(boxes, ids);
  const bool isInOrder = areAscending(ids);
  CellSearch search(isInOrder ? options : unordered(options));
  const Span<const Pair> found = search.find(boxes, cell);
  std::vector<IdPair> pairs;
  pairs.reserve(found.size());
  for (const Pair pair : found) {
    const auto [low, high] = std::minmax(ids[pair.first], ids[pair.second]);
    if (low == high) throw InvalidArgument("two boxes have the id " + std::to_string(low));
    pairs.push_back({low, high});
  }
  if (!isInOrder) orderPairs(pairs, options.order);
  return pairs;
}

// NOLINTNEXTLINE(readability-function-size): two sets, each with its ids
std::vector<IdPair> overlapsInCell(const BoxView& first, Span<const std::uint64_t> firstIds, const BoxView& second,
                                   Span<const std::uint64_t> secondIds, const Cell& cell,
                                   const OverlapOptions& options) {
  checkIds(first, firstIds);
  checkIds(second, secondIds);
  const bool isInOrder = areAscending(firstIds) && areAscending(secondIds);
  CellSearch search(isInOrder ? options : unordered(options));
  const Span<const Pair> found = search.find(first, second, cell);
  std::vector<IdPair> pairs;
  pairs.reserve(found.size());
  for (const Pair pair : found) pairs.push_back({firstIds[pair.first], secondIds[pair.second]});
  if (!isInOrder) orderPairs(pairs, options.order);
  return pairs;
}

std::uint64_t countOverlapsInCell(const BoxView& boxes, const Cell& cell, const OverlapOptions& options) {
  std::uint64_t count = 0;
  CellSearch(unordered(options)).stream(boxes, cell, [&](std::span<const Pair> batch) { count += batch.size(); });
  return count;
}

std::uint64_t countOverlapsInCell(const BoxView& first, const BoxView& second, const Cell& cell,
                                  const OverlapOptions& options) {
  std::uint64_t count = 0;
  CellSearch(unordered(options)).stream(first, second, cell, [&](std::span<const Pair> batch) {
    count += batch.size();
  });
  return count;
}

}  // namespace allpairs::partition
