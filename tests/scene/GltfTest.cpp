// SPDX-License-Identifier: MIT
// What the numbers of a glTF file mean, and what its specification does not allow.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "Expect.h"
#include "SceneText.h"
#include "allpairs/scene/ReadInput.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// A document that shows one mesh of one primitive; its buffer is a file beside it.
struct Gltf {
  std::string node{};  ///< What its node has besides the mesh.
  std::string mesh{};  ///< What its mesh has besides the primitive.
  std::string primitive = R"("attributes": {"POSITION": 0})";
  std::string accessors{};
  std::string views{};
  std::string bytes{};
  std::string uri = "bytes.bin";
  std::string file = "bytes.bin";  ///< In which the bytes are.

  [[nodiscard]] scene::Scene read() const {
    const TempFolder folder;
    folder.write(file, bytes);
    return scene::readInput(folder.write(
        "a.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0)" + node +
                      R"(}], "meshes": [{"primitives": [{)" + primitive + "}]" + mesh + R"(}], "accessors": [)" +
                      accessors + R"(], "bufferViews": [)" + views + R"(], "buffers": [{"uri": ")" + uri +
                      R"(", "byteLength": )" + std::to_string(bytes.size()) + "}]}"));
  }

  void expectRefused(const std::string& part) const {
    expectFileError([this] { (void)read(); }, part);
  }
};

std::string view(std::size_t offset, std::size_t length, const std::string& more = "") {
  return R"({"buffer": 0, "byteOffset": )" + std::to_string(offset) + R"(, "byteLength": )" + std::to_string(length) +
         more + "}";
}

std::string accessor(std::size_t view, int type, std::size_t count, const std::string& shape,
                     const std::string& more = "") {
  return R"({"bufferView": )" + std::to_string(view) + R"(, "componentType": )" + std::to_string(type) +
         R"(, "count": )" + std::to_string(count) + R"(, "type": ")" + shape + "\"" + more + "}";
}

/// Vertices at (0, 0, 0), (1, 0, 0), (2, 0, 0), ...
std::string row(std::size_t count) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) {
    for (const float coordinate : {static_cast<float>(i), 0.0F, 0.0F}) appendNumber(bytes, coordinate, false);
  }
  return bytes;
}

Gltf triangle() { return {.accessors = accessor(0, 5126, 3, "VEC3"), .views = view(0, 36), .bytes = row(3)}; }

/// One point of a row, named by a number of this type.
template <class Index>
Gltf indexed(std::size_t vertices, int type, Index index) {
  Gltf gltf{.primitive = R"("mode": 0, "indices": 1, "attributes": {"POSITION": 0})",
            .accessors = accessor(0, 5126, vertices, "VEC3") + ", " + accessor(1, type, 1, "SCALAR"),
            .views = view(0, 12 * vertices) + ", " + view(12 * vertices, sizeof(Index)),
            .bytes = row(vertices)};
  appendNumber(gltf.bytes, index, false);
  return gltf;
}

double placeOfPoint(const Gltf& gltf) { return boxOf(*gltf.read().models.at(0)).min[0]; }

TEST(Gltf, IndicesHaveNoSign) {
  EXPECT_EQ(placeOfPoint(indexed(201, 5121, std::uint8_t{200})), 200.0);
  EXPECT_EQ(placeOfPoint(indexed(40001, 5123, std::uint16_t{40000})), 40000.0);
  EXPECT_EQ(placeOfPoint(indexed(40001, 5125, std::uint32_t{40000})), 40000.0);
}

TEST(Gltf, IndicesThatNameNoVertexAreRefused) {
  constexpr const char* kProblem = "names a vertex that isn't there";
  indexed(3, 5121, std::uint8_t{3}).expectRefused(kProblem);
  indexed(3, 5120, std::int8_t{-1}).expectRefused(kProblem);
  indexed(3, 5126, 0.5F).expectRefused(kProblem);
  EXPECT_EQ(placeOfPoint(indexed(3, 5121, std::uint8_t{2})), 2.0);
}

TEST(Gltf, NormalizedNumbersEndAtMinusOne) {
  Gltf gltf{.primitive = R"("mode": 0, "attributes": {"POSITION": 0})",
            .accessors = accessor(0, 5120, 1, "VEC3", R"(, "normalized": true)"),
            .views = view(0, 3)};
  for (const std::int8_t number : {std::int8_t{-128}, std::int8_t{-127}, std::int8_t{127}})
    appendNumber(gltf.bytes, number, false);
  EXPECT_EQ(boxOf(*gltf.read().models.at(0)), (Box{{-1, -1, 1}, {-1, -1, 1}}));
}

TEST(Gltf, EntriesMayLieApartAndTheLastOneEndsWithItsNumbers) {
  Gltf gltf{.accessors = accessor(0, 5126, 3, "VEC3"), .views = view(0, 2 * 20 + 12, R"(, "byteStride": 20)")};
  for (int i = 0; i < 3; ++i) gltf.bytes += row(3).substr(static_cast<std::size_t>(12 * i), 12) + std::string(8, 'x');
  gltf.bytes.resize(2 * 20 + 12);
  EXPECT_EQ(boxOf(*gltf.read().models.at(0)), (Box{{0, 0, 0}, {2, 0, 0}}));
  Gltf shorter = gltf;
  shorter.views = view(0, 2 * 20 + 11, R"(, "byteStride": 20)");
  shorter.expectRefused("promises 3 entries, its buffer view has 2");
  Gltf narrow = triangle();
  narrow.views = view(0, 36, R"(, "byteStride": 8)");
  narrow.expectRefused("accessor 0 does not fit its buffer view");
}

TEST(Gltf, PositionsAreOfThreeNumbers) {
  Gltf gltf = triangle();
  gltf.accessors = accessor(0, 5126, 3, "VEC2");
  gltf.expectRefused("accessor 0 is of another type");
}

Gltf sparse(std::uint8_t place) {
  Gltf gltf = triangle();
  gltf.accessors = accessor(0, 5126, 3, "VEC3",
                            R"(, "sparse": {"count": 1, "indices": {"bufferView": 1, "componentType": 5121, )"
                            R"("byteOffset": 1}, "values": {"bufferView": 2, "byteOffset": 12}})");
  gltf.views += ", " + view(36, 2) + ", " + view(38, 24);
  gltf.bytes += '\0';
  gltf.bytes += static_cast<char>(place);
  for (const float coordinate : {1.0F, 1.0F, 1.0F, 5.0F, 6.0F, 7.0F}) appendNumber(gltf.bytes, coordinate, false);
  return gltf;
}

TEST(Gltf, EntriesThatAreGivenOneByOneTakeTheirPlaces) {
  EXPECT_EQ(boxOf(*sparse(2).read().models.at(0)), (Box{{0, 0, 0}, {5, 6, 7}}));
  sparse(3).expectRefused("'sparse' names an entry that isn't there");
}

TEST(Gltf, AViewEndsWithItsBuffer) {
  Gltf gltf = triangle();
  gltf.views = view(1, 36);
  gltf.expectRefused("bufferView 0 promises 36 bytes from 1, its buffer has 36");
  gltf.views = view(37, 0);
  gltf.expectRefused("bufferView 0 promises 0 bytes from 37, its buffer has 36");
}

/// The digits of base64 in their order: the numbers from 0 to 63, four of which are three bytes.
TEST(Gltf, AllDigitsOfBase64AreRead) {
  Gltf gltf{.primitive = R"("mode": 0, "attributes": {"POSITION": 0})",
            .views = view(0, 48),
            .bytes = std::string(48, '\0'),  // of which only the number is used
            .uri =
                "data:application/octet-stream;base64,ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
                "+/"};
  for (int i = 0; i < 16; ++i) {
    gltf.accessors = accessor(0, 5121, 1, "VEC3", R"(, "byteOffset": )" + std::to_string(3 * i));
    int digits = 0;
    for (int k = 0; k < 4; ++k) digits = 64 * digits + 4 * i + k;
    const std::array<double, 3> place{static_cast<double>(digits / 65536), static_cast<double>(digits / 256 % 256),
                                      static_cast<double>(digits % 256)};
    EXPECT_EQ(boxOf(*gltf.read().models.at(0)), (Box{place, place})) << i;
  }
}

TEST(Gltf, NamesOfFilesMayHaveEscapes) {
  const std::vector<std::pair<const char*, const char*>> uris{
      {"a%20b%30%39%4A%4F%6a%6f.bin", "a b09JOjo.bin"},
      {"%61.bi%6E", "a.bin"},
      {"5%.bin", "5%.bin"},
      {"%4g%g4%/4%4:.bin%6", "%4g%g4%/4%4:.bin%6"},
  };
  for (const auto& [uri, file] : uris) {
    Gltf gltf = triangle();
    gltf.uri = uri;
    gltf.file = file;
    EXPECT_EQ(boxOf(*gltf.read().models.at(0)), (Box{{0, 0, 0}, {2, 0, 0}})) << uri;
  }
}

TEST(Gltf, ModesAreThoseOfTheSpecification) {
  Gltf gltf = triangle();
  gltf.primitive += R"(, "mode": 7)";
  gltf.expectRefused("has an unknown mode");
  Gltf loop{.primitive = R"("mode": 2, "attributes": {"POSITION": 0})",
            .accessors = accessor(0, 5126, 2, "VEC3"),
            .views = view(0, 24),
            .bytes = row(2)};
  EXPECT_EQ(namesOf(loop.read()), "a.gltf TLineModel 2\n") << "there and back";
  loop.accessors = accessor(0, 5126, 1, "VEC3");
  loop.expectRefused("holds no triangles");
}

TEST(Gltf, MatricesWithAProjectionAreRefused) {
  for (const std::size_t place : {3U, 7U, 11U, 15U}) {
    std::vector<std::string> numbers{"1", "0", "0", "0", "0", "1", "0", "0", "0", "0", "1", "0", "5", "0", "0", "1"};
    numbers[place] = "0.5";
    Gltf gltf = triangle();
    for (const std::string& number : numbers) gltf.node += (gltf.node.empty() ? R"(, "matrix": [)" : ", ") + number;
    gltf.node += "]";
    gltf.expectRefused("has a matrix whose last row is not 0 0 0 1");
  }
}

TEST(Gltf, RotationsHaveALengthOfAboutOne) {
  for (const char* rotation : {"0, 0, 0, 0.8", "0, 0, 0, 1.2", "0, 0, 0, 0"}) {
    Gltf gltf = triangle();
    gltf.node = std::string(R"(, "rotation": [)") + rotation + "]";
    gltf.expectRefused("has a rotation that is no quaternion of length 1");
  }
  Gltf gltf = triangle();
  gltf.node = R"(, "rotation": [0, 0, 0, 0.9999])";
  EXPECT_EQ(boxOf(*gltf.read().models.at(0)), (Box{{0, 0, 0}, {2, 0, 0}}));
}

std::array<double, 3> crossOf(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// As a quaternion with the vector u and the scalar w turns a vector v: v + 2 w (u x v) + 2 u x (u x v).
TEST(Gltf, RotationsTurnAboutAnyAxis) {
  const std::array<double, 3> u{0.1, 0.5, -0.5};
  const double w = 0.7;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<double, 3> v{};
    v[axis] = 1.0;
    Gltf gltf{.node = R"(, "rotation": [0.1, 0.5, -0.5, 0.7])",
              .primitive = R"("mode": 0, "attributes": {"POSITION": 0})",
              .accessors = accessor(0, 5126, 1, "VEC3"),
              .views = view(0, 12)};
    for (const double coordinate : v) appendNumber(gltf.bytes, static_cast<float>(coordinate), false);
    const auto once = crossOf(u, v);
    const auto twice = crossOf(u, once);
    const Box box = boxOf(*gltf.read().models.at(0));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(box.min[k], v[k] + 2 * w * once[k] + 2 * twice[k], 1e-12) << axis << k;
  }
}

TEST(Gltf, RotationsAndMatricesMayBeRounded) {
  Gltf turned = triangle();
  turned.node = R"(, "rotation": [0, 0, 0.711, 0.711])";  // a quarter about z, of length 1.0055
  const Box box = boxOf(*turned.read().models.at(0));
  EXPECT_NEAR(box.max[0], 0.0, 1e-12);
  EXPECT_NEAR(box.max[1], 2.0, 1e-12);
  Gltf matrix = triangle();
  matrix.node = R"(, "matrix": [1, 0, 0, 1e-17, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 0.99999994])";
  EXPECT_EQ(boxOf(*matrix.read().models.at(0)), (Box{{5, 0, 0}, {7, 0, 0}}));
}

TEST(Gltf, OnlyWeightsThatMoveAnythingAreRemarked) {
  const auto remarks = [](const std::string& ofMesh, const std::string& ofNode) {
    Gltf gltf = triangle();
    gltf.mesh = R"(, "weights": [)" + ofMesh + "]";
    if (!ofNode.empty()) gltf.node = R"(, "weights": [)" + ofNode + "]";
    return gltf.read().remarks.size();
  };
  EXPECT_EQ(remarks("0, 0", ""), 0U);
  EXPECT_EQ(remarks("0, 0.5", ""), 1U);
  EXPECT_EQ(remarks("0, 0.5", "0, 0"), 0U) << "a node's own take the place of its mesh's";
  EXPECT_EQ(remarks("0, 0", "1, 0"), 1U);
}

std::string glb(std::string json) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  for (const std::size_t number : {std::size_t{2}, json.size() + 20, json.size()})
    appendNumber(bytes, static_cast<std::uint32_t>(number), false);
  return bytes + "JSON" + json;
}

TEST(Gltf, WhatStandsBehindTheLengthOfABinaryFileIsNotLost) {
  const auto read = [](const std::string& bytes) {
    const TempFolder folder;
    return scene::readInput(folder.write("a.glb", bytes));
  };
  const std::string bytes =
      glb(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": )"
          R"([{"primitives": [{"attributes": {"POSITION": 0}}]}], "accessors": [{"componentType": 5126, "count": 3, )"
          R"("type": "VEC3"}]})");
  EXPECT_EQ(read(bytes).models.size(), 1U);
  EXPECT_EQ(read(bytes + "\n").models.size(), 1U) << "filling";
  expectFileError([&] { (void)read(bytes + bytes); },
                  "a.glb: has " + std::to_string(bytes.size()) + " bytes behind what its header promises");
}

}  // namespace
}  // namespace allpairs::test
