// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/Overlaps.h"
#include "kernels/Kernels.h"
#include "kernels/Lanes.h"
#include "memory/Memory.h"
#include "search/PairSink.h"
#include "search/Workers.h"

namespace allpairs::engine {

/// Joins hierarchies, or tests rows of boxes against columns, on all threads of an executor. Each thread has a worker,
/// and each worker a sink for its pairs.
class JoinRunner {
 public:
  explicit JoinRunner(std::pmr::memory_resource* memory) : m_workers(memory), m_segments(memory) {}

  /// What to run, divided into tasks by units: leaf blocks of `first`, or rows.
  struct Job {
    const BvhView* first = nullptr;
    const BvhView* second = nullptr;
    bool withItself = false;  ///< Whether both are the same, of which each pair is wanted once.
    std::size_t units = 0;
    std::size_t firstLarge = 0;  ///< Leaf blocks from here on hold boxes larger than most.

    /// If set, by worker: where the partners of each box are listed, instead of giving hits to the sink.
    std::span<NeighborLists> lists = {};

    /// If set, rows of this search are run, and not a join.
    std::optional<FlatSearch> flat = {};

    static Job ofJoin(const BvhView& first, const BvhView& second);
    static Job ofSelfJoin(const BvhView& bvh);
  };

  /// Where the pairs of a task are, and where they go.
  struct Segment {
    std::size_t worker = 0;
    std::size_t begin = 0;
    std::size_t size = 0;
    std::size_t place = 0;
  };

  /// Resets, with one worker per thread of the executor; returns their number. The options must outlive the runs.
  std::size_t start(const SinkOptions& options, const Executor& executor);

  /// An estimate of how many boxes of the second hierarchy overlap a box of the first, and of how many are tested for
  /// that, from a few of its leaf blocks.
  [[nodiscard]] std::pair<double, double> partnersPerBox(const Job& job);

  /// Runs all tasks of a job. Sinks keep what they have.
  void run(const Job& job, Executor& executor);

  /// Runs tasks of many small joins: use(task, join), where join(job) runs a job into the sink of the task's worker and
  /// returns the number of box tests.
  template <class Use>
  void runTasks(std::size_t tasks, Executor& executor, const Use& use) {
    executor.run(tasks, [&](std::size_t task) {
      m_workers.withOne([&](std::size_t, Worker& worker) {
        use(task, [&](const Job& job) { return runWhole(job, worker); });
        worker.sink.finish();
      });
    });
  }

  /// Calls use(scratch), between runs, with memory of a worker, for so many numbers at least, that no other task has
  /// meanwhile.
  template <class Use>
  void withScratch(std::size_t size, const Use& use) {
    m_workers.withOne([&](std::size_t, Worker& worker) { use(worker.sink.idleMemory(size)); });
  }

  [[nodiscard]] std::size_t workers() const noexcept { return m_workers.size(); }
  [[nodiscard]] PairSink& sink(std::size_t worker) const noexcept { return m_workers[worker].sink; }
  [[nodiscard]] std::span<Segment> segments() noexcept { return m_segments; }

  /// The statistics of all workers since start().
  [[nodiscard]] OverlapStatistics totals() const noexcept;

 private:
  struct Worker {
    explicit Worker(std::pmr::memory_resource* memory) : sink(memory), scratch(memory) {}

    PairSink sink;
    JoinScratch scratch;
    NeighborLists* lists = nullptr;  ///< Those of the running job.
    std::atomic_flag busy;
  };

  std::uint64_t runWhole(const Job& job, Worker& worker) const;
  void runPart(const Job& job, std::size_t begin, std::size_t end, Worker& worker) const;
  void runInStretches(const Job& job, std::size_t begin, std::size_t end, Worker& worker) const;

  const Kernels* m_kernels = nullptr;
  const StopFlag* m_stop = nullptr;
  Workers<Worker> m_workers;
  std::pmr::vector<Segment> m_segments;
};

}  // namespace allpairs::engine
