// SPDX-License-Identifier: MIT
// What objects of one name are called, by the nodes that they are in.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "Expect.h"
#include "allpairs/scene/ReadInput.h"
#include "support/NestedGltf.h"
#include "support/Sanitizers.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// The name of a model, and where it is.
using Placed = std::pair<std::string, std::string>;

std::vector<Placed> placedOf(const scene::Scene& scene) {
  std::vector<Placed> names;
  for (std::size_t i = 0; i < scene.models.size(); ++i)
    names.emplace_back(scene.models[i]->getName(), scene.sources[i].path);
  return names;
}

scene::Scene readParts(const std::vector<Part>& parts, const scene::ReadOptions& options = {}) {
  const TempFolder folder;
  return scene::readInput(folder.write("a.gltf", nestedGltf(parts)), options);
}

std::vector<Placed> placedOf(const std::vector<Part>& parts) { return placedOf(readParts(parts)); }

const Part kBolt{"bolt", 1};

TEST(PathName, IsTheOwnNameWhereNoOtherHasIt) {
  EXPECT_EQ(placedOf({{"car", 0, {{"left door", 0, {kBolt}}, {"bonnet", 1}}}, {"horse", 1}}),
            (std::vector<Placed>{{"bolt", "car/left door/bolt"}, {"bonnet", "car/bonnet"}, {"horse", ""}}));
}

TEST(PathName, HasAsManyNodesAsTellItFromOthers) {
  const Part left{"left door", 0, {{"hinge", 0, {kBolt, kBolt}}}};
  const Part right{"right door", 0, {{"hinge", 0, {kBolt}}, kBolt}};
  EXPECT_EQ(placedOf({{"car", 0, {left, right}}, kBolt}),
            (std::vector<Placed>{{"left door/hinge/bolt", "car/left door/hinge/bolt"},
                                 {"left door/hinge/bolt#2", "car/left door/hinge/bolt#2"},
                                 {"right door/hinge/bolt", "car/right door/hinge/bolt"},
                                 {"right door/bolt", "car/right door/bolt"},
                                 {"bolt", ""}}));
}

TEST(PathName, IsNumberedWhereAllAreInOnePlace) {
  EXPECT_EQ(placedOf({{"plate", 0, {kBolt, kBolt}}}),
            (std::vector<Placed>{{"bolt", "plate/bolt"}, {"bolt#2", "plate/bolt#2"}}));
  EXPECT_EQ(placedOf({kBolt, kBolt}), (std::vector<Placed>{{"bolt", ""}, {"bolt#2", ""}}));
}

TEST(PathName, HasNoNumberThatIsAnothersName) {
  const Part numbered{"bolt#2", 1};
  EXPECT_EQ(
      placedOf({{"plate", 0, {kBolt, kBolt, numbered, kBolt}}}),
      (std::vector<Placed>{
          {"bolt", "plate/bolt"}, {"bolt#3", "plate/bolt#3"}, {"bolt#2", "plate/bolt#2"}, {"bolt#4", "plate/bolt#4"}}));
  EXPECT_EQ(placedOf({kBolt, kBolt, numbered}), (std::vector<Placed>{{"bolt", ""}, {"bolt#3", ""}, {"bolt#2", ""}}));
  const Part door{"door", 0, {kBolt}};
  EXPECT_EQ(
      placedOf({{"car", 0, {door, door, {"door#2", 0, {kBolt}}}}}),
      (std::vector<Placed>{
          {"door/bolt", "car/door/bolt"}, {"door#3/bolt", "car/door#3/bolt"}, {"door#2/bolt", "car/door#2/bolt"}}));
}

TEST(PathName, NumbersNodesOfOneNameAmongThoseThatShowSomething) {
  const Part door{"door", 0, {kBolt}};
  EXPECT_EQ(placedOf({{"car", 0, {{"door", 0, {{"lamp"}}}, door, door}}, {"cart", 0, {door}}}),
            (std::vector<Placed>{{"car/door/bolt", "car/door/bolt"},
                                 {"door#2/bolt", "car/door#2/bolt"},
                                 {"cart/door/bolt", "cart/door/bolt"}}));
}

TEST(PathName, PassesOverNodesWithoutAName) {
  const Part unnamed{"", 0, {{"", 0, {kBolt}}}};
  EXPECT_EQ(
      placedOf({{"left", 0, {unnamed}}, {"right", 0, {unnamed, unnamed}}, {"", 0, {{"pin", 1}}}}),
      (std::vector<Placed>{
          {"left/bolt", "left/bolt"}, {"right/bolt", "right/bolt"}, {"right/bolt#2", "right/bolt#2"}, {"pin", ""}}));
}

TEST(PathName, OfWhatHasNoneIsThatOfItsNodesOrTheFiles) {
  const Part unnamed{"", 1};
  EXPECT_EQ(placedOf({{"left", 0, {unnamed}}}), (std::vector<Placed>{{"a.gltf", "left"}}));
  EXPECT_EQ(placedOf({{"left", 0, {unnamed, unnamed}}, {"right", 0, {unnamed}}, unnamed}),
            (std::vector<Placed>{{"left", "left"}, {"left#2", "left/#2"}, {"right", "right"}, {"a.gltf", ""}}));
}

TEST(PathName, IsOneOfItsOwnWhateverNamesHold) {
  EXPECT_EQ(
      placedOf({{"a", 0, {{"b/c", 1}, {"\n", 1}}}, {"a/b", 0, {{"c", 1}}}, {"x", 0, {{"c", 1}, {"\n", 1}}}}),
      (std::vector<Placed>{{"b/c", "a/b/c"}, {"a/\n", "a/\n"}, {"a/b/c", "a/b/c"}, {"x/c", "x/c"}, {"x/\n", "x/\n"}}));
  // "door#2" is the name of one, and the number of another.
  const std::vector<Part> doors{{"door", 0, {kBolt}}, {"door#2", 0, {kBolt}}, {"door", 0, {kBolt}}};
  EXPECT_EQ(placedOf(doors),
            (std::vector<Placed>{
                {"door/bolt", "door/bolt"}, {"door#2/bolt", "door#2/bolt"}, {"door#3/bolt", "door#3/bolt"}}));
}

TEST(PathName, SaysNothingOfNodesFarAbove) {
  const auto chain = [](const std::string& top, int length) {
    Part part = kBolt;
    for (int i = 0; i < length; ++i) part = {"n", 0, {std::move(part)}};
    return Part{top, 0, {std::move(part)}};
  };
  std::string nodes;
  for (int i = 0; i < 63; ++i) nodes += "n/";
  EXPECT_EQ(placedOf({chain("left", 63), chain("right", 63)}),
            (std::vector<Placed>{{"left/" + nodes + "bolt", "left/" + nodes + "bolt"},
                                 {"right/" + nodes + "bolt", "right/" + nodes + "bolt"}}));
  nodes += "n/";
  EXPECT_EQ(placedOf({chain("left", 64), chain("right", 64)}),
            (std::vector<Placed>{{nodes + "bolt", nodes + "bolt"}, {nodes + "bolt#2", nodes + "bolt"}}));
}

TEST(PathName, TakesWorkAndMemoryInProportion) {
  constexpr std::size_t kMany = kIsSanitized ? 10'000 : 40'000;
  std::vector<Part> parts(kMany);
  for (std::size_t i = 0; i < kMany; ++i) parts[i] = {"door " + std::to_string(i / 2), 0, {kBolt}};
  const std::vector<Placed> doors = placedOf({{"car", 0, parts}});
  const std::string last = "door " + std::to_string(kMany / 2 - 1) + "#2/bolt";
  EXPECT_EQ(doors.back(), Placed(last, "car/" + last));
  const std::vector<Placed> bolts = placedOf({{"car", 0, std::vector<Part>(kMany, kBolt)}});
  const std::string lastBolt = "bolt#" + std::to_string(kMany);
  EXPECT_EQ(bolts.back(), Placed(lastBolt, "car/" + lastBolt));
  // The nodes that all are in have a name of a megabyte.
  expectFileError(
      [&] {
        static_cast<void>(readParts({Part{std::string(1 << 20, 'x'), 0, std::vector<Part>(1000, kBolt)}}));
      },
      "memory");
}

/// Assimp makes nodes of the file, and of the steps of a transform.
TEST(PathName, HasNoNodesThatOnlyAReaderMakes) {
  const TempFolder folder;
  const auto named = [&](const std::string& left) {
    const std::string mesh = R"(
Model: 30, "Model::bolt", "Mesh" { Properties70: { } }
Model: 31, "Model::bolt", "Mesh" { Properties70: { } }
Model: 21, "Model::right", "Null" { Properties70: { } }
Geometry: 10, "Geometry::g", "Mesh" { Vertices: *9 { a: 0,0,0,1,0,0,0,1,1 }
PolygonVertexIndex: *3 { a: 0,1,-3 } }
} )";
    return placedOf(scene::readInput(
        folder.write("a.fbx", "; FBX\nFBXHeaderExtension: { FBXVersion: 7400 }\nObjects: {\n" + left + mesh + R"(
Connections: {
C: "OO",20,0
C: "OO",21,0
C: "OO",30,20
C: "OO",31,21
C: "OO",10,30
C: "OO",10,31
})")));
  };
  const std::vector<Placed> expected{{"left/bolt", "left/bolt"}, {"right/bolt", "right/bolt"}};
  EXPECT_EQ(named(R"(Model: 20, "Model::left", "Null" { Properties70: { } })"), expected);
  EXPECT_EQ(named(R"(Model: 20, "Model::left", "Null" { Properties70: {
P: "PreRotation", "Vector3D", "Vector", "",10,0,0
P: "RotationActive", "bool", "", "",1
} })"),
            expected);
}

/// Triangles, lines and points of an object are models of their own, in one place.
TEST(PathName, IsTheSamePathForAllModelsOfAnObject) {
  const TempFolder folder;
  std::string text = nestedGltf({{"car", 0, {kBolt}}});
  const std::string primitive = R"({"attributes":{"POSITION":0}})";
  const std::size_t place = text.find(primitive);
  ASSERT_NE(place, std::string::npos);
  text.insert(place, R"({"attributes":{"POSITION":0},"mode":0},)");
  EXPECT_EQ(placedOf(scene::readInput(folder.write("a.gltf", text))),
            (std::vector<Placed>{{"bolt", "car/bolt"}, {"bolt#2", "car/bolt"}}));
}

}  // namespace
}  // namespace allpairs::test
