// SPDX-License-Identifier: MIT
#pragma once

#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <span>

#include "allpairs/partition/Cell.h"

namespace allpairs::app {

/// Writes the pairs of all ranks, one rank's after the other's, as a .npy array of shape (m, 2): uint32, or uint64 of more
/// than 2^32 boxes. Returns how many there are. Collective.
///
/// It is written beside its place, through MPI-IO, and renamed when it is complete.
/// Bad input: a file that cannot be written throws FileError on at least one rank, and Error on the others; what was
///            there before stays.
std::uint64_t writePairs(MPI_Comm communicator, const std::filesystem::path& path,
                         std::span<const partition::IdPair> pairs, std::uint64_t boxes);

}  // namespace allpairs::app
