// SPDX-License-Identifier: MIT
#include <pthread.h>

#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

#include "Handles.h"
#include "allpairs/parallel/TbbExecutor.h"

namespace allpairs::c {
namespace {

static_assert(sizeof(allpairs_pair) == sizeof(Pair) && alignof(allpairs_pair) == alignof(Pair));
static_assert(offsetof(allpairs_pair, second) == offsetof(Pair, second));

/// The last failure of a thread.
struct Failure {
  char message[512] = "";
  std::uint64_t index = 0;
};

/// What a thread has that has failed, and had no memory to say how.
Failure noMemory{"out of memory, for a message too"};

/// The last failure of each thread.
///
/// Not thread_local: in a library that is loaded later, the C library allocates a thread's copy at its first use, and
/// ends the process if it can't. Of threads that are alive when the library is unloaded a note of half a kilobyte is
/// lost, except of the one that unloads it.
class Failures {
 public:
  Failures() noexcept : m_hasKey(pthread_key_create(&m_key, forget) == 0) {}
  Failures(const Failures&) = delete;
  Failures& operator=(const Failures&) = delete;
  ~Failures() {
    if (!m_hasKey) return;
    forget(find());
    pthread_key_delete(m_key);
    m_hasKey = false;
  }

  /// That of this thread, or null.
  [[nodiscard]] Failure* find() const noexcept {
    return m_hasKey ? static_cast<Failure*>(pthread_getspecific(m_key)) : nullptr;
  }

  /// A place for that of this thread, or null.
  [[nodiscard]] Failure* make() const noexcept {
    Failure* mine = find();
    if (!m_hasKey || (mine != nullptr && mine != &noMemory)) return mine;
    auto made = std::unique_ptr<Failure>(new (std::nothrow) Failure);
    if (pthread_setspecific(m_key, made != nullptr ? made.get() : &noMemory) != 0) return nullptr;
    return made.release();
  }

 private:
  static void forget(void* failure) noexcept {
    if (failure != &noMemory) delete static_cast<Failure*>(failure);  // NOLINT(cppcoreguidelines-owning-memory)
  }

  pthread_key_t m_key{};
  bool m_hasKey;
};

Failures failures;

allpairs_status note(allpairs_status status, const char* message, std::uint64_t index = 0) noexcept {
  Failure* mine = failures.make();
  if (mine == nullptr) return status;
  std::strncpy(mine->message, message, sizeof(mine->message) - 1);
  mine->index = index;
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
  } catch (const allpairs::Stopped& error) {
    return note(ALLPAIRS_STOPPED, error.what());
  } catch (const Error& error) {
    return note(ALLPAIRS_INVALID_ARGUMENT, error.what());
  } catch (const VisitorStopped&) {
    return note(ALLPAIRS_STOPPED, "the visitor asked for no more");
  } catch (const std::bad_alloc&) {
    return note(ALLPAIRS_OUT_OF_MEMORY, "out of memory");
  } catch (const std::length_error&) {  // more than a container can hold
    return note(ALLPAIRS_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return note(ALLPAIRS_INTERNAL, error.what());
  } catch (...) {
    return note(ALLPAIRS_INTERNAL, "an exception of an unknown type");
  }
}

namespace {

/// The number of bytes of a structure that the caller knows.
template <class T>
std::size_t knownSize(const T& given) {
  if (given.struct_size < sizeof(given.struct_size) || given.struct_size > sizeof(T)) {
    throw InvalidArgument("struct_size is " + std::to_string(given.struct_size) + "; this library knows up to " +
                          std::to_string(sizeof(T)));
  }
  if (given.struct_size % alignof(T) != 0) {  // the size of no version of T
    throw InvalidArgument("struct_size is " + std::to_string(given.struct_size) + "; no such structure has that size");
  }
  return given.struct_size;
}

}  // namespace

template <class T>
T known(const T* options) {
  T result{};
  if (options != nullptr) std::memcpy(&result, options, knownSize(*options));
  return result;
}

template <class T>
void write(T result, T* to, const char* name) {
  result.struct_size = knownSize(required(to, name));
  std::memcpy(to, &result, result.struct_size);
}

template allpairs_options known(const allpairs_options* options);
template allpairs_world_options known(const allpairs_world_options* options);
template allpairs_worlds known(const allpairs_worlds* options);
template allpairs_elements_options known(const allpairs_elements_options* options);
template void write(allpairs_overlap_statistics result, allpairs_overlap_statistics* to, const char* name);
template void write(allpairs_step_statistics result, allpairs_step_statistics* to, const char* name);

std::string_view instructionSetOf(const char* name) {
  if (name == nullptr) return {};
  std::string names;
  for (const std::string_view each : instructionSets()) {
    if (each == name) return each;
    names += (names.empty() ? "" : ", ") + std::string(each);
  }
  throw InvalidArgument("no instruction set '" + std::string(name) + "' here; there are: " + names);
}

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

std::unique_ptr<CallerMemory> memoryOf(const allpairs_memory& memory) {
  if ((memory.allocate == nullptr) != (memory.deallocate == nullptr)) {
    throw InvalidArgument("memory has only one of allocate and deallocate");
  }
  return memory.allocate == nullptr ? nullptr : std::make_unique<CallerMemory>(memory);
}

allpairs_pairs toC(std::span<const Pair> pairs) {
  return {reinterpret_cast<const allpairs_pair*>(pairs.data()), pairs.size()};
}

Box boxOf(const double* bounds) { return {{bounds[0], bounds[1], bounds[2]}, {bounds[3], bounds[4], bounds[5]}}; }

}  // namespace allpairs::c

// NOLINTBEGIN(readability-identifier-naming): names are C's.

const char* allpairs_error_message(void) {
  const allpairs::c::Failure* failure = allpairs::c::failures.find();
  return failure != nullptr ? failure->message : "";
}

uint64_t allpairs_error_index(void) {
  const allpairs::c::Failure* failure = allpairs::c::failures.find();
  return failure != nullptr ? failure->index : 0;
}

const char* allpairs_version(void) { return ALLPAIRS_VERSION; }

const char* allpairs_instruction_set(size_t index) {
  const allpairs::Span<const std::string_view> names = allpairs::instructionSets();
  return index < names.size() ? names[index].data() : nullptr;  // literals, which end with a zero
}

// NOLINTEND(readability-identifier-naming)
