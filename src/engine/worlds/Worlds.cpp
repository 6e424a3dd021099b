// SPDX-License-Identifier: MIT
#include "allpairs/Worlds.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "allpairs/Error.h"
#include "memory/Memory.h"
#include "search/SearchState.h"
#include "worlds/SharedSearcher.h"
#include "worlds/WorldsSearcher.h"

namespace allpairs {
namespace {

std::string numbered(const char* what, std::uint64_t number) { return what + std::to_string(number); }

/// Throws unless world k is [begin, end) of that many boxes.
void checkWorld(std::size_t k, std::uint64_t begin, std::uint64_t end, std::size_t boxes) {
  if (end < begin) {
    throw InvalidArgument(numbered("the offsets of worlds decrease: world ", k) + numbered(" begins at box ", begin) +
                          numbered(" and ends at ", end));
  }
  if (end > boxes) {
    throw InvalidArgument(numbered("world ", k) + numbered(" ends at box ", end) + numbered(", but there are ", boxes) +
                          " boxes");
  }
}

}  // namespace

Worlds::Worlds(const BoxView& boxes, Span<const std::uint64_t> begin) : m_boxes(boxes), m_begin(begin) {
  if (begin.empty()) throw InvalidArgument("no offsets of worlds: there is one more than there are worlds");
  if (begin[0] != 0) throw InvalidArgument(numbered("world 0 begins at box ", begin[0]) + ", not at box 0");
  m_size = begin.size() - 1;
  m_eachSize = m_size == 0 ? 0 : static_cast<std::size_t>(begin[1]);
  for (std::size_t k = 0; k < m_size; ++k) {
    checkWorld(k, begin[k], begin[k + 1], boxes.size());
    const auto size = static_cast<std::size_t>(begin[k + 1] - begin[k]);
    m_largestSize = std::max(m_largestSize, size);
    m_hasEqualSizes = m_hasEqualSizes && size == m_eachSize;
  }
  if (begin[m_size] != boxes.size()) {
    if (m_size == 0) throw InvalidArgument(numbered("no worlds, but boxes: ", boxes.size()));
    throw InvalidArgument(numbered("the last world, ", m_size - 1) + numbered(", ends at box ", begin[m_size]) +
                          numbered(" of ", boxes.size()));
  }
}

Worlds Worlds::ofEqualSize(const BoxView& boxes, std::size_t worlds) {
  // Of that many a vector could not hold the offsets, which are one more.
  if (worlds >= PTRDIFF_MAX / sizeof(std::uint64_t)) throw InvalidArgument("too many worlds");
  if (worlds == 0 ? !boxes.empty() : boxes.size() % worlds != 0) {
    throw InvalidArgument(std::to_string(boxes.size()) + " boxes cannot be divided equally among " +
                          std::to_string(worlds) + " worlds");
  }
  Worlds result;
  result.m_boxes = boxes;
  result.m_size = worlds;
  result.m_eachSize = worlds == 0 ? 0 : boxes.size() / worlds;
  result.m_largestSize = result.m_eachSize;
  return result;
}

void Worlds::setIgnoredPairs(Span<const Pair> pairs) {
  for (const Pair pair : pairs) {
    if (std::max(pair.first, pair.second) < m_largestSize) continue;
    throw InvalidArgument("the ignored pair (" + std::to_string(pair.first) + ", " + std::to_string(pair.second) +
                          ") is in no world: the largest has " + std::to_string(m_largestSize) + " boxes");
  }
  m_ignoredPairs = pairs;
}

struct WorldsSearch::State {
  explicit State(std::pmr::memory_resource* memory) : own(memory), shared(memory), given(memory) {}

  OverlapOptions options;
  engine::WorldsSearcher own;
  engine::SharedSearcher shared;
  std::pmr::vector<std::uint64_t> given;  ///< The offsets that list() was given.
  OverlapStatistics statistics;
  engine::InUse inUse;

  /// Calls use() for one of the two, whose statistics are then those of the object.
  template <class Searcher, class Use>
  auto run(const Searcher& searcher, const Use& use) {
    const auto mark = inUse.mark();
    statistics = {};
    const auto found = use();
    statistics = searcher.statistics();
    return found;
  }

  /// Calls write(), which writes pairs where the offsets say and returns the offsets of those that it found; throws
  /// unless they are the same. The offsets are copied: those that count() gave are overwritten by the next search.
  template <class Write>
  void writeAt(const Worlds& worlds, std::span<const std::uint64_t> begin, std::span<Pair> pairs, const Write& write) {
    if (begin.size() != worlds.size() + 1 || begin[0] != 0 || !std::is_sorted(begin.begin(), begin.end())) {
      throw InvalidArgument("the offsets of pairs are not those that count() gives: one more than the " +
                            std::to_string(worlds.size()) + " worlds, from 0 on, ascending");
    }
    if (pairs.size() < begin.back()) {
      throw InvalidArgument("memory for " + std::to_string(pairs.size()) + " pairs, but there are " +
                            std::to_string(begin.back()));
    }
    given.assign(begin.begin(), begin.end());
    const std::span<const std::uint64_t> found = write();
    if (!std::equal(given.begin(), given.end(), found.begin(), found.end())) {
      throw InvalidArgument("the offsets of pairs are not those of these worlds; count them first");
    }
  }
};

WorldsSearch::WorldsSearch(OverlapOptions options) : m_state(engine::makeState<State>(std::move(options))) {}
WorldsSearch::~WorldsSearch() { const std::unique_ptr<State> last(m_state); }
WorldsSearch::WorldsSearch(WorldsSearch&& other) noexcept : m_state(std::exchange(other.m_state, nullptr)) {}
WorldsSearch& WorldsSearch::operator=(WorldsSearch&& other) noexcept {
  WorldsSearch taken(std::move(other));
  std::swap(m_state, taken.m_state);
  return *this;
}

WorldsSearch::State& WorldsSearch::state() { return engine::stateOf(m_state, "WorldsSearch"); }

const OverlapOptions& WorldsSearch::options() const noexcept {
  return m_state != nullptr ? m_state->options : engine::defaultOf<OverlapOptions>();
}

void WorldsSearch::setOptions(OverlapOptions options) { engine::replaceOptions(state().options, std::move(options)); }

const OverlapStatistics& WorldsSearch::statistics() const noexcept {
  return m_state != nullptr ? m_state->statistics : engine::defaultOf<OverlapStatistics>();
}

void WorldsSearch::shrink() {
  if (m_state == nullptr) return;
  State& state = this->state();
  State* const smaller = engine::makeState<State>(state.options);
  smaller->statistics = state.statistics;
  const std::unique_ptr<State> last(std::exchange(m_state, smaller));
}

WorldPairsView WorldsSearch::find(const Worlds& worlds) {
  State& state = this->state();
  return state.run(state.own, [&] { return state.own.find(worlds, state.options); });
}

WorldPairsView WorldsSearch::find(const Worlds& worlds, const BoxView& shared) {
  State& state = this->state();
  return state.run(state.shared, [&] { return state.shared.find(worlds, shared, state.options); });
}

Span<const std::uint64_t> WorldsSearch::count(const Worlds& worlds) {
  State& state = this->state();
  return state.run(state.own, [&] { return state.own.count(worlds, state.options); });
}

Span<const std::uint64_t> WorldsSearch::count(const Worlds& worlds, const BoxView& shared) {
  State& state = this->state();
  return state.run(state.shared, [&] { return state.shared.count(worlds, shared, state.options); });
}

void WorldsSearch::list(const Worlds& worlds, Span<const std::uint64_t> begin, Span<Pair> pairs) {
  State& state = this->state();
  state.writeAt(worlds, begin, pairs, [&] {
    return state.run(state.own, [&] { return state.own.list(worlds, state.options, state.given, pairs); });
  });
}

void WorldsSearch::list(const Worlds& worlds, const BoxView& shared, Span<const std::uint64_t> begin,
                        Span<Pair> pairs) {
  state().writeAt(worlds, begin, pairs, [&] {
    const WorldPairsView found = find(worlds, shared);
    std::copy_n(found.pairs.begin(), std::min(found.pairs.size(), pairs.size()), pairs.begin());
    return found.begin;
  });
}

namespace {

WorldPairs copied(const WorldPairsView& view) {
  return {{view.pairs.begin(), view.pairs.end()}, {view.begin.begin(), view.begin.end()}};
}

std::vector<std::uint64_t> copied(std::span<const std::uint64_t> begin) { return {begin.begin(), begin.end()}; }

}  // namespace

WorldPairs overlapsInWorlds(const Worlds& worlds, const OverlapOptions& options) {
  return copied(WorldsSearch(options).find(worlds));
}

WorldPairs overlapsInWorlds(const Worlds& worlds, const BoxView& shared, const OverlapOptions& options) {
  return copied(WorldsSearch(options).find(worlds, shared));
}

std::vector<std::uint64_t> countOverlapsInWorlds(const Worlds& worlds, const OverlapOptions& options) {
  return copied(WorldsSearch(options).count(worlds));
}

std::vector<std::uint64_t> countOverlapsInWorlds(const Worlds& worlds, const BoxView& shared,
                                                 const OverlapOptions& options) {
  return copied(WorldsSearch(options).count(worlds, shared));
}

void listOverlapsInWorlds(const Worlds& worlds, Span<const std::uint64_t> begin, Span<Pair> pairs,
                          const OverlapOptions& options) {
  WorldsSearch(options).list(worlds, begin, pairs);
}

}  // namespace allpairs
