// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <memory_resource>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "allpairs.h"
#include "allpairs/BoxView.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/StopFlag.h"
#include "allpairs/World.h"
#include "allpairs/Worlds.h"

namespace allpairs::c {

/// Memory that the caller's functions give.
class CallerMemory final : public std::pmr::memory_resource {
 public:
  explicit CallerMemory(const allpairs_memory& memory) : m_memory(memory) {}

  [[nodiscard]] bool is(const allpairs_memory& memory) const noexcept {
    return m_memory.allocate == memory.allocate && m_memory.deallocate == memory.deallocate &&
           m_memory.context == memory.context;
  }

 private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override {
    void* memory = m_memory.allocate(m_memory.context, bytes, alignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
  }
  void do_deallocate(void* memory, std::size_t bytes, std::size_t alignment) override {
    m_memory.deallocate(m_memory.context, memory, bytes, alignment);
  }
  [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

  allpairs_memory m_memory;
};

/// What the caller's function says of stopping.
class CallerStop {
 public:
  CallerStop(allpairs_stop ask, void* context) : m_ask(ask), m_context(context) {}

  bool operator()() const { return m_ask(m_context); }

  [[nodiscard]] const StopFlag* flag() const noexcept { return &m_flag; }

 private:
  allpairs_stop m_ask;
  void* m_context;
  StopFlag m_flag{*this};
};

/// The caller's function, of options that have one, or null.
template <class Options>
[[nodiscard]] std::unique_ptr<CallerStop> stopOf(const Options& options) {
  return options.stop == nullptr ? nullptr : std::make_unique<CallerStop>(options.stop, options.stop_context);
}

[[nodiscard]] inline const StopFlag* flagOf(const std::unique_ptr<CallerStop>& stop) noexcept {
  return stop == nullptr ? nullptr : stop->flag();
}

/// The library's own name of an instruction set, which is there for ever; empty for null.
///
/// Bad input: a name that is none throws InvalidArgument.
[[nodiscard]] std::string_view instructionSetOf(const char* name);

/// The caller's memory, or null for the default.
///
/// Bad input: one function without the other throws InvalidArgument.
[[nodiscard]] std::unique_ptr<CallerMemory> memoryOf(const allpairs_memory& memory);

}  // namespace allpairs::c

// What C's handles point to; memory, executor and stop first, which what follows uses to its end. NOLINTBEGIN(readability-identifier-naming): names are C's.

struct allpairs_set {
  allpairs::BoxView boxes;
};

struct allpairs_search {
  std::unique_ptr<allpairs::c::CallerMemory> memory;
  std::unique_ptr<allpairs::Executor> executor;
  std::unique_ptr<allpairs::c::CallerStop> stop;
  allpairs::OverlapSearch overlaps;
  allpairs_filter first{};
  allpairs_filter second{};
  std::optional<allpairs::WorldsSearch> worlds{};  ///< From the first search of worlds on.
  allpairs::OverlapStatistics statistics{};        ///< Of the last search, of either kind; all 0 if it failed.
  std::atomic<bool> isCalled = false;
};

struct allpairs_world {
  std::unique_ptr<allpairs::c::CallerMemory> memory;
  std::unique_ptr<allpairs::Executor> executor;
  std::unique_ptr<allpairs::c::CallerStop> stop;
  allpairs::World world;

  std::uint32_t queried = allpairs::kEveryWorld;  ///< The world whose boxes queries consider.
  std::atomic<int> callingBack = 0;               ///< Calls that run and may ask the caller's accept() or stop().

  /// What the last query of each kind gave. As a whole, so that its memory can be released by assigning another.
  struct Found {
    std::vector<allpairs::BoxId> ids;
    std::vector<allpairs::SweepHit> hits;
    std::vector<allpairs::Neighbor> neighbors;
    std::vector<allpairs::Pair> between;
    allpairs::ResultLists<allpairs::BoxId> idLists;
    allpairs::ResultLists<allpairs::SweepHit> hitLists;
    allpairs::ResultLists<allpairs::Neighbor> neighborLists;
  } found{};
};

// NOLINTEND(readability-identifier-naming)

namespace allpairs::c {

/// A visitor that wants no more: ends the search, is no failure.
struct VisitorStopped {};

/// Notes the exception that is being handled for allpairs_error_message(), and says which status it is.
[[nodiscard]] allpairs_status noteFailure() noexcept;

/// Runs what a function of the interface does; what it throws becomes a status.
template <class Work>
[[nodiscard]] allpairs_status guarded(Work&& work) noexcept {
  try {
    std::forward<Work>(work)();
    return ALLPAIRS_OK;
  } catch (...) {
    return noteFailure();
  }
}

/// The object behind a pointer of the caller's.
///
/// Bad input: null throws InvalidArgument that names it.
template <class T>
[[nodiscard]] T& required(T* pointer, const char* name) {
  if (pointer == nullptr) throw InvalidArgument(std::string(name) + " is null");
  return *pointer;
}

/// An array of the caller's. Bad input: null with elements in it throws InvalidArgument.
template <class T>
[[nodiscard]] std::span<T> requiredSpan(T* data, std::size_t count, const char* name) {
  if (data == nullptr && count != 0) throw InvalidArgument(std::string(name) + " is null");
  return {data, count};
}

/// The caller's options as far as the caller knows them, zeros beyond.
///
/// Bad input: no size, or more than this library knows, throws InvalidArgument.
template <class T>
[[nodiscard]] T known(const T* options);

/// Writes as much of a result as the caller knows of it.
///
/// Bad input: as of known(), and null.
template <class T>
void write(T result, T* to, const char* name);

/// What a filter's arrays are about: C says nothing of their length, which is that of a set.
[[nodiscard]] FilterBits bitsOf(const allpairs_filter& filter, std::size_t boxes);

/// A call of a search, the only one as long as it lasts: callbacks of the caller's, which may run on several threads,
/// must not change what it works on.
///
/// Bad input: no search, or one that is called, throws InvalidArgument.
class SearchCall {
 public:
  explicit SearchCall(allpairs_search* search) : m_search(required(search, "search")) {
    if (m_search.isCalled.exchange(true, std::memory_order_acquire)) {
      throw InvalidArgument("the search is called by its own filter, visitor or stop");
    }
  }
  ~SearchCall() { m_search.isCalled.store(false, std::memory_order_release); }
  SearchCall(const SearchCall&) = delete;
  SearchCall& operator=(const SearchCall&) = delete;

  [[nodiscard]] allpairs_search& handle() const noexcept { return m_search; }

 private:
  allpairs_search& m_search;
};

/// Keeps the statistics of a search with its handle, where they outlive what searched; all 0 if the search throws.
template <class Search>
class NotedSearch {
 public:
  NotedSearch(allpairs_search& handle, const Search& search) : m_handle(handle), m_search(search) {
    m_handle.statistics = {};
  }
  ~NotedSearch() {
    if (std::uncaught_exceptions() == m_exceptions) m_handle.statistics = m_search.statistics();
  }
  NotedSearch(const NotedSearch&) = delete;
  NotedSearch& operator=(const NotedSearch&) = delete;

 private:
  allpairs_search& m_handle;
  const Search& m_search;
  int m_exceptions = std::uncaught_exceptions();
};

/// Threads to run on, or null for the calling one.
[[nodiscard]] std::unique_ptr<Executor> executorFor(std::size_t threads);

/// The number that a caller in C has put where an enumerator is: if it is none of them, C++ may not read it as one.
template <class Enumerator>
[[nodiscard]] int numberIn(const Enumerator& place) {
  static_assert(sizeof(Enumerator) == sizeof(int));
  int number = 0;
  std::memcpy(&number, &place, sizeof number);
  return number;
}

/// Bad input: a number that is none of the orders throws InvalidArgument.
[[nodiscard]] Order orderOf(int order);

/// Throws InvalidArgument if the world is called by its own callback: results of queries, which a const World gives
/// away, are kept in the handle.
inline void checkIdle(const allpairs_world& world) {
  if (world.callingBack.load(std::memory_order_relaxed) != 0) {
    throw InvalidArgument("the world is called by its own accept or stop");
  }
}

[[nodiscard]] inline World& worldOf(allpairs_world* world, const char* name = "world") {
  checkIdle(required(world, name));
  return world->world;
}

/// A call that may ask the world's accept() or stop().
class CallingBack {
 public:
  explicit CallingBack(allpairs_world* world, const char* name = "world")
      : m_world(worldOf(world, name)), m_calls(world->callingBack) {
    m_calls.fetch_add(1, std::memory_order_relaxed);
  }
  ~CallingBack() { m_calls.fetch_sub(1, std::memory_order_relaxed); }
  CallingBack(const CallingBack&) = delete;
  CallingBack& operator=(const CallingBack&) = delete;

  [[nodiscard]] World& world() const noexcept { return m_world; }

 private:
  World& m_world;
  std::atomic<int>& m_calls;
};

[[nodiscard]] allpairs_pairs toC(std::span<const Pair> pairs);
[[nodiscard]] Box boxOf(const double* bounds);

/// A visitor of the engine that asks the caller's.
class Visitor {
 public:
  explicit Visitor(const allpairs_visitor& visitor) : m_visitor(visitor) {
    if (visitor.visit == nullptr) throw InvalidArgument("visitor.visit is null");
  }

  [[nodiscard]] std::size_t batchSize() const noexcept {
    return m_visitor.batch_size != 0 ? m_visitor.batch_size : kBatchSize;
  }

  void operator()(std::span<const Pair> batch) {
    if (!m_visitor.visit(m_visitor.context, toC(batch))) throw VisitorStopped();
  }

 private:
  allpairs_visitor m_visitor;
};

}  // namespace allpairs::c
