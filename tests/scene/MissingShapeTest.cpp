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

}  // namespace
}  // namespace allpairs::test
