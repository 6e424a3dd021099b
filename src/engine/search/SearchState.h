// SPDX-License-Identifier: MIT
// What the objects that keep a search have in common: a state with options, a mark of use and, after a move, none at all.
#pragma once

#include <memory>
#include <utility>

#include "allpairs/Error.h"
#include "allpairs/OverlapOptions.h"
#include "memory/Memory.h"

namespace allpairs::engine {

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
