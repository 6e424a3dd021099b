// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "MpiCase.h"
#include "allpairs/Error.h"
#include "allpairs/mpi/OnAllRanks.h"
#include "support/Boxes.h"

namespace allpairs::test {
namespace {

const std::vector<Box>& someBoxes() {
  static const std::vector<Box> boxes = [] {
    std::vector<Box> made;
    for (int i = 0; i < 90; ++i) made.push_back(cube(0.5 * i, 0, 0));
    return made;
  }();
  return boxes;
}

/// Every rank throws, and the object can be used on.
template <class Problem>
void expectAllThrow(MpiSearch& search, const std::vector<mpi::LocalBoxes>& sets) {
  EXPECT_THROW((void)search.find(sets), Problem);
  const auto begins = evenly(someBoxes().size());
  EXPECT_EQ(search.find({hereOf(someBoxes(), begins)}), pairsHere(oracle(someBoxes()), begins));
}

TEST(DistributedFailure, ANanOnOneRankIsThrownOnAll) {
  std::vector<Box> boxes(20, cube(0, 0, 0));
  if (rankHere() == rankCount() - 1) boxes[7].max[1] = std::numeric_limits<double>::quiet_NaN();
  MpiSearch search;
  expectAllThrow<InvalidBox>(search, {boxes});
  try {
    (void)search.find({boxes});
    ADD_FAILURE();
  } catch (const InvalidBox& problem) {
    EXPECT_EQ(problem.index(), 7);
    if (rankCount() > 1) {
      EXPECT_EQ(std::string(problem.what()).rfind("rank " + std::to_string(rankCount() - 1) + ": box 7", 0), 0)
          << problem.what();
    }
  }
}

TEST(DistributedFailure, MemoryOnOneRank) {
  const auto fail = [] {
    if (rankHere() == 0) throw std::bad_alloc();
    return BoxView();
  };
  MpiSearch search;
  expectAllThrow<std::bad_alloc>(search, {fail});
}

TEST(DistributedFailure, AnythingElseKeepsItsTypeWhereItWasThrown) {
  const auto fail = [] {
    if (rankHere() == 0) throw std::domain_error("the tape is torn");
    return BoxView();
  };
  MpiSearch search;
  if (rankHere() == 0) {
    expectAllThrow<std::domain_error>(search, {fail});
  } else {
    expectAllThrow<Error>(search, {fail});
  }
}

TEST(DistributedFailure, OptionsThatMakeNoSense) {
  const std::vector<Box> boxes(3, cube(0, 0, 0));
  EXPECT_THROW((void)MpiSearch({.distance = std::numeric_limits<double>::quiet_NaN()}).find({boxes}), InvalidArgument);
  const std::array<std::uint32_t, 2> groups{1, 2};
  mpi::DistributedOptions one;
  if (rankHere() == 0) one.first.groups = groups;
  EXPECT_THROW((void)MpiSearch(one).find({boxes}), InvalidArgument);
  mpi::DistributedOptions second;
  second.second.groups = groups;
  EXPECT_THROW((void)MpiSearch(second).find({boxes}), InvalidArgument);
}

TEST(DistributedFailure, RanksThatDoNotAgree) {
  if (rankCount() == 1) return;
  const auto begins = evenly(someBoxes().size());
  const auto here = hereOf(someBoxes(), begins);
  EXPECT_THROW((void)MpiSearch({.distance = 0.1 * rankHere()}).find({here}), InvalidArgument);
  EXPECT_THROW((void)MpiSearch({.maxPairs = 1000U + static_cast<unsigned>(rankHere())}).find({here}), InvalidArgument);
  MpiSearch search;
  if (rankHere() == 0) {
    EXPECT_THROW((void)search.find({here}), InvalidArgument);
  } else {
    EXPECT_THROW((void)search.count({here, here}), InvalidArgument);
  }
  EXPECT_EQ(search.find({here}), pairsHere(oracle(someBoxes()), begins));
}

TEST(DistributedFailure, NoRanks) {
  EXPECT_THROW(mpi::DistributedOverlaps(MPI_COMM_NULL), InvalidArgument);
  EXPECT_THROW(mpi::onAllRanks(MPI_COMM_NULL, [] {}), InvalidArgument);
  mpi::DistributedOverlaps search(MPI_COMM_WORLD);
  const mpi::DistributedOverlaps taken = std::move(search);
  EXPECT_THROW((void)search.count(someBoxes()), InvalidArgument);  // NOLINT(bugprone-use-after-move): what is tested
}

TEST(DistributedFailure, MorePairsThanAllowed) {
  const auto begins = evenly(someBoxes().size());
  const std::uint64_t pairs = oracle(someBoxes()).size();
  EXPECT_EQ(MpiSearch({.maxPairs = pairs}).count({hereOf(someBoxes(), begins)}), pairs);
  EXPECT_THROW((void)MpiSearch({.maxPairs = pairs - 1}).count({hereOf(someBoxes(), begins)}), LimitExceeded);
  EXPECT_THROW((void)MpiSearch({.maxPairs = pairs - 1}).find({hereOf(someBoxes(), begins)}), LimitExceeded);
  EXPECT_THROW((void)MpiSearch({.maxPairs = 1}).find({hereOf(someBoxes(), begins)}), LimitExceeded);
}

/// Wide boxes are searched with all boxes of every rank, which finds pairs twice, and boxes with themselves.
TEST(DistributedFailure, PairsOfWideBoxesCountOnce) {
  std::vector<Box> boxes = someBoxes();
  for (std::size_t i = 0; i < boxes.size(); i += 10) boxes[i] = {{0, 0, 0}, {50, 1, 1}};
  const auto begins = evenly(boxes.size());
  const std::vector<Pair> pairs = oracle(boxes);
  EXPECT_EQ(MpiSearch({.maxPairs = pairs.size()}).find({hereOf(boxes, begins)}), pairsHere(pairs, begins));
  EXPECT_EQ(MpiSearch({.maxPairs = pairs.size()}).count({hereOf(boxes, begins)}), pairs.size());
  EXPECT_THROW((void)MpiSearch({.maxPairs = pairs.size() - 1}).find({hereOf(boxes, begins)}), LimitExceeded);
}

/// Of a wide box and those before it, whose margins are added first, there are many pairs the other way round.
TEST(DistributedFailure, PairsThatAreNoneInTheirOrderDoNotCount) {
  const double distance = 0.1;
  double early = 0.0;
  double late = 0.0;
  for (int i = 1; i < 100 && late == 0.0; ++i) {
    for (int j = 1; j < i && late == 0.0; ++j) {
      const double a = 0.1 * i;
      const double b = 0.1 * j;
      if ((distance + a) + b == (distance + b) + a) continue;
      early = (distance + a) + b < (distance + b) + a ? a : b;
      late = early == a ? b : a;
    }
  }
  ASSERT_LT((distance + early) + late, (distance + late) + early);
  std::vector<Box> boxes;
  for (int i = 0; i < 200; ++i) boxes.push_back({{-1, 100.0 * i, 0}, {0, 100.0 * i + 1, 1}});
  const double gap = (distance + late) + early;
  boxes.push_back({{gap, 0, 0}, {gap + 1, 20'000, 1}});
  std::vector<double> margins(200, early);
  margins.push_back(late);
  ASSERT_TRUE(oracle(boxes, distance, margins).empty());
  const auto begins = evenly(boxes.size());
  const auto view = [&] {
    BoxView here(hereOf(boxes, begins));
    here.setMargins(hereOf(margins, begins));
    return here;
  };
  EXPECT_TRUE(MpiSearch({.distance = distance, .maxPairs = 0}).find({view}).empty());
}

TEST(DistributedFailure, StoppedOnOneRank) {
  StopFlag flag;
  if (rankHere() == 0) flag.set();
  const auto begins = evenly(someBoxes().size());
  EXPECT_THROW((void)MpiSearch({.stop = &flag}).find({hereOf(someBoxes(), begins)}), Stopped);
}

TEST(DistributedFailure, TheLowestRankIsReported) {
  try {
    mpi::onAllRanks(MPI_COMM_WORLD, [] { throw InvalidArgument("mine is " + std::to_string(rankHere())); });
    ADD_FAILURE();
  } catch (const InvalidArgument& problem) {
    EXPECT_EQ(std::string(problem.what()), rankCount() == 1 ? "mine is 0" : "rank 0: mine is 0");
  }
  EXPECT_NO_THROW(mpi::onAllRanks(MPI_COMM_WORLD, [] {}));
}

}  // namespace
}  // namespace allpairs::test
