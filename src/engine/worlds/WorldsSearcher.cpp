// SPDX-License-Identifier: MIT
#include "worlds/WorldsSearcher.h"

#include <algorithm>
#include <string>

#include "allpairs/Error.h"
#include "input/BoxRuns.h"
#include "input/Options.h"
#include "input/Parts.h"
#include "search/PairSink.h"
#include "search/TaskCut.h"

namespace allpairs::engine {
namespace {

/// The work that a part is worth: some fifty microseconds.
constexpr std::size_t kLeastWork = std::size_t{1} << 16;

/// What a world takes, very roughly in vector tests: some for the world, for each box its columns or its part of a
/// hierarchy.
std::uint64_t workOf(std::uint64_t boxes, std::uint64_t mostBoxes) {
  return 16 + boxes * (boxes <= mostBoxes ? 4 + boxes / kFanOut : 64);
}

/// The number of boxes up to which the exhaustive kernel finds the pairs that a search would, in the same order.
std::size_t mostBoxesOf(const Kernels& kernels, const OverlapOptions& options) {
  if (options.strategy == Strategy::Bvh) return 0;
  if (options.strategy == Strategy::Exhaustive) return kMostInWorld;
  const std::size_t flat = kernels.flatBoxes;
  // Of twice as many as a search of one set tests exhaustively a hierarchy is not faster yet: this kernel does not put
  // pairs in order, and rounds to the nearest at most (worlds_benchmark).
  return std::min(kMostInWorld, options.order == Order::Unordered ? flat : 2 * flat);
}

/// Whether the pairs of a world can be written to the sink at once.
bool hasRoom(WorldSink& sink, std::size_t boxes) { return sink.countOnly || sink.makeRoom(WorldSink::roomFor(boxes)); }

void append(std::span<const Pair> pairs, WorldSink& sink) {
  if (!sink.makeRoom(pairs.size())) {
    throw InvalidArgument("there are more pairs than the offsets given say; count them first");
  }
  std::copy(pairs.begin(), pairs.end(), sink.pairs + sink.size);
  sink.size += pairs.size();
}

}  // namespace

void WorldsSearcher::begin(const Worlds& worlds, const OverlapOptions& options) {
  m_worlds = &worlds;
  m_options = &options;
  m_statistics = {};
  m_kernels = &chooseKernels(options.instructionSet);
  checkStop(options.stop);
  m_executor = &m_callExecutor.over(options.executor, options.stop);
  const BoxView& boxes = worlds.boxes();
  m_isPlain = options.distance == 0.0 && !options.region && !boxes.hasMargins() && isRun(boxes);
  m_mostBoxes = mostBoxesOf(*m_kernels, options);
  if (!m_isPlain) m_mostBoxes = std::min(m_mostBoxes, m_kernels->wideBoxes);
  m_filter.prepare(worlds, options, m_mostBoxes);
  m_workers.require(m_executor->concurrency());
  for (std::size_t i = 0; i < m_workers.size(); ++i) {
    m_workers[i].size = 0;
    m_workers[i].statistics = {};
  }
  m_begin.resize(worlds.size() + 1);
  m_begin[0] = 0;
  cutParts();
}

/// Cuts the worlds into parts of similar work, one for each world that all threads search together.
void WorldsSearcher::cutParts() {
  m_parts.clear();
  const std::size_t worlds = m_worlds->size();
  const std::size_t threads = m_executor->concurrency();
  const bool mayStop = m_options->stop != nullptr;
  if (threads <= 1 && !mayStop) {
    m_parts.push_back({0, worlds});
    return;
  }
  std::uint64_t all = 0;
  for (std::size_t world = 0; world < worlds; ++world) all += workOf(sizeOf(world), m_mostBoxes);
  std::uint64_t most = std::max<std::uint64_t>(kLeastWork, all / (kTasksPerThread * threads));
  if (mayStop) most = std::min<std::uint64_t>(most, kWorkBetweenLooks);
  std::uint64_t work = most;
  for (std::size_t world = 0; world < worlds; ++world) {
    const bool takesAllThreads = sizeOf(world) > kPartSize;  // It has work for them.
    if (work >= most || takesAllThreads) {
      m_parts.push_back({world, world, takesAllThreads});
      work = 0;
    }
    m_parts.back().end = world + 1;
    work = takesAllThreads ? most : work + workOf(sizeOf(world), m_mostBoxes);
  }
}

/// Searches all parts, each by a worker that no other part has meanwhile; sinkOf(part, worker) says where its pairs go.
template <class SinkOf>
void WorldsSearcher::searchParts(const SinkOf& sinkOf) {
  const auto run = [&](Part& part) {
    m_workers.withOne([&](std::size_t index, Worker& worker) {
      WorldSink sink = sinkOf(part, worker);
      sink.bySecond = m_options->order == Order::BySecond;
      sink.allowed = m_filter.allowed();
      part.worker = index;
      part.firstPair = sink.size;
      searchPart(part, worker, sink);
      part.pairs = sink.size - part.firstPair;
      worker.size = sink.size;
    });
  };
  m_executor->run(m_parts.size(), [&](std::size_t i) {
    if (!m_parts[i].takesAllThreads) run(m_parts[i]);
  });
  for (Part& part : m_parts) {
    checkStop(m_options->stop);
    if (part.takesAllThreads) run(part);
  }
  placeParts();
  for (std::size_t i = 0; i < m_workers.size(); ++i) add(m_statistics, m_workers[i].statistics);
  m_statistics.pairs = m_begin.back();
}

/// Where the pairs of each part go in the result.
void WorldsSearcher::placeParts() {
  std::uint64_t place = 0;
  for (Part& part : m_parts) {
    part.place = place;
    place += part.pairs;
  }
  checkLimit(m_options->maxPairs, place);
  for (const Part& part : m_parts) {
    if (part.place == part.firstPair) continue;
    for (std::size_t world = part.begin; world < part.end; ++world) m_begin[world + 1] += part.place - part.firstPair;
  }
}

WorldPairsView WorldsSearcher::find(const Worlds& worlds, const OverlapOptions& options) {
  begin(worlds, options);
  searchParts([&](const Part& part, Worker& worker) {
    const std::size_t boxes = m_worlds->begin(part.end) - m_worlds->begin(part.begin);
    worker.pairs.grow(worker.size + likelyPairsOf(boxes) / 2);  // Boxes of small worlds have fewer.
    WorldSink sink{worker.pairs.data(), worker.pairs.capacity(), worker.size};
    sink.growing = &worker.pairs;
    return sink;
  });
  if (m_parts.size() <= 1) {
    const Pair* const pairs = m_parts.empty() ? nullptr : m_workers[m_parts[0].worker].pairs.data();
    return {{pairs, m_begin.back()}, m_begin};
  }
  m_joined.require(m_begin.back());
  m_executor->run(m_parts.size(), [&](std::size_t i) {
    const Part& part = m_parts[i];
    std::copy_n(m_workers[part.worker].pairs.data() + part.firstPair, part.pairs, m_joined.data() + part.place);
  });
  return {{m_joined.data(), m_begin.back()}, m_begin};
}

std::span<const std::uint64_t> WorldsSearcher::count(const Worlds& worlds, const OverlapOptions& options) {
  begin(worlds, options);
  searchParts([&](const Part&, Worker&) { return WorldSink{.countOnly = true}; });
  return m_begin;
}

std::span<const std::uint64_t> WorldsSearcher::list(const Worlds& worlds, const OverlapOptions& options,
                                                    std::span<const std::uint64_t> begin, std::span<Pair> pairs) {
  this->begin(worlds, options);
  searchParts([&](const Part& part, Worker&) {
    const std::uint64_t first = begin[part.begin];
    return WorldSink{pairs.data() + first, begin[part.end] - first};
  });
  return m_begin;
}

void WorldsSearcher::searchPart(const Part& part, Worker& worker, WorldSink& sink) {
  for (std::size_t world = part.begin; world < part.end;) {
    if (m_isPlain && !m_filter.selects()) {
      const std::size_t next = runPlain(world, part.end, worker, sink);
      checkLimit(m_options->maxPairs, sink.size);
      if (next == part.end) return;
      world = next;
      if (sizeOf(world) <= m_mostBoxes && hasRoom(sink, sizeOf(world))) continue;
    }
    if (sizeOf(world) <= m_mostBoxes) {
      searchSmall(world, worker, sink);
    } else {
      searchLarge(world, part.takesAllThreads, worker, sink);
    }
    checkLimit(m_options->maxPairs, sink.size);
    m_begin[world + 1] = sink.size;
    ++world;
  }
}

/// Worlds that the kernel reads itself, as many as there is room for; returns the one that follows them.
template <class T>
std::size_t WorldsSearcher::runKernel(std::size_t world, std::size_t end, Worker& worker, WorldSink& sink) {
  WorldsRun<T> run;
  run.boxes = runOf<T>(m_worlds->boxes());
  run.worlds = m_worlds;
  run.world = world;
  run.end = end;
  run.mostBoxes = m_mostBoxes;
  run.sink = sink;
  run.pairEnd = m_begin.data() + 1;
  run.hadMany = worker.hadMany;
  m_kernels->plain<T>().searchWorlds(run);
  worker.hadMany = run.hadMany;
  sink = run.sink;
  worker.statistics.boxTests += run.boxTests;
  return run.world;
}

std::size_t WorldsSearcher::runPlain(std::size_t world, std::size_t end, Worker& worker, WorldSink& sink) {
  return m_worlds->boxes().isFloat64() ? runKernel<double>(world, end, worker, sink)
                                       : runKernel<float>(world, end, worker, sink);
}

/// One world, in its place if there is certainly room for all its pairs before some are selected, else beside it.
void WorldsSearcher::searchSmall(std::size_t world, Worker& worker, WorldSink& sink) {
  const std::size_t boxes = sizeOf(world);
  const bool isDirect = sink.countOnly ? !m_filter.selects() : hasRoom(sink, boxes);
  WorldSink found = sink;
  if (!isDirect) {
    worker.scratch.require(WorldSink::roomFor(boxes));
    found = {worker.scratch.data(), worker.scratch.capacity()};
    found.bySecond = sink.bySecond;
    found.allowed = sink.allowed;
  }
  const std::uint64_t before = found.size;
  m_isPlain ? static_cast<void>(runPlain(world, world + 1, worker, found)) : runWide(world, worker, found);
  if (m_filter.selects()) {
    found.size = before + m_filter.select(world, {found.pairs + before, found.size - before});
  }
  if (isDirect) {
    sink = found;
  } else if (sink.countOnly) {
    sink.size += found.size;
  } else {
    append({found.pairs, found.size}, sink);
  }
}

void WorldsSearcher::runWide(std::size_t world, Worker& worker, WorldSink& sink) const {
  worker.wide.require(1);
  WideWorld& wide = worker.wide[0];
  const std::size_t first = m_worlds->begin(world);
  const std::size_t size = sizeOf(world);
  const auto isIn = [&](const Box& box, double margin) { return reachesRegion(box, margin, *m_options); };
  wide.read(
      size, m_worlds->boxes(), [=](std::size_t i) { return first + i; }, isIn);
  wide.distance = m_options->distance;
  m_kernels->searchWideWorld(wide, sink);
  worker.statistics.boxTests += WorldSink::pairsOf(size);
}

/// A world that is searched as if it were alone.
void WorldsSearcher::searchLarge(std::size_t world, bool takesAllThreads, Worker& worker, WorldSink& sink) {
  const BoxView boxes = (*m_worlds)[world];
  OverlapOptions options = *m_options;
  options.executor = takesAllThreads ? m_executor : nullptr;
  options.filter.first = m_filter.bitsOf(world);
  if (m_filter.hasIgnored()) {
    options.filter.accept = [this](std::uint32_t first, std::uint32_t second) {
      const PairPredicate& accept = m_options->filter.accept;
      return !m_filter.isIgnored({first, second}) && (!accept || accept(first, second));
    };
  }
  if (sink.countOnly) {
    sink.size += worker.search.count(Sets(boxes), options);
  } else {
    append(worker.search.find(Sets(boxes), options), sink);
  }
  add(worker.statistics, worker.search.statistics());
}

}  // namespace allpairs::engine
