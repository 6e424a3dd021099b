// SPDX-License-Identifier: MIT
#include "search/JoinRunner.h"

#include <algorithm>

#include "input/Parts.h"
#include "search/TaskCut.h"

namespace allpairs::engine {
namespace {

/// Rows, or leaf blocks, of a stretch at most: so many that the descent to them from the root is negligible.
constexpr std::size_t kMostUnits = 64;

}  // namespace

JoinRunner::Job JoinRunner::Job::ofJoin(const BvhView& first, const BvhView& second) {
  Job job;
  job.first = &first;
  job.second = &second;
  job.units = first.depth == 0 || second.depth == 0 ? 0 : first.level[0].blockCount();
  job.firstLarge = job.units;
  return job;
}

JoinRunner::Job JoinRunner::Job::ofSelfJoin(const BvhView& bvh) {
  Job job = ofJoin(bvh, bvh);
  job.withItself = true;
  return job;
}

std::size_t JoinRunner::start(const SinkOptions& options, const Executor& executor) {
  m_kernels = options.kernels;
  m_stop = options.stop;
  m_workers.require(executor.concurrency());
  for (std::size_t i = 0; i < m_workers.size(); ++i) m_workers[i].sink.start(options, i);
  return m_workers.size();
}

std::pair<double, double> JoinRunner::partnersPerBox(const Job& job) {
  // So few that they take about a hundredth of the time of the search.
  const std::size_t samples = std::clamp<std::size_t>(job.units / 256, 1, 16);
  Hits hits;
  hits.countOnly = true;
  double boxes = 0.0;
  for (std::size_t i = 0; i < samples; ++i) {
    const std::size_t leaf = job.units * (2 * i + 1) / (2 * samples);
    m_kernels->join({job.first, job.second, false, leaf, leaf + 1, &m_workers[0].scratch}, hits);
    boxes += static_cast<double>(job.first->level[0].fill(leaf));
  }
  return {static_cast<double>(hits.count) / boxes, static_cast<double>(hits.boxTests) / boxes};
}

void JoinRunner::run(const Job& job, Executor& executor) {
  const std::size_t threads = executor.concurrency();
  // Lists are made for all leaf blocks of a node at once.
  const std::size_t unit = job.flat || job.lists.empty() ? 1 : kFanOut;
  const TaskCut cut = job.flat ? TaskCut::ofRows(job.units, job.flat->columns.size, threads)
                               : TaskCut::ofLeaves((job.units + unit - 1) / unit, job.firstLarge / unit, threads);
  m_segments.resize(cut.tasks());
  const auto beginOf = [&](std::size_t task) {
    return task == cut.tasks() ? job.units : std::min(cut.begin(task) * unit, job.units);
  };
  executor.run(cut.tasks(), [&](std::size_t task) {
    m_workers.withOne([&](std::size_t index, Worker& worker) {
      const std::size_t begin = worker.sink.size();
      worker.lists = job.lists.empty() ? nullptr : &job.lists[index];
      runInStretches(job, beginOf(task), beginOf(task + 1), worker);
      worker.sink.finish();
      m_segments[task] = {index, begin, worker.sink.size() - begin};
    });
  });
}

std::uint64_t JoinRunner::runWhole(const Job& job, Worker& worker) const {
  const std::uint64_t before = worker.sink.hits().boxTests;
  runInStretches(job, 0, job.units, worker);
  return worker.sink.hits().boxTests - before;
}

void JoinRunner::runPart(const Job& job, std::size_t begin, std::size_t end, Worker& worker) const {
  if (begin == end) return;
  if (job.flat) {
    FlatSearch part = *job.flat;
    part.rowBegin = begin;
    part.rowEnd = end;
    part.lists = worker.lists;
    m_kernels->searchFlat(part, worker.sink.hits());
  } else {
    const bool withItself = job.withItself && worker.lists == nullptr;
    m_kernels->join({job.first, job.second, withItself, begin, end, &worker.scratch, worker.lists}, worker.sink.hits());
  }
}

/// Runs a part; if there is a flag, piece by piece, with a look at it before each. How many units make a piece depends
/// on the tests that the last one took: a unit may have any number of partners.
void JoinRunner::runInStretches(const Job& job, std::size_t begin, std::size_t end, Worker& worker) const {
  if (m_stop == nullptr) return runPart(job, begin, end, worker);
  const Hits& hits = worker.sink.hits();
  std::size_t units = kRowsAtOnce;
  while (begin < end) {
    checkStop(m_stop);
    // Lists are made for all leaf blocks of a node at once, unless they are so long that only some are between two
    // looks.
    const bool isWhole = worker.lists != nullptr && units >= kFanOut;
    const std::size_t next = std::min(end, isWhole ? (begin + units) / kFanOut * kFanOut : begin + units);
    const std::uint64_t before = hits.boxTests + hits.groupTests;
    runPart(job, begin, next, worker);
    const bool isLong = hits.boxTests + hits.groupTests - before > kWorkBetweenLooks;
    units = isLong ? std::max(units / 2, kRowsAtOnce) : std::min(2 * units, kMostUnits);
    begin = next;
  }
}

OverlapStatistics JoinRunner::totals() const noexcept {
  OverlapStatistics totals;
  for (std::size_t i = 0; i < m_workers.size(); ++i) add(totals, m_workers[i].sink.statistics());
  return totals;
}

}  // namespace allpairs::engine
