// SPDX-License-Identifier: MIT
#include "allpairs/Overlaps.h"

#include <memory_resource>
#include <utility>

#include "search/InUse.h"
#include "search/Search.h"

namespace allpairs {

struct Overlaps::State {
  explicit State(std::pmr::memory_resource* memory) : search(memory) {}

  OverlapOptions options;
  engine::Search search;
  engine::InUse inUse;
};

Overlaps::Overlaps(OverlapOptions options) : m_state(std::make_unique<State>(engine::memoryOr(options.memory))) {
  m_state->options = std::move(options);
}
Overlaps::~Overlaps() = default;
Overlaps::Overlaps(Overlaps&&) noexcept = default;
Overlaps& Overlaps::operator=(Overlaps&&) noexcept = default;

Overlaps::State& Overlaps::state() {
  if (m_state == nullptr) m_state = std::make_unique<State>(engine::defaultMemory());
  m_state->inUse.check("Overlaps");
  return *m_state;
}

const OverlapOptions& Overlaps::options() const noexcept {
  static const OverlapOptions kDefaults;
  return m_state != nullptr ? m_state->options : kDefaults;
}

void Overlaps::setOptions(OverlapOptions options) {
  State& state = this->state();
  options.memory = state.options.memory;
  state.options = std::move(options);
}

const OverlapStatistics& Overlaps::statistics() const noexcept {
  static constexpr OverlapStatistics kNone;
  return m_state != nullptr ? m_state->search.statistics() : kNone;
}

void Overlaps::shrink() {
  if (m_state != nullptr) state().search.shrink();
}

std::span<const Pair> Overlaps::find(const BoxSet& boxes) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  return state.search.find({boxes, boxes, true}, state.options);
}

std::span<const Pair> Overlaps::findBetween(const BoxSet& first, const BoxSet& second) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  return state.search.find({first, second, false}, state.options);
}

std::uint64_t Overlaps::count(const BoxSet& boxes) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  return state.search.count({boxes, boxes, true}, state.options);
}

std::uint64_t Overlaps::countBetween(const BoxSet& first, const BoxSet& second) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  return state.search.count({first, second, false}, state.options);
}

void Overlaps::stream(const BoxSet& boxes, PairVisitor visitor) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  state.search.stream({boxes, boxes, true}, state.options, visitor);
}

void Overlaps::streamBetween(const BoxSet& first, const BoxSet& second, PairVisitor visitor) {
  State& state = this->state();
  const engine::InUse::Scope scope(state.inUse);
  state.search.stream({first, second, false}, state.options, visitor);
}

namespace {

/// The memory of a search that is made, used and thrown away: for some thousand boxes one block, as large as it is likely to
/// need. glibc gives many blocks back to the system at the end of each search, to fetch them again for the next; fewer
/// boxes need few, and for more the block would be made of large pages and cost more than it saves (docs/decisions/0015).
class OneShot {
 public:
  OneShot(std::size_t boxes, const OverlapOptions& options)
      : m_block(kBytesPerBox * boxes, engine::memoryOr(options.memory)), m_options(options) {
    // The block is not made for several threads.
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

std::vector<Pair> toVector(std::span<const Pair> pairs) { return {pairs.begin(), pairs.end()}; }

}  // namespace

std::vector<Pair> overlaps(const BoxSet& boxes, const OverlapOptions& options) {
  const OneShot search(boxes.size(), options);
  return toVector(Overlaps(search.options()).find(boxes));
}

std::vector<Pair> overlapsBetween(const BoxSet& first, const BoxSet& second, const OverlapOptions& options) {
  const OneShot search(first.size() + second.size(), options);
  return toVector(Overlaps(search.options()).findBetween(first, second));
}

std::uint64_t countOverlaps(const BoxSet& boxes, const OverlapOptions& options) {
  const OneShot search(boxes.size(), options);
  return Overlaps(search.options()).count(boxes);
}

std::uint64_t countOverlapsBetween(const BoxSet& first, const BoxSet& second, const OverlapOptions& options) {
  const OneShot search(first.size() + second.size(), options);
  return Overlaps(search.options()).countBetween(first, second);
}

void streamOverlaps(const BoxSet& boxes, PairVisitor visitor, const OverlapOptions& options) {
  Overlaps(options).stream(boxes, visitor);
}

void streamOverlapsBetween(const BoxSet& first, const BoxSet& second, PairVisitor visitor,
                           const OverlapOptions& options) {
  Overlaps(options).streamBetween(first, second, visitor);
}

std::span<const std::string_view> instructionSets() { return engine::kernelNames(); }

}  // namespace allpairs
