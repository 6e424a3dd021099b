// SPDX-License-Identifier: MIT
#include "search/Search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "input/Options.h"
#include "input/Sampling.h"
#include "search/FewBoxes.h"

namespace allpairs::engine {
namespace {

/// Up to this many boxes are tested exhaustively against a set of any size: ordering a box of it takes some 30 ns, a
/// test of it in a vector one (docs/decisions/0022).
constexpr std::size_t kFewRows = 32;

/// Above this many boxes, Automatic never chooses the exhaustive search, however many of a sample overlap: a
/// sample that misleads then costs seconds.
constexpr std::size_t kMostOverlapping = std::size_t{1} << 15;

/// From this share of all pairs on, so few tests can be skipped that the exhaustive search is faster; it finds pairs in
/// order, so that for ordered output the share is smaller (allpairs bench cubes.csv --strategy exhaustive, and bvh, of
/// cubes with sides of 0.2 to 0.6 at random places in a unit cube).
constexpr double kMuchUnordered = 0.4;
constexpr double kMuchOrdered = 0.1;

/// From so many partners a box on, ordered pairs come from a list for each box and not from buckets. In one set, where
/// each pair is then found from both sides, it takes more if finding them takes many tests, but never more than this
/// (docs/decisions/0025, dense_benchmark).
constexpr double kDense = 9.0;
constexpr double kDenseBothWays = 70.0;

/// Counting takes so much of the time of buckets (dense_benchmark).
constexpr double kCounted = 0.6;

/// Up to so many boxes, a join is done on one thread before a second one has woken up, or soon after
/// (allpairs bench uniform -n 2000 --threads 2).
constexpr std::size_t kFewForThreads = 2048;

/// Lists take memory and time for each box of a set, those included that the other set cannot reach: not for so many
/// boxes more than those within its reach.
constexpr std::size_t kMostRowsPerBox = 4;

/// What memory is reserved for where a sample tells of so many: some more, but no more than 16 million, since a sample
/// may err.
std::size_t likelyOf(double sampled) noexcept { return static_cast<std::size_t>(std::min(1.25 * sampled, 0x1p24)) + 1; }

/// The axes on which all boxes of two sets are the same point: those on which all lanes are, which is cheap to see, if
/// the boxes are, which takes a pass over them. Equal lanes do not prove it: rounding may have made them equal.
std::array<bool, 3> flatAxes(const Readers& readers, const BvhView& first, const BvhView& second) {
  std::array<bool, 3> isFlat{};
  if (first.depth == 0 || second.depth == 0) return isFlat;
  const LaneBlock& a = first.level[first.depth - 1].blocks[0];
  const LaneBlock& b = second.level[second.depth - 1].blocks[0];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float min = std::min(std::ranges::min(a.bound[axis]), std::ranges::min(b.bound[axis]));
    const float max = std::max(std::ranges::max(a.bound[axis + 3]), std::ranges::max(b.bound[axis + 3]));
    if (min != max) continue;
    const double point = readers.first.boxes()[readers.first.idOf(0)].min[axis];
    isFlat[axis] = readers.first.areAll(axis, point) && (readers.one || readers.second.areAll(axis, point));
  }
  return isFlat;
}

/// The share of the pairs of kSample boxes that overlap: a row and the column of the same number may be one box. Fewer
/// are there if others overlap nothing.
double shareOfOverlaps(const Kernels& kernels, LaneTile& rows, LaneTile& columns, std::size_t size) {
  FlatSearch search{{&rows, size}, {&columns, size}};
  search.rowEnd = size;
  search.tested = Columns::Following;
  Hits hits;
  hits.countOnly = true;
  kernels.searchFlat(search, hits);
  return static_cast<double>(hits.count) / (0.5 * kSample * (kSample - 1));
}

/// Estimates the share of all pairs that overlap from a sample.
double shareOfOverlaps(const BoxReader& reader) {
  LaneTile boxes;
  std::size_t size = 0;
  sampleBoxes(reader, kSample, [&](const LaneBox& box) { boxes.set(size++, box); });
  return shareOfOverlaps(reader.kernels(), boxes, boxes, size);
}

/// The same of the rows and columns of an exhaustive search, which may take no longer than some microseconds.
double shareOfOverlaps(const Kernels& kernels, const FlatSearch& flat) {
  LaneTile rows;
  LaneTile columns;
  if (flat.rows.size < kSample || flat.columns.size < kSample) return 0.0;
  for (std::size_t i = 0; i < kSample; ++i) {
    rows.set(i, flat.rows.get(sampleIndex(i, kSample, flat.rows.size)));
    columns.set(i, flat.columns.get(sampleIndex(i, kSample, flat.columns.size)));
  }
  return shareOfOverlaps(kernels, rows, columns, kSample);
}

}  // namespace

bool Search::choosesFlat(const Readers& readers, const OverlapOptions& options, std::size_t& likelyPairs) const {
  const std::size_t rows = readers.first.size();
  const std::size_t columns = readers.second.size();
  likelyPairs = likelyPairsOf(rows);
  if (options.strategy != Strategy::Automatic) return options.strategy == Strategy::Exhaustive;
  const std::size_t few = m_kernels->flatBoxes;
  if (rows * columns <= few * few || std::min(rows, columns) <= kFewRows) return true;
  if (!readers.one || rows > kMostOverlapping) return false;
  const double share = shareOfOverlaps(readers.first);
  if (share <= (options.order == Order::Unordered ? kMuchUnordered : kMuchOrdered)) return false;
  likelyPairs = std::max(likelyPairs, static_cast<std::size_t>(share * 0.5 * static_cast<double>(rows * rows)));
  return true;
}

void Search::shrink() noexcept {
  if (m_joined.data() != m_pairs.data()) m_joined.release();
  for (std::size_t i = 0; i < m_runner.workers(); ++i) {
    Buffer<Pair>& pairs = m_runner.sink(i).pairs();
    if (!m_pairs.empty() && pairs.data() == m_pairs.data()) m_joined = std::move(pairs);
  }
  m_bySecond.release();
  m_rows.release();
  m_columns.release();
  m_fewValues.release();
  m_cull = BoxCull(m_memory);
  m_first = BvhBuilder(m_memory);
  m_second = BvhBuilder(m_memory);
  m_runner = JoinRunner(m_memory);
  m_lists = PairLists(m_memory);
  if (m_rowsFound.offsets.empty()) m_offsets.release();
  if (m_rowsFound.indices.empty()) m_indices.release();
  m_range.release();
  m_sort = PairSort(m_memory);
}

void Search::forget() noexcept {
  m_statistics = {};
  m_pairs = {};
  m_rowsFound = {};
}

void Search::begin(const Sets& sets, const OverlapOptions& options) {
  checkOptions(sets, options);
  m_kernels = &chooseKernels(options.instructionSet);
  m_executor = &m_callExecutor.over(options.executor, options.stop);
  forget();
}

Search::Plan Search::planOf(const Sets& sets, const OverlapOptions& options, Order order) {
  begin(sets, options);
  const Sets& read = m_fewValues.of(sets, options, *m_executor);
  Plan plan{read, order, {PairTest::of(read, options), m_kernels}};
  plan.sink.maxPairs = options.maxPairs;
  plan.sink.stop = options.stop;
  Readers readers = Readers::of(read, options, *m_kernels);
  if (!sets.one && options.strategy != Strategy::Exhaustive) m_cull.apply(readers.first, readers.second, *m_executor);
  std::size_t likelyPairs = 0;
  const bool flat = choosesFlat(readers, options, likelyPairs);
  flat ? planFlat(readers, plan) : planJoin(readers, plan);
  plan.sink.likelyPairs = std::min(likelyPairs / m_executor->concurrency(), options.maxPairs);
  return plan;
}

void Search::planFlat(const Readers& readers, Plan& plan) {
  m_columns.require(LaneList::tilesFor(readers.columns(plan.order).size()));
  if (!readers.one) m_rows.require(LaneList::tilesFor(readers.rows(plan.order).size()));
  FlatSearch& flat = plan.job.flat.emplace();
  flat.columns.tiles = m_columns.data();
  flat.rows.tiles = m_rows.data();
  const bool exact = readers.readAll(plan.order, flat);
  plan.sink.test.requireExactTestInDoubt(!exact, readers.first);
  plan.sink.side = plan.order == Order::BySecond ? PairSide::RowSecond : PairSide::RowFirst;
  plan.job.units = flat.rowEnd;
}

void Search::planJoin(const Readers& readers, Plan& plan) {
  const std::size_t boxes = readers.first.size() + (readers.one ? 0 : readers.second.size());
  // A filter may take any time for a pair.
  if (boxes <= kFewForThreads && !plan.sink.test.isFiltered())
    m_executor = &m_callExecutor.over(nullptr, plan.sink.stop);
  m_first.build(readers.first, *m_executor);
  if (!readers.one) m_second.build(readers.second, *m_executor);
  plan.sink.side = readers.one ? PairSide::SmallerFirst : PairSide::RowFirst;
  joinBoth(readers.one, plan);
  BvhBuilder& second = readers.one ? m_first : m_second;
  const bool required = !m_first.exact() || !second.exact();
  plan.sink.test.requireExactTestInDoubt(
      required, readers.first,
      required ? flatAxes(readers, m_first.levels().view(), second.levels().view()) : std::array<bool, 3>{});
}

/// Both hierarchies as one job.
void Search::joinBoth(bool one, Plan& plan) {
  const BvhView& first = m_first.levels().view();
  plan.job = one ? JoinRunner::Job::ofSelfJoin(first) : JoinRunner::Job::ofJoin(first, m_second.levels().view());
  plan.job.firstLarge = m_first.firstLarge() / kFanOut;
}

void Search::run(const Plan& plan) {
  m_runner.start(plan.sink, *m_executor);
  m_runner.run(plan.job, *m_executor);
  m_statistics = m_runner.totals();
  // Each worker has checked only its own pairs.
  checkLimit(plan.sink.maxPairs, m_statistics.pairs);
}

/// Where the pairs of all tasks are concatenated.
std::span<Pair> Search::roomForPairs(const PairRoom* room) {
  if (room != nullptr) return (*room)(m_statistics.pairs);
  m_joined.require(m_statistics.pairs);
  return {m_joined.data(), m_statistics.pairs};
}

/// Concatenates the pairs of the tasks.
void Search::concatenate(const PairRoom* room) {
  const std::span<JoinRunner::Segment> segments = m_runner.segments();
  if (segments.size() == 1) {
    m_pairs = {m_runner.sink(segments[0].worker).pairs().data(), m_statistics.pairs};
    return;
  }
  m_pairs = roomForPairs(room);
  std::size_t place = 0;
  for (JoinRunner::Segment& segment : segments) {
    segment.place = place;
    place += segment.size;
  }
  m_executor->run(segments.size(), [&](std::size_t i) {
    const JoinRunner::Segment& segment = segments[i];
    const Pair* const from = m_runner.sink(segment.worker).pairs().data() + segment.begin;
    std::copy_n(from, segment.size, m_pairs.data() + segment.place);
  });
}

std::span<const Pair> Search::find(const Sets& sets, const OverlapOptions& options) {
  if (areFew(sets, options)) return findAmongFew(sets, options, options.order);
  Plan plan = planOf(sets, options, options.order);
  return findPlanned(plan, nullptr);
}

std::span<const Pair> Search::findPlanned(Plan& plan, const PairRoom* room) {
  if (!plan.job.flat && (findInLists(plan, room) || findInBuckets(plan, room))) return m_pairs;
  expectPairs(plan);
  expectAmply(plan);
  run(plan);
  concatenate(room);
  if (!plan.job.flat) sortPairs(plan);
  return m_pairs;
}

std::span<const Pair> Search::findAmongFew(const Sets& sets, const OverlapOptions& options, Order order) {
  forget();
  std::size_t size = 0;
  const auto append = [&](std::span<const Pair> pairs) {
    m_joined.grow(size + pairs.size());
    std::copy(pairs.begin(), pairs.end(), m_joined.data() + size);
    size += pairs.size();
  };
  m_statistics = findFew(sets, options, order, append);
  m_pairs = {m_joined.data(), size};
  return m_pairs;
}

std::vector<Pair> Search::take(const Sets& sets, const OverlapOptions& options) {
  Plan plan = planOf(sets, options, options.order);
  std::vector<Pair> taken;
  if (comeInOrder(plan)) {
    expectPairs(plan);
    reserve(taken, plan.sink.likelyPairs);
    runInto(plan, [&](std::span<const Pair> pairs) { append(taken, pairs); });
    if (taken.size() < taken.capacity() / 2) taken.shrink_to_fit();
    return taken;
  }
  const auto resized = [&](std::uint64_t pairs) -> std::span<Pair> {
    reserve(taken, pairs);
    taken.resize(pairs);
    return taken;
  };
  const PairRoom room(resized);
  const std::span<const Pair> pairs = findPlanned(plan, &room);
  if (pairs.data() != taken.data()) taken.assign(pairs.begin(), pairs.end());
  return taken;
}

bool Search::comeInOrder(const Plan& plan) const {
  return (plan.job.flat || plan.order == Order::Unordered) && m_executor->concurrency() == 1;
}

void Search::runInto(Plan& plan, FunctionRef<void(std::span<const Pair>)> take) {
  const auto emit = [&](std::span<Pair> pairs, std::size_t) {
    take(pairs);
    return pairs.size();
  };
  plan.sink.emit.emplace(emit);
  plan.sink.likelyPairs = 0;
  run(plan);
}

bool Search::findInBuckets(Plan& plan, const PairRoom* room) {
  if (plan.order == Order::Unordered || !fillBuckets(plan, &PairBuckets::add)) return false;
  m_pairs = roomForPairs(room);
  m_sort.sort(m_pairs, *m_executor, m_runner);
  return true;
}

PairOrder Search::orderOf(const Plan& plan) const {
  return {plan.sets.first.size(), plan.sets.second.size(), plan.order, m_executor->concurrency()};
}

bool Search::fillBuckets(Plan& plan, void (PairBuckets::*add)(std::span<const Pair>)) {
  const PairOrder order = orderOf(plan);
  if (plan.job.units == 0 || !order.packs()) return false;
  m_sort.start(order, m_runner.start(plan.sink, *m_executor), *m_kernels);
  const auto toBuckets = [&](std::span<Pair> pairs, std::size_t worker) {
    (m_sort.ofWorker(worker).*add)(pairs);
    return pairs.size();
  };
  plan.sink.emit.emplace(toBuckets);
  plan.sink.likelyPairs = 0;
  run(plan);
  m_sort.finish();
  return true;
}

bool Search::findInLists(Plan& plan, const PairRoom* room) {
  const bool bySecond = plan.order == Order::BySecond;
  const Columns kept = !plan.sets.one ? Columns::All : bySecond ? Columns::Preceding : Columns::Following;
  if (plan.order == Order::Unordered || !listPartners(plan, kept)) return false;
  m_pairs = roomForPairs(room);
  m_lists.expand(m_pairs, bySecond, *m_executor);
  return true;
}

std::size_t Search::likelyPartners(const JoinRunner::Job& job, std::size_t rows, Columns kept, bool areCounted) {
  const bool keepsAll = kept == Columns::All || kept == Columns::Others;
  double partners = 0.0;  // of a row
  if (job.flat) {
    const double share = shareOfOverlaps(*m_kernels, *job.flat);
    if (share <= kMuchOrdered) return 0;
    partners = share * static_cast<double>(job.flat->columns.size);
  } else {
    if (job.units == 0 || std::max(job.first->depth, job.second->depth) < 2) return 0;
    if (job.units * kFanOut < rows / kMostRowsPerBox) return 0;
    const auto [found, tests] = m_runner.partnersPerBox(job);
    const double testsForPair = (areCounted ? kCounted : 1.0) * m_kernels->testsForPair;
    if (found < (keepsAll ? kDense : std::min(kDense + tests / testsForPair, kDenseBothWays))) return 0;
    partners = found;
    rows = std::min(rows, job.units * kFanOut);
  }
  return likelyOf((keepsAll ? 1.0 : 0.5) * partners * static_cast<double>(rows));
}

void Search::expectPairs(Plan& plan) {
  if (plan.job.flat || plan.job.units < kFanOut) return;
  const std::size_t workers = m_runner.start(plan.sink, *m_executor);
  if (m_runner.sink(0).pairs().capacity() >= plan.sink.likelyPairs) return;
  const double partners = m_runner.partnersPerBox(plan.job).first * static_cast<double>(plan.job.units * kFanOut);
  const std::size_t likely = likelyOf(plan.sets.one ? 0.5 * partners : partners) / workers;
  plan.sink.likelyPairs = std::min<std::uint64_t>(std::max(plan.sink.likelyPairs, likely), plan.sink.maxPairs);
}

void Search::expectAmply(Plan& plan) {
  const Sets& sets = plan.sets;
  const std::size_t boxes = sets.first.size() + (sets.one ? 0 : sets.second.size());
  if (!isAmple(m_memory, boxes)) return;
  const std::size_t ample = 5 * kLikelyPairs * boxes / m_executor->concurrency();
  plan.sink.likelyPairs = std::min<std::uint64_t>(std::max(plan.sink.likelyPairs, ample), plan.sink.maxPairs);
}

bool Search::listPartners(Plan& plan, Columns kept) {
  const Sets& sets = plan.sets;
  const std::size_t workers = m_runner.start(plan.sink, *m_executor);
  const bool bySecond = plan.order == Order::BySecond;
  const std::size_t rows = (bySecond ? sets.second : sets.first).size();
  JoinRunner::Job job = plan.job;
  if (bySecond && !sets.one && !job.flat) {
    job = JoinRunner::Job::ofJoin(*plan.job.second, *plan.job.first);
    job.firstLarge = m_second.firstLarge() / kFanOut;
  }
  const std::size_t likely = likelyPartners(job, rows, kept, orderOf(plan).isCounted);
  if (likely == 0) return false;
  if (job.flat) job.flat->tested = kept;
  m_lists.start(rows, (bySecond ? sets.first : sets.second).size(), workers, likely);
  m_lists.select(kept, bySecond ? PairSide::RowSecond : PairSide::RowFirst, plan.sink);
  job.lists = m_lists.ofWorkers();
  m_runner.run(job, *m_executor);
  m_statistics = m_runner.totals();
  m_statistics.pairs = m_lists.pairs();
  for (const NeighborLists& lists : m_lists.ofWorkers()) m_statistics.exactTests += lists.exactTests;
  checkLimit(plan.sink.maxPairs, m_statistics.pairs);
  return true;
}

void Search::sortPairs(const Plan& plan) {
  if (plan.order == Order::Unordered) return;
  // The hierarchy is no longer needed: its memory is the sort's second buffer.
  m_sort.sortList(m_pairs, orderOf(plan), m_first.levels().memory<Pair>(), *m_executor);
}

std::uint64_t Search::count(const Sets& sets, const OverlapOptions& options) {
  if (!areFew(sets, options)) return countMany(sets, options);
  forget();
  m_statistics = countFew(sets, options);
  return m_statistics.pairs;
}

std::uint64_t Search::countMany(const Sets& sets, const OverlapOptions& options) {
  Plan plan = planOf(sets, options, options.order);
  plan.sink.countOnly = true;
  plan.sink.likelyPairs = 0;
  run(plan);
  return m_statistics.pairs;
}

}  // namespace allpairs::engine
