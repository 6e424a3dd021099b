// SPDX-License-Identifier: MIT
// Boxes whose pairs were counted elsewhere, where that data is present.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "allpairs/Overlaps.h"
#include "support/Boxes.h"
#include "support/Data.h"
#include "support/Strategies.h"

namespace allpairs {
namespace {

/// The values of a version 1 .npy file, which is all that this data has; the real reader has tests of its own.
template <class T>
std::vector<T> npyValues(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(bytes.at(i))}; };
  const std::size_t header = 10 + byte(8) + 256 * byte(9);
  std::vector<T> values((bytes.size() - header) / sizeof(T));
  std::copy_n(bytes.data() + header, values.size() * sizeof(T), reinterpret_cast<char*>(values.data()));
  return values;
}

bool isFloat64(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string header(128, ' ');
  file.read(header.data(), 128);
  return header.find("<f8") != std::string::npos;
}

void expectPublishedPairs(const std::filesystem::path& path, const OverlapOptions& options) {
  const std::vector<std::uint32_t> flat =
      npyValues<std::uint32_t>(std::filesystem::path(path).replace_extension(".pairs.npy"));
  std::vector<Pair> expected;
  for (std::size_t i = 0; i + 1 < flat.size(); i += 2) expected.push_back({flat[i], flat[i + 1]});
  if (isFloat64(path)) {
    const std::vector<double> rows = npyValues<double>(path);
    EXPECT_EQ(overlaps(BoxView::fromRows(rows), options), expected) << path;
  } else {
    const std::vector<float> rows = npyValues<float>(path);
    EXPECT_EQ(overlaps(BoxView::fromRows(rows), options), expected) << path;
  }
}

TEST(BoxData, PublishedBoxesGiveThePublishedPairs) {
  const std::filesystem::path folder = test::dataFolder() / "boxes";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no data folder with boxes: set ALLPAIRS_DATA";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".pairs.npy") || !name.ends_with(".npy")) continue;
    ++files;
    for (const std::string_view instructionSet : instructionSets()) {
      for (const Strategy strategy : test::kStrategies) {
        OverlapOptions options;
        options.strategy = strategy;
        options.instructionSet = instructionSet;
        expectPublishedPairs(entry.path(), options);
      }
    }
  }
  EXPECT_GT(files, 5U);
}

}  // namespace
}  // namespace allpairs
