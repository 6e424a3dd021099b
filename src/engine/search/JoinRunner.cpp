// SPDX-License-Identifier: MIT
#include "search/JoinRunner.h"

#include <memory>
#include <thread>

#include "search/TaskCut.h"

namespace allpairs::engine {

JoinRunner::Job JoinRunner::Job::ofJoin(const BvhView& first, const BvhView& second) {
  Job job;
  job.first = &first;
  job.second = &second;
  job.units = first.depth == 0 || second.depth == 0 ? 0 : first.level[0].blockCount();
  job.firstLarge = job.units;
  return job;
}

std::size_t JoinRunner::start(const SinkOptions& options, const Executor& executor) {
  m_kernels = options.kernels;
  while (m_workers.size() < executor.concurrency()) m_workers.push_back(makeOwned<Worker>(memory()));
  for (std::size_t i = 0; i < m_workers.size(); ++i) m_workers[i]->sink.start(options, i);
  return m_workers.size();
}

std::size_t JoinRunner::claimWorker() {
  for (;;) {
    for (std::size_t i = 0; i < m_workers.size(); ++i) {
      if (!m_workers[i]->busy.test_and_set(std::memory_order_acquire)) return i;
    }
    std::this_thread::yield();
  }
}

void JoinRunner::run(const Job& job, Executor& executor) {
  const std::size_t threads = executor.concurrency();
  const TaskCut cut = job.isFlat ? TaskCut::ofRows(job.units, job.flat.columns.size, threads)
                                 : TaskCut::ofLeaves(job.units, job.firstLarge, threads);
  m_segments.resize(cut.tasks());
  executor.run(cut.tasks(), [&](std::size_t task) {
    withWorker([&](std::size_t index, Worker& worker) {
      const std::size_t begin = worker.sink.size();
      runPart(job, cut.begin(task), cut.begin(task + 1), worker);
      worker.sink.finish();
      m_segments[task] = {index, begin, worker.sink.size()};
    });
  });
}

void JoinRunner::runPart(const Job& job, std::size_t begin, std::size_t end, Worker& worker) const {
  if (begin == end) return;
  if (job.isFlat) {
    FlatSearch part = job.flat;
    part.rowBegin = begin;
    part.rowEnd = end;
    m_kernels->searchFlat(part, worker.sink.hits());
  } else {
    m_kernels->join({job.first, job.second, job.first == job.second, begin, end, &worker.scratch}, worker.sink.hits());
  }
}

OverlapStatistics JoinRunner::totals() const noexcept {
  OverlapStatistics totals;
  for (const Owned<Worker>& worker : m_workers) {
    totals.pairs += worker->sink.count();
    totals.exactTests += worker->sink.exactTests();
    totals.boxTests += worker->sink.hits().boxTests;
    totals.groupTests += worker->sink.hits().groupTests;
  }
  return totals;
}

}  // namespace allpairs::engine
