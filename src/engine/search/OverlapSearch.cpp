// SPDX-License-Identifier: MIT
#include "allpairs/Overlaps.h"

#include <memory>
#include <memory_resource>
#include <utility>

#include "allpairs/Error.h"
#include "search/InUse.h"
#include "search/Search.h"

namespace allpairs {

struct OverlapSearch::State {
  explicit State(std::pmr::memory_resource* memory) : search(memory) {}

  OverlapOptions options;
  engine::Search search;
  engine::InUse inUse;
};

OverlapSearch::OverlapSearch(OverlapOptions options) {
  auto made = std::make_unique<State>(engine::memoryOr(options.memory));
  made->options = std::move(options);
  m_state = made.release();
}
OverlapSearch::~OverlapSearch() { const std::unique_ptr<State> last(m_state); }
OverlapSearch::OverlapSearch(OverlapSearch&& other) noexcept : m_state(std::exchange(other.m_state, nullptr)) {}
OverlapSearch& OverlapSearch::operator=(OverlapSearch&& other) noexcept {
  OverlapSearch taken(std::move(other));
  std::swap(m_state, taken.m_state);
  return *this;
}

OverlapSearch::State& OverlapSearch::state() {
  if (m_state == nullptr) m_state = std::make_unique<State>(engine::defaultMemory()).release();
  m_state->inUse.check("OverlapSearch");
  return *m_state;
}

const OverlapOptions& OverlapSearch::options() const noexcept {
  static const OverlapOptions kDefaults;
  return m_state != nullptr ? m_state->options : kDefaults;
}

void OverlapSearch::setOptions(OverlapOptions options) {
  State& state = this->state();
  if (options.memory != nullptr && options.memory != state.options.memory) {
    throw InvalidArgument("an object keeps the memory resource that it was made with; make another object");
  }
  options.memory = state.options.memory;
  state.options = std::move(options);
}

const OverlapStatistics& OverlapSearch::statistics() const noexcept {
  static constexpr OverlapStatistics kNone;
  return m_state != nullptr ? m_state->search.statistics() : kNone;
}

void OverlapSearch::shrink() {
  if (m_state != nullptr) state().search.shrink();
}

std::span<const Pair> OverlapSearch::find(const BoxView& boxes) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  return state.search.find({boxes, boxes, true}, state.options);
}

std::span<const Pair> OverlapSearch::find(const BoxView& first, const BoxView& second) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  return state.search.find({first, second, false}, state.options);
}

std::uint64_t OverlapSearch::count(const BoxView& boxes) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  return state.search.count({boxes, boxes, true}, state.options);
}

std::uint64_t OverlapSearch::count(const BoxView& first, const BoxView& second) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  return state.search.count({first, second, false}, state.options);
}

void OverlapSearch::stream(const BoxView& boxes, PairVisitor visitor, std::size_t batchSize) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  state.search.stream({boxes, boxes, true}, state.options, {visitor, batchSize});
}

void OverlapSearch::stream(const BoxView& first, const BoxView& second, PairVisitor visitor, std::size_t batchSize) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  state.search.stream({first, second, false}, state.options, {visitor, batchSize});
}

namespace {

/// The memory of a one-shot search: for some thousand boxes one block, of the size that it is likely to need. Otherwise
/// glibc returns many blocks to the system at the end of each search and maps them again for the next. Fewer boxes need
/// few blocks; for more, the block would consist of large pages and cost more than it saves (docs/decisions/0015).
class OneShot {
 public:
  OneShot(std::size_t boxes, const OverlapOptions& options)
      : m_block(kBytesPerBox * boxes, engine::memoryOr(options.memory)), m_options(options) {
    // The block is not thread-safe.
    if (boxes >= kLeast && boxes < kMost && options.executor == nullptr) m_options.memory = &m_block;
  }

  [[nodiscard]] const OverlapOptions& options() const noexcept { return m_options; }

 private:
  static constexpr std::size_t kLeast = 4096;
  static constexpr std::size_t kMost = 16384;
  static constexpr std::size_t kBytesPerBox = 127;  ///< kMost of them are less than a large page.

  std::pmr::monotonic_buffer_resource m_block;
  OverlapOptions m_options;
};

/// The pairs of a search that is made for this one question.
std::vector<Pair> takePairs(const engine::Sets& sets, std::size_t boxes, const OverlapOptions& given) {
  const OneShot search(boxes, given);
  return engine::Search(engine::memoryOr(search.options().memory)).take(sets, search.options());
}

}  // namespace

std::vector<Pair> overlaps(const BoxView& boxes, const OverlapOptions& options) {
  return takePairs({boxes, boxes, true}, boxes.size(), options);
}

std::vector<Pair> overlaps(const BoxView& first, const BoxView& second, const OverlapOptions& options) {
  return takePairs({first, second, false}, first.size() + second.size(), options);
}

std::uint64_t countOverlaps(const BoxView& boxes, const OverlapOptions& options) {
  const OneShot search(boxes.size(), options);
  return OverlapSearch(search.options()).count(boxes);
}

std::uint64_t countOverlaps(const BoxView& first, const BoxView& second, const OverlapOptions& options) {
  const OneShot search(first.size() + second.size(), options);
  return OverlapSearch(search.options()).count(first, second);
}

void streamOverlaps(const BoxView& boxes, PairVisitor visitor, const OverlapOptions& options, std::size_t batchSize) {
  OverlapSearch(options).stream(boxes, visitor, batchSize);
}

void streamOverlaps(const BoxView& first, const BoxView& second, PairVisitor visitor, const OverlapOptions& options,
                    std::size_t batchSize) {
  OverlapSearch(options).stream(first, second, visitor, batchSize);
}

std::span<const std::string_view> instructionSets() { return engine::kernelNames(); }

}  // namespace allpairs
