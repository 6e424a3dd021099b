// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <vector>

#include "MpiCase.h"
#include "support/Boxes.h"

// Of support/FailingNew.cpp.
extern "C" void allpairsTestFail(std::uint64_t k, bool andLater, std::size_t size) noexcept;
extern "C" bool allpairsTestStop() noexcept;

namespace allpairs::test {
namespace {

bool onAnyRank(bool here) {
  int any = here ? 1 : 0;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return any != 0;
}

/// Every rank gets std::bad_alloc wherever the memory of one ends, and the next search is right.
TEST(DistributedMemory, AnyAllocationOfOneRankMayFail) {
  if (rankCount() > 3) GTEST_SKIP() << "thousands of searches: a minute where ranks share cores";
  std::vector<Box> boxes;
  for (int i = 0; i < 60; ++i) boxes.push_back(cube(0.4 * i, i % 3, 0));
  boxes[30] = {{-9, -9, -9}, {99, 99, 99}};  // wide
  const auto begins = evenly(boxes.size());
  const std::vector<IdPair> expected = pairsHere(oracle(boxes), begins);
  const std::span<const Box> here = hereOf(boxes, begins);
  MpiSearch search;
  for (const bool andLater : {false, true}) {
    bool hasFailed = true;
    for (std::uint64_t k = 1; hasFailed; k += 7) {
      const bool isFailing = rankHere() == static_cast<int>(k) % rankCount();
      std::vector<IdPair> found;
      bool isComplete = true;
      const std::vector<mpi::LocalBoxes> sets{here};
      if (isFailing) allpairsTestFail(k, andLater, 0);
      try {
        found = search.find(sets);
      } catch (const std::bad_alloc&) {
        isComplete = false;
      }
      const bool hasFailedHere = allpairsTestStop() && isFailing;
      hasFailed = onAnyRank(hasFailedHere);
      EXPECT_EQ(isComplete, !hasFailed) << "allocation " << k;
      if (isComplete) {
        EXPECT_EQ(found, expected);
      }
      EXPECT_EQ(search.find(sets), expected);
      if (onAnyRank(HasFailure())) return;
    }
  }
}

/// Making a search is collective too.
TEST(DistributedMemory, ASearchThatOneRankCannotMakeIsMadeOnNone) {
  if (rankHere() == rankCount() - 1) allpairsTestFail(1, true, 0);
  EXPECT_THROW(mpi::DistributedOverlaps(MPI_COMM_WORLD), std::bad_alloc);
  allpairsTestStop();
  mpi::DistributedOverlaps search(MPI_COMM_WORLD);
  EXPECT_EQ(search.count(std::vector<Box>{}), 0U);
}

}  // namespace
}  // namespace allpairs::test
