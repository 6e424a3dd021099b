// SPDX-License-Identifier: MIT
#include "allpairs/fcl/RowSearch.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

namespace allpairs {
namespace {

/// While at most one box in this many changes, a step of the world is cheaper than a full search: measured with 10,000
/// boxes that have 1 to 19 pairs each, where they break even at 13 to 3 %.
constexpr std::size_t kShareOfChanged = 32;

WorldOptions worldOptions(Executor* executor) {
  WorldOptions options;
  options.executor = executor;
  return options;
}

OverlapOptions searchOptions(Executor* executor, bool isOrdered) {
  OverlapOptions options;
  options.executor = executor;
  options.order = isOrdered ? Order::ByFirst : Order::Unordered;
  return options;
}

/// Rounding to the nearest never changes which of two numbers is the greater, it only makes them equal: what overlaps
/// in double does so when rounded.
void roundRows(std::span<const double> rows, std::vector<float>& results) {
  static_assert(std::numeric_limits<float>::is_iec559);  // too great a number becomes infinity
  results.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) results[i] = static_cast<float>(rows[i]);
}

/// Two numbers that are compared at once, which every 64-bit processor can: pairs are many, and lie anywhere.
using Two [[gnu::vector_size(16)]] = double;

Two load(const double* numbers) {
  Two two;
  std::memcpy(&two, numbers, sizeof(two));
  return two;
}

bool overlap(const double* a, const double* b) {
  const auto xy = (load(a) <= load(b + 3)) & (load(b) <= load(a + 3));
  const auto z = Two{a[2], b[2]} <= Two{b[5], a[5]};
  const auto both = xy & z;
  return (both[0] & both[1]) != 0;
}

/// Copies the pairs that overlap by their rows.
void selectExact(std::span<const Pair> pairs, std::span<const double> rows, std::vector<Pair>& results) {
  results.resize(pairs.size());
  std::size_t kept = 0;
  for (const Pair pair : pairs) {
    results[kept] = pair;
    kept += overlap(&rows[std::size_t{6} * pair.first], &rows[std::size_t{6} * pair.second]) ? 1U : 0U;
  }
  results.resize(kept);
}

}  // namespace

template <class T>
RowSearch<T>::RowSearch(Executor* executor, bool isOrdered)
    : m_executor(executor), m_search(searchOptions(executor, isOrdered)), m_world(worldOptions(executor)) {}

template <class T>
void RowSearch<T>::clear() {
  m_world = World(worldOptions(m_executor));
  m_isPending.clear();
  m_changes = 0;
  m_isCalm = false;
  m_isBehind = false;
  m_pairs = {};
}

template <class T>
std::span<const Pair> RowSearch<T>::pairs(std::span<const T> rows) {
  if (m_changes == 0) return m_pairs;
  const bool isCalm = m_changes * kShareOfChanged <= rows.size() / 6;
  // The world has to catch up with all that changed in between, which one quiet step is no reason for.
  m_pairs = isCalm && m_isCalm ? world(rows).step().pairs : searchAll(rows);
  m_isCalm = isCalm;
  m_changes = 0;
  return m_pairs;
}

template <class T>
std::span<const Pair> RowSearch<T>::searchAll(std::span<const T> rows) {
  if constexpr (std::is_same_v<T, float>) {
    return m_search.find(BoxView::fromRows(rows));
  } else {
    roundRows(rows, m_rounded);
    selectExact(m_search.find(BoxView::fromRows(std::span<const float>(m_rounded))), rows, m_exact);
    return m_exact;
  }
}

template <class T>
World& RowSearch<T>::world(std::span<const T> rows) {
  if (m_isBehind) bringIn(rows);
  return m_world;
}

template <class T>
void RowSearch<T>::bringIn(std::span<const T> rows) {
  const std::size_t known = m_world.idBound();
  m_ids.clear();
  m_moved.clear();
  const auto end = m_isPending.begin() + static_cast<std::ptrdiff_t>(std::min(known, m_isPending.size()));
  for (auto at = std::find(m_isPending.begin(), end, 1); at != end; at = std::find(at + 1, end, 1)) {
    m_ids.push_back(static_cast<BoxId>(at - m_isPending.begin()));
    const std::span<const T> row = rows.subspan(std::size_t{6} * m_ids.back(), 6);
    m_moved.insert(m_moved.end(), row.begin(), row.end());
  }
  m_world.move(m_ids, BoxView::fromRows(std::span<const T>(m_moved)));
  const BoxView fresh = BoxView::fromRows(rows.subspan(6 * known));
  m_ids.resize(fresh.size());
  m_world.add(fresh, {}, m_ids);  // none has ever been removed, so that they are the next ones
  std::fill(m_isPending.begin(), m_isPending.end(), std::uint8_t{0});
  m_isBehind = false;
}

template class RowSearch<float>;
template class RowSearch<double>;

}  // namespace allpairs
