// SPDX-License-Identifier: MIT
#include "allpairs/elements/ElementCandidates.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "ElementBoxes.h"
#include "PairChecks.h"
#include "allpairs/Error.h"
#include "memory/Memory.h"
#include "search/SearchState.h"

namespace allpairs::elements {
namespace {

/// So many pairs, and those of them that stay, are in the second-level cache when they are looked at again.
constexpr std::size_t kBatch = 8192;

/// Pairs that are worth a task of their own.
constexpr std::size_t kPairsPerTask = std::size_t{1} << 16;

/// The boxes of the elements of a kind of candidate: one set, or two.
struct Sets {
  BoxView first;
  BoxView second;
  bool one = true;
};

/// The pairs of a kind that were found, in memory that the next search writes over.
struct Found {
  explicit Found(std::pmr::memory_resource* memory) : pairs(memory) {}

  engine::Buffer<Pair> pairs;
  std::size_t size = 0;
};

/// Room for the pairs of the first search. Growing costs much, and default memory that isn't touched nothing.
std::size_t firstCapacity(const ElementCounts& counts, const std::pmr::memory_resource* memory) {
  constexpr std::size_t kPairsPerElement = 128;
  constexpr std::size_t kMost = std::size_t{1} << 24;
  if (memory != engine::defaultMemory()) return kBatch;
  return std::min(kMost, kPairsPerElement * (counts.edges + counts.triangles + 1));
}

/// A number that is no kind may come from a cast.
void checkKind(CandidateKind kind) {
  if (kind <= CandidateKind::FaceFace) return;
  throw InvalidArgument("no kind of candidate " + std::to_string(static_cast<int>(kind)));
}

/// Adds the pairs that pass to what was found, many at once.
template <class Check>
void addSelected(std::span<const Pair> pairs, const Check& check, Executor& executor, Found& found) {
  found.pairs.grow(found.size + pairs.size());
  Pair* to = found.pairs.data() + found.size;
  const std::size_t tasks =
      std::clamp<std::size_t>(pairs.size() / kPairsPerTask, 1, 4 * std::max<std::size_t>(executor.concurrency(), 1));
  std::vector<std::size_t> sizes(tasks);
  const auto begin = [&](std::size_t task) { return pairs.size() * task / tasks; };
  executor.run(tasks, [&](std::size_t task) {
    sizes[task] = selectPairs(pairs.subspan(begin(task), begin(task + 1) - begin(task)), check, to + begin(task));
  });
  std::size_t total = sizes[0];
  for (std::size_t task = 1; task < tasks; ++task) {
    std::copy_n(to + begin(task), sizes[task], to + total);
    total += sizes[task];
  }
  found.size += total;
}

}  // namespace

struct ElementCandidates::State {
  State(MeshTopology meshes, const CandidateOptions& wanted)
      : topology(std::move(meshes)),
        options(wanted),
        corners(topology.triangles().begin(), topology.triangles().end()),
        boxes(topology),
        search(engineOptions(options.order)),
        found(engine::makeArray<Found, 3>(engine::memoryOr(options.memory))),
        batch(engine::memoryOr(options.memory)) {}

  OverlapOptions engineOptions(Order order) const {
    OverlapOptions engine;
    engine.order = order;
    engine.distance = options.distance;
    engine.executor = options.executor;
    engine.memory = options.memory;
    engine.stop = options.stop;
    return engine;
  }

  /// No candidates, whatever the positions.
  [[nodiscard]] bool wantsNothing() const {
    return !options.withinMeshes && (!options.betweenMeshes || topology.meshCount() < 2);
  }

  /// Calls `use` with the check of a kind and with the boxes to search.
  template <class Use>
  void visit(CandidateKind kind, Use use);

  template <class Elements, class Use>
  void visitAs(Elements elements, ElementKind first, ElementKind second, Use use);

  void stream(const Sets& sets, PairVisitor visitor, std::size_t batchSize = kBatch) {
    sets.one ? search.stream(sets.first, visitor, batchSize)
             : search.stream(sets.first, sets.second, visitor, batchSize);
  }

  std::span<const Pair> find(const Sets& sets) {
    return sets.one ? search.find(sets.first) : search.find(sets.first, sets.second);
  }

  void streamIn(Order order, CandidateKind kind, PairVisitor visitor, std::size_t batchSize = kBatch);

  [[nodiscard]] BoxTables tables(ElementKind kind) { return {boxes.lanes(kind).data(), boxes.exact(kind).data()}; }

  MeshTopology topology;
  CandidateOptions options;
  std::vector<Corners> corners;
  ElementBoxes boxes;
  OverlapSearch search;
  SerialExecutor serial;
  engine::InUse inUse;
  std::array<Found, 3> found;
  std::pmr::vector<Pair> batch;
};

template <class Elements, class Use>
void ElementCandidates::State::visitAs(Elements elements, ElementKind first, ElementKind second, Use use) {
  const bool all = options.withinMeshes && options.betweenMeshes;
  const bool tell = !all && topology.meshCount() > 1;
  const MeshRule rule{tell ? topology.meshOfVertex().data() : nullptr, options.withinMeshes};
  const auto differ = [=](Pair pair) { return !elements.share(pair) & rule.allows(elements, pair); };
  const bool one = first == second;
  if (options.distance != 0.0) {  // The engine compares in double.
    use(differ, Sets{boxes.exact(first), boxes.exact(second), one});
    return;
  }
  const Sets rounded{boxes.rounded(first), boxes.rounded(second), one};
  if (boxes.roundedAreExact()) {
    use(differ, rounded);
  } else {
    const BoxTables a = tables(first);
    const BoxTables b = tables(second);
    use([=](Pair pair) { return differ(pair) && overlapExactly(a, b, pair); }, rounded);
  }
}

template <class Use>
void ElementCandidates::State::visit(CandidateKind kind, Use use) {
  if (wantsNothing()) return;
  switch (kind) {
    case CandidateKind::VertexFace:
      visitAs(VertexAndFace{corners.data()}, ElementKind::Vertices, ElementKind::Faces, use);
      break;
    case CandidateKind::EdgeEdge:
      visitAs(TwoEdges{topology.edges().data()}, ElementKind::Edges, ElementKind::Edges, use);
      break;
    case CandidateKind::FaceFace:
      visitAs(TwoFaces{corners.data()}, ElementKind::Faces, ElementKind::Faces, use);
      break;
  }
}

void ElementCandidates::State::streamIn(Order order, CandidateKind kind, PairVisitor visitor, std::size_t batchSize) {
  checkKind(kind);
  search.setOptions(engineOptions(order));
  visit(kind, [&](const auto& check, const Sets& sets) {
    const auto select = [&](std::span<const Pair> pairs) {
      batch.resize(std::max(batch.size(), pairs.size()));
      const std::size_t size = selectPairs(pairs, check, batch.data());
      if (size != 0) visitor(std::span<const Pair>(batch).first(size));
    };
    stream(sets, select, std::min(kBatch, batchSize));
  });
}

ElementCandidates::ElementCandidates(MeshTopology topology, CandidateOptions options)
    : m_state(std::make_unique<State>(std::move(topology), options)) {
  OverlapOptions checked = m_state->engineOptions(options.order);
  checked.stop = nullptr;  // set or not, it is for searches
  m_state->search.setOptions(std::move(checked));
  static_cast<void>(m_state->search.count(BoxView()));  // refuses a distance that makes no sense, wanted or not
}
ElementCandidates::~ElementCandidates() = default;
ElementCandidates::ElementCandidates(ElementCandidates&&) noexcept = default;
ElementCandidates& ElementCandidates::operator=(ElementCandidates&&) noexcept = default;

ElementCandidates::State& ElementCandidates::state() {
  if (m_state == nullptr) m_state = std::make_unique<State>(MeshTopology(), CandidateOptions());
  m_state->inUse.check("ElementCandidates");
  return *m_state;
}

void ElementCandidates::shrink() {
  if (m_state == nullptr) return;
  State& state = this->state();
  state.search.shrink();
  state.batch.clear();
  state.batch.shrink_to_fit();
}

const MeshTopology& ElementCandidates::topology() const noexcept {
  static const MeshTopology kNone;
  return m_state != nullptr ? m_state->topology : kNone;
}

void ElementCandidates::setPositions(std::size_t mesh, Span<const float> start, Span<const float> end) {
  state().boxes.setPositions<float>(mesh, start, end);
}

void ElementCandidates::setPositions(std::size_t mesh, Span<const double> start, Span<const double> end) {
  state().boxes.setPositions<double>(mesh, start, end);
}

Span<const Pair> ElementCandidates::find(CandidateKind kind) {
  State& state = this->state();
  const auto mark = state.inUse.mark();
  checkKind(kind);
  Found& found = state.found[static_cast<std::size_t>(kind)];
  found.size = 0;
  if (found.pairs.capacity() == 0) {
    found.pairs.require(firstCapacity(state.topology.counts(), engine::memoryOr(state.options.memory)));
  }
  state.search.setOptions(state.engineOptions(state.options.order));
  state.visit(kind, [&](const auto& check, const Sets& sets) {
    if (state.options.order == Order::Unordered && state.options.executor == nullptr) {
      state.stream(sets, [&](std::span<const Pair> pairs) { addSelected(pairs, check, state.serial, found); });
    } else {
      Executor& executor = state.options.executor != nullptr ? *state.options.executor : state.serial;
      addSelected(state.find(sets), check, executor, found);
    }
  });
  return {found.pairs.data(), found.size};
}

std::uint64_t ElementCandidates::count(CandidateKind kind) {
  State& state = this->state();
  const auto mark = state.inUse.mark();
  std::uint64_t count = 0;
  state.streamIn(Order::Unordered, kind, [&count](std::span<const Pair> pairs) { count += pairs.size(); });
  return count;
}

void ElementCandidates::stream(CandidateKind kind, PairVisitor visitor, std::size_t batchSize) {
  if (batchSize == 0) throw InvalidArgument("a batch size of 0 pairs");
  State& state = this->state();
  const auto mark = state.inUse.mark();
  state.streamIn(state.options.order, kind, visitor, batchSize);
}

}  // namespace allpairs::elements
