// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

#include "allpairs/Executor.h"
#include "allpairs/Overlaps.h"
#include "allpairs/Worlds.h"
#include "kernels/Kernels.h"
#include "memory/Memory.h"
#include "search/CallExecutor.h"
#include "search/Search.h"
#include "search/Workers.h"
#include "worlds/WorldsFilter.h"

namespace allpairs::engine {

/// Searches many worlds, and keeps its memory for the next time.
class WorldsSearcher {
 public:
  explicit WorldsSearcher(std::pmr::memory_resource* memory)
      : m_filter(memory), m_workers(memory), m_parts(memory), m_begin(memory), m_joined(memory) {}

  WorldPairsView find(const Worlds& worlds, const OverlapOptions& options);
  std::span<const std::uint64_t> count(const Worlds& worlds, const OverlapOptions& options);
  /// Writes the pairs of each world to where the offsets say, if there is room; returns the offsets of what it found.
  std::span<const std::uint64_t> list(const Worlds& worlds, const OverlapOptions& options,
                                      std::span<const std::uint64_t> begin, std::span<Pair> pairs);

  [[nodiscard]] const OverlapStatistics& statistics() const noexcept { return m_statistics; }

 private:
  /// What a thread needs.
  struct Worker {
    explicit Worker(std::pmr::memory_resource* memory) : search(memory), pairs(memory), scratch(memory), wide(memory) {}

    Search search;       ///< Of worlds that are too large for the kernels.
    Buffer<Pair> pairs;  ///< Results.
    std::uint64_t size = 0;
    Buffer<Pair> scratch;  ///< Of a world whose pairs cannot be written to their place at once.
    Buffer<WideWorld> wide;
    OverlapStatistics statistics;
    bool hadMany = false;  ///< As the kernel has it.
    std::atomic_flag busy;
  };

  /// Worlds that follow each other, searched by one thread, or one world searched by all.
  struct Part {
    std::size_t begin = 0;
    std::size_t end = 0;
    bool takesAllThreads = false;
    std::size_t worker = 0;
    std::uint64_t firstPair = 0;  ///< In the memory of the worker.
    std::uint64_t pairs = 0;
    std::uint64_t place = 0;  ///< In the result.
  };

  void begin(const Worlds& worlds, const OverlapOptions& options);
  void cutParts();
  template <class SinkOf>
  void searchParts(const SinkOf& sinkOf);
  void placeParts();

  void searchPart(const Part& part, Worker& worker, WorldSink& sink);
  template <class T>
  std::size_t runKernel(std::size_t world, std::size_t end, Worker& worker, WorldSink& sink);
  std::size_t runPlain(std::size_t world, std::size_t end, Worker& worker, WorldSink& sink);
  void searchSmall(std::size_t world, Worker& worker, WorldSink& sink);
  void searchLarge(std::size_t world, bool takesAllThreads, Worker& worker, WorldSink& sink);
  void runWide(std::size_t world, Worker& worker, WorldSink& sink) const;
  [[nodiscard]] std::size_t sizeOf(std::size_t world) const noexcept {
    return m_worlds->begin(world + 1) - m_worlds->begin(world);
  }

  const Worlds* m_worlds = nullptr;
  const OverlapOptions* m_options = nullptr;
  const Kernels* m_kernels = nullptr;
  Executor* m_executor = nullptr;
  CallExecutor m_callExecutor;
  std::size_t m_mostBoxes = 0;  ///< Of a world that the kernels search.
  bool m_isPlain = false;       ///< Boxes that the kernel reads from the caller's memory.
  WorldsFilter m_filter;
  Workers<Worker> m_workers;
  std::pmr::vector<Part> m_parts;
  std::pmr::vector<std::uint64_t> m_begin;
  Buffer<Pair> m_joined;
  OverlapStatistics m_statistics;
};

}  // namespace allpairs::engine
