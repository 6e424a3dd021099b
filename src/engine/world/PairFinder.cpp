// SPDX-License-Identifier: MIT
#include "world/PairFinder.h"

#include <algorithm>
#include <thread>

namespace allpairs::engine {
namespace {

/// Two arrays of so many ids, and the pairs made of them, stay in the caches near the processor.
constexpr std::size_t kHitCapacity = 4096;

/// Tasks are cut to at least so many leaf blocks, so that starting one costs nothing to speak of.
constexpr std::size_t kMinLeafBlocks = 64;
constexpr std::size_t kMaxTasks = 512;

/// What a full buffer of hits is handed to.
struct Receiver {
  const Kernels& kernels;
  PairSide side;
  Buffer<Pair>& pairs;
  PairFinder::Taker taker;
  std::size_t finder;

  void receive(Hits& hits) const {
    if (hits.size == 0) return;
    kernels.writePairs(hits, side, pairs.data());
    const std::size_t size = hits.size;
    hits.size = 0;
    taker({pairs.data(), size}, finder);
  }
};

}  // namespace

std::size_t PairFinder::prepare(Executor& executor) {
  while (m_finders.size() < executor.concurrency()) m_finders.push_back(std::make_unique<Finder>());
  for (const std::unique_ptr<Finder>& finder : m_finders) start(*finder);
  return m_finders.size();
}

void PairFinder::start(Finder& finder) {
  constexpr std::size_t kStride = kHitCapacity + Hits::kSlack;
  finder.memory.require(2 * kStride);
  finder.pairs.require(kStride);
  finder.hits = {};
  finder.hits.row = finder.memory.data();
  finder.hits.partner = finder.memory.data() + kStride;
  finder.hits.capacity = kHitCapacity;
}

std::size_t PairFinder::claim() {
  for (;;) {
    for (std::size_t i = 0; i < m_finders.size(); ++i) {
      if (!m_finders[i]->busy.test_and_set(std::memory_order_acquire)) return i;
    }
    std::this_thread::yield();
  }
}

PairFinder::Counts PairFinder::run(const Job& job, const Kernels& kernels, Executor& executor, Taker taker) {
  if (job.first.depth == 0 || job.second.depth == 0) return {};
  const std::size_t leaves = job.first.level[0].blockCount();
  const std::size_t tasks =
      executor.concurrency() == 1 ? 1 : std::clamp<std::size_t>(leaves / kMinLeafBlocks, 1, kMaxTasks);
  executor.run(tasks, [&](std::size_t index) {
    const std::size_t number = claim();
    Finder& finder = *m_finders[number];
    const struct Release {
      Finder& held;
      ~Release() {
        held.hits.size = 0;
        held.busy.clear(std::memory_order_release);
      }
    } release{finder};
    Receiver receiver{kernels, job.side, finder.pairs, taker, number};
    finder.hits.receiver = &receiver;
    finder.hits.flush = [](void* self, Hits& hits) { static_cast<Receiver*>(self)->receive(hits); };
    JoinTask task;
    task.first = &job.first;
    task.second = &job.second;
    task.withItself = job.withItself;
    task.leafBegin = leaves * index / tasks;
    task.leafEnd = leaves * (index + 1) / tasks;
    task.scratch = &finder.scratch;
    kernels.join(task, finder.hits);
    receiver.receive(finder.hits);
  });
  Counts counts;
  for (const std::unique_ptr<Finder>& finder : m_finders) {
    counts.boxTests += std::exchange(finder->hits.boxTests, 0);
    counts.groupTests += std::exchange(finder->hits.groupTests, 0);
  }
  return counts;
}

}  // namespace allpairs::engine
