// SPDX-License-Identifier: MIT
#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "allpairs/partition/Cell.h"

namespace allpairs::app {

/// A file that all ranks write, each a part of its own: a .npy array of pairs. It is written beside its place, and
/// renamed when it is complete; what was there before stays until then. A link stays one, and its target is replaced.
///
/// All of it is collective. Every rank needs to see the file's folder.
/// Bad input: a place that is no file's, or cannot be written, throws FileError on at least one rank, and Error on the
///            others.
class PairFile {
 public:
  PairFile(MPI_Comm communicator, const std::filesystem::path& target);
  ~PairFile();
  PairFile(const PairFile&) = delete;
  PairFile& operator=(const PairFile&) = delete;

  /// Writes the pairs of all ranks, one rank's after the other's, as shape (m, 2): uint32, or uint64 of more than 2^32
  /// boxes. Returns how many there are, and puts the file in its place.
  std::uint64_t write(std::span<const partition::IdPair> pairs, std::uint64_t boxes);

 private:
  void create();
  void shareName();
  template <class Id>
  void writeAs(std::uint64_t position, std::span<const partition::IdPair> pairs);
  void writeAt(std::uint64_t position, const void* bytes, std::size_t count);
  void close();
  [[noreturn]] void fail(const char* action, int problem) const;

  MPI_Comm m_communicator;
  std::filesystem::path m_given;   ///< What errors name.
  std::filesystem::path m_target;  ///< The same, or what it leads to where it is a link.
  std::string m_part;              ///< Where it is until it is complete; empty while, or after, it is not there.
  int m_descriptor = -1;
  int m_rank = 0;
};

}  // namespace allpairs::app
