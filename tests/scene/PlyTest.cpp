// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "Expect.h"
#include "SceneText.h"
#include "allpairs/collision/LineModel.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadInput.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

constexpr const char* kVertices = "element vertex 4\nproperty double x\nproperty double y\nproperty float32 z\n";

scene::Scene read(const std::string& bytes) {
  const TempFolder folder;
  return scene::readInput(folder.write("mesh.ply", bytes));
}

std::string ascii(const std::string& elements, const std::string& body) {
  return "ply\nformat ascii 1.0\ncomment made by hand\n" + elements + "end_header\n" + body;
}

/// A quad as binary: four vertices and one face of four.
std::string binary(bool bigEndian) {
  std::string bytes = std::string("ply\nformat ") + (bigEndian ? "binary_big_endian" : "binary_little_endian") +
                      " 1.0\n" + kVertices + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {0.1, 0.0}, {0.1, 2.0}, {0.0, 2.0}}) {
    appendNumber(bytes, x, bigEndian);
    appendNumber(bytes, y, bigEndian);
    appendNumber(bytes, 3.0F, bigEndian);
  }
  bytes += '\x04';
  for (const std::int32_t index : {0, 1, 2, 3}) appendNumber(bytes, index, bigEndian);
  return bytes;
}

std::string quad() {
  return ascii(std::string(kVertices) + "element face 1\nproperty list uchar int vertex_indices\n",
               "0 0 3\n0.1 0 3\n0.1 2 3\n0 2 3\n4 0 1 2 3\n");
}

TEST(PlyMesh, TextAndBothByteOrdersGiveTheSameInDouble) {
  for (const std::string& bytes : {quad(), binary(false), binary(true)}) {
    const scene::Scene scene = read(bytes);
    ASSERT_EQ(namesOf(scene), "mesh.ply TTriangleModel 2\n");
    EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 3}, {0.1, 2, 3}}));
  }
}

TEST(PlyMesh, EdgesAreLinesStripsAreTrianglesAndVerticesAlonePoints) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  EXPECT_EQ(namesOf(read(ascii(std::string(kVertices) + "element edge 1\nproperty int vertex1\nproperty int vertex2\n",
                               body + "0 3\n"))),
            "mesh.ply TLineModel 1\n");
  EXPECT_EQ(namesOf(read(ascii(std::string(kVertices) + "element tristrips 1\nproperty list int int vertex_indices\n",
                               body + "8 0 1 2 3 -1 0 1 2\n"))),
            "mesh.ply TTriangleModel 3\n");
  EXPECT_EQ(namesOf(read(ascii(kVertices, body))), "mesh.ply TPointModel 4\n");
}

TEST(PlyMesh, EdgesMayHaveMoreThanTheirEnds) {
  const auto scene = read(ascii(std::string(kVertices) +
                                    "element edge 2\nproperty int before\nproperty int vertex1\nproperty int between\n"
                                    "property int vertex2\nproperty int weight\n",
                                "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 2 3 2\n2 1 0 2 3\n"));
  const auto& model = dynamic_cast<const collision::LineModel&>(*scene.models[0]);
  using Lines = std::vector<collision::LineModel::Line>;
  EXPECT_EQ(model.lines(), (Lines{{0, 3}, {1, 2}}));
}

TEST(PlyMesh, OfStripsNothingIsThereThatOnlyLeadsToTheNextPiece) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n9 0 0\n8 0 0\n9 1 0\n";
  const auto scene =
      read(ascii("element vertex 7\nproperty float x\nproperty float y\nproperty float z\n"
                 "element tristrips 1\nproperty list int int vertex_indices\n",
                 body + "9 0 1 2 3 3 4 4 5 6\n"));
  const auto& model = dynamic_cast<const collision::TriangleModel&>(*scene.models[0]);
  using Triangles = std::vector<collision::TriangleModel::Triangle>;
  EXPECT_EQ(model.triangles(), (Triangles{{0, 1, 2}, {2, 1, 3}, {4, 5, 6}})) << "and all face one way";
}

TEST(PlyMesh, PropertiesOfOtherNamesAndFacesThatAreNoneAreNoProblem) {
  const std::string vertices =
      "element vertex 1\nproperty float a\nproperty float x\nproperty float y\n"
      "property float z\nproperty float s\nelement face 0\nproperty int other\n";
  const scene::Scene scene = read(ascii(vertices, "7 1 2 3 8\n"));
  EXPECT_EQ(namesOf(scene), "mesh.ply TPointModel 1\n");
  EXPECT_EQ(boxOf(*scene.models[0]), (Box{{1, 2, 3}, {1, 2, 3}}));
}

TEST(PlyMesh, ListsAndIndicesAreWholeNumbersFromZeroOn) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const auto expectRefused = [&](const std::string& element, const std::string& row, const std::string& part) {
    expectFileError([&] { (void)read(ascii(kVertices + element, body + row)); }, part);
  };
  const std::string faces = "element face 1\nproperty list float float vertex_indices\n";
  expectRefused(faces, "-1\n", "face 0 has a list without a proper length");
  expectRefused(faces, "2.5 0 1 2\n", "face 0 has a list without a proper length");
  expectRefused(faces, "3 0 1 1.5\n", "face 0 has an index that names no vertex");
  expectRefused("element face 1\nproperty list uchar double vertex_indices\n", "3 0 1 4294967298\n",
                "face 0 has an index that names no vertex");
  expectRefused("element tristrips 1\nproperty list int int vertex_indices\n", "4 0 1 2 -2\n",
                "has an index that names no vertex");
  expectRefused("element edge 1\nproperty int vertex1\nproperty int vertex2\n", "0 4\n", "edge 0 names vertex 4 of 4");
}

TEST(PlyMesh, FilesCutAnywhereAreRefused) {
  const TempFolder folder;
  for (const std::string& bytes : {quad(), binary(false)}) {
    const std::size_t end = bytes.find_last_not_of('\n');
    for (std::size_t length = 0; length <= end; ++length) {
      const auto path = folder.write("cut.ply", std::string_view(bytes).substr(0, length));
      EXPECT_THROW((void)scene::readInput(path), FileError) << length;
    }
  }
}

TEST(PlyMesh, WhatStandsBehindTheEndOfABinaryFileIsNotLost) {
  const std::string bytes = binary(false);
  const std::string face = bytes.substr(bytes.size() - 17);
  expectFileError([&] { (void)read(bytes + bytes); },
                  "mesh.ply: has " + std::to_string(bytes.size()) + " bytes behind");
  expectFileError([&] { (void)read(bytes + face); }, "mesh.ply: has 17 bytes behind what its header promises");
  for (const std::string& filling : {std::string("\n"), std::string(100, '\0'), std::string(" \r\n")})
    EXPECT_EQ(namesOf(read(bytes + filling)), "mesh.ply TTriangleModel 2\n");
}

TEST(PlyMesh, HugeClaimsEndWithTheFile) {
  const std::string huge =
      "element vertex 18446744073709551615\nproperty float x\nproperty float y\nproperty float z\n";
  expectFileError([&] { (void)read(ascii(huge, "0 0 0\n")); }, "truncated: its header promises more than the file has");
  expectFileError([&] { (void)read(ascii("element nothing 18446744073709551615\n", "")); }, "holds no triangles");
  expectFileError(
      [&] {
        (void)read(ascii(std::string(kVertices) + "element face 1\nproperty list uint int vertex_indices\n",
                         "0 0 0\n1 0 0\n0 1 0\n1 1 0\n4294967295 0 1 2\n"));
      },
      "truncated: its header promises more than the file has");
}

TEST(PlyMesh, ErrorsNameTheLine) {
  expectFileError([] { (void)read("plx\n"); }, "mesh.ply:1:");
  expectFileError([] { (void)read("ply\nformat ascii 1.0\nelement vertex many\nend_header\n"); }, "mesh.ply:3:");
  expectFileError([] { (void)read("ply\nformat ascii 1.0\nproperty float x\nend_header\n"); }, "mesh.ply:3:");
  expectFileError([] { (void)read("ply\nformat ascii 1.0\nelement v 1\nproperty real x\nend_header\n"); }, "'real'");
  expectFileError([] { (void)read(ascii(kVertices, "0 0 0\n1 x 0\n")); }, "mesh.ply:10: 'x' is not a number");
  expectFileError(
      [] {
        (void)read(ascii(std::string(kVertices) + "element face 1\nproperty list uchar int vertex_index\n",
                         "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 4\n"));
      },
      "face 0 names vertex 4 of 4");
  expectFileError([] { (void)read(ascii(kVertices, "0 0 0\n1 nan 0\n0 1 0\n1 1 0\n")); },
                  "mesh.ply:10: vertex 1 has a coordinate that is missing or no finite number");
  expectFileError([] { (void)read(ascii(kVertices, "0 0 0\n1 0 0\n0 1 0\n1 1 0\n\n5 5 5\n")); },
                  "mesh.ply:14: has more than its header promises");
  expectFileError(
      [] {
        (void)read(ascii(std::string(kVertices) + "element face 1\nproperty list uchar int corners\n",
                         "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n"));
      },
      "mesh.ply: its faces have no list 'vertex_indices'");
}

TEST(PlyMesh, ErrorsFoundAtTheEndNameTheLineOfTheFace) {
  const std::string head = std::string(kVertices) + "element face 3\nproperty list uchar int vertex_index\n";
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  expectFileError([&] { (void)read(ascii(head, vertices + "3 0 1 2\n\n3 0 1 4\n3 0 1 2\n")); },
                  "mesh.ply:17: face 1 names vertex 4 of 4");
  expectFileError([&] { (void)read(ascii(head, vertices + "3 0 1 4\n3 0 1\n2\n3 0 1 4\n")); },
                  "mesh.ply:15: face 0 names vertex 4 of 4");
  std::string bytes = binary(false);
  bytes[bytes.size() - 4] = 9;
  expectFileError([&] { (void)read(bytes); }, "mesh.ply: face 0 names vertex 9 of 4");
}

/// As of old Macs. Greg Turk's description of the format has the lines of its header end in a carriage return.
TEST(PlyMesh, LinesMayEndInACarriageReturnAlone) {
  const auto inReturns = [](std::string text, const std::string& lineEnd) {
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + lineEnd.size()))
      text.replace(at, 1, lineEnd);
    return text;
  };
  EXPECT_EQ(namesOf(read(inReturns(quad(), "\r"))), "mesh.ply TTriangleModel 2\n");
  EXPECT_EQ(namesOf(read(inReturns(quad(), "\r\n"))), "mesh.ply TTriangleModel 2\n");
  EXPECT_EQ(namesOf(read(inReturns(quad(), "\r\r\n"))), "mesh.ply TTriangleModel 2\n");
  expectFileError([&] { (void)read(inReturns(ascii(kVertices, "0 0 0\n1 x 0\n"), "\r")); },
                  "mesh.ply:10: 'x' is not a number");
  for (const bool bigEndian : {false, true}) {
    const std::string bytes = binary(bigEndian);
    const std::size_t body = bytes.find("end_header\n") + 11;
    const scene::Scene scene = read(inReturns(bytes.substr(0, body), "\r") + bytes.substr(body));
    EXPECT_EQ(namesOf(scene), "mesh.ply TTriangleModel 2\n");
    EXPECT_EQ(boxOf(*scene.models[0]), (Box{{0, 0, 3}, {0.1, 2, 3}}));
  }
}

/// As MeshLab's library writes meshes of tetrahedra; as faces of four corners they lacked two of their four sides.
TEST(PlyMesh, TetrahedraAreRefused) {
  const std::string list = "\nproperty list uchar int vertex_indices\n";
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  expectFileError([&] { (void)read(ascii(kVertices + ("element tetra 1" + list), vertices + "4 0 1 2 3\n")); },
                  "mesh.ply: has tetrahedra, which are not read: export their surface");
  EXPECT_EQ(namesOf(read(ascii(kVertices + ("element tetra 0" + list), vertices))), "mesh.ply TPointModel 4\n");
}

TEST(PlyMesh, EdgesAndStripsWhoseVerticesGoByOtherNamesAreRefused) {
  const auto expectRefused = [](const std::string& element, const std::string& row, const std::string& part) {
    expectFileError([&] { (void)read(ascii(kVertices + element, "0 0 0\n1 0 0\n0 1 0\n1 1 0\n" + row)); }, part);
  };
  const std::string ends = "mesh.ply: its edges have no numbers 'vertex1' and 'vertex2'";
  expectRefused("element edge 1\nproperty int vertex_1\nproperty int vertex_2\n", "1 2\n", ends);
  expectRefused("element edge 1\nproperty int vertex1\n", "1\n", ends);
  expectRefused("element edge 1\nproperty int vertex1\nproperty list int int vertex2\n", "1 1 2\n", ends);
  expectRefused("element tristrips 1\nproperty list int int strip\n", "3 0 1 2\n",
                "mesh.ply: its strips of triangles have no list 'vertex_indices'");
}

TEST(PlyMesh, VerticesOfFacesOfOneCornerAreThereOnce) {
  const scene::Scene scene =
      read(ascii("element vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                 "element face 1\nproperty list uchar int vertex_indices\n",
                 "0 0 0\n1 0 0\n1 0\n"));
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.models.front()->getLast()->getSize(), 1U);
}

}  // namespace
}  // namespace allpairs::test
