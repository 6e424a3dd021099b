// SPDX-License-Identifier: MIT
#include "allpairs/Overlaps.h"

#include <memory>
#include <memory_resource>
#include <mutex>
#include <new>
#include <utility>

#include "input/Options.h"
#include "input/Parts.h"
#include "memory/Platform.h"
#include "search/FewBoxes.h"
#include "search/Search.h"
#include "search/SearchState.h"

namespace allpairs {

struct OverlapSearch::State {
  explicit State(std::pmr::memory_resource* memory) : search(memory) {}

  OverlapOptions options;
  engine::Search search;
  engine::InUse inUse;

  /// Calls a method of the search with these sets and the options, marked as running.
  template <class Method, class... Arguments>
  auto run(Method method, const engine::Sets& sets, Arguments... arguments) {
    const auto mark = inUse.mark();
    return (search.*method)(sets, options, arguments...);
  }
};

OverlapSearch::OverlapSearch(OverlapOptions options) : m_state(engine::makeState<State>(std::move(options))) {}
OverlapSearch::~OverlapSearch() { const std::unique_ptr<State> last(m_state); }
OverlapSearch::OverlapSearch(OverlapSearch&& other) noexcept : m_state(std::exchange(other.m_state, nullptr)) {}
OverlapSearch& OverlapSearch::operator=(OverlapSearch&& other) noexcept {
  OverlapSearch taken(std::move(other));
  std::swap(m_state, taken.m_state);
  return *this;
}

OverlapSearch::State& OverlapSearch::state() { return engine::stateOf(m_state, "OverlapSearch"); }

const OverlapOptions& OverlapSearch::options() const noexcept {
  return m_state != nullptr ? m_state->options : engine::defaultOf<OverlapOptions>();
}

void OverlapSearch::setOptions(OverlapOptions options) { engine::replaceOptions(state().options, std::move(options)); }

const OverlapStatistics& OverlapSearch::statistics() const noexcept {
  return m_state != nullptr ? m_state->search.statistics() : engine::defaultOf<OverlapStatistics>();
}

void OverlapSearch::shrink() {
  if (m_state != nullptr) state().search.shrink();
}

Span<const Pair> OverlapSearch::find(const BoxView& boxes) {
  return state().run(&engine::Search::find, engine::Sets(boxes));
}

Span<const Pair> OverlapSearch::find(const BoxView& first, const BoxView& second) {
  return state().run(&engine::Search::find, {first, second});
}

NeighborsView OverlapSearch::findNeighbors(const BoxView& boxes, NeighborRows rows) {
  engine::checkRows(rows);
  return state().run(&engine::Search::findNeighbors, engine::Sets(boxes), rows, nullptr);
}

NeighborsView OverlapSearch::findNeighbors(const BoxView& first, const BoxView& second) {
  return state().run(&engine::Search::findNeighbors, {first, second}, NeighborRows::Half, nullptr);
}

Span<Pair> OverlapSearch::findInto(const BoxView& boxes, Span<Pair> memory) {
  return state().run(&engine::Search::findInto, engine::Sets(boxes), memory);
}

Span<Pair> OverlapSearch::findInto(const BoxView& first, const BoxView& second, Span<Pair> memory) {
  return state().run(&engine::Search::findInto, {first, second}, memory);
}

NeighborsView OverlapSearch::findNeighborsInto(const BoxView& boxes, NeighborRows rows, const NeighborsMemory& memory) {
  engine::checkRows(rows);
  return state().run(&engine::Search::findNeighborsInto, engine::Sets(boxes), rows, memory);
}

NeighborsView OverlapSearch::findNeighborsInto(const BoxView& first, const BoxView& second,
                                               const NeighborsMemory& memory) {
  return state().run(&engine::Search::findNeighborsInto, {first, second}, NeighborRows::Half, memory);
}

std::uint64_t OverlapSearch::count(const BoxView& boxes) {
  return state().run(&engine::Search::count, engine::Sets(boxes));
}

std::uint64_t OverlapSearch::count(const BoxView& first, const BoxView& second) {
  return state().run(&engine::Search::count, {first, second});
}

void OverlapSearch::stream(const BoxView& boxes, PairVisitor visitor, std::size_t batchSize) {
  state().run(&engine::Search::stream, engine::Sets(boxes), visitor, batchSize);
}

void OverlapSearch::stream(const BoxView& first, const BoxView& second, PairVisitor visitor, std::size_t batchSize) {
  state().run(&engine::Search::stream, {first, second}, visitor, batchSize);
}

namespace {

/// The size of a block for all memory of one search: what dense scenes need, or half of that, or nothing where that is
/// too much.
///
/// glibc returns the end of its heap to the system once it is more than twice the largest block that was freed before.
/// The block, of which only what is used is ever touched, and a result that is smaller are not that much: their pages
/// are still there for the next call. A larger block gains in a program that does nothing else, and loses in others
/// (docs/decisions/0015).
std::size_t blockFor(std::size_t boxes) {
  const std::size_t most = std::size_t{7} << 20;
  return 256 * boxes <= most ? std::min(512 * boxes, most) : 0;
}

/// Memory of one search, all in a block of this size while that lasts, or if there is memory for it. It is as operator
/// new aligns it: glibc splits off what precedes an address that is aligned better, a piece that divides its heap.
///
/// Threads: any number may allocate, if it says so.
class BlockMemory final : public std::pmr::memory_resource {
 public:
  BlockMemory(std::size_t size, bool isForThreads)
      : m_isForThreads(isForThreads),
        m_block(new(std::nothrow) std::byte[size]),
        m_rest(m_block.get(), m_block == nullptr ? 0 : size, engine::defaultMemory()) {
    engine::adviseLargePages(m_block.get(), m_block == nullptr ? 0 : size);
  }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    const auto lock = m_isForThreads ? std::unique_lock(m_mutex) : std::unique_lock<std::mutex>();
    return m_rest.allocate(bytes, alignment);
  }

  void do_deallocate(void* /*memory*/, std::size_t /*bytes*/, std::size_t /*alignment*/) override {}

  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  bool m_isForThreads;
  std::mutex m_mutex;
  std::unique_ptr<std::byte[]> m_block;
  std::pmr::monotonic_buffer_resource m_rest;
};

/// Calls use(search) with a search for one question.
template <class Use>
auto searchOnce(const engine::Sets& sets, const OverlapOptions& given, const Use& use) {
  // How memory of the caller is used is the caller's affair.
  const std::size_t boxes = sets.first.size() + (sets.one ? 0 : sets.second.size());
  const std::size_t size = given.memory == nullptr ? blockFor(boxes) : 0;
  if (size == 0) {
    engine::Search search(engine::memoryOr(given.memory));
    return use(search);
  }
  BlockMemory memory(size, given.executor != nullptr);
  engine::Search search(&memory);
  return use(search);
}

/// Memory for so many pairs, 16 MiB: what needs more than half a part gets it at once, or less if there cannot be as
/// many pairs. Of that only what is used takes memory, while a vector that grows is copied from page to fresh page.
/// What needs more than that doubles.
constexpr std::size_t kLargeResult = std::size_t{1} << 21;

std::vector<Pair> takeAmongFew(const engine::Sets& sets, const OverlapOptions& options) {
  std::vector<Pair> taken;
  const auto append = [&](std::span<const Pair> pairs) {
    const std::size_t size = taken.size() + pairs.size();
    const std::size_t most = std::min(engine::pairsOf(sets), kLargeResult);
    if (size > engine::kPartSize / 2 && taken.capacity() < most) taken.reserve(most);
    engine::append(taken, pairs);
  };
  engine::findFew(sets, options, options.order, append);
  if (taken.size() < taken.capacity() / 2) taken.shrink_to_fit();
  return taken;
}

std::vector<Pair> takeOverlaps(const engine::Sets& sets, const OverlapOptions& options) {
  if (engine::areFew(sets, options)) return takeAmongFew(sets, options);
  return searchOnce(sets, options, [&](engine::Search& search) { return search.take(sets, options); });
}

Neighbors takeNeighbors(const engine::Sets& sets, NeighborRows rows, const OverlapOptions& options) {
  return searchOnce(sets, options, [&](engine::Search& search) { return search.takeNeighbors(sets, options, rows); });
}

std::uint64_t countOnce(const engine::Sets& sets, const OverlapOptions& options) {
  if (engine::areFew(sets, options)) return engine::countFew(sets, options).pairs;
  return searchOnce(sets, options, [&](engine::Search& search) { return search.countMany(sets, options); });
}

void streamOnce(const engine::Sets& sets, PairVisitor visitor, const OverlapOptions& options, std::size_t batchSize) {
  engine::Search search(engine::memoryOr(options.memory));
  search.stream(sets, options, visitor, batchSize);
}

}  // namespace

std::vector<Pair> overlaps(const BoxView& boxes, const OverlapOptions& options) {
  return takeOverlaps(engine::Sets(boxes), options);
}

std::vector<Pair> overlaps(const BoxView& first, const BoxView& second, const OverlapOptions& options) {
  return takeOverlaps({first, second}, options);
}

Neighbors neighbors(const BoxView& boxes, NeighborRows rows, const OverlapOptions& options) {
  engine::checkRows(rows);
  return takeNeighbors(engine::Sets(boxes), rows, options);
}

Neighbors neighbors(const BoxView& first, const BoxView& second, const OverlapOptions& options) {
  return takeNeighbors({first, second}, NeighborRows::Half, options);
}

std::uint64_t countOverlaps(const BoxView& boxes, const OverlapOptions& options) {
  return countOnce(engine::Sets(boxes), options);
}

std::uint64_t countOverlaps(const BoxView& first, const BoxView& second, const OverlapOptions& options) {
  return countOnce({first, second}, options);
}

void streamOverlaps(const BoxView& boxes, PairVisitor visitor, const OverlapOptions& options, std::size_t batchSize) {
  streamOnce(engine::Sets(boxes), visitor, options, batchSize);
}

void streamOverlaps(const BoxView& first, const BoxView& second, PairVisitor visitor, const OverlapOptions& options,
                    std::size_t batchSize) {
  streamOnce({first, second}, visitor, options, batchSize);
}

Span<const std::string_view> instructionSets() { return engine::kernelNames(); }

}  // namespace allpairs
