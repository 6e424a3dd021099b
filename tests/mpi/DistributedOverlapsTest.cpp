// SPDX-License-Identifier: MIT
#include "allpairs/mpi/DistributedOverlaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "MpiCase.h"
#include "allpairs/generate/BoxScenes.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Boxes.h"
#include "support/Oracle.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct NamedBoxes {
  std::string name;
  std::vector<Box> boxes;
};

std::vector<Box> generated(std::string_view scene, std::size_t count) {
  const std::vector<float> rows = generate::makeBoxes({.scene = scene, .count = count, .seed = 5});
  std::vector<Box> boxes(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      boxes[i].min[axis] = static_cast<double>(rows[6 * i + axis]);
      boxes[i].max[axis] = static_cast<double>(rows[6 * i + 3 + axis]);
    }
  }
  return boxes;
}

/// Cubes whose faces touch, so that they lie on the borders of cells.
std::vector<Box> lattice(int side) {
  std::vector<Box> boxes;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) boxes.push_back(cube(x, y, z));
    }
  }
  return boxes;
}

std::vector<Box> farAway(std::vector<Box> boxes) {
  for (Box& box : boxes) {
    for (double& value : box.min) value = 1e9 + value;
    for (double& value : box.max) value = 1e9 + value;
  }
  return boxes;
}

/// Infinite, empty and flat boxes among others.
std::vector<Box> special() {
  std::vector<Box> boxes = generated("uniform", 200);
  std::mt19937 generator(3);
  for (Box& box : boxes) {
    const std::size_t axis = generator() % 3;
    switch (generator() % 12) {
      case 0:
        box.min[axis] = -kInfinity;
        break;
      case 1:
        box.max[axis] = kInfinity;
        break;
      case 2:
        box.min[axis] = box.max[axis] = kInfinity;
        break;
      case 3:
        box.min[axis] = box.max[axis] = -kInfinity;
        break;
      case 4:
        std::swap(box.min[axis], box.max[axis]);
        break;
      case 5:
        box.max[axis] = box.min[axis];
        break;
      default:
        break;
    }
  }
  return boxes;
}

std::vector<NamedBoxes> cases() {
  std::vector<NamedBoxes> cases;
  for (const generate::BoxScene& scene : generate::boxScenes()) {
    cases.push_back({std::string(scene.name), generated(scene.name, 400)});
  }
  cases.push_back({"lattice", lattice(7)});
  cases.push_back({"far away", farAway(generated("uniform", 300))});
  cases.push_back({"all the same", std::vector<Box>(150, cube(1, 2, 3))});
  std::vector<Box> withGiant = generated("uniform", 300);
  withGiant[77] = {{-9, -9, -9}, {9, 9, 9}};
  cases.push_back({"one giant", withGiant});
  for (std::size_t i = 0; i < withGiant.size(); i += 5) withGiant[i] = withGiant[77];
  cases.push_back({"many giants", withGiant});
  cases.push_back({"special", special()});
  cases.push_back({"none", {}});
  cases.push_back({"one", {cube(0, 0, 0)}});
  cases.push_back({"three", {cube(0, 0, 0), cube(0.5, 0, 0), cube(1.25, 0, 0)}});
  return cases;
}

std::vector<BoxF> toFloat(const std::vector<Box>& boxes) {
  std::vector<BoxF> narrow(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      narrow[i].min[axis] = static_cast<float>(boxes[i].min[axis]);
      narrow[i].max[axis] = static_cast<float>(boxes[i].max[axis]);
    }
  }
  return narrow;
}

TEST(DistributedOverlaps, AllScenesGiveThePairsOfTheDoubleLoop) {
  int number = 0;
  for (const NamedBoxes& given : cases()) {
    for (const double distance : {0.0, 0.03, -0.01}) {
      if (kIsSanitized && ++number % 2 == 0) continue;  // of each scene one or two
      SCOPED_TRACE(given.name + ", distance " + std::to_string(distance));
      const auto begins = atRandom(given.boxes.size(), 7);
      const std::vector<Pair> expected = oracle(given.boxes, distance);
      MpiSearch search({.distance = distance});
      EXPECT_EQ(search.find({hereOf(given.boxes, begins)}), pairsHere(expected, begins));
      EXPECT_EQ(search.count({hereOf(given.boxes, begins)}), expected.size());
    }
  }
}

TEST(DistributedOverlaps, UncutAsUsersHaveIt) {
  for (const NamedBoxes& given : cases()) {
    SCOPED_TRACE(given.name);
    const auto begins = evenly(given.boxes.size());
    mpi::DistributedOverlaps search(MPI_COMM_WORLD);
    EXPECT_EQ(search.find(hereOf(given.boxes, begins)), pairsHere(oracle(given.boxes), begins));
    EXPECT_EQ(search.find(hereOf(given.boxes, begins), hereOf(given.boxes, begins)),
              pairsHere(oracleBetween(given.boxes, given.boxes), begins));
  }
}

TEST(DistributedOverlaps, ThousandsOfBoxesAndThreads) {
  const std::vector<Box> boxes = generated("clusters", 6000);
  const auto begins = evenly(boxes.size());
  parallel::TbbExecutor threads(2);
  const std::vector<IdPair> expected = pairsHere(oracle(boxes), begins);
  MpiSearch search({.executor = &threads}, {.leastSample = 1000});
  EXPECT_EQ(search.find({hereOf(boxes, begins)}), expected);
}

TEST(DistributedOverlaps, SomeRanksHaveFloat32) {
  const std::vector<BoxF> narrow = toFloat(generated("uniform", 300));
  const std::vector<Box> wide = toDouble(narrow);
  const auto begins = evenly(wide.size());
  const std::vector<IdPair> expected = pairsHere(oracle(wide), begins);
  MpiSearch search;
  if (rankHere() % 2 == 0) {
    EXPECT_EQ(search.find({hereOf(narrow, begins)}), expected);
  } else {
    EXPECT_EQ(search.find({hereOf(wide, begins)}), expected);
  }
  EXPECT_EQ(search.find({hereOf(narrow, begins)}), expected);
}

/// Three margins whose sum depends on the order in which they are added, on boxes that are exactly that far apart.
TEST(DistributedOverlaps, MarginsAreAddedAsInOneProcess) {
  std::mt19937 generator(11);
  for (int round = 0; round < repeats(20); ++round) {
    const std::vector<Box> boxes = lattice(5);
    std::vector<double> margins(boxes.size());
    for (double& margin : margins) margin = 0.1 * static_cast<double>(generator() % 7) - 0.2;
    const double distance = 0.1 * static_cast<double>(generator() % 5) - 0.2;
    const auto begins = atRandom(boxes.size(), static_cast<unsigned>(round));
    const auto view = [&] {
      BoxView here(hereOf(boxes, begins));
      here.setMargins(hereOf(margins, begins));
      return here;
    };
    MpiSearch search({.distance = distance});
    EXPECT_EQ(search.find({view}), pairsHere(oracle(boxes, distance, margins), begins)) << round;
  }
}

TEST(DistributedOverlaps, OneRankHasMargins) {
  const std::vector<Box> boxes = lattice(4);
  const auto begins = evenly(boxes.size());
  std::vector<double> margins(boxes.size(), 0.0);
  const int last = rankCount() - 1;
  for (std::size_t i = begins[static_cast<std::size_t>(last)]; i < margins.size(); ++i) margins[i] = 1.0;
  const auto view = [&] {
    BoxView here(hereOf(boxes, begins));
    if (rankHere() == last) here.setMargin(1.0);
    return here;
  };
  EXPECT_EQ(MpiSearch().find({view}), pairsHere(oracle(boxes, 0.0, margins), begins));
}

TEST(DistributedOverlaps, FiltersAreThoseOfTheBoxes) {
  const std::vector<Box> boxes = generated("clusters", 300);
  std::mt19937 generator(2);
  std::vector<std::uint32_t> categories(boxes.size());
  std::vector<std::uint32_t> masks(boxes.size());
  std::vector<std::uint32_t> groups(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    categories[i] = 1U << generator() % 3;
    masks[i] = static_cast<std::uint32_t>(generator() % 8);
    groups[i] = static_cast<std::uint32_t>(generator() % 4);
  }
  const auto begins = atRandom(boxes.size(), 4);
  if (rankCount() > 1) {  // rank 1 has no groups
    std::fill(groups.begin() + static_cast<std::ptrdiff_t>(begins[1]),
              groups.begin() + static_cast<std::ptrdiff_t>(begins[2]), 0U);
  }
  for (const bool hasBits : {false, true}) {
    for (const bool hasGroups : {false, true}) {
      const auto isKept = [&](const Pair& pair) {
        const auto [a, b] = pair;
        if (hasGroups && groups[a] == groups[b] && groups[a] != 0) return false;
        return !hasBits || ((masks[a] & categories[b]) != 0 && (masks[b] & categories[a]) != 0);
      };
      std::vector<Pair> expected;
      for (const Pair pair : oracle(boxes)) {
        if (isKept(pair)) expected.push_back(pair);
      }
      FilterBits bits;
      if (hasBits) bits = {.categories = hereOf(categories, begins), .masks = hereOf(masks, begins)};
      if (hasGroups && rankHere() != 1) bits.groups = hereOf(groups, begins);
      MpiSearch search({.first = bits});
      EXPECT_EQ(search.find({hereOf(boxes, begins)}), pairsHere(expected, begins));
      EXPECT_EQ(search.count({hereOf(boxes, begins)}), expected.size());
    }
  }
}

TEST(DistributedOverlaps, TwoSets) {
  const std::vector<NamedBoxes> all = cases();
  for (std::size_t k = 0; k + 1 < all.size(); ++k) {
    const std::vector<Box>& first = all[k].boxes;
    const std::vector<Box>& second = all[k + 1].boxes;
    SCOPED_TRACE(all[k].name + " and " + all[k + 1].name);
    const auto firstBegins = atRandom(first.size(), 21);
    const auto secondBegins = atRandom(second.size(), 22);
    const std::vector<Pair> expected = oracleBetween(first, second, 0.02);
    MpiSearch search({.distance = 0.02});
    EXPECT_EQ(search.find({hereOf(first, firstBegins), hereOf(second, secondBegins)}),
              pairsHere(expected, firstBegins));
    EXPECT_EQ(search.count({hereOf(first, firstBegins), hereOf(second, secondBegins)}), expected.size());
  }
}

TEST(DistributedOverlaps, ARegion) {
  const std::vector<Box> boxes = lattice(6);
  const Box region{{0.5, 0.5, 0.5}, {2.5, 4.5, 3.5}};
  const auto isInside = [&](std::uint32_t i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (boxes[i].min[axis] > region.max[axis] || region.min[axis] > boxes[i].max[axis]) return false;
    }
    return true;
  };
  std::vector<Pair> expected;
  for (const Pair pair : oracle(boxes)) {
    if (isInside(pair.first) && isInside(pair.second)) expected.push_back(pair);
  }
  const auto begins = evenly(boxes.size());
  EXPECT_EQ(MpiSearch({.region = region}).find({hereOf(boxes, begins)}), pairsHere(expected, begins));
}

TEST(DistributedOverlaps, RandomBoxesCutAtRandom) {
  for (unsigned seed = 0; seed < repeats(60U); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 generator(seed);
    std::vector<Box> boxes(generator() % 120);
    const double step = std::pow(2.0, static_cast<double>(generator() % 4));
    for (Box& box : boxes) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.min[axis] = static_cast<double>(generator() % 9) / step;
        box.max[axis] = box.min[axis] + static_cast<double>(generator() % 5) - 0.5;
        if (generator() % 30 == 0) box.max[axis] = kInfinity;
      }
    }
    mpi::Tuning tuning = tinyTuning();
    tuning.boxesPerCell = 1 + generator() % 40;
    tuning.samplePerCell = 1 + generator() % 9;
    tuning.leastCrowded = generator() % 60;
    tuning.wideAtOnce = 1 + generator() % 20;
    tuning.pieceWords = 1 + generator() % 30;
    const auto begins = atRandom(boxes.size(), seed);
    const double distance = generator() % 20 == 0 ? kInfinity : 0.25 * static_cast<double>(generator() % 4) - 0.25;
    EXPECT_EQ(MpiSearch({.distance = distance}, tuning).find({hereOf(boxes, begins)}),
              pairsHere(oracle(boxes, distance), begins));
  }
}

/// The ranks of a part of all.
TEST(DistributedOverlaps, ACommunicatorOfSomeRanks) {
  MPI_Comm part = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, rankHere() % 2, 0, &part);
  const std::vector<Box> boxes = lattice(4);
  int rank = 0;
  MPI_Comm_rank(part, &rank);
  {
    mpi::DistributedOverlaps search(part);
    const std::span<const Box> here = rank == 0 ? std::span<const Box>(boxes) : std::span<const Box>();
    const std::vector<IdPair> pairs = search.find(here);
    EXPECT_EQ(pairs.size(), rank == 0 ? oracle(boxes).size() : 0);
    EXPECT_EQ(search.count(here), oracle(boxes).size());
  }
  MPI_Comm_free(&part);
}

}  // namespace
}  // namespace allpairs::test
