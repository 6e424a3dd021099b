// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "PairHash.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "allpairs/generate/BoxMotions.h"
#include "allpairs/generate/BoxScenes.h"
#include "support/Boxes.h"

// Hashes of whole results, written down once: every processor, instruction set and compiler gives the same.

namespace allpairs {
namespace {

using Hashes = std::map<std::string, std::string, std::less<>>;

std::vector<BoxF> toBoxes(std::span<const float> rows) {
  std::vector<BoxF> boxes;
  for (std::size_t i = 0; i < rows.size(); i += 6) {
    boxes.push_back({{rows[i], rows[i + 1], rows[i + 2]}, {rows[i + 3], rows[i + 4], rows[i + 5]}});
  }
  return boxes;
}

Hashes hashesOfScenes(std::string_view instructionSet) {
  OverlapOptions options;
  options.instructionSet = instructionSet;
  Hashes hashes;
  for (const generate::BoxScene& scene : generate::boxScenes()) {
    const std::size_t count = scene.name == "all-overlap" ? 700 : 5000;
    const std::vector<BoxF> boxes = toBoxes(generate::makeBoxes({.scene = scene.name, .count = count}));
    hashes[std::string(scene.name)] = measure::hexadecimal(measure::hashOfPairs(overlaps(boxes, options)));
  }
  return hashes;
}

class ResultHash : public ::testing::TestWithParam<std::string_view> {};

INSTANTIATE_TEST_SUITE_P(All, ResultHash, ::testing::ValuesIn(instructionSets().begin(), instructionSets().end()),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(ResultHash, OfEachSceneIsThatOfEveryProcessor) {
  const Hashes expected{{"uniform", "d4f54b3f93cf584c"},   {"clusters", "07cfee28a6a5cca0"},
                        {"power-law", "4ae9f85d6bb45e90"}, {"city", "e4c8d3b814e28d71"},
                        {"needles", "8005c8bb8ddbf4ec"},   {"all-overlap", "72a503a06d8e3695"},
                        {"mesh", "e86f8d7f517a3b0e"}};
  EXPECT_EQ(hashesOfScenes(GetParam()), expected);
}

/// The pairs of twenty frames, and those that began and ended, one after the other.
std::string hashOfMotion(std::string_view motion, std::string_view instructionSet) {
  WorldOptions options;
  options.instructionSet = instructionSet;
  World world(options);
  generate::MotionFrames frames({.motion = motion, .count = 2000});
  const std::vector<BoxId> ids = world.add(test::lent(toBoxes(frames.next())));
  std::vector<Pair> all;
  for (int frame = 0; frame < 20; ++frame) {
    const StepResult result = world.step();
    for (const auto& list : {result.pairs, result.began, result.ended}) all.insert(all.end(), list.begin(), list.end());
    world.move(ids, test::lent(toBoxes(frames.next())));
  }
  return measure::hexadecimal(measure::hashOfPairs(all));
}

TEST_P(ResultHash, OfEachMotionIsThatOfEveryProcessor) {
  const Hashes expected{
      {"brownian", "717aee0a376c5baa"}, {"free-fall", "a30c4058b8789cee"}, {"rotating-gravity", "773943d8f1d5ca07"}};
  Hashes hashes;
  for (const generate::BoxMotion& motion : generate::boxMotions()) {
    hashes[std::string(motion.name)] = hashOfMotion(motion.name, GetParam());
  }
  EXPECT_EQ(hashes, expected);
}

}  // namespace
}  // namespace allpairs
