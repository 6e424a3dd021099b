// SPDX-License-Identifier: MIT
#include "Ranks.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <numeric>
#include <string>
#include <string_view>

#include "allpairs/Error.h"
#include "allpairs/mpi/OnAllRanks.h"

namespace allpairs::mpi {
namespace {

enum class Kind : std::uint64_t { Argument, Box, Limit, Stopped, Memory, Other };

/// An exception in a form that travels, made without an allocation.
struct Failure {
  Kind kind = Kind::Other;
  std::uint64_t number = 0;  ///< The index of a box, or the count of pairs.
  std::array<char, 520> message{};

  Failure() = default;
  Failure(Kind given, std::string_view text, std::uint64_t value = 0) noexcept : kind(given), number(value) {
    std::memcpy(message.data(), text.data(), std::min(text.size(), message.size() - 1));
  }
};

Failure describe(const std::exception_ptr& failed) noexcept {
  try {
    std::rethrow_exception(failed);
  } catch (const InvalidBox& problem) {
    return {Kind::Box, problem.what(), problem.index()};
  } catch (const LimitExceeded& problem) {
    return {Kind::Limit, problem.what(), problem.count()};
  } catch (const InvalidArgument& problem) {
    return {Kind::Argument, problem.what()};
  } catch (const Stopped& problem) {
    return {Kind::Stopped, problem.what()};
  } catch (const std::bad_alloc& problem) {
    return {Kind::Memory, problem.what()};
  } catch (const std::exception& problem) {
    return {Kind::Other, problem.what()};
  } catch (...) {
    return {Kind::Other, "an exception that is none of the standard library"};
  }
}

[[noreturn]] void raise(const Failure& failure, int rank) {
  if (failure.kind == Kind::Memory) throw std::bad_alloc();
  if (failure.kind == Kind::Stopped) throw Stopped();
  const std::string message = "rank " + std::to_string(rank) + ": " + failure.message.data();
  if (failure.kind == Kind::Argument) throw InvalidArgument(message);
  if (failure.kind == Kind::Box) throw InvalidBox(static_cast<std::size_t>(failure.number), message);
  if (failure.kind == Kind::Limit) throw LimitExceeded(failure.number, message);
  throw Error(message);
}

/// One rank alone throws what it threw.
void throwFirst(MPI_Comm communicator, int size, const std::exception_ptr& failed) {
  int rank = 0;
  check(MPI_Comm_rank(communicator, &rank));
  int first = failed ? rank : size;
  check(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, communicator));
  if (first == size) return;
  if (size == 1) std::rethrow_exception(failed);
  Failure failure = failed ? describe(failed) : Failure();
  check(MPI_Bcast(&failure, sizeof(failure), MPI_BYTE, first, communicator));
  if (failure.kind == Kind::Other && rank == first) std::rethrow_exception(failed);
  raise(failure, first);
}

/// MPI itself would end the program.
void requireRanks(MPI_Comm communicator) {
  requireUsable();
  if (communicator == MPI_COMM_NULL) throw InvalidArgument("the communicator is MPI_COMM_NULL");
  int isBetweenGroups = 0;
  check(MPI_Comm_test_inter(communicator, &isBetweenGroups));
  if (isBetweenGroups != 0) throw InvalidArgument("the communicator is one between two groups");
}

void agree(MPI_Comm communicator, int size, FunctionRef<void()> work) {
  std::exception_ptr failed;
  try {
    work();
  } catch (...) {
    failed = std::current_exception();
  }
  throwFirst(communicator, size, failed);
}

}  // namespace

void check(int code) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  throw MpiError("MPI: " + std::string(text.data(), static_cast<std::size_t>(length)));
}

void requireUsable() {
  int isInitialized = 0;
  int isFinalized = 0;
  MPI_Initialized(&isInitialized);
  MPI_Finalized(&isFinalized);
  if (isInitialized == 0 || isFinalized != 0) throw InvalidArgument("MPI is not initialized, or is finalized");
}

void onAllRanks(MPI_Comm communicator, FunctionRef<void()> work) {
  requireRanks(communicator);
  int size = 0;
  check(MPI_Comm_size(communicator, &size));
  agree(communicator, size, work);
}

Ranks::Ranks(MPI_Comm communicator, std::size_t pieceWords) : m_pieceWords(pieceWords) {
  requireRanks(communicator);
  check(MPI_Comm_dup(communicator, &m_communicator));
  check(MPI_Comm_set_errhandler(m_communicator, MPI_ERRORS_RETURN));
  check(MPI_Comm_rank(m_communicator, &m_rank));
  check(MPI_Comm_size(m_communicator, &m_size));
}

Ranks::~Ranks() {
  int isFinalized = 0;
  MPI_Finalized(&isFinalized);
  if (isFinalized == 0 && m_communicator != MPI_COMM_NULL) MPI_Comm_free(&m_communicator);
}

void Ranks::onAll(FunctionRef<void()> work) const { agree(m_communicator, m_size, work); }

void Ranks::sum(std::span<std::uint64_t> values) const {
  check(MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_UINT64_T, MPI_SUM,
                      m_communicator));
}

void Ranks::greatest(std::span<double> values) const {
  check(
      MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_MAX, m_communicator));
}

void Ranks::bits(std::span<std::uint64_t> values) const {
  check(MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_UINT64_T, MPI_BOR,
                      m_communicator));
}

std::vector<std::uint64_t> Ranks::gather(std::uint64_t value) const {
  std::vector<std::uint64_t> values;
  onAll([&] { values.resize(static_cast<std::size_t>(m_size)); });
  check(MPI_Allgather(&value, 1, MPI_UINT64_T, values.data(), 1, MPI_UINT64_T, m_communicator));
  return values;
}

void Ranks::exchange(std::span<const std::vector<std::uint64_t>> outgoing, std::vector<std::uint64_t>& incoming) const {
  std::vector<std::uint64_t> sent;
  std::vector<std::uint64_t> ends;
  onAll([&] {
    for (const auto& part : outgoing) sent.push_back(part.size());
    ends.resize(sent.size());
  });
  check(MPI_Alltoall(sent.data(), 1, MPI_UINT64_T, ends.data(), 1, MPI_UINT64_T, m_communicator));
  onAll([&] {
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    incoming.resize(ends.back());
  });
  for (int distance = 0; distance < m_size; ++distance) {
    const auto to = static_cast<std::size_t>((m_rank + distance) % m_size);
    const auto from = static_cast<std::size_t>((m_rank + m_size - distance) % m_size);
    const std::size_t begin = from == 0 ? 0 : ends[from - 1];
    swap(outgoing[to], std::span(incoming).subspan(begin, ends[from] - begin), distance);
  }
}

/// Sends to the rank that is so far after this one, and receives from the one so far before it.
void Ranks::swap(std::span<const std::uint64_t> outgoing, std::span<std::uint64_t> incoming, int distance) const {
  if (distance == 0) {
    std::copy(outgoing.begin(), outgoing.end(), incoming.begin());
    return;
  }
  const int to = (m_rank + distance) % m_size;
  const int from = (m_rank + m_size - distance) % m_size;
  const auto piece = [this](auto words, std::size_t at) {
    return at < words.size() ? words.subspan(at, std::min(m_pieceWords, words.size() - at)) : words.first(0);
  };
  for (std::size_t at = 0; at < std::max(outgoing.size(), incoming.size()); at += m_pieceWords) {
    const auto out = piece(outgoing, at);
    const auto in = piece(incoming, at);
    check(MPI_Sendrecv(out.data(), static_cast<int>(out.size()), MPI_UINT64_T, out.empty() ? MPI_PROC_NULL : to, 0,
                       in.data(), static_cast<int>(in.size()), MPI_UINT64_T, in.empty() ? MPI_PROC_NULL : from, 0,
                       m_communicator, MPI_STATUS_IGNORE));
  }
}

std::vector<std::uint64_t> Ranks::collect(std::span<const std::uint64_t> words) const {
  const std::vector<std::uint64_t> sizes = gather(words.size());
  std::vector<int> counts;
  std::vector<int> begins;
  std::vector<std::uint64_t> all;
  onAll([&] {
    std::uint64_t total = 0;
    for (const std::uint64_t size : sizes) {
      counts.push_back(static_cast<int>(size));
      begins.push_back(static_cast<int>(total));
      total += size;
    }
    if (total > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) throw Error("too much to send at once");
    all.resize(total);
  });
  check(MPI_Allgatherv(words.data(), counts[static_cast<std::size_t>(m_rank)], MPI_UINT64_T, all.data(), counts.data(),
                       begins.data(), MPI_UINT64_T, m_communicator));
  return all;
}

void Ranks::broadcast(std::span<std::uint64_t> words, int from) const {
  for (std::size_t at = 0; at < words.size(); at += m_pieceWords) {
    const auto piece = words.subspan(at, std::min(m_pieceWords, words.size() - at));
    check(MPI_Bcast(piece.data(), static_cast<int>(piece.size()), MPI_UINT64_T, from, m_communicator));
  }
}

}  // namespace allpairs::mpi
