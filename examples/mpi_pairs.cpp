// SPDX-License-Identifier: MIT
// The pairs of boxes that lie on the ranks of MPI: mpirun -n 4 example_mpi_pairs
#include <allpairs/mpi/DistributedOverlaps.h>
#include <mpi.h>

#include <cstdio>
#include <vector>

namespace {

/// Of a row of 12 boxes, each of which touches the next, those of one rank.
std::vector<allpairs::Box> boxesOf(int rank, int ranks) {
  std::vector<allpairs::Box> boxes;
  for (int i = 12 * rank / ranks; i < 12 * (rank + 1) / ranks; ++i) {
    const double x = i;
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  return boxes;
}

}  // namespace

int main(int count, char** arguments) {
  MPI_Init(&count, &arguments);
  int rank = 0;
  int ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  {
    allpairs::mpi::DistributedOverlaps search(MPI_COMM_WORLD);
    for (const allpairs::mpi::IdPair& pair : search.find(boxesOf(rank, ranks))) {
      std::printf("%llu %llu\n", static_cast<unsigned long long>(pair.first),
                  static_cast<unsigned long long>(pair.second));
    }
  }
  MPI_Finalize();
}
