// SPDX-License-Identifier: MIT
#include "Search.h"

#include <algorithm>
#include <array>
#include <thread>

#include "BlockReader.h"
#include "CheckOptions.h"
#include "Sampling.h"
#include "TaskCut.h"

namespace allpairs::engine {
namespace {

/// Up to this many pairs of boxes, testing them all is faster than ordering the boxes first (docs/decisions/0003).
constexpr double kFlatPairs = 256.0 * 256.0;

/// So few boxes against any number are tested one by one: ordering the others would cost more.
constexpr std::size_t kFewRows = 32;

/// Pairs of a box in a scene as most are, and the most that room is made for before any has been found.
constexpr std::size_t kLikelyPairs = 4;
constexpr std::size_t kMostLikelyPairs = std::size_t{1} << 20;

/// Beyond this many boxes a sample is not trusted to say that all pairs had better be tested.
constexpr std::size_t kMostOverlapping = std::size_t{1} << 15;

/// From this share of all pairs on there is so little to leave out that the exhaustive search is faster; it finds its
/// pairs in order, and so needs less to be.
constexpr double kMuchUnordered = 0.4;
constexpr double kMuchOrdered = 0.1;

/// About what share of all pairs overlaps, by a few of them.
double shareOfOverlaps(const LaneReader& reader) {
  constexpr std::size_t kSample = 24;
  std::array<LaneBox, kSample> boxes;
  std::size_t size = 0;
  sampleBoxes(reader, kSample, [&](const LaneBox& box) { boxes[size++] = box; });
  std::size_t hits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = i + 1; j < size; ++j) hits += touch(boxes[i], boxes[j]) ? 1U : 0U;
  }
  return static_cast<double>(hits) / (0.5 * static_cast<double>(kSample * (kSample - 1)));
}

/// Reads whole blocks of a tile's boxes by a kernel; returns where it stopped.
std::size_t readBlocks(const BlockReader& reader, std::size_t begin, std::size_t end, LaneTile& tile, bool& exact) {
  LaneBlock block;
  std::size_t i = begin;
  for (; i + kFanOut <= end; i += kFanOut) {
    const RowBlockResult read = reader.readRun(i, block);
    exact &= read.exact;
    for (std::size_t row = 0; row < 6; ++row)
      std::copy_n(block.bound[row].data(), kFanOut, &tile.bound[row][i - begin]);
    for (std::size_t lane = 0; lane < kFanOut; ++lane) {
      tile.id[i - begin + lane] = static_cast<std::uint32_t>(i + lane);
      if ((read.emptyLanes >> lane & 1U) != 0) tile.set(i - begin + lane, kNeverLanes, 0);
    }
  }
  return i;
}

/// Reads all boxes of a set, in their own order, as lanes; those that can overlap nothing as lanes that never do.
bool readList(const LaneReader& reader, const Kernels& kernels, Buffer<LaneTile>& buffer, LaneList& list) {
  buffer.require(LaneList::tilesFor(reader.size()));
  list = {buffer.data(), reader.size()};
  const float* rows = reader.plainFloat32();
  const BlockReader blocks(reader, kernels);
  bool exact = true;
  for (std::size_t begin = 0; begin < reader.size(); begin += LaneTile::kCapacity) {
    LaneTile& tile = list.tileOf(begin);
    const std::size_t end = std::min(reader.size(), begin + LaneTile::kCapacity);
    if (rows != nullptr) {
      exact &= kernels.readTile32(rows + 6 * begin, end - begin, static_cast<std::uint32_t>(begin), tile);
      continue;
    }
    const std::size_t rest = blocks.isUsable() ? readBlocks(blocks, begin, end, tile, exact) : begin;
    exact &= reader.read(
        rest, end, [&](std::size_t i, const LaneBox& box) { tile.set(i - begin, box, static_cast<std::uint32_t>(i)); },
        [&](std::size_t i) { tile.set(i - begin, kNeverLanes, static_cast<std::uint32_t>(i)); });
  }
  return exact;
}

/// For fewer boxes of both sides there are too few pairs in a bucket; a sort of all of them is faster.
constexpr std::size_t kFewForBuckets = std::size_t{1} << 14;

/// Buckets of so many boxes that most of them have some thousand pairs.
BucketRule bucketRule(const Sets& sets, Order order, const Kernels& kernels) {
  constexpr std::size_t kKeysPerBucket = 256;
  const bool bySecond = order == Order::BySecond;
  const std::size_t keys = (bySecond ? sets.second : sets.first).size();
  const std::size_t others = (bySecond ? sets.first : sets.second).size();
  const std::size_t wanted = std::clamp<std::size_t>(keys / kKeysPerBucket, 1, BucketRule::kMostBuckets);
  return {keys, others, wanted, order, kernels};
}

}  // namespace

Search::Choice Search::choose(const Sets& sets, const OverlapOptions& options) {
  const std::size_t likely = std::min(kLikelyPairs * sets.first.size(), kMostLikelyPairs);
  if (options.strategy != Strategy::Automatic) return {options.strategy == Strategy::Exhaustive, likely};
  if (static_cast<double>(sets.first.size()) * static_cast<double>(sets.second.size()) <= kFlatPairs) {
    return {true, likely};
  }
  if (std::min(sets.first.size(), sets.second.size()) <= kFewRows) return {true, likely};
  if (!sets.one || sets.first.size() > kMostOverlapping) return {false, likely};
  const double share = shareOfOverlaps(LaneReader(sets.first, options));
  if (share <= (options.order == Order::Unordered ? kMuchUnordered : kMuchOrdered)) return {false, likely};
  const auto size = static_cast<double>(sets.first.size());
  return {true, std::max(likely, static_cast<std::size_t>(share * 0.5 * size * size))};
}

void Search::begin(const Sets& sets, const OverlapOptions& options) {
  checkOptions(sets, options);
  m_kernels = &chooseKernels(options);
  m_executor = options.executor != nullptr ? options.executor : &m_serial;
  m_statistics = {};
  m_pairs = {};
}

Search::Plan Search::plan(const Sets& sets, const OverlapOptions& options, PairTest& test) {
  Plan plan;
  plan.withItself = sets.one;
  plan.rules.kernels = m_kernels;
  plan.rules.test = &test;
  plan.rules.maxPairs = options.maxPairs;
  const Choice choice = choose(sets, options);
  plan.blocked = !choice.flat;
  plan.rules.likelyPairs = std::min(choice.likelyPairs / m_executor->concurrency(), options.maxPairs);
  if (plan.blocked) {
    planBlocked(sets, options, test, plan);
  } else {
    planFlat(sets, options, test, plan);
  }
  return plan;
}

void Search::planFlat(const Sets& sets, const OverlapOptions& options, PairTest& test, Plan& plan) {
  const bool bySecond = options.order == Order::BySecond;
  const BoxSet& rowSet = bySecond ? sets.second : sets.first;
  const BoxSet& columnSet = bySecond ? sets.first : sets.second;
  bool exact = readList(LaneReader(columnSet, options), *m_kernels, m_columns, plan.flat.columns);
  if (sets.one) {
    plan.flat.rows = plan.flat.columns;
    plan.flat.tested = bySecond ? Columns::Preceding : Columns::Following;
  } else {
    exact &= readList(LaneReader(rowSet, options), *m_kernels, m_rows, plan.flat.rows);
  }
  test.requireExactTest(!exact);
  plan.rules.side = bySecond ? PairSide::RowSecond : PairSide::RowFirst;
  plan.units = rowSet.size();
}

void Search::planBlocked(const Sets& sets, const OverlapOptions& options, PairTest& test, Plan& plan) {
  m_firstHierarchy.build(LaneReader(sets.first, options), *m_kernels, *m_executor);
  bool exact = m_firstHierarchy.exact();
  if (!sets.one) {
    m_secondHierarchy.build(LaneReader(sets.second, options), *m_kernels, *m_executor);
    exact &= m_secondHierarchy.exact();
    m_firstHierarchy.deepen(m_secondHierarchy.hierarchy().depth);
    m_secondHierarchy.deepen(m_firstHierarchy.hierarchy().depth);
  }
  test.requireExactTest(!exact);
  plan.rules.side = sets.one ? PairSide::SmallerFirst : PairSide::RowFirst;
  const bool nothing =
      m_firstHierarchy.hierarchy().depth == 0 || (!sets.one && m_secondHierarchy.hierarchy().depth == 0);
  plan.units = nothing ? 0 : m_firstHierarchy.hierarchy().level[0].blockCount();
  plan.firstLarge = m_firstHierarchy.firstLarge() / kFanOut;
}

void Search::runPart(const Plan& plan, std::size_t begin, std::size_t end, Worker& worker) {
  if (begin == end) return;
  if (!plan.blocked) {
    FlatSearch part = plan.flat;
    part.rowBegin = begin;
    part.rowEnd = end;
    m_kernels->searchFlat(part, worker.receiver.hits());
    return;
  }
  JoinTask task;
  task.first = &m_firstHierarchy.hierarchy();
  task.second = plan.withItself ? task.first : &m_secondHierarchy.hierarchy();
  task.withItself = plan.withItself;
  task.leafBegin = begin;
  task.leafEnd = end;
  task.scratch = &worker.scratch;
  m_kernels->join(task, worker.receiver.hits());
}

void Search::startWorkers(std::size_t count, const Plan& plan) {
  while (m_workers.size() < count) m_workers.push_back(std::make_unique<Worker>());
  for (const std::unique_ptr<Worker>& worker : m_workers) {
    worker->receiver.start(plan.rules);
    if (plan.buckets == nullptr) continue;
    worker->buckets.start(*plan.buckets);
    const auto toBuckets = [](void* context, PairReceiver& receiver) {
      static_cast<PairBuckets*>(context)->add({receiver.pairs().data(), receiver.size()});
      receiver.drop(receiver.size());
    };
    worker->receiver.whenAdded(toBuckets, &worker->buckets);
  }
}

std::size_t Search::claimWorker() {
  for (;;) {
    for (std::size_t i = 0; i < m_workers.size(); ++i) {
      if (!m_workers[i]->busy.test_and_set(std::memory_order_acquire)) return i;
    }
    std::this_thread::yield();
  }
}

void Search::runAll(const Plan& plan) {
  const std::size_t threads = m_executor->concurrency();
  startWorkers(threads, plan);
  const TaskCut cut = plan.blocked ? TaskCut::ofLeaves(plan.units, plan.firstLarge, threads)
                                   : TaskCut::ofRows(plan.units, plan.flat.columns.size, threads);
  const std::size_t tasks = cut.tasks();
  m_segments.resize(tasks);
  m_executor->run(tasks, [&](std::size_t task) {
    const std::size_t index = claimWorker();
    Worker& worker = *m_workers[index];
    const struct Release {
      Worker& held;
      ~Release() { held.busy.clear(std::memory_order_release); }
    } release{worker};
    Segment& segment = m_segments[task];
    segment.worker = index;
    segment.begin = worker.receiver.size();
    runPart(plan, cut.begin(task), cut.begin(task + 1), worker);
    worker.receiver.finish();
    segment.end = worker.receiver.size();
  });
  collect();
  // Each worker has looked at its own pairs; here are all of them.
  checkLimit(plan.rules, m_statistics.pairs);
}

void Search::collect() {
  for (const std::unique_ptr<Worker>& worker : m_workers) {
    m_statistics.pairs += worker->receiver.count();
    m_statistics.exactTests += worker->receiver.exactTests();
    m_statistics.boxTests += worker->receiver.hits().boxTests;
    m_statistics.groupTests += worker->receiver.hits().groupTests;
  }
}

void Search::join(const Plan& plan) {
  if (plan.rules.countOnly) return;
  if (m_segments.size() == 1) {
    m_pairs = {m_workers[m_segments[0].worker]->receiver.pairs().data(), m_statistics.pairs};
    return;
  }
  m_joined.require(m_statistics.pairs);
  m_pairs = {m_joined.data(), m_statistics.pairs};
  m_places.resize(m_segments.size());
  std::size_t place = 0;
  for (std::size_t i = 0; i < m_segments.size(); ++i) {
    m_places[i] = place;
    place += m_segments[i].end - m_segments[i].begin;
  }
  m_executor->run(m_segments.size(), [&](std::size_t i) {
    const Segment& segment = m_segments[i];
    std::copy_n(m_workers[segment.worker]->receiver.pairs().data() + segment.begin, segment.end - segment.begin,
                m_pairs.data() + m_places[i]);
  });
}

std::span<const Pair> Search::find(const Sets& sets, const OverlapOptions& options) {
  begin(sets, options);
  PairTest test(sets.first, sets.second, options, sets.one);
  Plan search = plan(sets, options, test);
  if (search.blocked && findInBuckets(sets, options, search)) return m_pairs;
  runAll(search);
  join(search);
  if (search.blocked) sortPairs(sets, options.order);
  return m_pairs;
}

bool Search::findInBuckets(const Sets& sets, const OverlapOptions& options, Plan plan) {
  if (options.order == Order::Unordered || plan.units == 0) return false;
  if (sets.first.size() + sets.second.size() < kFewForBuckets) return false;
  const BucketRule rule = bucketRule(sets, options.order, *m_kernels);
  if (!rule.packs()) return false;
  plan.buckets = &rule;
  plan.rules.likelyPairs = 0;
  runAll(plan);
  sortBuckets(rule);
  return true;
}

void Search::sortBuckets(const BucketRule& rule) {
  m_joined.require(m_statistics.pairs);
  m_pairs = {m_joined.data(), m_statistics.pairs};
  m_places.resize(rule.buckets + 1);
  m_places[0] = 0;
  for (std::size_t b = 0; b < rule.buckets; ++b) {
    m_places[b + 1] = m_places[b];
    for (const std::unique_ptr<Worker>& worker : m_workers) m_places[b + 1] += worker->buckets.size(b);
  }
  m_executor->run(rule.buckets, [&](std::size_t b) {
    BucketSort sort(rule, m_pairs.subspan(m_places[b], m_places[b + 1] - m_places[b]));
    for (const std::unique_ptr<Worker>& worker : m_workers) {
      worker->buckets.forEachPart(b, [&](std::span<const Pair> part) { sort.add(part); });
    }
    sort.finish();
  });
}

void Search::sortPairs(const Sets& sets, Order order) {
  // The hierarchy has done its work: its memory is where the sort moves pairs to and fro.
  m_sort.sort(m_pairs, {sets.first.size(), sets.second.size(), order, m_kernels, m_firstHierarchy.takeMemory()},
              *m_executor);
}

std::uint64_t Search::count(const Sets& sets, const OverlapOptions& options) {
  begin(sets, options);
  PairTest test(sets.first, sets.second, options, sets.one);
  Plan search = plan(sets, options, test);
  search.rules.countOnly = true;
  search.rules.likelyPairs = 0;
  runAll(search);
  return m_statistics.pairs;
}

}  // namespace allpairs::engine
