// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "Expect.h"
#include "SceneText.h"
#include "allpairs/scene/ReadInput.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

scene::Scene readStl(const std::string& bytes) {
  const TempFolder folder;
  return scene::readInput(folder.write("mesh.stl", bytes));
}

void expectStlProblem(const std::string& bytes, const std::string& part) {
  expectFileError([&] { (void)readStl(bytes); }, part);
}

std::string facetText(const std::string& lastVertex) {
  return "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex " + lastVertex +
         "\n endloop\nendfacet\n";
}

std::string solid(const std::string& name, const std::string& facets) {
  return "solid " + name + "\n" + facets + "endsolid " + name + "\n";
}

/// A binary file whose 80 bytes begin with `start`.
std::string binaryStl(std::string start, const std::vector<float>& coordinates) {
  start.resize(80, ' ');
  appendNumber(start, static_cast<std::uint32_t>(coordinates.size() / 9), false);
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    if (i % 9 == 0) start.append(12, '\0');
    appendNumber(start, coordinates[i], false);
    if (i % 9 == 8) start.append(2, '\0');
  }
  return start;
}

const std::vector<float> kTwoFacets{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 5};

TEST(StlMesh, SolidsKeepTheirWholeNamesAndAreReadInDouble) {
  const scene::Scene scene = readStl(solid("two words", facetText("0 0.1 0") + facetText("0 0 0.1")) +
                                     solid("", facetText("0 1 0")) + solid("two words", facetText("0 7 0")));
  EXPECT_EQ(namesOf(scene), "two words TTriangleModel 2\nmesh.stl TTriangleModel 1\ntwo words#2 TTriangleModel 1\n");
  EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 0}, {1, 0.1, 0.1}}));
}

TEST(StlMesh, WordsMayBeInCapitalsAndLinesEndAsElsewhere) {
  EXPECT_EQ(namesOf(readStl("SOLID a\r\nFACET NORMAL 0 0 1\r\nOUTER LOOP\r\nVERTEX 0 0 0\r\nVERTEX 1 0 0\r\n"
                            "VERTEX 0 1 0\r\nENDLOOP\r\nENDFACET\r\nENDSOLID\r\n")),
            "a TTriangleModel 1\n");
  const std::string facet = "facet normal nan 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 2 9 endloop endfacet\n";
  const scene::Scene scene = readStl("\xEF\xBB\xBF" + solid("vertex outer", facetText("0 1 0") + facet));
  EXPECT_EQ(namesOf(scene), "vertex outer TTriangleModel 2\n");
  EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 0}, {1, 2, 9}})) << "a facet in one line";
  std::string mac = solid("a", facetText("0 1 0"));
  std::replace(mac.begin(), mac.end(), '\n', '\r');
  EXPECT_EQ(namesOf(readStl(mac)), "a TTriangleModel 1\n");
}

TEST(StlMesh, BinaryFilesMayBeginWithSolid) {
  for (const char* start : {"", "solid of a program that does not care"}) {
    for (const char* end : {"", "\n", "what some programs add"}) {
      const scene::Scene scene = readStl(binaryStl(start, kTwoFacets) + end);
      EXPECT_EQ(namesOf(scene), "mesh.stl TTriangleModel 2\n");
      EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 0}, {1, 1, 5}}));
    }
  }
}

TEST(StlMesh, BinaryFilesWithMoreFacetsThanTheirHeaderSaysAreRefused) {
  std::string bytes = binaryStl("", kTwoFacets);
  bytes[80] = 1;
  expectStlProblem(bytes, "mesh.stl: has 2 facets where its header says 1");
  bytes[80] = 0;
  expectStlProblem(bytes, "mesh.stl: has 2 facets where its header says 0");
}

TEST(StlMesh, BinaryFilesMayEndInZeros) {
  for (const std::size_t zeros : {49U, 50U, 100U}) {
    EXPECT_EQ(namesOf(readStl(binaryStl("", kTwoFacets) + std::string(zeros, '\0'))), "mesh.stl TTriangleModel 2\n");
  }
}

TEST(StlMesh, WhatStandsBehindTheFacetsOfABinaryFileIsNotLost) {
  const std::string bytes = binaryStl("", kTwoFacets);
  expectStlProblem(bytes + bytes, "mesh.stl: has 184 bytes behind the 2 facets that its header promises");
  expectStlProblem(bytes + bytes, "a binary STL file holds one solid");
  expectStlProblem(bytes + solid("a", facetText("0 1 0")), "a binary STL file holds one solid");
  expectStlProblem(bytes + std::string(51, 'x'), "mesh.stl: has 51 bytes behind the 2 facets that its header promises");
  EXPECT_EQ(namesOf(readStl(bytes + std::string(60, ' ') + "\r\n")), "mesh.stl TTriangleModel 2\n") << "blanks";
}

TEST(StlMesh, FilesCutAnywhereAreRefused) {
  const TempFolder folder;
  const std::string text = solid("a", facetText("0 1 0") + facetText("0 0 1"));
  const std::size_t last = text.rfind("endsolid") + 8;
  for (const std::string& bytes : {text.substr(0, last), binaryStl("", kTwoFacets), binaryStl("solid", kTwoFacets)}) {
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      const auto path = folder.write("cut.stl", std::string_view(bytes).substr(0, length));
      expectFileError([&] { (void)scene::readInput(path); }, "cut.stl:");
    }
  }
}

TEST(StlMesh, ErrorsNameTheLine) {
  expectStlProblem("", "mesh.stl: is empty");
  expectStlProblem("hello", "mesh.stl: is too short for an STL file");
  expectStlProblem("solid a\nendsolid a\n", "mesh.stl: holds no triangles");
  expectStlProblem("solid a\n" + facetText("0 1 0"), "mesh.stl:8: ends within a solid");
  expectStlProblem("solid a\nsolid b\n", "mesh.stl:2: a solid begins within another");
  expectStlProblem(solid("a", facetText("0 1")), "mesh.stl:6: a vertex has three coordinates");
  expectStlProblem(solid("a", facetText("0 nan 0")), "mesh.stl:6: 'nan' is no finite number");
  expectStlProblem(solid("a", facetText("0 1 0\nvertex 0 0 1")), "mesh.stl:9: a facet has three vertices, not 4");
  expectStlProblem("solid a\nhello\n", "mesh.stl:2: 'hello' is no word of STL");
  expectStlProblem("solid a\nendsolid\nendfacet\n", "mesh.stl:3: a facet or its end stands outside of any solid");
  std::vector<float> bad = kTwoFacets;
  bad[10] = std::numeric_limits<float>::infinity();
  expectStlProblem(binaryStl("", bad), "mesh.stl: facet 1 has a coordinate that is no finite number");
}

TEST(StlMesh, ColoursAreNoGeometry) {
  EXPECT_EQ(namesOf(readStl("solid a\ncolor 1 0 0.5\n" + facetText("0 1 0") + "endsolid a\n")), "a TTriangleModel 1\n");
}

TEST(StlMesh, PiecesThatEndOrBeginTooEarlyAreRefused) {
  const std::string two = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  expectStlProblem("solid a\n" + facetText("0 1 0") + two + "endsolid a\n", "a facet has three vertices, not 2");
  expectStlProblem("solid a\n" + two + "facet normal 0 0 1\nouter loop\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n",
                   "mesh.stl:6: a facet has three vertices, not 2");
  expectStlProblem("solid a\nendsolid\nvertex 0 0 0\n", "mesh.stl:3: a vertex stands outside of any solid");
  expectStlProblem("solid a\nendsolid\nfacet normal 0 0 1\n", "mesh.stl:3: a facet or its end stands outside of any");
}

TEST(StlMesh, HugeClaimsEndWithTheFile) {
  std::string bytes(80, '\0');
  appendNumber(bytes, std::numeric_limits<std::uint32_t>::max(), false);
  expectStlProblem(bytes + std::string(50, '\0'),
                   "mesh.stl: truncated: the header promises 214748364834 bytes, the file has 134");
}

TEST(StlMesh, TheWordsOfASolidMayStandInOneLine) {
  const std::string facet = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet ";
  const std::string far = "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 9 0 endloop endfacet ";
  EXPECT_EQ(namesOf(readStl("solid two words " + facet + far + "endsolid two words")), "two words TTriangleModel 2\n");
  EXPECT_EQ(namesOf(readStl("solid a " + facet + "\n" + far + "\nendsolid a\n")), "a TTriangleModel 2\n");
  EXPECT_EQ(namesOf(readStl("SOLID A " + facet + "ENDSOLID A\nsolid  " + far + "endsolid")),
            "A TTriangleModel 1\nmesh.stl TTriangleModel 1\n");
  EXPECT_EQ(namesOf(readStl("solid a\ncolor 1 0 0 " + facet + "\n" + far + "endsolid\n")), "a TTriangleModel 2\n");
  EXPECT_EQ(namesOf(readStl("solid normal facet\n" + facet + "\nendsolid normal facet\n")),
            "normal facet TTriangleModel 1\n");
  for (const std::string name : {"facet normal", "a facet normal map"})
    EXPECT_EQ(namesOf(readStl("solid " + name + '\n' + facet + "\nendsolid " + name + "\n")),
              name + " TTriangleModel 1\n");
  EXPECT_EQ(namesOf(readStl("solid a facet " + facet + "endsolid a facet")), "a facet TTriangleModel 1\n");
  const std::string both = "solid a\n" + facet + "\nendsolid a solid b " + far + "endsolid b\n";
  expectStlProblem(both, "mesh.stl:3: a facet stands behind the end of a solid");
  expectStlProblem("solid a\n" + facet + "endsolid a solid b " + far + "endsolid b\n",
                   "mesh.stl:2: a facet stands behind the end of a solid");
}

TEST(StlMesh, ABinaryFileThatBeginsWithSolidAndIsCutIsTruncated) {
  for (const char filling : {'\0', ' '}) {
    const std::string bytes = binaryStl("solid a" + std::string(73, filling), kTwoFacets);
    expectStlProblem(bytes.substr(0, 150), "mesh.stl: truncated: the header promises 184 bytes, the file has 150");
  }
}

/// A reader that copied the rest of the line for each facet would take half a minute.
TEST(StlMesh, AllFacetsMayStandInOneLine) {
  std::string facets;
  for (int i = 0; i < 30'000; ++i)
    facets += "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet ";
  EXPECT_EQ(namesOf(readStl(solid("a", facets + "\n"))), "a TTriangleModel 30000\n");
}

}  // namespace
}  // namespace allpairs::test
