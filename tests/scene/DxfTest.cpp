// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "Expect.h"
#include "SceneText.h"
#include "allpairs/scene/ReadInput.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// Groups: codes and values, each on a line.
std::string groups(const std::string& codesAndValues) {
  std::istringstream words(codesAndValues);
  std::string text;
  for (std::string word; words >> word;) text += word + '\n';
  return text;
}

/// A drawing: what it has in its blocks, and in itself.
std::string drawing(const std::string& blocks, const std::string& entities) {
  return groups("0 SECTION 2 BLOCKS " + blocks + " 0 ENDSEC 0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF");
}

std::string dxfBlock(const std::string& name, const std::string& entities, const std::string& base = "10 0 20 0 30 0") {
  return " 0 BLOCK 8 0 2 " + name + ' ' + base + ' ' + entities + " 0 ENDBLK ";
}

constexpr const char* kDxfFace = " 0 3DFACE 8 walls 10 1 20 2 30 3 11 5 21 2 31 3 12 1 22 9 32 4 13 1 23 9 33 4 ";
constexpr const char* kDxfInsert = " 0 INSERT 8 parts 2 B 10 10 20 20 30 30 ";

scene::Scene readDrawing(const std::string& text) {
  const TempFolder folder;
  return scene::readInput(folder.write("a.dxf", text));
}

void expectDxfProblem(const std::string& text, const std::string& part) {
  expectFileError([&] { static_cast<void>(readDrawing(text)); }, part);
}

std::string textOf(const Box& box) {
  std::ostringstream text;
  text << box.min[0] << ' ' << box.min[1] << ' ' << box.min[2] << " to " << box.max[0] << ' ' << box.max[1] << ' '
       << box.max[2];
  return text.str();
}

/// For each model its name, and the letter of its type and the box of each of its elements.
std::vector<std::string> elementsOf(const scene::Scene& scene) {
  std::vector<std::string> lines;
  for (const auto& model : scene.models) {
    lines.push_back(model->getName());
    for (std::size_t i = 0; i < model->getSize(); ++i)
      lines.push_back(std::string(model->typeName().substr(1, 1)) + ' ' + textOf(model->elementBox(i)));
  }
  return lines;
}

std::vector<std::string> elementsOf(const std::string& entities, const std::string& blocks = {}) {
  const scene::Scene scene = readDrawing(drawing(blocks, entities));
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0].reason;
  return elementsOf(scene);
}

std::vector<std::string> warningsOf(const std::string& entities, const std::string& blocks = {}) {
  std::vector<std::string> reasons;
  for (const scene::Remark& warning : readDrawing(drawing(blocks, entities)).warnings) {
    EXPECT_EQ(warning.subject, "shapes");
    reasons.push_back(warning.reason);
  }
  return reasons;
}

using DxfLines = std::vector<std::string>;

TEST(Dxf, LinesPointsAndFacesAreReadInDoubleByLayers) {
  EXPECT_EQ(elementsOf("0 LINE 8 axes 10 0.1 20 2 30 3 11 1 21 1 31 1 0 POINT 10 7 20 8 30 9 0 3DLINE 8 axes 10 0 20 0 "
                       "30 0 11 4 21 4 31 4 0 LINE 10 1 20 2 11 3 21 4" +
                       std::string(kDxfFace)),
            (DxfLines{"axes", "L 0.1 1 1 to 1 2 3", "L 0 0 0 to 4 4 4", "0", "L 1 2 0 to 3 4 0", "0#2",
                      "P 7 8 9 to 7 8 9", "walls", "T 1 2 3 to 5 9 4"}));
  const auto far = readDrawing(drawing("", "0 POINT 10 123456789.1 20 0 30 -0.1"));
  EXPECT_EQ(boxOf(*far.models[0]), (Box{{123456789.1, 0, -0.1}, {123456789.1, 0, -0.1}}));
}

TEST(Dxf, AFaceMayHaveFourCornersOrThree) {
  const std::string three = "0 3DFACE 10 0 20 0 30 0 11 4 21 0 31 0 12 4 22 2 32 1";
  EXPECT_EQ(elementsOf(three), (DxfLines{"0", "T 0 0 0 to 4 2 1"}));
  EXPECT_EQ(elementsOf(three + " 13 0 23 1 33 0"), (DxfLines{"0", "T 0 0 0 to 4 2 1", "T 0 0 0 to 4 2 1"}));
  expectDxfProblem(drawing("", "0 3DFACE 10 0 20 0 30 0 11 4 21 0 31 0"), "a.dxf:12: a 3DFACE without group 12");
}

TEST(Dxf, SolidsAndTracesHaveTheirLastCornersExchangedAndMayBeThick) {
  const DxfLines quad{"0", "T 0 0 5 to 4 1 5", "T 0 0 5 to 1 2 5"};
  const std::string corners = " 10 0 20 0 30 5 11 4 21 0 31 5 12 0 22 2 32 5";
  EXPECT_EQ(elementsOf("0 SOLID" + corners + " 13 1 23 1 33 5"), quad);
  EXPECT_EQ(elementsOf("0 TRACE" + corners + " 13 1 23 1 33 5"), quad);
  EXPECT_EQ(elementsOf("0 SOLID" + corners), (DxfLines{"0", "T 0 0 5 to 4 2 5"}));
  EXPECT_EQ(elementsOf("0 SOLID" + corners + " 13 0 23 2 33 5"), (DxfLines{"0", "T 0 0 5 to 4 2 5"}));
  EXPECT_EQ(elementsOf("0 SOLID" + corners + " 39 2"),
            (DxfLines{"0", "T 0 0 5 to 4 2 5", "T 0 0 5 to 4 0 7", "T 0 0 5 to 4 0 7", "T 0 0 5 to 4 2 7",
                      "T 0 0 5 to 4 2 7", "T 0 0 5 to 0 2 7", "T 0 0 5 to 0 2 7", "T 0 0 7 to 4 2 7"}));
  EXPECT_EQ(elementsOf("0 SOLID" + corners + " 210 0 220 0 230 -1"), (DxfLines{"0", "T -4 0 -5 to 0 2 -5"}));
}

TEST(Dxf, LinesAndPointsMayBeThickAlongTheirExtrusion) {
  EXPECT_EQ(elementsOf("0 LINE 39 2 210 1 220 0 230 0 10 1 20 2 30 3 11 1 21 5 31 3"),
            (DxfLines{"0", "T 1 2 3 to 3 5 3", "T 1 2 3 to 3 5 3"}));
  EXPECT_EQ(elementsOf("0 POINT 39 -2 210 0 220 1 230 0 10 1 20 2 30 3"), (DxfLines{"0", "L 1 0 3 to 1 2 3"}));
  EXPECT_EQ(elementsOf("0 LINE 230 -1 10 1 20 2 30 3 11 1 21 5 31 3"), (DxfLines{"0", "L 1 2 3 to 1 5 3"}));
}

TEST(Dxf, TheAxesOfAnExtrusionNearZAreThoseOfY) {
  const std::string lwpolyline = "0 LWPOLYLINE 10 1 20 0 210 0 230 1 220 ";
  EXPECT_EQ(elementsOf(lwpolyline + "0.0156"), (DxfLines{"0", "P 1 0 0 to 1 0 0"}));
  EXPECT_EQ(elementsOf(lwpolyline + "0.0157"), (DxfLines{"0", "P -1 0 0 to -1 0 0"}));
}

TEST(Dxf, PolylinesHaveAllTheirPieces) {
  const std::string vertices = " 0 VERTEX 10 0 20 0 30 1 0 VERTEX 10 4 20 0 30 1 0 VERTEX 10 4 20 3 30 2 0 SEQEND";
  EXPECT_EQ(elementsOf("0 POLYLINE 70 8" + vertices), (DxfLines{"0", "L 0 0 1 to 4 0 1", "L 4 0 1 to 4 3 2"}));
  EXPECT_EQ(elementsOf("0 POLYLINE 70 9" + vertices),
            (DxfLines{"0", "L 0 0 1 to 4 0 1", "L 4 0 1 to 4 3 2", "L 0 0 1 to 4 3 2"}));
  EXPECT_EQ(elementsOf("0 POLYLINE 30 7" + vertices), (DxfLines{"0", "L 0 0 7 to 4 0 7", "L 4 0 7 to 4 3 7"}));
  EXPECT_EQ(elementsOf("0 POLYLINE" + vertices), (DxfLines{"0", "L 0 0 1 to 4 0 1", "L 4 0 1 to 4 3 2"}));
  EXPECT_EQ(
      elementsOf("0 POLYLINE 30 7 230 -1 39 2" + vertices),
      (DxfLines{"0", "T -4 0 -9 to 0 0 -7", "T -4 0 -9 to 0 0 -7", "T -4 0 -9 to -4 3 -7", "T -4 0 -9 to -4 3 -7"}));
  EXPECT_EQ(elementsOf("0 POLYLINE 70 8 0 VERTEX 10 1 20 2 30 3 0 SEQEND"), (DxfLines{"0", "P 1 2 3 to 1 2 3"}));
  EXPECT_EQ(elementsOf("0 POLYLINE 70 12 0 VERTEX 70 16 10 9 20 9 30 9" + vertices),  // with its control point
            (DxfLines{"0", "L 0 0 1 to 4 0 1", "L 4 0 1 to 4 3 2"}));
  EXPECT_EQ(elementsOf("0 LWPOLYLINE 38 6 90 3 70 1 10 0 20 0 10 4 20 0 10 4 20 3"),
            (DxfLines{"0", "L 0 0 6 to 4 0 6", "L 4 0 6 to 4 3 6", "L 0 0 6 to 4 3 6"}));
  EXPECT_EQ(elementsOf("0 LWPOLYLINE 70 0 0 LWPOLYLINE 70 1 0 LWPOLYLINE 70 1 10 1 20 2"),
            (DxfLines{"0", "P 1 2 0 to 1 2 0"}));
  EXPECT_EQ(elementsOf("0 POLYLINE 70 8 230 -1" + vertices), (DxfLines{"0", "L 0 0 1 to 4 0 1", "L 4 0 1 to 4 3 2"}));
  const std::string open = "0 POLYLINE 70 8 0 VERTEX 10 1 20 0 30 0 0 VERTEX 10 2 20 0 30 0";  // without its end
  EXPECT_EQ(elementsOf(open + " 0 POINT 10 5 20 5 " + open),
            (DxfLines{"0", "L 1 0 0 to 2 0 0", "L 1 0 0 to 2 0 0", "0#2", "P 5 5 0 to 5 5 0"}));
  EXPECT_EQ(elementsOf("0 INSERT 2 B", dxfBlock("B", open) + dxfBlock("A", "")), (DxfLines{"0", "L 1 0 0 to 2 0 0"}));
}

TEST(Dxf, OldFilesGiveZOnceAsTheElevation) {
  EXPECT_EQ(elementsOf("0 LINE 38 5 10 1 20 2 11 3 21 4 0 LINE 38 5 10 1 20 2 30 6 11 3 21 4 31 7"),
            (DxfLines{"0", "L 1 2 5 to 3 4 5", "L 1 2 6 to 3 4 7"}));
  const std::string vertices = " 0 VERTEX 10 1 20 2 0 VERTEX 10 3 20 4 0 SEQEND";
  EXPECT_EQ(elementsOf("0 POLYLINE 38 5" + vertices), (DxfLines{"0", "L 1 2 5 to 3 4 5"}));
  EXPECT_EQ(elementsOf("0 POLYLINE 38 5 0 VERTEX 38 6 10 1 20 2 0 VERTEX 10 3 20 4 30 7 0 SEQEND"),
            (DxfLines{"0", "L 1 2 6 to 3 4 7"}));
  EXPECT_EQ(elementsOf("0 POLYLINE 70 8 38 5" + vertices), (DxfLines{"0", "L 1 2 0 to 3 4 0"}));
}

TEST(Dxf, MeshesOfPolylinesAreFacesBetweenRows) {
  const std::string rows =
      " 0 VERTEX 70 64 10 0 20 0 30 0 0 VERTEX 70 64 10 1 20 0 30 0 0 VERTEX 70 64 10 0 20 2 30 0"
      " 0 VERTEX 70 64 10 1 20 2 30 0 0 VERTEX 70 64 10 0 20 2 30 5 0 VERTEX 70 64 10 1 20 2 30 5 0 SEQEND";
  const DxfLines open{"0", "T 0 0 0 to 1 2 0", "T 0 0 0 to 1 2 0", "T 0 2 0 to 1 2 5", "T 0 2 0 to 1 2 5"};
  EXPECT_EQ(elementsOf("0 POLYLINE 70 16 71 3 72 2" + rows), open);
  DxfLines closed = open;
  closed.insert(closed.end(), 2, "T 0 0 0 to 1 2 5");
  EXPECT_EQ(elementsOf("0 POLYLINE 70 17 71 3 72 2" + rows), closed);
  EXPECT_EQ(elementsOf("0 POLYLINE 70 48 71 3 72 2" + rows).size(), 1U + 8U);
  EXPECT_EQ(elementsOf("0 POLYLINE 70 20 71 9 72 9 73 3 74 2 0 VERTEX 70 80 10 99 20 0 30 0" + rows), open);
  expectDxfProblem(drawing("", "0 POLYLINE 70 16 71 4 72 2" + rows), "a.dxf:12: a POLYLINE of 4 x 2 vertices has 6");
}

TEST(Dxf, PolyfaceMeshesMayHideEdges) {
  const std::string positions =
      "0 POLYLINE 8 walls 70 64 0 VERTEX 70 192 10 0 20 0 30 0 0 VERTEX 70 192 10 4 20 0 30 0"
      " 0 VERTEX 70 192 10 4 20 3 30 1 0 VERTEX 70 192 10 0 20 3 30 9";
  const auto face = [&](const std::string& indices) {
    return positions + " 0 VERTEX 70 128 10 0 20 0 30 0 " + indices + " 0 SEQEND";
  };
  EXPECT_EQ(elementsOf(face("71 1 72 -2 73 3")), (DxfLines{"walls", "T 0 0 0 to 4 3 1"}));
  EXPECT_EQ(elementsOf(face("71 -1 72 2 73 3 74 -4")), (DxfLines{"walls", "T 0 0 0 to 4 3 1", "T 0 0 0 to 4 3 9"}));
  EXPECT_EQ(elementsOf(face("71 2 72 4 73 0 74 0")), (DxfLines{"walls", "L 0 0 0 to 4 3 9"}));
  EXPECT_EQ(elementsOf(face("8 roof 71 1 72 2 73 3")), (DxfLines{"roof", "T 0 0 0 to 4 3 1"}));
  for (const char* index : {"5", "-5", "9223372036854775807", "-9223372036854775808"})
    expectDxfProblem(drawing("", face(std::string("71 1 72 2 73 ") + index)),
                     "a.dxf:58: index " + std::string(index) + " names no vertex: the POLYLINE has 4");
}

TEST(Dxf, BlocksAreShownWhereTheyAreInserted) {
  const std::string line = "0 LINE 8 axes 10 1 20 2 30 3 11 5 21 2 31 4";
  const auto inserted = [&](const std::string& how, const std::string& base = "10 0 20 0 30 0") {
    return elementsOf(kDxfInsert + how, dxfBlock("B", line, base));
  };
  EXPECT_EQ(inserted(""), (DxfLines{"axes", "L 11 22 33 to 15 22 34"}));
  EXPECT_EQ(inserted("", "10 1 20 2 30 3"), (DxfLines{"axes", "L 10 20 30 to 14 20 31"}));
  EXPECT_EQ(inserted("41 2 42 -1 43 0.5"), (DxfLines{"axes", "L 12 18 31.5 to 20 18 32"}));
  EXPECT_EQ(inserted("50 90"), (DxfLines{"axes", "L 8 21 33 to 8 25 34"}));
  EXPECT_EQ(inserted("50 -180.0"), (DxfLines{"axes", "L 5 18 33 to 9 18 34"}));
  EXPECT_EQ(inserted("50 990 41 3"), (DxfLines{"axes", "L 12 5 33 to 12 17 34"}));
  EXPECT_EQ(inserted("210 0 220 0 230 -1"), (DxfLines{"axes", "L -15 22 -34 to -11 22 -33"}));
  EXPECT_EQ(inserted("210 1 220 0 230 0"), (DxfLines{"axes", "L 33 11 22 to 34 15 22"}));
  EXPECT_EQ(inserted("70 2 71 2 44 100 45 1000 41 2"),
            (DxfLines{"axes", "L 12 22 33 to 20 22 34", "L 112 22 33 to 120 22 34", "L 12 1022 33 to 20 1022 34",
                      "L 112 1022 33 to 120 1022 34"}));
  EXPECT_EQ(inserted("70 0 71 -3 44 100 45 1000"), (DxfLines{"axes", "L 11 22 33 to 15 22 34"}));
  EXPECT_EQ(inserted("70 2 44 100 50 90"), (DxfLines{"axes", "L 8 21 33 to 8 25 34", "L 8 121 33 to 8 125 34"}));
  expectDxfProblem(drawing(dxfBlock("B", line), std::string(kDxfInsert) + "210 0 220 0 230 0"),
                   "its extrusion has no direction");
}

TEST(Dxf, BlocksInEachOtherAreShown) {
  const std::string point = "0 POINT 8 dots 10 1 20 2 30 3";
  const std::string inner = "0 INSERT 2 A 10 100 20 0 30 0 50 90";
  const std::string blocks = dxfBlock("A", point) + dxfBlock("B", inner + ' ' + point);
  EXPECT_EQ(elementsOf(kDxfInsert, blocks), (DxfLines{"dots", "P 11 22 33 to 11 22 33", "P 108 21 33 to 108 21 33"}));
  EXPECT_EQ(elementsOf(std::string(kDxfInsert) + "41 2", blocks),
            (DxfLines{"dots", "P 12 22 33 to 12 22 33", "P 206 21 33 to 206 21 33"}));
  const std::string endless = " is in itself, or in too many others";
  expectDxfProblem(drawing(dxfBlock("B", std::string(kDxfInsert) + point), kDxfInsert), "the block 'B'" + endless);
  expectDxfProblem(drawing(dxfBlock("A", kDxfInsert) + dxfBlock("B", inner + ' ' + point), kDxfInsert), endless);
  EXPECT_EQ(elementsOf(point + kDxfInsert, dxfBlock("B", kDxfInsert)), (DxfLines{"dots", "P 1 2 3 to 1 2 3"}));
}

TEST(Dxf, LayerZeroOfABlockIsTheLayerInWhichItIsInserted) {
  const std::string points = " 0 POINT 10 1 20 0 30 0 0 POINT 8 own 10 2 20 0 30 0 ";
  EXPECT_EQ(elementsOf(kDxfInsert, dxfBlock("B", points)),
            (DxfLines{"parts", "P 11 20 30 to 11 20 30", "own", "P 12 20 30 to 12 20 30"}));
  EXPECT_EQ(elementsOf(kDxfInsert, dxfBlock("A", points) + dxfBlock("B", "0 INSERT 2 A 10 0 20 0 30 0")),
            (DxfLines{"parts", "P 11 20 30 to 11 20 30", "own", "P 12 20 30 to 12 20 30"}));
  EXPECT_EQ(elementsOf("0 INSERT 2 B", dxfBlock("B", points)),
            (DxfLines{"0", "P 1 0 0 to 1 0 0", "own", "P 2 0 0 to 2 0 0"}));
}

TEST(Dxf, ABlockMayBeNamedInAnotherCaseButWhereAFileHasBoth) {
  const std::string one = "0 POINT 8 one 10 1 20 0 30 0";
  const std::string two = "0 POINT 8 two 10 2 20 0 30 0";
  EXPECT_EQ(elementsOf(kDxfInsert, dxfBlock("b", one)), (DxfLines{"one", "P 11 20 30 to 11 20 30"}));
  EXPECT_EQ(elementsOf(kDxfInsert, dxfBlock("B", two) + dxfBlock("b", one)),
            (DxfLines{"two", "P 12 20 30 to 12 20 30"}));
}

TEST(Dxf, WhatIsNotReadIsNamedAndTextsAndUnusedBlocksAreNot) {
  const std::string face = kDxfFace;
  const std::string text = " 0 TEXT 8 0 10 100 20 200 30 0 40 2 1 ROOM 0 DIMENSION 2 *D1 0 ATTDEF 2 TAG ";
  const std::string solid = "0 3DSOLID 1 manm ";
  EXPECT_EQ(warningsOf(face + text, dxfBlock("A", solid)), DxfLines{});
  EXPECT_EQ(warningsOf(face + kDxfInsert, dxfBlock("B", text)), DxfLines{});
  const std::string curves = " 0 CIRCLE 40 5 0 ARC 40 5 0 CIRCLE 40 6 0 AEC_WALL 5 1F ";
  const std::string missing = "4 of kinds that are not read are missing: AEC_WALL, ARC, CIRCLE";
  EXPECT_EQ(warningsOf(face + curves), DxfLines{missing});
  EXPECT_EQ(warningsOf(face + kDxfInsert, dxfBlock("B", curves)), DxfLines{missing});
  expectDxfProblem(drawing("", curves), "holds no triangles, lines or points: " + missing);
  std::string many;
  for (int i = 10; i < 22; ++i) many += " 0 KIND" + std::to_string(i);
  EXPECT_EQ(
      warningsOf(face + many),
      DxfLines{"12 of kinds that are not read are missing: KIND10, KIND11, KIND12, KIND13, KIND14, KIND15, KIND16, "
               "KIND17, KIND18, KIND19 and 2 more"});
  for (const char* kind : {"3DSOLID", "BODY", "REGION", "MESH", "PLANESURFACE"}) {
    const std::string problem = ": '" + std::string(kind) + "' is not read; export 3DFACEs";
    expectDxfProblem(drawing("", face + "0 " + kind + " 1 manm"), "a.dxf:40" + problem);
    expectDxfProblem(drawing(dxfBlock("B", std::string("0 ") + kind), face + kDxfInsert), "a.dxf:18" + problem);
  }
}

TEST(Dxf, ArcsAndWidthsOfPolylinesAreNamedAndTheirOtherPiecesRead) {
  const std::string flat = "0 LWPOLYLINE 90 3 10 0 20 0 42 0.5 10 4 20 0 40 1 41 1 10 4 20 3 42 1";
  EXPECT_EQ(warningsOf(flat),
            DxfLines{"2 of kinds that are not read are missing: arcs of LWPOLYLINE, widths of LWPOLYLINE"});
  EXPECT_EQ(elementsOf(readDrawing(drawing("", flat))), (DxfLines{"0", "L 4 0 0 to 4 3 0"}));
  EXPECT_EQ(warningsOf("0 LWPOLYLINE 43 1 10 0 20 0 10 4 20 0"),
            DxfLines{"1 of kinds that are not read is missing: widths of LWPOLYLINE"});
  EXPECT_EQ(warningsOf("0 POLYLINE 70 8 40 1 0 VERTEX 10 0 20 0 30 0 0 VERTEX 10 4 20 0 30 0 0 SEQEND"), DxfLines{});
  const std::string vertices = " 0 VERTEX 10 0 20 0 0 VERTEX 10 4 20 0 42 -1 40 0 41 0 0 VERTEX 10 4 20 3 0 SEQEND";
  EXPECT_EQ(warningsOf("0 POLYLINE 40 1 41 1" + vertices),
            DxfLines{"2 of kinds that are not read are missing: arcs of POLYLINE, widths of POLYLINE"});
}

TEST(Dxf, BlocksThatAreNotThereAreNamed) {
  const std::string face = kDxfFace;
  const std::string elsewhere = "0 BLOCK 2 B 70 4 10 0 20 0 30 0 1 other.dwg 0 ENDBLK";
  EXPECT_EQ(warningsOf(face + kDxfInsert, elsewhere),
            DxfLines{"blocks of other drawings are not read, and missing: 'B'"});
  EXPECT_EQ(warningsOf(face + kDxfInsert, "0 BLOCK 2 B 70 8 0 ENDBLK"),
            DxfLines{"blocks of other drawings are not read, and missing: 'B'"});
  EXPECT_EQ(warningsOf(face, elsewhere), DxfLines{});
  EXPECT_EQ(warningsOf(face + kDxfInsert + kDxfInsert),
            DxfLines{"blocks that the file does not have are missing: 'B'"});
}

TEST(Dxf, BlocksOfTheSameNameAreNamedWhereOneIsShown) {
  const std::string two = dxfBlock("B", "0 POINT 10 1 20 0 30 0") + dxfBlock("B", "0 POINT 8 last 10 2 20 0 30 0");
  EXPECT_EQ(warningsOf(kDxfFace, two), DxfLines{});
  EXPECT_EQ(warningsOf(kDxfInsert, two), DxfLines{"of blocks with the same name only the last is shown: 'B'"});
  EXPECT_EQ(elementsOf(readDrawing(drawing(two, kDxfInsert))), (DxfLines{"last", "P 12 20 30 to 12 20 30"}));
}

TEST(Dxf, ThePaperSpaceIsPassedOverWithARemark) {
  const std::string paper =
      "0 LINE 67 1 10 100 20 100 30 0 11 200 21 100 31 0 0 POLYLINE 67 1 0 VERTEX 10 0 20 0 0 VERTEX 10 1 20 0 0 "
      "SEQEND "
      "0 3DSOLID 67 1 1 manm 0 INSERT 67 1 2 B 0 TEXT 67 1 1 ROOM";
  const scene::Scene scene = readDrawing(drawing(dxfBlock("B", kDxfFace), kDxfFace + paper));
  EXPECT_EQ(elementsOf(scene), (DxfLines{"walls", "T 1 2 3 to 5 9 4"}));
  EXPECT_TRUE(scene.warnings.empty());
  ASSERT_EQ(scene.remarks.size(), 1U);
  EXPECT_EQ(scene.remarks[0].subject, "a.dxf");
  EXPECT_EQ(scene.remarks[0].reason, "its paper space, of 4 entities, is passed over");
}

TEST(Dxf, BlocksOfTheModelSpaceAndThePaperSpaceAreTheDrawingItself) {
  const std::string point = "0 POINT 8 dots 10 1 20 2 30 3";
  for (const char* sign : {"*", "$"}) {
    const std::string name = sign;
    EXPECT_EQ(elementsOf("", dxfBlock(name + "Model_Space", point)), (DxfLines{"dots", "P 1 2 3 to 1 2 3"}));
    const std::string papers = dxfBlock(name + "PAPER_SPACE", "") + dxfBlock(name + "Paper_Space0", point + " 0 TEXT") +
                               dxfBlock(name + "Paper_Space12", point) + dxfBlock(name + "PAPER_SPACES", point);
    const scene::Scene scene = readDrawing(drawing(papers, kDxfFace));
    EXPECT_EQ(elementsOf(scene), (DxfLines{"walls", "T 1 2 3 to 5 9 4"}));
    ASSERT_EQ(scene.remarks.size(), 1U);
    EXPECT_EQ(scene.remarks[0].reason, "its paper space, of 2 entities, is passed over");
  }
}

TEST(Dxf, HiddenEntitiesArePassedOverWithARemark) {
  const std::string hidden =
      " 0 POINT 60 1 10 9 20 9 30 9 0 POLYLINE 60 1 0 VERTEX 10 8 20 8 0 VERTEX 10 9 20 9 0 SEQEND"
      " 0 3DSOLID 60 1 1 manm 0 TEXT 60 1 1 ROOM ";
  const std::string shown = " 0 POINT 8 dots 60 0 10 1 20 2 30 3 ";
  const auto remarksOf = [](const std::string& entities, const std::string& blocks = {}) {
    const scene::Scene scene = readDrawing(drawing(blocks, entities));
    EXPECT_EQ(elementsOf(scene), (DxfLines{"dots", "P 1 2 3 to 1 2 3"}));
    EXPECT_TRUE(scene.warnings.empty());
    std::vector<std::string> reasons;
    for (const scene::Remark& remark : scene.remarks) reasons.push_back(remark.reason);
    return reasons;
  };
  EXPECT_EQ(remarksOf(shown + hidden), DxfLines{"3 of its entities are hidden, and passed over"});
  EXPECT_EQ(remarksOf(shown + "0 INSERT 60 1 2 B", dxfBlock("B", shown)),
            DxfLines{"1 of its entities is hidden, and passed over"});
  EXPECT_EQ(remarksOf("0 INSERT 2 B", dxfBlock("B", shown + hidden)),
            DxfLines{"3 of its entities are hidden, and passed over"});
  EXPECT_EQ(remarksOf(shown, dxfBlock("B", hidden)), DxfLines{});
}

TEST(Dxf, TheHeaderSaysTheUnit) {
  const auto unitOf = [](const std::string& header) {
    return readDrawing(groups("999 made-by-hand 0 SECTION 2 HEADER " + header + " 0 ENDSEC") + drawing("", kDxfFace))
        .metresPerUnit;
  };
  EXPECT_EQ(unitOf("9 $MEASUREMENT 70 6 9 $INSUNITS 70 4"), 0.001);
  EXPECT_EQ(unitOf("9 $INSUNITS 70 1"), 0.0254);
  EXPECT_EQ(unitOf("9 $INSUNITS 70 6"), 1.0);
  EXPECT_EQ(unitOf("9 $INSUNITS 70 21"), 1200.0 / 3937);
  EXPECT_EQ(unitOf("9 $INSUNITS 70 24"), 1200.0 / 3937 * 5280);
  EXPECT_EQ(unitOf("9 $INSUNITS 70 0"), std::nullopt);
  EXPECT_EQ(unitOf("9 $INSUNITS 70 25"), std::nullopt);
  EXPECT_EQ(unitOf("9 $INSUNITS 70 99"), std::nullopt);
  EXPECT_EQ(unitOf("9 $MEASUREMENT 70 6"), std::nullopt);
}

TEST(Dxf, TextsMayHoldWhatLooksLikeGroups) {
  const std::string text = "0\nMTEXT\n8\n0\n1\n{\\fArial|b0;0\n3\n \n102\n{ACAD\n102\n}\n";
  const std::string all = drawing("", kDxfFace);
  const std::size_t at = all.find("0\n3DFACE");
  EXPECT_EQ(elementsOf(readDrawing(std::string(all).insert(at, text))), (DxfLines{"walls", "T 1 2 3 to 5 9 4"}));
}

TEST(Dxf, GroupsOfApplicationsAndCommentsAreNotThoseOfTheEntity) {
  const std::string other = " 102 {APP 10 99 20 99 30 99 60 1 70 4 102 } 999 10 ";
  EXPECT_EQ(elementsOf("0 POINT" + other + "10 1 20 2 30 3 1001 APP 1010 99 1020 99 1030 99 1070 1"),
            (DxfLines{"0", "P 1 2 3 to 1 2 3"}));
  EXPECT_EQ(elementsOf("0 LWPOLYLINE" + other + "10 1 999 10 20 2 10 3 20 4 102 {APP 10 99 102 } 8 behind"),
            (DxfLines{"behind", "L 1 2 0 to 3 4 0"}));
  EXPECT_EQ(elementsOf("0 POINT 10 4 20 5 30 6 102 {APP 0 POINT 10 1 20 2 30 3"),
            (DxfLines{"0", "P 4 5 6 to 4 5 6", "P 1 2 3 to 1 2 3"}));
}

TEST(Dxf, NamesOfLayersMayHaveEscapedCharacters) {
  const auto nameOf = [](const std::string& layer) {
    return elementsOf("0 POINT 8 " + layer + " 10 1 20 2 30 3").at(0);
  };
  EXPECT_EQ(nameOf("W\\U+00E4nde\\U+20AC"), "W\u00e4nde\u20ac");
  EXPECT_EQ(nameOf("\\U+d83d\\U+DE00"), "\U0001F600");
  for (const char* name :
       {"\\U+", "a\\U+00E", "\\U+00EG", "\\u+00E4", "U+00E4", "\\U+D83D", "\\U+DE00\\U+D83D", "\\U+0000", "\\U+000A"})
    EXPECT_EQ(nameOf(name), name);
}

TEST(Dxf, FilesCutBeforeTheirEndAreRefused) {
  const std::string text = drawing(dxfBlock("B", kDxfFace), kDxfFace);
  const std::size_t end = text.find("ENDSEC", text.find("ENTITIES")) + 6;
  for (std::size_t length = 1; length < end; ++length) expectDxfProblem(text.substr(0, length), "a.dxf");
  for (const std::size_t length : {end, end + 1, text.size() - 1})
    EXPECT_EQ(elementsOf(readDrawing(text.substr(0, length))), (DxfLines{"walls", "T 1 2 3 to 5 9 4"})) << length;
}

TEST(Dxf, ErrorsNameTheLine) {
  expectDxfProblem("AutoCAD Binary DXF\r\n\x1a", "is a binary DXF, which is not read: save it as text");
  expectDxfProblem("8\nwalls\n", "a.dxf:2: is no DXF file: it does not begin with a section");
  expectDxfProblem("solid\n", "a.dxf:1: 'solid' is no group code");
  expectDxfProblem(drawing("", "0 LINE 10 x 20 0 30 0 11 0 21 0 31 0"), "a.dxf:14: 'x' is no finite number");
  expectDxfProblem(drawing("", "0 LINE 10 1e999 20 0 30 0 11 0 21 0 31 0"), "a.dxf:14: '1e999' is no finite number");
  expectDxfProblem(drawing("", "0 POLYLINE 70 many 0 SEQEND"), "a.dxf:14: 'many' is no integer");
  const std::string inserts = std::string(kDxfInsert) + "41 1e300";
  expectDxfProblem(drawing(dxfBlock("A", kDxfFace) + dxfBlock("B", "0 INSERT 2 A 41 1e300"), inserts),
                   "has coordinates too large for a number in the layer 'walls'");
}

TEST(Dxf, AFewWordsCannotAskForAllMemory) {
  const auto expectRefusal = [](const std::string& text) {
    const TempFolder folder;
    const auto path = folder.write("a.dxf", text);
    const scene::ReadOptions options{.maxMemory = 16U << 20U};
    expectFileError([&] { static_cast<void>(scene::readInput(path, options)); }, "--max-memory");
  };
  const std::string grid = " 70 1000000 71 1000000 44 1 45 1 ";
  expectRefusal(drawing(dxfBlock("B", kDxfFace), kDxfInsert + grid));
  std::string blocks = dxfBlock("B0", kDxfFace);
  for (int i = 1; i < 100; ++i) {
    const std::string inner = " 0 INSERT 2 B" + std::to_string(i - 1) + " 10 1 20 0 30 0";
    blocks += dxfBlock("B" + std::to_string(i), inner + inner);
  }
  expectRefusal(drawing(blocks, "0 INSERT 2 B99"));
  const auto often = [](const std::string& words) {
    std::string text;
    for (int i = 0; i < 50000; ++i) text += words;
    return text;
  };
  const std::string empty = dxfBlock("E", "");
  const std::string thousand = "0 INSERT 2 B 70 1000";
  expectRefusal(drawing(empty + dxfBlock("B", kDxfFace + often("0 INSERT 2 E ")), thousand));
  expectRefusal(drawing(often("0 BLOCK 2 B "), kDxfFace));
  expectRefusal(drawing(empty, kDxfFace + often("0 INSERT 2 E ")));
  expectRefusal(drawing("", kDxfFace + ("0 POLYLINE " + often("0 VERTEX 8 L 8 L 8 L "))));
  expectRefusal(drawing("", kDxfFace + ("0 TEXT " + often("1 A 1 B 1 C 1 D "))));
}

}  // namespace
}  // namespace allpairs::test
