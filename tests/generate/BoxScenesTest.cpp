// SPDX-License-Identifier: MIT
#include "allpairs/generate/BoxScenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <string>

#include "allpairs/Error.h"

namespace {

using allpairs::generate::boxScenes;
using allpairs::generate::makeBoxes;
using allpairs::generate::SceneRequest;

/// The oracle: how many pairs of rows overlap.
std::size_t countPairs(const std::vector<float>& rows) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < rows.size(); i += 6) {
    for (std::size_t j = 0; j < i; j += 6) {
      bool apart = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        apart |= rows[i + axis] > rows[j + 3 + axis] || rows[j + axis] > rows[i + 3 + axis];
      }
      count += apart ? 0 : 1;
    }
  }
  return count;
}

/// FNV-1a over the bits of the numbers, lowest byte first.
std::uint64_t hashOf(const std::vector<float>& rows) {
  std::uint64_t hash = 14695981039346656037U;
  for (const float value : rows) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (unsigned shift = 0; shift < 32; shift += 8) hash = (hash ^ (bits >> shift & 0xFFU)) * 1099511628211U;
  }
  return hash;
}

using Row = std::array<float, 6>;

std::multiset<Row> rowsOf(const std::vector<float>& values) {
  std::multiset<Row> rows;
  for (std::size_t i = 0; i < values.size(); i += 6) {
    Row row{};
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i), 6, row.begin());
    rows.insert(row);
  }
  return rows;
}

/// How far apart neighbours in the list are, on average.
double meanStep(const std::vector<float>& rows) {
  double sum = 0.0;
  for (std::size_t i = 6; i < rows.size(); i += 6) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      sum += static_cast<double>(std::abs(rows[i + axis] - rows[i - 6 + axis]));
  }
  return sum / static_cast<double>(rows.size() / 6);
}

class EveryScene : public testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static std::vector<float> boxes(std::size_t count, std::uint64_t seed = 1, bool sorted = false) {
    return makeBoxes({.scene = GetParam(), .count = count, .seed = seed, .sorted = sorted});
  }
};

TEST_P(EveryScene, HasAsManyBoxesAsAskedFor) {
  for (const std::size_t count : {0U, 1U, 2U, 3U, 7U, 100U, 1001U}) EXPECT_EQ(boxes(count).size(), 6 * count);
}

TEST_P(EveryScene, HasOnlyFiniteBoxesThatAreNotEmpty) {
  const std::vector<float> rows = boxes(5000);
  for (std::size_t i = 0; i < rows.size(); i += 6) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_TRUE(std::isfinite(rows[i + axis]) && std::isfinite(rows[i + 3 + axis])) << "box " << i / 6;
      ASSERT_LE(rows[i + axis], rows[i + 3 + axis]) << "box " << i / 6;
    }
  }
}

TEST_P(EveryScene, DependsOnTheSeed) { EXPECT_NE(boxes(100, 1), boxes(100, 2)); }

TEST_P(EveryScene, HasTheSameBoxesWhenSorted) {
  const std::vector<float> shuffled = boxes(2000);
  const std::vector<float> sorted = boxes(2000, 1, true);
  EXPECT_NE(shuffled, sorted);
  EXPECT_EQ(rowsOf(shuffled), rowsOf(sorted));
}

TEST_P(EveryScene, HasBetweenOneAndTenPairsABoxUnlessAllOverlap) {
  for (const std::size_t count : {1000U, 5000U}) {
    const std::size_t pairs = countPairs(boxes(count));
    if (GetParam() == "all-overlap") {
      EXPECT_EQ(pairs, count * (count - 1) / 2);
    } else {
      EXPECT_GE(pairs, count);
      EXPECT_LE(pairs, 10 * count);
    }
  }
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const auto& scene : boxScenes()) names.emplace_back(scene.name);
  return names;
}

std::string testName(const testing::TestParamInfo<std::string>& scene) {
  std::string name = scene.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(BoxScenes, EveryScene, testing::ValuesIn(sceneNames()), testName);

TEST(BoxScenes, SortingBringsNeighboursTogether) {
  const SceneRequest shuffled{.scene = "uniform", .count = 5000};
  const SceneRequest sorted{.scene = "uniform", .count = 5000, .sorted = true};
  EXPECT_LT(meanStep(makeBoxes(sorted)), 0.25 * meanStep(makeBoxes(shuffled)));
}

TEST(BoxScenes, AreTheSameBytesOnEveryMachine) {
  const std::vector<std::pair<std::string, std::uint64_t>> expected{
      {"uniform", 0xf02fd1f10c0ef0abU}, {"clusters", 0x7361979c0f1db0f6U}, {"power-law", 0xde79ef26771acd15U},
      {"city", 0xf9814d518b1100e0U},    {"needles", 0x5b66d5d5cde66c35U},  {"all-overlap", 0x4d3eaa7daf83b924U},
      {"mesh", 0xe46cd209d17efae4U},
  };
  for (const auto& [scene, hash] : expected) {
    EXPECT_EQ(hashOf(makeBoxes({.scene = scene, .count = 1000, .seed = 1})), hash) << scene;
  }
  EXPECT_EQ(expected.size(), boxScenes().size());
}

TEST(BoxScenes, OfAnUnknownNameThrowsAnErrorThatListsTheKnownOnes) {
  try {
    (void)makeBoxes({.scene = "unknown"});
    FAIL() << "no error";
  } catch (const allpairs::InvalidArgument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'unknown'"));
    for (const auto& scene : boxScenes()) EXPECT_THAT(error.what(), testing::HasSubstr(std::string(scene.name)));
  }
}

TEST(BoxScenes, OfMoreBoxesThanAnIndexCanNumberAreRefused) {
  EXPECT_THROW((void)makeBoxes({.count = std::size_t{1} << 32U}), allpairs::InvalidArgument);
}

}  // namespace
