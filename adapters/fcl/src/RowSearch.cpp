// SPDX-License-Identifier: MIT
#include "allpairs/fcl/RowSearch.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace allpairs {
namespace {

/// While one box in so many changes, or less, a step of the world is cheaper than a search of all.
constexpr std::size_t kShareOfChanged = 8;

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

bool isEmpty(const double* row) { return (row[0] > row[3]) | (row[1] > row[4]) | (row[2] > row[5]); }

/// Rounding to the nearest never changes which of two numbers is the greater, it only makes them equal: what overlaps in
/// double does so when rounded.
float rounded(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::min(std::max(value, -kMost), kMost));
}

void roundRows(std::span<const double> rows, std::vector<float>& results) {
  results.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) results[i] = rounded(rows[i]);
  for (std::size_t i = 0; i < rows.size(); i += 6) {
    if (!isEmpty(&rows[i])) continue;
    results[i] = 1.0F;  // which rounding might have filled
    results[i + 3] = -1.0F;
  }
}

bool overlap(const double* a, const double* b) {
  return (a[0] <= b[3]) & (b[0] <= a[3]) & (a[1] <= b[4]) & (b[1] <= a[4]) & (a[2] <= b[5]) & (b[2] <= a[5]);
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
  m_pending.clear();
  m_isPending.clear();
  m_changes = 0;
  m_isCalm = false;
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
    return m_search.find(BoxSet::fromRows(rows));
  } else {
    roundRows(rows, m_rounded);
    selectExact(m_search.find(BoxSet::fromRows(std::span<const float>(m_rounded))), rows, m_exact);
    return m_exact;
  }
}

template <class T>
World& RowSearch<T>::world(std::span<const T> rows) {
  if (!m_pending.empty()) bringIn(rows);
  return m_world;
}

template <class T>
void RowSearch<T>::bringIn(std::span<const T> rows) {
  const std::size_t known = m_world.idBound();
  for (const BoxId row : m_pending) m_isPending[row] = 0;
  std::erase_if(m_pending, [&](BoxId row) { return row >= known; });
  m_moved.clear();
  for (const BoxId row : m_pending) {
    const std::span<const T> bounds = rows.subspan(std::size_t{6} * row, 6);
    m_moved.insert(m_moved.end(), bounds.begin(), bounds.end());
  }
  m_world.move(m_pending, BoxSet::fromRows(std::span<const T>(m_moved)));
  const BoxSet fresh = BoxSet::fromRows(rows.subspan(6 * known));
  std::vector<BoxId> ids(fresh.size());
  m_world.add(fresh, {}, ids);  // none has ever been removed, so that they are the next ones
  m_pending.clear();
}

template class RowSearch<float>;
template class RowSearch<double>;

}  // namespace allpairs
