// SPDX-License-Identifier: MIT
#pragma once

#include <mpi.h>

#include "allpairs/Error.h"
#include "allpairs/FunctionRef.h"

namespace allpairs::mpi {

/// A call of MPI failed, on this rank at least: others may wait for it, and only MPI_Abort is sure to end them.
class MpiError : public Error {
 public:
  using Error::Error;
};

/// Does work on every rank of a communicator, and throws on all ranks what it throws on one: no rank goes on, and
/// waits, for one that has failed.
///
/// Collective. The work is each rank's own: it must not communicate.
/// Bad input: where several ranks fail, all throw the exception of the lowest. Its message begins with that rank where
///            there are several. InvalidArgument, InvalidBox, LimitExceeded, Stopped and std::bad_alloc keep their
///            type; anything else keeps it on its own rank and is an Error on the others.
/// Cost:      one reduction.
void onAllRanks(MPI_Comm communicator, FunctionRef<void()> work);

}  // namespace allpairs::mpi
