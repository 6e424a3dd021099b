// SPDX-License-Identifier: MIT
// What Assimp leaves out, puts in wrong places or rounds is not silent.
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadInput.h"
#include "allpairs/scene/WriteResult.h"
#include "support/IfcText.h"
#include "support/Npy.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

/// The names of the models that are read, and behind them the warnings.
std::vector<std::string> namesAndWarnings(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  const scene::Scene scene = scene::readInput(folder.write(name, bytes));
  std::vector<std::string> lines;
  for (const auto& model : scene.models) lines.push_back(model->getName());
  for (const scene::Remark& warning : scene.warnings) {
    EXPECT_EQ(warning.file.filename(), name);
    lines.push_back(warning.subject + ": " + warning.reason);
  }
  return lines;
}

std::string problemReading(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  try {
    static_cast<void>(scene::readInput(folder.write(name, bytes)));
  } catch (const FileError& problem) {
    return std::to_string(problem.line()) + ": " + problem.problem();
  }
  return "none";
}

using Said = std::vector<std::string>;

/// The IFC with another text in place of one of its statements.
std::string ifcWith(const std::string& statement, const std::string& other) {
  std::string text = kIfc;
  const std::size_t at = text.find(statement);
  EXPECT_NE(at, std::string::npos) << statement;
  return text.replace(at, statement.size(), other);
}

constexpr const char* kColumnShape = "#37=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#36));";

TEST(MissingShape, ProductsOfAnIfcWhoseShapesAreNotReadAreNamed) {
  EXPECT_EQ(namesAndWarnings("two.ifc", kIfc), (Said{"wall", "column"}));
  const std::string representation = "#37=IFCSHAPEREPRESENTATION(#10,'Body','CSG',(#52));";
  const std::string block = "#51=IFCBLOCK(#9,1000.,1000.,1000.);\n";
  EXPECT_EQ(
      namesAndWarnings("two.ifc", ifcWith(kColumnShape, block + "#52=IFCCSGSOLID(#51);\n" + representation)),
      (Said{"wall",
            "shapes: IfcCsgSolid is not read: nothing is there of 'column', and parts of others may be missing"}));
  EXPECT_EQ(
      namesAndWarnings("two.ifc", ifcWith(kColumnShape, "#52=IFCBOOLEANRESULT(.UNION.,#36,#36);\n" + representation)),
      (Said{"wall",
            "shapes: IfcBooleanResult of union is not read: nothing is there of 'column', and parts of "
            "others may be missing"}));
  EXPECT_EQ(namesAndWarnings("two.ifc", ifcWith("#35=IFCRECTANGLEPROFILEDEF(.AREA.,$,#34,1000.,1000.);",
                                                "#35=IFCUSHAPEPROFILEDEF(.AREA.,$,#34,1000.,500.,10.,10.,$,$,$,$);")),
            (Said{"wall",
                  "shapes: IfcUShapeProfileDef is not read: nothing is there of 'column', and parts of others "
                  "may be missing"}));
}

TEST(MissingShape, PartsOfProductsOfAnIfcThatAreNotReadAreSaidToBeMissing) {
  EXPECT_EQ(namesAndWarnings("two.ifc", ifcWith(kColumnShape,
                                                "#51=IFCBLOCK(#9,1000.,1000.,1000.);\n"
                                                "#37=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#36,#51));")),
            (Said{"wall", "column", "shapes: IfcBlock is not read: parts of products are missing"}));
}

TEST(MissingShape, PortsOfAnIfcHaveNoShapeThatIsMissing) {
  std::string text = ifcWith("IFCCOLUMN('2AvctVUKr0kugbFTf53O9L',#5,'column',$,$,#32,#38,$)",
                             "IFCDISTRIBUTIONPORT('2AvctVUKr0kugbFTf53O9L',#5,'port',$,$,#32,$,.SOURCE.)");
  const std::string shape = "#25=IFCSHAPEREPRESENTATION(#10,'Body','SweptSolid',(#24";
  text.replace(text.find(shape), shape.size(), "#51=IFCBLOCK(#9,1000.,1000.,1000.);\n" + shape + ",#51");
  EXPECT_EQ(namesAndWarnings("two.ifc", text),
            (Said{"wall", "shapes: IfcBlock is not read: parts of products are missing"}));
}

TEST(MissingShape, AnIfcOfWhichNothingCanBeReadSaysWhy) {
  std::string text = ifcWith(kColumnShape,
                             "#51=IFCBLOCK(#9,1000.,1000.,1000.);\n"
                             "#37=IFCSHAPEREPRESENTATION(#10,'Body','CSG',(#51));");
  text.replace(text.find("(#24)"), 5, "(#51)");
  EXPECT_EQ(problemReading("two.ifc", text), "0: holds no triangles, lines or points: IfcBlock is not read");
}

TEST(MissingShape, AnAxisOfAProductIsNoShapeThatIsMissing) {
  const std::string axis =
      "#51=IFCCARTESIANPOINT((1.,0.));\n#52=IFCPOLYLINE((#20,#51));\n#53=IFCSHAPEREPRESENTATION(#10,'Axis','Curve2D',"
      "(#52));\n#38=IFCPRODUCTDEFINITIONSHAPE($,$,(#53));";
  EXPECT_EQ(namesAndWarnings("two.ifc", ifcWith("#38=IFCPRODUCTDEFINITIONSHAPE($,$,(#37));", axis)), (Said{"wall"}));
}

TEST(MissingShape, ABoundingBoxThatIsAllOfAProductOfAnIfcIsNamed) {
  const std::string box =
      "#51=IFCBOUNDINGBOX(#8,1000.,1000.,5000.);\n#52=IFCSHAPEREPRESENTATION(#10,'Box','BoundingBox',(#51));\n";
  EXPECT_EQ(namesAndWarnings("two.ifc", ifcWith("#38=IFCPRODUCTDEFINITIONSHAPE($,$,(#37));",
                                                box + "#38=IFCPRODUCTDEFINITIONSHAPE($,$,(#52));")),
            (Said{"wall", "shapes: IfcBoundingBox is not read: nothing is there of 'column'"}));
  EXPECT_EQ(namesAndWarnings("two.ifc", ifcWith("#38=IFCPRODUCTDEFINITIONSHAPE($,$,(#37));",
                                                box + "#38=IFCPRODUCTDEFINITIONSHAPE($,$,(#52,#37));")),
            (Said{"wall", "column"}));
}

TEST(MissingShape, TopologyOfAnIfcIsNoShapeThatIsMissing) {
  const std::string vertex =
      "#51=IFCVERTEXPOINT(#8);\n#52=IFCTOPOLOGYREPRESENTATION(#10,'Reference','Vertex',(#51));\n";
  EXPECT_EQ(namesAndWarnings("two.ifc", ifcWith("#38=IFCPRODUCTDEFINITIONSHAPE($,$,(#37));",
                                                vertex + "#38=IFCPRODUCTDEFINITIONSHAPE($,$,(#52,#37));")),
            (Said{"wall", "column"}));
}

TEST(MissingShape, PlacementsOfAnIfcThatAreNotReadAreSaidToBeWrong) {
  const std::string grid =
      "#51=IFCGRIDAXIS('A',#55,.T.);\n#52=IFCGRIDAXIS('B',#55,.T.);\n"
      "#53=IFCVIRTUALGRIDINTERSECTION((#51,#52),(0.,0.,0.));\n#54=IFCCARTESIANPOINT((1.,0.));\n"
      "#55=IFCPOLYLINE((#20,#54));\n#32=IFCGRIDPLACEMENT(#53,$);";
  EXPECT_EQ(namesAndWarnings("two.ifc", ifcWith("#32=IFCLOCALPLACEMENT(#15,#31);", grid)),
            (Said{"wall", "column", "placements: IfcGridPlacement is not read: products are in wrong places"}));
}

TEST(MissingShape, NodesOfAnX3dThatAreNotReadAreNamed) {
  const std::string begin = "<?xml version=\"1.0\"?>\n<X3D version=\"3.3\"><Scene>";
  const std::string box = "<Shape><Box size=\"2 2 2\"/></Shape>";
  const std::string end = "</Scene></X3D>";
  const std::string lod = "<LOD>" + box + "</LOD>";
  EXPECT_EQ(namesAndWarnings("a.x3d", begin + box + "<Viewpoint/><TimeSensor/>" + end), (Said{"a.x3d"}));
  EXPECT_EQ(namesAndWarnings("a.x3d", begin + box + "<Collision>" + box + "</Collision>" + lod + lod + end),
            (Said{"a.x3d", "shapes: Collision, LOD are not read: what they hold is missing"}));
  EXPECT_EQ(problemReading("a.x3d", begin + lod + end), "0: holds no triangles, lines or points: LOD is not read");
  for (const std::string node :
       {"GeoViewpoint", "GeoOrigin", "GeoMetadata", "GeoTouchSensor", "GeoProximitySensor", "GeoPositionInterpolator",
        "NurbsPositionInterpolator", "NurbsOrientationInterpolator", "Viewport", "LOD", "ViewpointGroup"}) {
    std::string text = begin;
    text += box + '<' + node + "/>" + end;
    EXPECT_EQ(namesAndWarnings("a.x3d", text), (Said{"a.x3d"})) << node;
  }
  for (const std::string node : {"PickableGroup", "CollidableShape", "EspduTransform", "LayoutGroup", "LayoutLayer",
                                 "GeoTransform", "Viewport"}) {
    std::string text = begin;
    text += box + '<' + node + "><Group>" + box + "</Group></" + node + '>' + end;
    EXPECT_EQ(namesAndWarnings("a.x3d", text),
              (Said{"a.x3d", "shapes: " + node + " is not read: what they hold is missing"}));
  }
  for (const std::string node : {"QuadSet", "IndexedQuadSet", "NurbsPatchSurface", "Text"}) {
    std::string text = begin;
    text += box + "<Shape><" + node + "/></Shape>" + end;
    EXPECT_EQ(namesAndWarnings("a.x3d", text),
              (Said{"a.x3d", "shapes: " + node + " is not read: what they hold is missing"}));
  }
}

TEST(MissingShape, CoordinatesFarFromTheOriginAreSaidToBeRounded) {
  const std::string placed = ifcWith("#15=IFCLOCALPLACEMENT($,#9);",
                                     "#98=IFCCARTESIANPOINT((456789123.,0.,0.));\n"
                                     "#99=IFCAXIS2PLACEMENT3D(#98,#7,#6);\n#15=IFCLOCALPLACEMENT($,#99);");
  EXPECT_EQ(namesAndWarnings("two.ifc", placed),
            (Said{"wall", "column",
                  "coordinates: up to 4.57e+08 from the origin, where they are rounded by up to 54.5; move the model "
                  "nearer to it"}));
}

/// A triangle in AMF, and what else there is.
std::string amfWith(const std::string& more) {
  return R"(<?xml version="1.0"?><amf unit="millimeter"><object id="1"><mesh><vertices>
<vertex><coordinates><x>0</x><y>0</y><z>0</z></coordinates></vertex>
<vertex><coordinates><x>1</x><y>0</y><z>0</z></coordinates></vertex>
<vertex><coordinates><x>0</x><y>1</y><z>0</z></coordinates></vertex></vertices><volume>
<triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle></volume></mesh></object>)" +
         more + "</amf>";
}

std::string constellationOf(const std::string& how) {
  return R"(<constellation id="2"><instance objectid="1">)" + how + "</instance></constellation>";
}

TEST(MissingShape, ConstellationsOfAnAmfAreAnError) {
  for (const char* how : {"<deltax>5</deltax>", "<rz>90</rz>", "<deltay>0</deltay><scalex>2</scalex>"}) {
    EXPECT_EQ(problemReading("a.amf", amfWith(constellationOf(how))),
              "0: has constellations, which are not read: export each object in its place")
        << how;
  }
}

TEST(MissingShape, ConstellationsOfAnAmfThatLeaveAllInPlaceAndTheWordAreNoError) {
  EXPECT_EQ(namesAndWarnings("a.amf", amfWith(constellationOf("<deltax>0</deltax><rz> 0.0 </rz><scalex>1</scalex>"))),
            (Said{"1"}));
  EXPECT_EQ(namesAndWarnings("a.amf", amfWith("<!-- no <constellation> with <instance> -->")), (Said{"1"}));
  EXPECT_EQ(namesAndWarnings("a.amf", amfWith("<metadata type=\"name\"><![CDATA[<constellation>]]></metadata>")),
            (Said{"1"}));
}

/// An archive whose files are not compressed.
std::string archiveOf(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string bytes;
  std::string directory;
  const auto append = [](std::string& to, auto... numbers) { (appendNumber(to, numbers, false), ...); };
  for (const auto& [name, text] : files) {
    std::uint32_t check = ~0U;
    for (const char c : text) {
      check ^= static_cast<unsigned char>(c);
      for (int bit = 0; bit < 8; ++bit) check = check >> 1U ^ ((check & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    std::string common;
    const auto size = static_cast<std::uint32_t>(text.size());
    append(common, std::uint16_t{20}, std::uint16_t{0}, std::uint16_t{0}, std::uint32_t{0x21'0000}, ~check, size, size,
           static_cast<std::uint16_t>(name.size()), std::uint16_t{0});
    append(directory, std::uint32_t{0x0201'4B50}, std::uint16_t{20});
    directory += common;
    append(directory, std::uint16_t{0}, std::uint16_t{0}, std::uint16_t{0}, std::uint32_t{0},
           static_cast<std::uint32_t>(bytes.size()));
    directory += name;
    append(bytes, std::uint32_t{0x0403'4B50});
    bytes += common + name + text;
  }
  const auto begin = static_cast<std::uint32_t>(bytes.size());
  const auto count = static_cast<std::uint16_t>(files.size());
  bytes += directory;
  append(bytes, std::uint32_t{0x0605'4B50}, std::uint32_t{0}, count, count,
         static_cast<std::uint32_t>(directory.size()), begin, std::uint16_t{0});
  return bytes;
}

TEST(MissingShape, ObjectsInSeveralPartsOfA3mfAreAnError) {
  const std::string types = R"(<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>)";
  const std::string relations = R"(<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
<Relationship Target="/3D/a.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>)";
  const std::string model = R"(<model unit="millimeter"
xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" type="model"><mesh><vertices>
<vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/><vertex x="0" y="1" z="0"/></vertices><triangles>
<triangle v1="0" v2="1" v3="2"/></triangles></mesh></object></resources><build><item objectid="1"/></build></model>)";
  using Files = std::vector<std::pair<std::string, std::string>>;
  const Files files{{"[Content_Types].xml", types}, {"_rels/.rels", relations}, {"3D/a.model", model}};
  const auto with = [&files](const std::string& name, const std::string& text) {
    Files others = files;
    others.emplace_back(name, text);
    return archiveOf(others);
  };
  EXPECT_EQ(namesAndWarnings("a.3mf", archiveOf(files)), (Said{"Object_1"}));
  EXPECT_EQ(namesAndWarnings("a.3mf", with("__MACOSX/3D/._a.model", "x")), (Said{"Object_1"}));
  EXPECT_EQ(namesAndWarnings("a.3mf", with("Metadata/thumbnail.png", "\x89PNG")), (Said{"Object_1"}));
  for (const char* name : {"3D/Objects/b.model", "3D/Objects/b.MODEL"}) {
    EXPECT_EQ(problemReading("a.3mf", with(name, model)),
              "0: has objects in several parts, which are not read: export it as one part")
        << name;
  }
}

/// A drawing: what it has in its blocks, and in itself.
std::string dxf(const std::string& blocks, const std::string& entities) {
  return "0\nSECTION\n2\nBLOCKS\n" + blocks + "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

constexpr const char* kFace =
    "0\n3DFACE\n8\nwalls\n10\n1\n20\n2\n30\n3\n11\n5\n21\n2\n31\n3\n12\n1\n22\n9\n32\n4\n13\n1\n23\n9\n33\n4\n";

std::string dxfBlock(const std::string& name, const std::string& entities) {
  return "0\nBLOCK\n8\n0\n2\n" + name + "\n10\n0\n20\n0\n30\n0\n" + entities + "0\nENDBLK\n";
}

std::string dxfInsert(const std::string& how, const std::string& name = "B") {
  return "0\nINSERT\n8\nwalls\n2\n" + name + "\n10\n10\n20\n20\n30\n30\n" + how;
}

TEST(MissingShape, BlocksOfADxfThatAreOnlyMovedAreRead) {
  const TempFolder folder;
  for (const char* how : {"", "41\n1.0\n42\n1\n43\n1\n50\n0.0\n70\n1\n71\n0\n210\n0\n220\n0\n230\n1\n",
                          "41\n1.0000000000000002\n42\n0.9999999999999999\n50\n6.361109362927032E-15\n210\n1.2e-16\n",
                          "50\n360\n", "50\n-360.0\n"}) {
    const scene::Scene scene = scene::readInput(folder.write("a.dxf", dxf(dxfBlock("B", kFace), dxfInsert(how))));
    ASSERT_EQ(scene.models.size(), 1U) << how;
    scene.models[0]->computeBoundingTree();
    EXPECT_EQ(scene::modelRecord(*scene.models[0]).box, (Box{{11, 22, 33}, {15, 29, 34}})) << how;
    EXPECT_TRUE(scene.warnings.empty()) << how;
  }
}

TEST(MissingShape, WhatWouldBeInAWrongPlaceInADxfIsAnError) {
  for (const char* how : {"50\n90\n", "42\n2\n", "70\n3\n", "230\n-1\n", "210\n1\n"}) {
    EXPECT_EQ(problemReading("a.dxf", dxf(dxfBlock("B", kFace), dxfInsert(how))),
              "54: an INSERT that turns, scales or repeats its block is not read; explode it")
        << how;
  }
  EXPECT_EQ(problemReading("a.dxf", dxf(dxfBlock("A", kFace) + dxfBlock("B", dxfInsert("", "A")), dxfInsert(""))),
            "60: a block within a block is not read; explode it");
  EXPECT_EQ(problemReading("a.dxf", dxf("", std::string(kFace) + "0\nPOLYLINE\n70\n8\n0\nVERTEX\n10\n1\n0\nSEQEND\n")),
            "40: a POLYLINE that is no polyface mesh is not read; export LINEs");
  EXPECT_EQ(problemReading("a.dxf",
                           dxf("", std::string(kFace) +
                                       "0\nPOLYLINE\n70\n64\n0\nVERTEX\n70\n128\n71\n-1\n72\n2\n73\n3\n0\nSEQEND\n")),
            "44: a POLYLINE that hides edges of its faces is not read; export 3DFACEs");
  EXPECT_EQ(problemReading("a.dxf", dxf("", std::string(kFace) + "0\n3DSOLID\n1\nmanm\n")),
            "40: '3DSOLID' is not read; export 3DFACEs");
}

TEST(MissingShape, CurvesOfADxfAreNamedAndTextsAndUnusedBlocksAreNot) {
  const std::string unused = dxfBlock("A", "0\n3DSOLID\n1\nmanm\n" + dxfInsert("50\n90\n"));
  const std::string curves = "0\nCIRCLE\n40\n5\n0\nARC\n40\n5\n0\nCIRCLE\n40\n6\n";
  EXPECT_EQ(namesAndWarnings("a.dxf", dxf(unused, std::string(kFace) + "0\nTEXT\n1\nROOM\n")), (Said{"walls"}));
  EXPECT_EQ(namesAndWarnings("a.dxf", dxf(unused, kFace + curves)),
            (Said{"walls", "shapes: 3 of kinds that are not read are missing: ARC, CIRCLE"}));
}

constexpr const char* kDxfText = "0\nTEXT\n8\n0\n10\n100\n20\n200\n30\n0\n40\n2\n1\nROOM\n";
constexpr const char* kDxfCircle = "0\nCIRCLE\n8\n0\n10\n100\n20\n200\n30\n0\n40\n2\n";
constexpr const char* kDxfAttribute = "0\nATTDEF\n8\n0\n10\n0\n20\n0\n30\n0\n40\n2\n1\nx\n2\nTAG\n";

TEST(MissingShape, ABlockOfADxfThatOtherEntitiesWouldMoveOrRenameIsAnError) {
  const std::string face = kFace;
  const auto problem = [&](const std::string& content) {
    return problemReading("a.dxf", dxf(dxfBlock("B", content), face + dxfInsert("")));
  };
  EXPECT_EQ(problem(face + kDxfText),
            "46: a block of faces or lines in which there is 'TEXT' too is not read; explode it");
  EXPECT_EQ(problem(kDxfCircle + face),
            "18: a block of faces or lines in which there is 'CIRCLE' too is not read; explode it");
  EXPECT_EQ(problem(face + kDxfAttribute),
            "46: a block of faces or lines in which there is 'ATTDEF' too is not read; explode it");
  EXPECT_EQ(problem(face + "0\nHATCH\n10\n0\n20\n0\n30\n0\n2\nANSI31\n70\n0\n"),
            "46: a block of faces or lines in which there is 'HATCH' too is not read; explode it");
  EXPECT_EQ(problem(face + "0\nCIRCLE\n10\n0\n20\n0\n30\n0\n40\n2\n"), "none");  // at the block's base
  EXPECT_EQ(problemReading("a.dxf", dxf(dxfBlock("A", face + kDxfText) + dxfBlock("B", face), dxfInsert(""))), "none");
}

TEST(MissingShape, ABlockOfADxfThatIsInsertedByAnotherNameIsAnErrorOrNamed) {
  const std::string face = kFace;
  EXPECT_EQ(problemReading("a.dxf", dxf(dxfBlock("b", face), face + dxfInsert(""))),
            "82: the block 'b' is not read where it is called 'B'");
  EXPECT_EQ(namesAndWarnings("a.dxf", dxf(dxfBlock("b", face) + dxfBlock("B", face), dxfInsert(""))), (Said{"walls"}));
  EXPECT_EQ(namesAndWarnings("a.dxf", dxf(dxfBlock("b", kDxfText), face + dxfInsert(""))), (Said{"walls"}));
  const std::string other = "0\nBLOCK\n2\nB\n70\n4\n10\n0\n20\n0\n30\n0\n1\nother.dwg\n0\nENDBLK\n";
  EXPECT_EQ(namesAndWarnings("a.dxf", dxf(other, face + dxfInsert(""))),
            (Said{"walls", "shapes: blocks of other drawings are not read, and missing: 'B'"}));
  EXPECT_EQ(namesAndWarnings("a.dxf", dxf(other, face)), (Said{"walls"}));
}

TEST(MissingShape, BlocksOfADxfWithoutShapesMayBeTurnedAndInEachOther) {
  const std::string face = kFace;
  const auto said = [&](const std::string& blocks) {
    return namesAndWarnings("a.dxf", dxf(blocks, face + dxfInsert("50\n90\n")));
  };
  EXPECT_EQ(said(""), (Said{"walls"}));
  EXPECT_EQ(said(dxfBlock("B", "")), (Said{"walls"}));
  EXPECT_EQ(said(dxfBlock("B", kDxfText)), (Said{"walls"}));
  const Said circle{"walls", "shapes: 1 of kinds that are not read is missing: CIRCLE"};
  EXPECT_EQ(said(dxfBlock("B", kDxfCircle)), circle);
  const std::string inB = dxfInsert("50\n90\n", "A");
  EXPECT_EQ(said(dxfBlock("A", kDxfCircle) + dxfBlock("B", inB)), circle);
  const auto nested = [&](const std::string& content) {
    return problemReading("a.dxf", dxf(dxfBlock("A", kDxfText) + dxfBlock("B", content), dxfInsert("")));
  };
  EXPECT_EQ(nested(face + inB), "none");
  EXPECT_EQ(nested(inB + face), "46: a block within a block is not read; explode it");
  EXPECT_EQ(problemReading("a.dxf", dxf(dxfBlock("B", inB) + dxfBlock("A", dxfInsert("")), face + dxfInsert(""))),
            "none");  // they are in each other
}

TEST(MissingShape, PaperSpaceOfADxfIsNoErrorAndSaidToBeInTheModel) {
  const std::string line = "0\nLINE\n67\n1\n8\nframe\n10\n100\n20\n100\n30\n0\n11\n200\n21\n100\n31\n0\n";
  const std::string polyline =
      "0\nPOLYLINE\n67\n1\n8\nframe\n70\n1\n0\nVERTEX\n10\n0\n20\n0\n30\n0\n0\nVERTEX\n10\n1\n20\n0\n30\n0\n"
      "0\nVERTEX\n10\n1\n20\n5\n30\n0\n0\nSEQEND\n";
  const std::string other = "0\n3DSOLID\n67\n1\n1\nmanm\n0\nCIRCLE\n67\n1\n40\n5\n";
  EXPECT_EQ(namesAndWarnings("a.dxf", dxf(dxfBlock("B", kFace), kFace + other)), (Said{"walls"}));
  EXPECT_EQ(
      namesAndWarnings("a.dxf", dxf(dxfBlock("B", kFace), kFace + line + polyline + dxfInsert("67\n1\n41\n2\n"))),
      (Said{"walls", "frame", "shapes: 3 of the paper space are read as if in the model: INSERT, LINE, POLYLINE"}));
}

TEST(MissingShape, APolylineOfADxfOfOnePieceIsRead) {
  const auto polyline = [](const std::string& how, const std::string& last) {
    return dxf("", "0\nPOLYLINE\n8\nwalls\n" + how +
                       "0\nVERTEX\n10\n1\n20\n2\n30\n3\n0\nVERTEX\n10\n5\n20\n2\n30\n3\n" + last + "0\nSEQEND\n");
  };
  EXPECT_EQ(namesAndWarnings("a.dxf", polyline("70\n8\n", "")), (Said{"walls"}));
  EXPECT_EQ(namesAndWarnings("a.dxf", polyline("", "")), (Said{"walls"}));
  const std::string problem = "12: a POLYLINE that is no polyface mesh is not read; export LINEs";
  EXPECT_EQ(problemReading("a.dxf", polyline("", "0\nVERTEX\n10\n5\n20\n9\n30\n3\n")), problem);
  EXPECT_EQ(problemReading("a.dxf", polyline("", "42\n0.5\n")), problem);
  EXPECT_EQ(problemReading("a.dxf", polyline("230\n-1\n", "")), problem);
}

TEST(MissingShape, ATextOfADxfThatHidesShapesIsAnError) {
  const std::string face = kFace;
  const std::string text = "0\nMTEXT\n8\n0\n10\n0\n20\n0\n30\n0\n1\n{\\fArial|b0;room}\n";
  const std::string group =
      "0\nLINE\n5\n2A\n102\n{ACAD_REACTORS\n330\n2\n102\n}\n8\nwalls\n10\n1\n20\n2\n30\n3\n11\n5\n";
  const std::string problem = ": what follows a text that begins with '{' is not read; remove it";
  EXPECT_EQ(problemReading("a.dxf", dxf("", face + text + face)), "50" + problem);
  EXPECT_EQ(problemReading("a.dxf", dxf("", face + text + group)), "50" + problem);
  EXPECT_EQ(problemReading("a.dxf", dxf(dxfBlock("B", face), face + text + dxfInsert(""))), "92" + problem);
  EXPECT_EQ(problemReading("a.dxf", dxf(dxfBlock("B", text + face) + group, face + dxfInsert(""))), "28" + problem);
  EXPECT_EQ(problemReading("a.dxf", dxf("", face + text)), "none");
  EXPECT_EQ(problemReading("a.dxf", dxf("", face + text + kDxfText + "0\nTEXT\n1\n\n" + face + group + face)), "none");
  EXPECT_EQ(problemReading("a.dxf", dxf("", face + group + face)), "none");
}

}  // namespace
}  // namespace allpairs::test
