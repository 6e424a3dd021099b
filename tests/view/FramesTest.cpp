// SPDX-License-Identifier: MIT
// What pages are given of inputs: boxes and meshes over time, frame by frame, and what inputs and boxes are called.
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "app/view/MakeViewScene.h"
#include "app/view/ViewFrames.h"
#include "support/Npy.h"
#include "support/Oracle.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

using view::ViewScene;

app::InputSettings inputOf(const std::vector<std::string>& paths) {
  app::InputSettings input;
  input.paths = paths;
  return input;
}

/// The pairs of boxes of which both touch a region, the newer one first, as the double loop meets them.
std::vector<Pair> newestFirst(const std::vector<Box>& boxes, double distance, const Box& region) {
  std::vector<Pair> pairs;
  for (std::uint32_t newer = 0; newer < boxes.size(); ++newer) {
    for (std::uint32_t older = 0; older < newer; ++older) {
      const bool areIn =
          overlapByOracle(boxes[newer], region, distance) && overlapByOracle(boxes[older], region, distance);
      if (areIn && overlapByOracle(boxes[newer], boxes[older], distance)) pairs.push_back({newer, older});
    }
  }
  return pairs;
}

std::size_t countMissing(const std::vector<Pair>& pairs, const std::vector<Pair>& in) {
  return static_cast<std::size_t>(std::count_if(
      pairs.begin(), pairs.end(), [&](const Pair& p) { return std::find(in.begin(), in.end(), p) == in.end(); }));
}

TEST(Frames, OfBoxesHaveThePairsOfTheDoubleLoopAndWhatChanges) {
  constexpr std::size_t kEach = 6, kFrames = 7;
  app::ViewRequest request;
  request.detection.distance = 0.25;
  request.detection.region = Box{{-1, -1, -1}, {6, 2, 2}};
  std::vector<Box> all;
  for (std::size_t i = 0; i < kEach * kFrames; ++i) {  // some stand, others run through them
    const std::size_t box = i % kEach;
    const double x = box % 2 == 0 ? static_cast<double>(box) / 2.0 : static_cast<double>((i / kEach * 3 + box) % 9);
    all.push_back({{x, 0, 0}, {x + 0.75, 1, 1}});
  }
  const TempFolder folder;
  const std::string input = folder.write("f.npy", npyBytes(all, {.shape = "(7, 6, 6)"}));
  const ViewScene scene = app::makeViewScene(inputOf({input}), request);
  EXPECT_EQ(scene.title, "f.npy");
  EXPECT_EQ(scene.method, "boxes at most 0.25 apart on every axis, in the region [-1, -1, -1] to [6, 2, 2], 7 frames");
  EXPECT_EQ(scene.distance, 0.25);
  EXPECT_EQ(scene.modelCount, kEach);
  EXPECT_EQ(scene.statistics.testsOfAllPairs, kFrames * kEach * (kEach - 1) / 2);
  ASSERT_EQ(scene.frames.size(), kFrames);
  std::vector<Pair> before;
  std::size_t began = 0, ended = 0, kept = 0, outside = 0;
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    const std::vector<Box> boxes(all.begin() + static_cast<std::ptrdiff_t>(frame * kEach),
                                 all.begin() + static_cast<std::ptrdiff_t>((frame + 1) * kEach));
    const view::ViewFrame& shown = scene.frames[frame];
    EXPECT_EQ(shown.boxes, boxes);
    const std::vector<Pair> pairs = newestFirst(boxes, 0.25, *request.detection.region);
    EXPECT_EQ(shown.pairs, pairs) << frame;
    EXPECT_EQ(shown.began, countMissing(pairs, before)) << frame;
    EXPECT_EQ(shown.ended, countMissing(before, pairs)) << frame;
    for (std::size_t i = 0; i < kEach; ++i) {
      const bool isOutside = !overlapByOracle(boxes[i], *request.detection.region, 0.25);
      EXPECT_EQ(shown.flags[i], isOutside ? 7 + 16 : 7) << frame << ' ' << i;
      outside += isOutside ? 1U : 0U;
    }
    kept += pairs.size() - shown.began;
    before = pairs;
    began += shown.began;
    ended += frame == 0 ? 0 : shown.ended;
  }
  EXPECT_GT(began, 10U) << "there is something to count";
  EXPECT_GT(ended, 10U);
  EXPECT_GT(kept, 10U);
  EXPECT_GT(outside, 3U);
}

TEST(Frames, OfMeshesHaveTheirTrianglesNumberedByMesh) {
  const TempFolder folder;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
  const std::string two = "o left\n" + vertices + "f 1 2 3\nf 4 3 2\no right\n" + vertices + "f 5 6 8\n";
  std::vector<std::string> files{folder.write("0.obj", two), folder.write("1.obj", two)};
  ViewScene scene = app::makeViewFrames(inputOf(files), {});
  EXPECT_EQ(scene.names, (std::vector<std::string>{"left: triangle 0", "left: triangle 1", "right: triangle 0"}));
  EXPECT_EQ(scene.corners.size(), 9U);
  EXPECT_EQ(scene.modelCount, 3U);
  EXPECT_EQ(scene.elements, (std::vector<std::uint32_t>{1, 1, 1}));
  EXPECT_EQ(scene.typeNames, std::vector<std::string>{"Triangle"});
  EXPECT_EQ(scene.method, "boxes, 2 frames; triangles that share a vertex are never paired");
  for (const view::ViewFrame& frame : scene.frames) {
    EXPECT_EQ(frame.pairs, (std::vector<Pair>{{2, 0}, {2, 1}})) << "those of one mesh share vertices";
    for (std::size_t i = 0; i < 3; ++i) {
      Box box = kEmptyBox;
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
        const double* p = &frame.positions.at(3 * std::size_t{scene.corners[k]});
        box = merge(box, Box{{p[0], p[1], p[2]}, {p[0], p[1], p[2]}});
      }
      EXPECT_EQ(frame.boxes[i], box);
    }
  }
  const std::string one = folder.write("one.obj", vertices + "f 1 2 3\nf 4 3 2\n");
  EXPECT_EQ(app::makeViewFrames(inputOf({one}), {}).names, (std::vector<std::string>{"triangle 0", "triangle 1"}));
}

TEST(Names, OfInputsAreListedUpToThree) {
  const TempFolder folder;
  std::vector<std::string> files;
  const auto title = [&files] { return app::makeViewScene(inputOf(files), {}).title; };
  for (const char* name : {"a", "b", "c", "d"})
    files.push_back(folder.write(std::string(name) + ".csv", "0,0,0,1,1,1\n"));
  EXPECT_EQ(title(), "a.csv and 3 more");
  files.pop_back();
  EXPECT_EQ(title(), "a.csv, b.csv, c.csv");
  folder.write("parts/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  files = {folder.path() / "parts/"};
  EXPECT_EQ(title(), "parts");
}

TEST(Names, OfBoxesThatAreOnlyTheirNumbersAreLeftOut) {
  const TempFolder folder;
  const auto namesOf = [&folder](const std::string& text) {
    return app::makeViewScene(inputOf({folder.write("b.csv", text)}), {}).names;
  };
  EXPECT_EQ(namesOf("0,0,0,1,1,1\n5,5,5,6,6,6\n"), std::vector<std::string>());
  EXPECT_EQ(namesOf("a,0,0,0,1,1,1\n1,5,5,5,6,6,6\n"), (std::vector<std::string>{"a", "1"}));
}

}  // namespace
}  // namespace allpairs::test
