// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Expect.h"
#include "SceneText.h"
#include "allpairs/scene/ReadInput.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

scene::Scene readOff(const std::string& text) {
  const TempFolder folder;
  return scene::readInput(folder.write("mesh.off", text));
}

void expectOffProblem(const std::string& text, const std::string& part) {
  expectFileError([&] { (void)readOff(text); }, part);
}

constexpr const char* kSquare = "0 0 0\n1 0 0\n1 0.1 0\n0 0.1 0\n";

TEST(OffMesh, IsReadInDoubleAndNamedAfterItsFile) {
  const scene::Scene scene = readOff(std::string("OFF\n4 1 0\n") + kSquare + "4 0 1 2 3\n");
  EXPECT_EQ(namesOf(scene), "mesh.off TTriangleModel 2\n");
  EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 0}, {1, 0.1, 0}}));
}

TEST(OffMesh, CountsMayFollowTheFirstWordAndCommentsAndColoursArePassedOver) {
  const std::string face = "4 0 1 2 3\n";
  for (const std::string& text :
       {std::string("OFF 4 1 0\n") + kSquare + face, std::string("OFF4 1 0\n") + kSquare + face,
        std::string("# made by hand\n\nOFF # what it is\n4 1\n") + kSquare + "4  0 1 2 3  0.5 0.5 0.5 # grey",
        std::string("COFF\r\n4 1 0\r\n0 0 0 1 1 1 1\r\n1 0 0 1 1 1 1\r\n1 1 0 1 1 1 1\r\n0 1 0 1 1 1 1\r\n") + face}) {
    EXPECT_EQ(namesOf(readOff(text)), "mesh.off TTriangleModel 2\n") << text;
  }
}

TEST(OffMesh, TheFirstWordMayBeMissingAndTheCountsOnSeveralLines) {
  const std::string rest = kSquare + std::string("4 0 1 2 3\n");
  for (const std::string& text : {"4 1 0\n" + rest, "# made by hand\n4 1 0\n" + rest, "OFF\n4 1\n0\n" + rest,
                                  "OFF\n4\n1\n0\n" + rest, "OFF 4\n1 0\n" + rest, "4\n1 # faces\n\n0\n" + rest}) {
    const scene::Scene scene = readOff(text);
    EXPECT_EQ(namesOf(scene), "mesh.off TTriangleModel 2\n") << text;
    EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 0}, {1, 0.1, 0}})) << text;
  }
  expectOffProblem("OFF\n4\n", "mesh.off:2: truncated: its header promises more than the file has");
  expectOffProblem("OFF\n4\nx\n", "mesh.off:3: 'x' is not a number of vertices or faces");
}

TEST(OffMesh, FacesOfTwoAreLinesThoseOfOnePointsAndVerticesAlonePoints) {
  EXPECT_EQ(namesOf(readOff(std::string("OFF\n4 3 0\n") + kSquare + "2 0 1\n1 2\n3 0 1 2\n")),
            "mesh.off TTriangleModel 1\nmesh.off#2 TLineModel 1\nmesh.off#3 TPointModel 1\n");
  EXPECT_EQ(namesOf(readOff(std::string("OFF\n4 0 0\n") + kSquare)), "mesh.off TPointModel 4\n");
}

TEST(OffMesh, FilesCutAnywhereAreRefused) {
  const TempFolder folder;
  const std::string text = std::string("OFF\n4 2 0\n") + kSquare + "3 0 1 2\n3 0 2 3";
  for (std::size_t length = 0; length < text.size(); ++length) {
    const auto path = folder.write("cut.off", std::string_view(text).substr(0, length));
    expectFileError([&] { (void)scene::readInput(path); }, "cut.off:");
  }
}

TEST(OffMesh, HugeClaimsEndWithTheFile) {
  expectOffProblem("OFF\n99999999 99999999 0\n0 0 0\n",
                   "mesh.off:3: truncated: its header promises more than the file has");
  expectOffProblem("OFF\n99999999999 1 0\n", "mesh.off:2: claims more vertices than can be numbered");
}

TEST(OffMesh, ErrorsNameTheLine) {
  expectOffProblem(" \n", "mesh.off: is empty");
  expectOffProblem("4OFF\n1 1 0\n", "mesh.off:1: is no OFF file of points in space: its first word is '4OFF'");
  expectOffProblem("OFF BINARY\n", "mesh.off:1: is a binary OFF file");
  expectOffProblem("OFF\n-1 -1 0\n", "mesh.off:2: '-1' is not a number of vertices or faces");
  expectOffProblem("OFF\n1 0 0\n0 0\n", "mesh.off:3: a position has three coordinates");
  expectOffProblem("OFF\n1 0 0\n0 0 nan\n", "mesh.off:3: 'nan' is no finite number");
  const std::string square = std::string("OFF\n4 1 0\n") + kSquare;
  expectOffProblem(square + "3 0 1 4\n", "mesh.off:7: index 4 names no vertex: the file has 4");
  expectOffProblem(square + "3 0 1 -1\n", "mesh.off:7: index -1 names no vertex");
  expectOffProblem(square + "3 0 1\n", "mesh.off:7: a face names 2 vertices instead of 3");
  expectOffProblem(square + "0\n", "mesh.off:7: a face has no vertices");
  expectOffProblem(square + "3 0 1 2\n# a comment\n\n3 0 1 3\n", "mesh.off:10: has more than its header promises");
}

}  // namespace
}  // namespace allpairs::test
