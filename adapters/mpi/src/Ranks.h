// SPDX-License-Identifier: MIT
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "allpairs/FunctionRef.h"

namespace allpairs::mpi {

/// Throws InvalidArgument where MPI is not initialized, or no more.
void requireUsable();

/// Throws MpiError for a code of MPI that is none of success.
void check(int code);

/// Gives up memory that the next use of a buffer needs a small part of.
inline void freeIfLarge(std::vector<std::uint64_t>& words, std::size_t needed) {
  if (words.capacity() > 4 * needed) words = {};
}

/// The ranks of a communicator of its own, and what they do together. All of it is collective.
class Ranks {
 public:
  /// Pieces of `pieceWords` words travel at once: below 2^31 bytes.
  Ranks(MPI_Comm communicator, std::size_t pieceWords);
  ~Ranks();
  Ranks(Ranks&&) = delete;

  [[nodiscard]] int rank() const noexcept { return m_rank; }
  [[nodiscard]] int size() const noexcept { return m_size; }

  /// As mpi::onAllRanks().
  void onAll(FunctionRef<void()> work) const;

  /// Replaces each value by the sum, the greatest, or the bits of all ranks.
  void sum(std::span<std::uint64_t> values) const;
  void greatest(std::span<double> values) const;
  void bits(std::span<std::uint64_t> values) const;

  /// The value of every rank, in their order.
  [[nodiscard]] std::vector<std::uint64_t> gather(std::uint64_t value) const;

  /// Sends each rank its words, and replaces `incoming` by what came from all, in their order.
  void exchange(std::span<const std::vector<std::uint64_t>> outgoing, std::vector<std::uint64_t>& incoming) const;

  /// The words of all ranks, in their order: together less than 2^31.
  [[nodiscard]] std::vector<std::uint64_t> collect(std::span<const std::uint64_t> words) const;

  /// Replaces the words of all ranks by those of one. Their number is the same on all.
  void broadcast(std::span<std::uint64_t> words, int from) const;

 private:
  void swap(std::span<const std::uint64_t> outgoing, std::span<std::uint64_t> incoming, int distance) const;

  MPI_Comm m_communicator = MPI_COMM_NULL;
  std::size_t m_pieceWords;
  int m_rank = 0;
  int m_size = 1;
};

}  // namespace allpairs::mpi
