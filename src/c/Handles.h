// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "allpairs.h"
#include "allpairs/BoxSet.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"

// What C's handles point to. NOLINTBEGIN(readability-identifier-naming): names are C's.

struct allpairs_set {
  allpairs::BoxSet boxes;
};

struct allpairs_search {
  std::unique_ptr<allpairs::Executor> executor;
  allpairs::Overlaps overlaps;
  allpairs_filter first{};
  allpairs_filter second{};
};

struct allpairs_world {
  std::unique_ptr<allpairs::Executor> executor;  // before the world, which uses it to its end
  allpairs::World world;
};

// NOLINTEND(readability-identifier-naming)

namespace allpairs::c {

/// A visitor that wants no more: ends the search, is no failure.
struct Stopped {};

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

/// Threads to run on, or null for the calling one.
[[nodiscard]] std::unique_ptr<Executor> executorFor(std::size_t threads);

[[nodiscard]] allpairs_pairs toC(std::span<const Pair> pairs);
[[nodiscard]] Box boxOf(const double* bounds);

}  // namespace allpairs::c
