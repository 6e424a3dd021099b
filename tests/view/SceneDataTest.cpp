// SPDX-License-Identifier: MIT
// All that a page is given of a scene: the whole text, and the whole of each array.
#include "SceneData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace allpairs::test {
namespace {

using collision::Vec3;
using view::ViewScene;

/// The type of an array, and its numbers.
using Array = std::pair<std::string, std::vector<double>>;

/// In place of NaN, which equals nothing.
constexpr double kNoNumber = 1e99;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

template <class T>
std::vector<double> numbersAt(const std::string& bytes, std::size_t offset, std::size_t length) {
  std::vector<T> values(length);
  if (length != 0) std::memcpy(values.data(), bytes.data() + offset, length * sizeof(T));
  std::vector<double> numbers;
  for (const T value : values) {
    const auto number = static_cast<double>(value);
    numbers.push_back(std::isnan(number) ? kNoNumber : number);
  }
  return numbers;
}

/// The arrays by their names; one must begin where the one before ends, at a multiple of eight bytes.
std::map<std::string, Array> arraysOf(const view::SceneData& data) {
  std::map<std::string, Array> arrays;
  std::size_t end = 0;
  const auto json = nlohmann::json::parse(data.json);
  for (const auto& entry : json["arrays"]) {
    const auto offset = entry["offset"].get<std::size_t>();
    const auto length = entry["length"].get<std::size_t>();
    const auto type = entry["type"].get<std::string>();
    EXPECT_EQ(offset, end) << entry;
    const std::size_t size = type == "Float64" ? 8 : type == "Uint8" ? 1 : 4;
    end = offset + (length * size + 7) / 8 * 8;
    if (end > data.bytes.size()) break;
    std::vector<double> numbers = type == "Float64"   ? numbersAt<double>(data.bytes, offset, length)
                                  : type == "Float32" ? numbersAt<float>(data.bytes, offset, length)
                                  : type == "Uint32"  ? numbersAt<std::uint32_t>(data.bytes, offset, length)
                                                      : numbersAt<std::uint8_t>(data.bytes, offset, length);
    arrays[entry["name"]] = {type, std::move(numbers)};
  }
  EXPECT_EQ(end, data.bytes.size());
  return arrays;
}

ExactPair clashPair() {
  ExactPair pair;
  pair.state = ExactState::Clash;
  pair.depth = 0.25;
  pair.pointOnFirst = {1, 2, 3};
  pair.pointOnSecond = {4, 5, 6};
  pair.normal = {0, 0, -1};
  pair.contactBox = {{10, 11, 12}, {13, 14, 15}};
  pair.contactLines = {{Vec3{10, 20, 30}, Vec3{11, 22, 33}}, {Vec3{1, 1, 1}, Vec3{2, 2, 2}}};
  pair.isFirstOpen = true;
  return pair;
}

ExactPair apartPair() {
  ExactPair pair;
  pair.state = ExactState::Apart;
  pair.distance = 0.5;
  pair.contactBox = {{0, 0, 0}, {0, 0, 0}};
  pair.isSecondOpen = true;
  return pair;
}

ExactPair containedPair() {
  ExactPair pair;
  pair.state = ExactState::Contained;
  pair.depth = 3.0;
  pair.contactBox = {{0, 0, 0}, {0, 0, 0}};
  pair.contactLines = {{Vec3{5, 5, 5}, Vec3{7, 9, 11}}};
  pair.isFirstInner = true;
  return pair;
}

/// Three models and two frames; the third box of the first frame is infinite, and so has no part in the origin.
ViewScene sceneOfAll() {
  ViewScene scene;
  scene.title = "</a>";
  scene.method = "shapes";
  scene.distance = 0.5;
  scene.addsContactDistances = true;
  scene.region = Box{{-1, -2, -3}, {1, 2, 3}};
  scene.modelCount = 3;
  scene.names = {"a", "b<!--", "c"};
  scene.typeNames = {"T", "U"};
  scene.groupSets = {{}, {2, 5}};
  scene.types = {0, 1, 0};
  scene.groups = {0, 1, 1};
  scene.owners = {0, 0, 1};
  scene.elements = {12, 13, 14};
  scene.contactDistances = {0.0, 0.125, 0.25};
  scene.mesh.vertices = {10, 20, 30, 11, 20, 30, 10, 22, 33, 10, 20, 31};
  scene.mesh.triangles = {0, 1, 2};
  scene.mesh.lines = {1, 2};
  scene.mesh.points = {3};
  scene.mesh.triangleEnds = {3, 3, 3};
  scene.mesh.lineEnds = {0, 2, 2};
  scene.mesh.pointEnds = {0, 0, 1};
  scene.mesh.isShortened = true;
  scene.leavesOutExcluded = true;
  const std::vector<Box> boxes{{{2, 0, 0}, {4, 4, 6}}, {{4, 2, 2}, {8, 8, 8}}, {{-90, 0, 0}, {1, kInfinite, 1}}};
  scene.frames.push_back({.boxes = boxes, .flags = {1, 2, 4}, .pairs = {{1, 0}, {2, 0}, {2, 1}}, .excluded = {{2, 1}}});
  scene.frames.push_back({.boxes = {{{0, 1, 2}, {3, 4, 5}}, {{6, 7, 8}, {9, 10, 11}}, {{0, 0, 0}, {1, 1, 1}}},
                          .flags = {8, 16, 32},
                          .pairs = {{2, 1}},
                          .excluded = {{1, 0}, {2, 0}},
                          .began = 1,
                          .ended = 2});
  scene.ignored = {{"parts/a.scn", 3, "/A/s", "why", false}};
  scene.statistics = {"bvh", 2, 0.0, 3, 4, 5, 0.25, 0.75, true};
  scene.exact = {clashPair(), apartPair(), containedPair()};
  scene.sides = {0, 255, 1};
  scene.exactSeconds = 1.5;
  scene.clearance = 0.25;
  scene.up = -3;
  scene.isExact = true;
  scene.bodies = {0, 0, 1};
  scene.bodyNames = {"A", "B"};
  scene.kinds = {"IfcSlab", "", ""};
  scene.ids = {"id", "", ""};
  return scene;
}

TEST(SceneData, HasTheWholeSceneAsText) {
  const std::string json = dataOf(sceneOfAll()).json;
  const std::string expected =
      R"({"format":1,"version":")" ALLPAIRS_VERSION
      R"(","title":"\u003c/a>","method":"shapes","addsContactDistances":true,"models":3,"isExact":true,)"
      R"("exactSeconds":1.5,"clearance":0.25,"up":-3,"frames":2,"meshIsShortened":true,"leavesOutExcluded":true,)"
      R"("names":["a","b\u003c!--","c"],"bodyNames":["A","B"],"kinds":["IfcSlab","",""],"ids":["id","",""],)"
      R"("typeNames":["T","U"],"groupSets":[[],[2,5]],)"
      R"("statistics":{"strategy":"bvh","threads":2,"verified":true,"testsOfAllPairs":3,"testsMade":4,)"
      R"("candidates":5,"readSeconds":0.25,"detectSeconds":0.75},)"
      R"("ignored":[{"file":"a.scn","line":3,"subject":"/A/s","reason":"why"}],"arrays":[)";
  EXPECT_EQ(json.substr(0, expected.size()), expected);
}

TEST(SceneData, HasAllNumbersOfAllModelsPairsAndFrames) {
  const std::map<std::string, Array> arrays = arraysOf(dataOf(sceneOfAll()));
  const double length = std::sqrt(0.48 * 0.48 + 0.72 * 0.72 + 0.5 * 0.5);
  const auto part = [&](double value) { return static_cast<double>(static_cast<float>(value / length)); };
  const double inf = kInfinite;
  // To the right and up are turned round where z points down.
  const std::map<std::string, Array> expected{
      {"distance", {"Float64", {0.5}}},
      {"region", {"Float64", {-1, -2, -3, 1, 2, 3}}},
      {"origin", {"Float64", {5, 4, 4}}},
      {"types", {"Uint32", {0, 1, 0}}},
      {"groups", {"Uint32", {0, 1, 1}}},
      {"owners", {"Uint32", {0, 0, 1}}},
      {"bodies", {"Uint32", {0, 0, 1}}},
      {"elements", {"Uint32", {12, 13, 14}}},
      {"contactDistances", {"Float64", {0.0, 0.125, 0.25}}},
      {"exactStates", {"Uint8", {2 + 16, 7 + 32, 1 + 64}}},
      {"exactNumbers", {"Float64", {0,   0.25, 1, 2, 3, 4, 5, 6, 0, 0, -1, 10, 11, 12, 13, 14, 15,  //
                                    0.5, 1e99, 0, 0, 0, 0, 0, 0, 0, 0, 0,  0,  0,  0,  0,  0,  0,   //
                                    0,   3,    0, 0, 0, 0, 0, 0, 0, 0, 0,  0,  0,  0,  0,  0,  0}}},
      {"contactLines", {"Float32", {5, 16, 26, 6, 18, 29, -4, -3, -3, -3, -2, -2, 0, 1, 1, 2, 5, 7}}},
      {"contactLineEnds", {"Uint32", {2, 2, 3}}},
      {"exactViews", {"Float32", {part(0.48), part(0.72), part(0.5), 0, 0, 0, part(-0.48), part(0.72), part(0.5)}}},
      {"boxes", {"Float64", {2, 0, 0, 4, 4, 6, 4, 2, 2, 8, 8,  8,  -90, 0, 0, 1, inf, 1,  //
                             0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0,   0, 0, 1, 1,   1}}},
      {"flags", {"Uint8", {1, 2, 4, 8, 16, 32}}},
      {"pairs", {"Uint32", {1, 0, 2, 0, 2, 1, 2, 1}}},
      {"pairEnds", {"Uint32", {3, 4}}},
      {"excluded", {"Uint32", {2, 1, 1, 0, 2, 0}}},
      {"excludedEnds", {"Uint32", {1, 3}}},
      {"began", {"Uint32", {0, 1}}},
      {"ended", {"Uint32", {0, 2}}},
      {"vertices", {"Float32", {5, 16, 26, 6, 16, 26, 5, 18, 29, 5, 16, 27}}},
      {"triangles", {"Uint32", {0, 1, 2}}},
      {"triangleEnds", {"Uint32", {3, 3, 3}}},
      {"lines", {"Uint32", {1, 2}}},
      {"lineEnds", {"Uint32", {0, 2, 2}}},
      {"points", {"Uint32", {3}}},
      {"pointEnds", {"Uint32", {0, 0, 1}}},
      {"positions", {"Float32", {}}},
      {"corners", {"Uint32", {}}}};
  EXPECT_EQ(arrays, expected);
}

TEST(SceneData, OfASequenceOfMeshesHasPositionsInPlaceOfBoxes) {
  ViewScene scene;
  scene.modelCount = 1;
  scene.corners = {0, 1, 2};
  for (const double z : {0.5, 0.75}) {
    scene.frames.push_back({.boxes = {{{0, 0, 0}, {1, 1, z}}},
                            .flags = {7},
                            .pairs = {},
                            .excluded = {},
                            .positions = {0, 0, 0, 1, 0, z, 0, 1, 0}});
  }
  std::map<std::string, Array> arrays = arraysOf(dataOf(scene));
  const Array positions{"Float32", {0, 0, 0, 1, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0.75, 0, 1, 0}};
  EXPECT_EQ(arrays["positions"], positions);
  EXPECT_EQ(arrays["corners"], (Array{"Uint32", {0, 1, 2}}));
  EXPECT_EQ(arrays["boxes"], (Array{"Float64", {}}));
  EXPECT_EQ(arrays["origin"], (Array{"Float64", {0.5, 0.5, 0.25}}));
  scene.frames[1].positions[5] = 0.1;
  arrays = arraysOf(dataOf(scene));
  EXPECT_EQ(arrays["positions"].first, "Float64") << "0.1 is no float32";
  EXPECT_EQ(arrays["positions"].second[14], 0.1);
  scene.frames.front().boxes = {kEmptyBox};
  EXPECT_EQ(arraysOf(dataOf(scene))["origin"], (Array{"Float64", {0, 0, 0}})) << "nothing is finite";
}

}  // namespace
}  // namespace allpairs::test
