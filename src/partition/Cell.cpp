// SPDX-License-Identifier: MIT
#include "allpairs/partition/Cell.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "allpairs/Error.h"

namespace allpairs::partition {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double greatestReach(double margin, double distance, double maxMargin) {
  return std::max((distance + margin) + maxMargin, (distance + maxMargin) + margin);  // as first, and as second
}

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

void orderPairs(std::vector<IdPair>& pairs, Order order) {
  if (order == Order::ByFirst) std::sort(pairs.begin(), pairs.end());
  if (order != Order::BySecond) return;
  std::sort(pairs.begin(), pairs.end(), [](const IdPair& a, const IdPair& b) {
    return std::pair(a.second, a.first) < std::pair(b.second, b.first);
  });
}

OverlapOptions unordered(OverlapOptions options) {
  options.order = Order::Unordered;
  return options;
}

}  // namespace

Box reachOf(const Box& box, double margin, double distance, double maxMargin) noexcept {
  if (isEmpty(box)) return kEmptyBox;
  const double widening = greatestReach(margin, distance, maxMargin);
  Box reach = box;
  for (double& max : reach.max) {
    if (widening == kInfinity) {
      max = widening;  // also of -infinity, with which the sum would be NaN
    } else {
      max = std::max(max, max + widening);
    }
  }
  return reach;
}

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
    const BoxView& second;
  };

  explicit State(OverlapOptions given) : maxPairs(given.maxPairs), search(withoutLimit(std::move(given))) {}

  /// Pairs of other cells are found too, and do not count.
  static OverlapOptions withoutLimit(OverlapOptions options) {
    options.maxPairs = OverlapOptions().maxPairs;
    return options;
  }

  /// Two boxes whose minima are both in the cell need no look at their bounds.
  static void findHome(const BoxView& boxes, const Cell& cell, std::vector<char>& home) {
    home.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) home[i] = cell.holds(boxes[i].min) ? 1 : 0;
  }

  void give(std::span<const Pair> pairs, PairVisitor visitor) {
    if (pairs.empty()) return;
    count += pairs.size();
    if (count > maxPairs) {
      throw LimitExceeded(count, "more than " + std::to_string(maxPairs) + " pairs: the limit that was set");
    }
    visitor(pairs);
  }

  /// Passes on those of a batch that belong to the cell.
  void filter(std::span<const Pair> batch, const Sets& sets, const Cell& cell, PairVisitor visitor) {
    const std::vector<char>& homeOfSecond = secondHome.empty() ? home : secondHome;
    kept.clear();
    for (const Pair pair : batch) {
      const bool isHome = (home[pair.first] & homeOfSecond[pair.second]) != 0;
      if (isHome || cell.holds(pairPoint(sets.first[pair.first], sets.second[pair.second]))) kept.push_back(pair);
    }
    give(kept, visitor);
  }

  std::uint64_t maxPairs;
  std::uint64_t count = 0;
  OverlapSearch search;
  std::vector<char> home;
  std::vector<char> secondHome;  ///< Empty for one set.
  std::vector<Pair> kept;
};

CellSearch::CellSearch(OverlapOptions options) : m_state(std::make_unique<State>(std::move(options))) {}
CellSearch::~CellSearch() = default;
CellSearch::CellSearch(CellSearch&&) noexcept = default;
CellSearch& CellSearch::operator=(CellSearch&&) noexcept = default;

void CellSearch::setFilter(Filter filter) {
  OverlapOptions options = m_state->search.options();
  options.filter = std::move(filter);
  m_state->search.setOptions(std::move(options));
}

void CellSearch::stream(const BoxView& boxes, const Cell& cell, PairVisitor visitor) {
  checkCell(cell);
  State& state = *m_state;
  state.count = 0;
  if (hasAll(cell)) {
    state.search.stream(boxes, [&](std::span<const Pair> batch) { state.give(batch, visitor); });
    return;
  }
  State::findHome(boxes, cell, state.home);
  state.secondHome.clear();
  state.search.stream(boxes, [&](std::span<const Pair> batch) { state.filter(batch, {boxes, boxes}, cell, visitor); });
}

void CellSearch::stream(const BoxView& first, const BoxView& second, const Cell& cell, PairVisitor visitor) {
  checkCell(cell);
  State& state = *m_state;
  state.count = 0;
  if (hasAll(cell)) {
    state.search.stream(first, second, [&](std::span<const Pair> batch) { state.give(batch, visitor); });
    return;
  }
  State::findHome(first, cell, state.home);
  State::findHome(second, cell, state.secondHome);
  state.search.stream(first, second, [&](std::span<const Pair> batch) {
    state.filter(batch, {first, second}, cell, visitor);
  });
}

std::vector<IdPair> overlapsInCell(const BoxView& boxes, Span<const std::uint64_t> ids, const Cell& cell,
                                   const OverlapOptions& options) {
  checkIds(boxes, ids);
  checkAscend(boxes, ids);
  std::vector<IdPair> pairs;
  CellSearch search(unordered(options));
  search.stream(boxes, cell, [&](std::span<const Pair> batch) {
    for (const Pair pair : batch) {
      const auto [low, high] = std::minmax(ids[pair.first], ids[pair.second]);
      if (low == high) throw InvalidArgument("two boxes have the id " + std::to_string(low));
      pairs.push_back({low, high});
    }
  });
  orderPairs(pairs, options.order);
  return pairs;
}

// NOLINTNEXTLINE(readability-function-size): two sets, each with its ids
std::vector<IdPair> overlapsInCell(const BoxView& first, Span<const std::uint64_t> firstIds, const BoxView& second,
                                   Span<const std::uint64_t> secondIds, const Cell& cell,
                                   const OverlapOptions& options) {
  checkIds(first, firstIds);
  checkIds(second, secondIds);
  std::vector<IdPair> pairs;
  CellSearch search(unordered(options));
  search.stream(first, second, cell, [&](std::span<const Pair> batch) {
    for (const Pair pair : batch) pairs.push_back({firstIds[pair.first], secondIds[pair.second]});
  });
  orderPairs(pairs, options.order);
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
