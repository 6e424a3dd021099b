// SPDX-License-Identifier: MIT
// What the objects that keep a search have in common: a state with options, a mark of use and, after a move, none at
// all.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "allpairs/Error.h"
#include "allpairs/OverlapOptions.h"
#include "memory/Memory.h"

namespace allpairs::engine {

/// Marks an object as running. Calls from its own callbacks would then change the data that it works on.
///
/// Threads: tasks of the running work may call check().
class InUse {
 public:
  /// Whether several threads may call the object at once, as const members: then a mark takes as long as a search of
  /// two boxes.
  explicit InUse(bool isShared = false) noexcept : m_isShared(isShared) {}

  /// Marks the object as running while the result exists.
  [[nodiscard]] auto mark() noexcept {
    add(1);
    const auto unmark = [](InUse* inUse) { inUse->add(-1); };
    return std::unique_ptr<InUse, decltype(unmark)>(this, unmark);
  }

  /// Throws InvalidArgument, which names the kind of object, if the object is running.
  void check(const char* object) const {
    if (m_scopes.load(std::memory_order_relaxed) != 0) refuse(object);
  }

  [[noreturn]] static void refuse(const char* object) {
    throw InvalidArgument(std::string(object) + " is called by its own filter, visitor, stop or task");
  }

 private:
  void add(int scopes) noexcept {
    if (m_isShared) {
      m_scopes.fetch_add(scopes, std::memory_order_relaxed);
    } else {
      m_scopes.store(m_scopes.load(std::memory_order_relaxed) + scopes, std::memory_order_relaxed);
    }
  }

  std::atomic<int> m_scopes = 0;
  bool m_isShared;
};

/// The value that a moved-from object returns a reference to.
template <class T>
[[nodiscard]] const T& defaultOf() {
  static const T value;
  return value;
}

/// A new state, which allocates from the options' memory.
template <class State>
[[nodiscard]] State* makeState(OverlapOptions options) {
  auto made = std::make_unique<State>(memoryOr(options.memory));
  made->options = std::move(options);
  return made.release();
}

/// The state of an object that is called: a new one if it has been moved from. Throws InvalidArgument, which names the
/// kind of object, if the object is running.
template <class State>
[[nodiscard]] State& stateOf(State*& state, const char* object) {
  if (state == nullptr) state = makeState<State>({});
  state->inUse.check(object);
  return *state;
}

/// Replaces the options, but for the memory resource.
inline void replaceOptions(OverlapOptions& options, OverlapOptions given) {
  if (given.memory != nullptr && given.memory != options.memory) {
    throw InvalidArgument("an object keeps the memory resource that it was made with; make another object");
  }
  given.memory = options.memory;
  options = std::move(given);
}

}  // namespace allpairs::engine
