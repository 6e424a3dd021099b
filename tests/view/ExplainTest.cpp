// SPDX-License-Identifier: MIT
#include "Explain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "app/view/MakeViewScene.h"
#include "app/view/ViewFrames.h"
#include "support/Data.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using view::Verdict;
using view::ViewScene;

ViewScene sceneOf(const std::string& path, const std::vector<std::string>& roots = {},
                  const app::DetectionOptions& options = {}) {
  return app::makeViewScene({.paths = {path}, .searchRoots = roots}, {.detection = options});
}

/// The pairs that the verdicts name, in the order of the double loop.
std::vector<Pair> pairsByVerdict(const ViewScene& scene, const view::ViewFrame& frame) {
  std::vector<Pair> pairs;
  for (std::uint32_t newer = 0; newer < scene.modelCount; ++newer) {
    if (explain(scene, frame, newer, newer).verdict == Verdict::Pair) pairs.push_back({newer, newer});
    for (std::uint32_t older = 0; older < newer; ++older) {
      if (explain(scene, frame, newer, older).verdict == Verdict::Pair) pairs.push_back({newer, older});
    }
  }
  return pairs;
}

Verdict verdictOf(const ViewScene& scene, const std::string& a, const std::string& b) {
  const auto indexOf = [&scene](const std::string& name) {
    const auto place = std::find(scene.names.begin(), scene.names.end(), name);
    EXPECT_NE(place, scene.names.end()) << name;
    return static_cast<std::uint32_t>(place - scene.names.begin());
  };
  const auto [older, newer] = std::minmax({indexOf(a), indexOf(b)});
  return explain(scene, scene.frames.front(), newer, older).verdict;
}

/// A model for each rule.
const std::string kRules = ALLPAIRS_SOURCE_DIR "/tests/view/rules.scn";
const std::string kFlat = ALLPAIRS_SOURCE_DIR "/tests/view/flat.scn";

TEST(Explain, NamesTheRuleThatKeepsTwoModelsApart) {
  const ViewScene scene = sceneOf(kRules);
  EXPECT_EQ(verdictOf(scene, "/A/s", "/G/s"), Verdict::Pair);
  EXPECT_EQ(verdictOf(scene, "/A/s", "/B/s"), Verdict::Apart);
  EXPECT_EQ(verdictOf(scene, "/G/s", "/H/s"), Verdict::SameGroup);
  EXPECT_EQ(verdictOf(scene, "/S/s", "/T/s"), Verdict::NotSimulated);
  EXPECT_EQ(verdictOf(scene, "/T/s", "/T/t"), Verdict::SameOwner);
  EXPECT_EQ(verdictOf(scene, "/A/s", "/O/s"), Verdict::Outside);
  EXPECT_EQ(verdictOf(scene, "/A/s", "/A/s"), Verdict::NoSelf);
  EXPECT_EQ(verdictOf(scene, "/T/t", "/T/t"), Verdict::Pair);
  EXPECT_EQ(verdictOf(scene, "/A/s", "/I/s"), Verdict::Inactive);
  EXPECT_EQ(verdictOf(scene, "/A/s", "/E/p"), Verdict::NoElements);
  const ViewScene flat = sceneOf(kFlat);
  EXPECT_EQ(verdictOf(flat, "/Flat/t", "/Flat/t"), Verdict::Flat);
  EXPECT_EQ(verdictOf(flat, "/Bent/t", "/Bent/t"), Verdict::Pair);
}

TEST(Explain, TellsTheWidestGapAndItsAxisAndTheSmallestCommonGroup) {
  const ViewScene scene = sceneOf(kRules);
  const auto apart = explain(scene, scene.frames.front(), 1, 0);
  EXPECT_EQ(apart.axis, 0);
  EXPECT_DOUBLE_EQ(apart.gap, 1.0);
  EXPECT_EQ(explain(scene, scene.frames.front(), 3, 2).group, 7);
}

TEST(Explain, AnEmptyBoxIsApartFromAllAlongNoAxis) {
  const ViewScene scene = sceneOf(kRules);
  for (const std::size_t empty : {0U, 1U}) {
    view::ViewFrame frame = scene.frames.front();
    frame.boxes[empty] = kEmptyBox;
    const auto apart = explain(scene, frame, 1, 0);
    EXPECT_EQ(apart.verdict, Verdict::Apart);
    EXPECT_EQ(apart.axis, -1);
    EXPECT_EQ(apart.gap, 0.0);
  }
}

TEST(Explain, GivesThePairsOfTheBroadPhaseInItsOrder) {
  const std::vector<std::string> paths{kRules, kFlat, ALLPAIRS_SOURCE_DIR "/examples/scenes/demo.scn",
                                       ALLPAIRS_SOURCE_DIR "/examples/boxes.csv"};
  for (const std::string& path : paths) {
    const ViewScene scene = sceneOf(path);
    EXPECT_FALSE(scene.frames.front().pairs.empty()) << path;
    EXPECT_EQ(pairsByVerdict(scene, scene.frames.front()), scene.frames.front().pairs) << path;
  }
}

/// A strip of squares, two triangles each, folded about its middle by `angle`.
std::string foldedStrip(double angle) {
  std::ostringstream text;
  for (int i = 0; i <= 8; ++i) {
    const double along = i - 4;
    const double x = along > 0 ? along * std::cos(angle) : along;
    const double z = along > 0 ? along * std::sin(angle) : 0.0;
    text << "v " << x << " 0 " << z << "\nv " << x << " 1 " << z << '\n';
  }
  for (int i = 1; i < 16; i += 2) {
    text << "f " << i << ' ' << i + 2 << ' ' << i + 1 << "\nf " << i + 1 << ' ' << i + 2 << ' ' << i + 3 << '\n';
  }
  return text.str();
}

TEST(Explain, GivesThePairsOfEachFrameOfAMeshAndSaysWhichTrianglesShareAVertex) {
  const TempFolder folder;
  app::InputSettings input;
  for (const double angle : {0.1, 1.5, 3.1}) {
    const std::string name = std::to_string(input.paths.size()) + ".obj";
    input.paths.push_back(folder.write(name, foldedStrip(angle)));
  }
  app::ViewRequest request;
  request.detection.distance = 0.25;
  const ViewScene scene = makeViewFrames(input, request);
  ASSERT_EQ(scene.frames.size(), 3U);
  for (const view::ViewFrame& frame : scene.frames) EXPECT_EQ(pairsByVerdict(scene, frame), frame.pairs);
  EXPECT_EQ(explain(scene, scene.frames[0], 1, 0).verdict, Verdict::SharesVertex);
  EXPECT_EQ(explain(scene, scene.frames[0], 15, 0).verdict, Verdict::Apart);
  EXPECT_EQ(explain(scene, scene.frames[2], 15, 0).verdict, Verdict::Pair);
}

TEST(Explain, FollowsDistanceAndRegionOfBoxes) {
  app::DetectionOptions options;
  options.distance = 0.75;
  options.region = Box{{-1.0, -1.0, -1.0}, {2.0, 2.0, 2.0}};
  const ViewScene scene = sceneOf(ALLPAIRS_SOURCE_DIR "/examples/boxes.csv", {}, options);
  EXPECT_EQ(pairsByVerdict(scene, scene.frames.front()), scene.frames.front().pairs);
}

TEST(Explain, GivesThePairsOfRealScenes) {
  const std::filesystem::path folder = dataFolder() / "scenes";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no folder of data: real scenes are not tried";
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "examples")) {
    if (entry.path().extension() != ".scn") continue;
    const ViewScene scene = sceneOf(entry.path(), {folder, folder / "examples"});
    EXPECT_EQ(pairsByVerdict(scene, scene.frames.front()), scene.frames.front().pairs) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 12U);
}

TEST(ExcludedPairs, AreThoseThatTouchAndThatARuleKeepsApart) {
  for (const std::string& path : {kRules, std::string(ALLPAIRS_SOURCE_DIR "/examples/scenes/demo.scn")}) {
    const ViewScene scene = sceneOf(path);
    const view::ViewFrame& frame = scene.frames.front();
    std::vector<Pair> expected;
    for (std::uint32_t newer = 0; newer < scene.modelCount; ++newer) {
      for (std::uint32_t older = 0; older < newer; ++older) {
        const Verdict verdict = explain(scene, frame, newer, older).verdict;
        const bool takePart =
            verdict != Verdict::Outside && verdict != Verdict::Inactive && verdict != Verdict::NoElements;
        const bool areNear = overlap(frame.boxes[newer], frame.boxes[older], distanceOf(scene, newer, older));
        if (takePart && areNear && verdict != Verdict::Pair) expected.push_back({newer, older});
      }
    }
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(frame.excluded, expected) << path;
    EXPECT_EQ(excludedPairs(scene, frame, expected.size()), expected) << path;
    EXPECT_EQ(excludedPairs(scene, frame, expected.size() - 1), std::nullopt) << path;
  }
}

}  // namespace
}  // namespace allpairs::test
