// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <mpi.h>

/// Rank 0 reports what its tests say, and the others what failed.
int main(int count, char** arguments) {
  int provided = 0;
  MPI_Init_thread(&count, &arguments, MPI_THREAD_FUNNELED, &provided);
  testing::InitGoogleTest(&count, arguments);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank != 0) GTEST_FLAG_SET(brief, true);
  const int failed = RUN_ALL_TESTS();
  MPI_Finalize();
  return failed;
}
