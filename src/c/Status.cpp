// SPDX-License-Identifier: MIT
#include <cstring>
#include <new>

#include "Handles.h"
#include "allpairs/parallel/TbbExecutor.h"

namespace allpairs::c {
namespace {

static_assert(sizeof(allpairs_pair) == sizeof(Pair) && alignof(allpairs_pair) == alignof(Pair));
static_assert(offsetof(allpairs_pair, second) == offsetof(Pair, second));

/// The last failure of a thread. The text has a size of its own, so that noting it can't fail.
struct Failure {
  char message[512] = "";
  std::uint64_t index = 0;
};

thread_local Failure lastFailure;

allpairs_status note(allpairs_status status, const char* message, std::uint64_t index = 0) noexcept {
  std::strncpy(lastFailure.message, message, sizeof(lastFailure.message) - 1);
  lastFailure.index = index;
  return status;
}

}  // namespace

allpairs_status noteFailure() noexcept {
  try {
    throw;
  } catch (const InvalidBox& error) {
    return note(ALLPAIRS_INVALID_BOX, error.what(), error.index());
  } catch (const LimitExceeded& error) {
    return note(ALLPAIRS_LIMIT_EXCEEDED, error.what(), error.count());
  } catch (const Error& error) {
    return note(ALLPAIRS_INVALID_ARGUMENT, error.what());
  } catch (const Stopped&) {
    return note(ALLPAIRS_STOPPED, "the visitor asked for no more");
  } catch (const std::bad_alloc&) {
    return note(ALLPAIRS_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return note(ALLPAIRS_INTERNAL, error.what());
  } catch (...) {
    return note(ALLPAIRS_INTERNAL, "an exception of an unknown type");
  }
}

template <class T>
T known(const T* options) {
  T result{};
  if (options == nullptr) return result;
  if (options->struct_size < sizeof(options->struct_size) || options->struct_size > sizeof(T)) {
    throw InvalidArgument("struct_size is " + std::to_string(options->struct_size) + "; this library knows up to " +
                          std::to_string(sizeof(T)));
  }
  std::memcpy(&result, options, options->struct_size);
  return result;
}

template allpairs_options known(const allpairs_options* options);
template allpairs_world_options known(const allpairs_world_options* options);
template allpairs_elements_options known(const allpairs_elements_options* options);

Order orderOf(int order) {
  switch (order) {
    case ALLPAIRS_BY_FIRST:
      return Order::ByFirst;
    case ALLPAIRS_BY_SECOND:
      return Order::BySecond;
    case ALLPAIRS_UNORDERED:
      return Order::Unordered;
  }
  throw InvalidArgument("no order " + std::to_string(order));
}

std::unique_ptr<Executor> executorFor(std::size_t threads) {
  if (threads <= 1) return nullptr;
  return std::make_unique<parallel::TbbExecutor>(threads == ALLPAIRS_ALL_THREADS ? 0 : threads);
}

allpairs_pairs toC(std::span<const Pair> pairs) {
  return {reinterpret_cast<const allpairs_pair*>(pairs.data()), pairs.size()};
}

Box boxOf(const double* bounds) { return {{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}}; }

}  // namespace allpairs::c

// NOLINTBEGIN(readability-identifier-naming): names are C's.

const char* allpairs_error_message(void) { return allpairs::c::lastFailure.message; }
uint64_t allpairs_error_index(void) { return allpairs::c::lastFailure.index; }
const char* allpairs_version(void) { return ALLPAIRS_VERSION; }

// NOLINTEND(readability-identifier-naming)
