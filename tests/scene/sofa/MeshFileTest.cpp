// SPDX-License-Identifier: MIT
#include <map>

#include "allpairs/scene/FileError.h"
#include "scene/sofa/SceneText.h"
#include "sofa/mesh/Mesh.h"

namespace allpairs::scene::sofa {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;
using Line = std::array<Index, 2>;
using Triangle = std::array<Index, 3>;
using Four = std::array<Index, 4>;

class SofaMeshFile : public SceneTest {
 protected:
  [[nodiscard]] Mesh mesh(const std::string& name, const std::string& text) const {
    auto result = readMesh(m_folder.write(name, text), nullptr);
    checkMesh(result, name);
    return result;
  }
  [[nodiscard]] std::string problem(const std::string& name, const std::string& text) const {
    try {
      (void)mesh(name, text);
    } catch (const FileError& error) {
      return error.what();
    }
    return {};
  }
};

TEST_F(SofaMeshFile, Utf16IsNamed) {
  const std::string little("\xff\xfeO\0F\0F\0", 8);
  for (const std::string name : {"a.obj", "a.off", "a.trian", "a.sph", "a.msh", "a.vtk", "a.vtu"})
    EXPECT_THAT(problem(name, little), testing::EndsWith(name + ": is a text in UTF-16; UTF-8 can be read"));
}

TEST_F(SofaMeshFile, AStopEndsTheReadingOfEveryKind) {
  std::string plain, obj, spheres, gmsh;
  for (int i = 0; i < 200; ++i) {
    plain += "0 0 0\n";
    obj += "v 0 0 0\n";
    spheres += "sphe 0 0 0 0 1\n";
    gmsh += std::to_string(i) + " 0 0 0\n";
  }
  const std::string points = "<Piece><Points><DataArray>" + plain + "</DataArray></Points></Piece>";
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.obj", obj},
      {"a.off", "OFF\n200 0 0\n" + plain},
      {"a.trian", "200\n" + plain + "0\n"},
      {"a.sph", "sph 1.0\n" + spheres},
      {"a.msh", "$NOD\n200\n" + gmsh + "$ENDNOD\n$ELM\n0\n$ENDELM\n"},
      {"a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 200 float\n" + plain},
      {"a.vtu", "<VTKFile><UnstructuredGrid>" + points + "</UnstructuredGrid></VTKFile>"},
      {"a.vtp", "<VTKFile><PolyData>" + points + "</PolyData></VTKFile>"}};
  for (const auto& [name, text] : files) {
    EXPECT_THAT(mesh(name, text).positions, SizeIs(200)) << name;
    int asked = 0;
    const auto isTime = [&asked] { return ++asked > 100; };
    const StopFlag stop(isTime);
    EXPECT_THROW((void)readMesh(m_folder.path() / name, &stop), Stopped) << name;
  }
}

constexpr auto kObj = "# a comment\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\n";

TEST_F(SofaMeshFile, ObjKeepsItsPointsAndTheOrderOfItsFaces) {
  const auto m = mesh("a.obj", std::string{kObj} + "g part\nf 1 2 3\nf 1/1 2/2/2 3//3 4\nl 3 1\nf -5 -4 -3\n");
  EXPECT_THAT(m.positions, SizeIs(5));
  EXPECT_THAT(m.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 1, 2}));
  EXPECT_THAT(m.quads, ElementsAre(Four{0, 1, 2, 3}));
  EXPECT_THAT(m.edges, ElementsAre(Line{0, 2}));
}

TEST_F(SofaMeshFile, ObjFansLargerFaces) {
  const auto m = mesh("a.obj", std::string{kObj} + "f 1 2 3 4 5\n");
  EXPECT_THAT(m.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{0, 3, 4}));
}

TEST_F(SofaMeshFile, ObjCutsQuadsOnRequest) {
  const auto file = m_folder.write("a.obj", std::string{kObj} + "f 1 2 3 4\n");
  EXPECT_THAT(readObj(file, {.triangulate = true}, nullptr).triangles,
              ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
}

TEST_F(SofaMeshFile, ObjSplitsSeamsOnRequestAndDropsWhatNoFaceUses) {
  const auto file = m_folder.write(
      "a.obj",
      "v 0 0 0\nv 1 0 0\nv 9 9 9\nv 0 1 0\nvt 0 0\nvt 1 1\nvn 0 0 1\nf 1/1/1 2/1/1 4/1/1\nf 1/2/1 2/1/1 4/1/1\n");
  const auto m = readObj(file, {.triangulate = false, .splitSeams = true}, nullptr);
  EXPECT_THAT(m.positions, ElementsAre(Vec3{0, 0, 0}, Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}));
  EXPECT_THAT(m.triangles, ElementsAre(Triangle{0, 2, 3}, Triangle{1, 2, 3}));
}

TEST_F(SofaMeshFile, ObjNamesTheLineOfWhatIsWrong) {
  EXPECT_THAT(problem("a.obj", "v 0 0 0\nv 1 x 0\n"), AllOf(HasSubstr("a.obj:2:"), testing::Not(HasSubstr("'x'"))));
  EXPECT_THAT(problem("a.obj", "v 0 0\n"), HasSubstr("a.obj:1:"));
  EXPECT_THAT(problem("a.obj", "v 0 0 nan\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(problem("a.obj", "v 0 0 1e999\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(problem("a.obj", "v 0 0 0\nf 1 2 3\n"), HasSubstr("a point that isn't there"));
  EXPECT_THAT(problem("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n# end\n"), HasSubstr("a.obj:3: a face names a point that"));
  EXPECT_THAT(problem("a.obj", "v 0 0 0\nf 0 1 1\n"), HasSubstr("count from 1"));
  EXPECT_THAT(problem("a.obj", "v 0 0 0\nf -2 1 1\n"), HasSubstr("before the first point"));
  EXPECT_THAT(problem("a.obj", "v 0 0 0\nf 99999999999999999999 1 1\n"), HasSubstr("not an integer"));
}

constexpr auto kNodes = "4\n10 0 0 0\n20 1 0 0\n30 0 1 0\n7 0 0 1\n";

TEST_F(SofaMeshFile, GmshOneAndTwoRenumberNodesByTheirOrder) {
  const auto first = mesh("a.msh", std::string{"$NOD\n"} + kNodes +
                                       "$ENDNOD\n$ELM\n3\n1 1 0 0 2 10 20\n2 2 0 0 3 10 20 30\n"
                                       "3 4 0 0 4 10 20 30 7\n$ENDELM\n");
  const auto second = mesh("b.msh", std::string{"$MeshFormat\n2.1 0 8\n$EndMeshFormat\n$Nodes\n"} + kNodes +
                                        "$EndNodes\n$Elements\n4\n1 1 2 0 0 10 20\n2 2 0 10 20 30\n3 4 1 5 10 20 30 7\n"
                                        "4 15 2 0 0 10\n$EndElements\n");
  for (const auto& m : {first, second}) {
    EXPECT_THAT(m.positions, ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}));
    EXPECT_THAT(m.edges, ElementsAre(Line{0, 1}));
    EXPECT_THAT(m.triangles, ElementsAre(Triangle{0, 1, 2}));
    EXPECT_THAT(m.tetrahedra, ElementsAre(Four{0, 1, 2, 3}));
  }
}

TEST_F(SofaMeshFile, GmshPassesOverOtherSectionsAndElements) {
  const auto m =
      mesh("a.msh", std::string{"$MeshFormat\n2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n2 1 \"x\"\n"
                                "$EndPhysicalNames\n$Nodes\n"} +
                        kNodes + "$EndNodes\n$Elements\n2\n1 99 2 0 0 10 20 30\n2 2 2 0 0 10 20 30\n$EndElements\n");
  EXPECT_THAT(m.triangles, SizeIs(1));
}

TEST_F(SofaMeshFile, GmshFourPointOneIsReadInBlocks) {
  // Two blocks of nodes, the first with parametric coordinates, then a point, a line, and two triangles of six nodes.
  const auto m = mesh("a.msh",
                      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 0 0\n1 0 0 0 0\n$EndEntities\n"
                      "$Nodes\n2 6 1 6\n1 1 1 2\n1\n2\n0 0 0 0.5\n1 0 0 0.6\n2 1 0 4\n3\n4\n5\n6\n"
                      "0 1 0\n1 1 0\n0.5 0 0\n0.5 1 0\n$EndNodes\n"
                      "$Elements\n3 4 1 4\n0 1 15 1\n1 1\n1 1 1 1\n2 1 2\n2 1 9 2\n3 1 2 3 5 5 5\n4 2 4 3 6 6 6\n"
                      "$EndElements\n");
  EXPECT_THAT(m.positions, ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}, Vec3{0.5, 0, 0},
                                       Vec3{0.5, 1, 0}));
  EXPECT_THAT(m.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{1, 3, 2}));
  EXPECT_THAT(m.edges, ElementsAre(Line{0, 1}, Line{0, 1}, Line{1, 2}, Line{0, 2}, Line{1, 3}, Line{2, 3}))
      << "the edges of larger elements each once";
}

TEST_F(SofaMeshFile, GmshNamesWhatIsWrong) {
  EXPECT_THAT(problem("a.msh", "hello"), HasSubstr("no Gmsh mesh"));
  EXPECT_THAT(problem("a.msh", "$MeshFormat\n4 0 8\n$EndMeshFormat\n"), HasSubstr("only the forms 1, 2 and 4.1"));
  EXPECT_THAT(problem("a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 9000000000 1 1\n2 1 0 9000000000\n"),
              HasSubstr("missing"));
  EXPECT_THAT(problem("a.msh", "$MeshFormat\n2.1 1 8\n"), HasSubstr("only Gmsh meshes in ASCII"));
  EXPECT_THAT(problem("a.msh", "$NOD\n1000000000\n1 0 0 0\n"), HasSubstr("missing"));
  EXPECT_THAT(problem("a.msh", std::string{"$NOD\n"} + kNodes + "$ENDNOD\n$ELM\n1\n1 2 0 0 3 10 20 99\n$ENDELM"),
              HasSubstr("a node that isn't there"));
  EXPECT_THAT(problem("a.msh", std::string{"$NOD\n"} + kNodes + "$ENDNOD\n$ELM\n1\n1 2 0 0 1 10\n$ENDELM"),
              HasSubstr("too few nodes"));
}

TEST_F(SofaMeshFile, SpheresHaveCentresAndRadii) {
  const auto m = mesh("a.sph", "sph 1.0\nnums 2\nsphe 0 1 2 3 0.5\n# comment\nwhat is this\nsphe 1 4 5 6 2\n");
  EXPECT_THAT(m.positions, ElementsAre(Vec3{1, 2, 3}, Vec3{4, 5, 6}));
  EXPECT_THAT(m.radii, ElementsAre(0.5, 2));
  EXPECT_THAT(problem("a.sph", "nums 2\n"), HasSubstr("starts with 'sph 1.0'"));
  EXPECT_THAT(problem("a.sph", "sph 1.0\nsphe 0 1 2\n"), HasSubstr("a.sph:"));
}

constexpr auto kVtuHead =
    "<VTKFile type='UnstructuredGrid'><UnstructuredGrid><Piece><Points><DataArray format='ascii'>"
    "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>";

TEST_F(SofaMeshFile, VtkIsReadAsXmlAndAsText) {
  const auto xml = mesh("a.vtu", std::string{kVtuHead} +
                                     "<DataArray Name='connectivity'>0 1 2 3 0 1 2</DataArray>"
                                     "<DataArray Name='offsets'>4 7</DataArray><DataArray Name='types'>10 5</DataArray>"
                                     "</Cells></Piece></UnstructuredGrid></VTKFile>");
  const auto text = mesh("a.vtk",
                         "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
                         "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 2 9\n4 0 1 2 3\n3 0 1 2\nCELL_TYPES 2\n10\n5\n");
  for (const auto& m : {xml, text}) {
    EXPECT_THAT(m.positions, SizeIs(4));
    EXPECT_THAT(m.tetrahedra, ElementsAre(Four{0, 1, 2, 3}));
    EXPECT_THAT(m.triangles, ElementsAre(Triangle{0, 1, 2}));
  }
}

TEST_F(SofaMeshFile, EdgesOfTheSecondOrderInVtkJoinTheirEnds) {
  const auto m = mesh("a.vtk",
                      "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n"
                      "0 0 0 1 0 0 0.5 0 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n21\n");
  EXPECT_THAT(m.edges, ElementsAre(Line{0, 1}));
}

TEST_F(SofaMeshFile, VtkMayBeBinary) {
  const std::string one("\x3f\x80\0\0", 4), zero(4, '\0');
  const auto number = [](char n) { return std::string(3, '\0') + n; };
  const auto m = mesh("a.vtk", "# vtk DataFile Version 3.0\ntitle\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n" + zero +
                                   zero + zero + one + zero + zero + zero + one + zero + "\nPOLYGONS 1 4\n" +
                                   number(3) + number(0) + number(1) + number(2) + "\n");
  EXPECT_THAT(m.positions, ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}));
  EXPECT_THAT(m.triangles, ElementsAre(Triangle{0, 1, 2}));
  const std::string two("\x40\0\0\0\0\0\0\0", 8);
  EXPECT_THAT(mesh("b.vtk", "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 1 DOUBLE\n" + two + two +
                                two + "\n")
                  .positions,
              ElementsAre(Vec3{2, 2, 2}));
}

/// As VTK 9 writes them unless it is told otherwise.
TEST_F(SofaMeshFile, VtkOfVersion5IsNamed) {
  const std::string refusal =
      "is of version 5 of VTK's files, in which cells stand in two arrays: write version 4.2, which can be read";
  for (const std::string encoding : {"ASCII", "BINARY"}) {
    const std::string numbers = encoding == "ASCII" ? "0 0 0 1 0 0 0 1 0" : std::string(36, '\0');
    const std::string head = "# vtk DataFile Version 5.1\nt\n" + encoding + "\nDATASET ";
    const std::string points = "\nPOINTS 3 float\n" + numbers + "\n";
    const std::string arrays = " 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\n";
    for (const char* cells : {"POLYGONS", "LINES", "TRIANGLE_STRIPS"})
      EXPECT_THAT(problem("a.vtk", head + "POLYDATA" + points + cells + arrays), HasSubstr("a.vtk:8: " + refusal));
    EXPECT_THAT(problem("a.vtk", head + "UNSTRUCTURED_GRID" + points + "CELLS" + arrays + "CELL_TYPES 1\n5\n"),
                HasSubstr("a.vtk:8: " + refusal));
    EXPECT_THAT(mesh("a.vtk", head + "POLYDATA" + points + "VERTICES" + arrays).positions, SizeIs(3));
  }
}

TEST_F(SofaMeshFile, VtkNamesWhatIsWrong) {
  EXPECT_THAT(problem("a.vtk", "nothing"), HasSubstr("no VTK file"));
  EXPECT_THAT(problem("a.vtu", "<VTKFile><Unstr"), HasSubstr("not well-formed"));
  EXPECT_THAT(
      problem("a.vtu", std::string{kVtuHead} + "<DataArray Name='connectivity'>0 1 9</DataArray><DataArray "
                                               "Name='offsets'>3</DataArray><DataArray Name='types'>5</DataArray>"
                                               "</Cells></Piece></UnstructuredGrid></VTKFile>"),
      HasSubstr("missing point"));
  EXPECT_THAT(
      problem("a.vtu", std::string{kVtuHead} + "<DataArray Name='connectivity'>0 1 2</DataArray><DataArray "
                                               "Name='offsets'>1e300</DataArray></Cells></Piece></UnstructuredGrid>"
                                               "</VTKFile>"),
      HasSubstr("offsets"));
  EXPECT_THAT(
      problem("a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3000000000 float\n0 0 0\n"),
      HasSubstr("out of all reason"));
  EXPECT_THAT(problem("a.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 int\n0 0 0\n"),
              HasSubstr("float and double only"));
  EXPECT_THAT(problem("a.vtu", std::string{kVtuHead} + "</Cells></Piece><Piece/></UnstructuredGrid></VTKFile>"),
              HasSubstr("several pieces"));
  EXPECT_THAT(problem("a.vtk",
                      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n"
                      "0 0 0 1 0 0 0 1 0 0 0 1\nCELLS 1 5\n4 0 1 2 3\n"),
              HasSubstr("the list of the cells' types is missing"));
  EXPECT_THAT(problem("a.vtu", std::string{kVtuHead} +
                                   "<DataArray Name='connectivity'>0 1 2 3</DataArray><DataArray "
                                   "Name='offsets'>4</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>"),
              HasSubstr("the list of the cells' types is missing"));
}

TEST_F(SofaMeshFile, OfPolygonsInXmlTrianglesAndQuadsAreFaces) {
  const std::string vtp =
      "<VTKFile type='PolyData'><PolyData><Piece><Points><DataArray>0 0 0 1 0 0 2 1 0 1 2 0 0 1 0</DataArray></Points>"
      "<Polys><DataArray Name='connectivity'>0 1 2 3 4 0 1 0 1 2 0 1 2 3</DataArray>"
      "<DataArray Name='offsets'>5 7 10 14</DataArray></Polys></Piece></PolyData></VTKFile>";
  const auto m = mesh("a.vtp", vtp);
  EXPECT_THAT(m.edges, ElementsAre(Line{0, 1}));
  EXPECT_THAT(m.triangles, ElementsAre(Triangle{0, 1, 2}));
  EXPECT_THAT(m.quads, ElementsAre(Four{0, 1, 2, 3}));
  EXPECT_EQ(m.passedOver, 1U);
  const std::string scene =
      "<MeshVTKLoader name='l' filename='a.vtp'/><MeshTopology src='@l'/><MechanicalObject/>"
      "<TriangleModel/>";
  m_sofa = SofaVersion::Sofa2006;
  EXPECT_THAT(complaintIn(scene), HasSubstr("SOFA 20.06 does not read PolyData"));
  m_sofa = SofaVersion::Sofa2612;
  const auto read = readIn(scene);
  EXPECT_THAT(read.models.at(0).triangles, SizeIs(3));
  ASSERT_THAT(read.warnings, testing::Not(testing::IsEmpty()));
  EXPECT_EQ(read.warnings.back().reason,
            "1 element of its file is of a kind that SOFA does not read, and is passed over");
}

TEST_F(SofaMeshFile, ElementsOfKindsThatSofaDoesNotReadAreCounted) {
  const std::string six = "6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 0 1\n6 0 1 1\n";
  const auto gmsh =
      mesh("a.msh", "$MeshFormat\n2 0 8\n$EndMeshFormat\n$Nodes\n" + six +
                        "$EndNodes\n$Elements\n3\n1 2 0 1 2 3\n2 6 0 1 2 3 4 5 6\n3 15 0 1\n$EndElements\n");
  EXPECT_THAT(gmsh.triangles, SizeIs(1));
  EXPECT_EQ(gmsh.passedOver, 1U) << "a prism; a point is no element";
  const auto vtk = mesh("a.vtk",
                        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 float\n"
                        "0 0 0 1 0 0 0 1 0 0 0 1 1 0 1 0 1 1\nCELLS 4 17\n3 0 1 2\n6 0 1 2 3 4 5\n1 0\n3 0 1 2\n"
                        "CELL_TYPES 4\n5\n13\n1\n4\n");
  EXPECT_THAT(vtk.triangles, SizeIs(1));
  EXPECT_EQ(vtk.passedOver, 2U) << "a prism and a line of several";
  EXPECT_EQ(mesh("a.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n-1 0 0\n5 0 1 2 3 4\n3 0 1 2\n2 0 1\n").passedOver,
            2U);
}

TEST_F(SofaMeshFile, StripsAndLinesOfAVtkSurfaceAreCounted) {
  const auto words = [](const std::string& encoding, const std::string& numbers, const std::string& strip) {
    return "# vtk DataFile Version 3.0\nt\n" + encoding + "\nDATASET POLYDATA\nTRIANGLE_STRIPS 1 5\n" + strip +
           "\nPOINTS 4 float\n" + numbers + "\n";
  };
  const std::string points = "0 0 0 1 0 0 0 1 0 1 1 0";
  const auto text = mesh("a.vtk", words("ASCII", points, "4 0 1 2 3") +
                                      "POLYGONS 1 4\n3 0 1 2\nLINES 2 6\n2 0 1 2 1 2\n"
                                      "VERTICES 1 2\n1 0\n");
  EXPECT_THAT(text.triangles, SizeIs(1));
  EXPECT_EQ(text.passedOver, 3U) << "a point is no element";
  const auto binary =
      mesh("a.vtk", words("BINARY", std::string(48, '\0'), std::string("\0\0\0\4POINTS 9 float\n", 19) + '\0'));
  EXPECT_THAT(binary.positions, SizeIs(4));
  EXPECT_EQ(binary.passedOver, 1U);
  const auto xml = mesh("a.vtp",
                        "<VTKFile><PolyData><Piece NumberOfLines='2' NumberOfStrips='1'><Points><DataArray>0 0 0"
                        "</DataArray></Points></Piece></PolyData></VTKFile>");
  EXPECT_EQ(xml.passedOver, 3U);
}

TEST_F(SofaMeshFile, VtkPolygonsAndStripsOfLessThanThreeCornersAreCounted) {
  const std::string head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET ";
  const std::string points = "\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n";
  const auto surface = mesh("a.vtk", head + "POLYDATA" + points + "POLYGONS 3 9\n2 0 1\n3 0 1 2\n1 0\n");
  EXPECT_THAT(surface.triangles, SizeIs(1));
  EXPECT_EQ(surface.passedOver, 2U);
  const auto cells =
      mesh("a.vtk", head + "UNSTRUCTURED_GRID" + points + "CELLS 3 10\n2 0 1\n3 0 1 2\n2 1 2\nCELL_TYPES 3\n7\n7\n6\n");
  EXPECT_THAT(cells.triangles, SizeIs(1));
  EXPECT_EQ(cells.passedOver, 2U);
}

TEST_F(SofaMeshFile, VtkNamesTheLineOfACellEvenWherePointsComeLater) {
  const std::string head = "# vtk DataFile Version 2.0\nx\nASCII\nDATASET POLYDATA\n";
  const std::string points = "POINTS 3 float\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_THAT(problem("a.vtk", head + points + "POLYGONS 2 8\n3 0 1 2\n3 0 1 9\nPOINT_DATA 3\n"),
              HasSubstr("a.vtk:11: a cell names a missing point"));
  EXPECT_THAT(problem("a.vtk", head + "POLYGONS 2 8\n3 0 1 2\n9 0 1 2\n" + points),
              HasSubstr("a.vtk:7: the list of cells is cut off"));
}

TEST_F(SofaMeshFile, OffMayHaveComments) {
  const auto read =
      mesh("a.off", "OFF\n# made by hand\n3 1 0\n# points\n0 0 0\n1 0 0\n# the last\n0 1 0\n\n# a face\n3 0 1 2\n");
  EXPECT_THAT(read.positions, SizeIs(3));
  EXPECT_EQ(read.triangles, (Elements<3>{{0, 1, 2}}));
}

TEST_F(SofaMeshFile, NumbersOutOfRangeAreToldApartByAllOfTheirDigits) {
  const std::string zeros(400, '0');
  EXPECT_THAT(mesh("a.off", "OFF 1 0 0\n1.5e-400 -0." + zeros + "1 " + "0." + zeros + "1e+40").positions,
              ElementsAre(Vec3{0, 0, 0}));
  EXPECT_THAT(problem("a.off", "OFF 1 0 0\n0 0 1" + zeros + "e-5"), HasSubstr("not a finite number"));
  EXPECT_THAT(problem("a.off", "OFF 1 0 0\n0 0 1e99999999999999999999"), HasSubstr("not a finite number"));
  EXPECT_THAT(problem("a.off", "OFF 1 0 0\n0 0 +-1"), HasSubstr("not a finite number"));
}

TEST_F(SofaMeshFile, OffAndTrianAreRead) {
  EXPECT_THAT(mesh("a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n").quads, SizeIs(1));
  EXPECT_THAT(mesh("a.trian", "3\n0 0 0\n1 0 0\n1 1 0\n1\n0 1 2 -1 -1 -1\n").triangles, SizeIs(1));
}

TEST_F(SofaMeshFile, FacesOfOffAndTrianNameThePointsThatAreThere) {
  const std::string points = "OFF\n4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const auto read = mesh("a.off", points + "3 3 1 2\n4 1 0 3 2\n2 0 1\n");
  EXPECT_EQ(read.triangles, (Elements<3>{{3, 1, 2}}));
  EXPECT_EQ(read.quads, (Elements<4>{{1, 0, 3, 2}}));
  EXPECT_THAT(problem("a.off", points + "3 1 2 4\n"), HasSubstr("a point that isn't there"));
  EXPECT_THAT(problem("a.trian", "3\n0 0 0\n1 0 0\n1 1 0\n1\n0 1 3 -1 -1 -1\n"), HasSubstr("a point that isn't there"));
}

TEST_F(SofaMeshFile, OtherKindsOfFilesAreNamed) {
  EXPECT_THAT(problem("a.xyz", ""), HasSubstr("'.xyz' cannot be read"));
}

TEST_F(SofaMeshFile, EveryFormatCutAtEveryByteIsReadOrNamedButNeverCrashes) {
  const std::map<std::string, std::string> whole = {
      {"a.obj", std::string{kObj} + "vt 0 0\nf 1/1 2/1 3/1 4/1\nl 1 2\n"},
      {"a.msh", std::string{"$NOD\n"} + kNodes + "$ENDNOD\n$ELM\n1\n1 4 0 0 4 10 20 30 7\n$ENDELM\n"},
      {"a.sph", "sph 1.0\nnums 1\nsphe 0 1 2 3 0.5\n"},
      {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n"},
      {"a.vtk",
       "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 "
       "2\n"},
      {"a.vtu", std::string{kVtuHead} + "<DataArray Name='connectivity'>0 1 2</DataArray><DataArray Name='offsets'>3"
                                        "</DataArray><DataArray Name='types'>5</DataArray></Cells></Piece>"
                                        "</UnstructuredGrid></VTKFile>"}};
  for (const auto& [name, text] : whole) {
    EXPECT_EQ(problem(name, text), "") << name;
    for (std::size_t size = 0; size < text.size(); ++size) {
      const auto said = problem(name, text.substr(0, size));
      EXPECT_TRUE(said.empty() || said.find(name) != std::string::npos) << name << " cut at " << size << ": " << said;
    }
  }
}

// Loaders.

class SofaLoader : public SofaMeshFile {
 protected:
  [[nodiscard]] SceneDescription load(const std::string& attributes,
                                      const std::string& models = "<PointModel/>") const {
    write("a.obj", std::string{kObj} + "f 1 2 3 4\n");
    return readIn("<MeshObjLoader name='loader' filename='a.obj' " + attributes +
                  "/><MechanicalObject src='@loader'/><MeshTopology src='@loader'/>" + models);
  }
};

TEST_F(SofaLoader, TheirScaleMultipliesScale3d) {
  EXPECT_THAT(onlyBox(load("scale3d='1 2 3' scale='2'")), IsBox(Corners{0, 0, 0, 10, 20, 30}));
}

TEST_F(SofaLoader, TheyScaleTurnAndMove) {
  EXPECT_THAT(onlyBox(load("scale3d='2 1 1' rotation='0 0 90' translation='100 0 0'")),
              IsBox(Corners{95, 0, 0, 100, 10, 5}));
}

TEST_F(SofaLoader, TheirTransformIsNotTakenThroughSrc) {
  EXPECT_THAT(onlyBox(load("translation='100 0 0'")), IsBox(Corners{100, 0, 0, 105, 5, 5}));
}

TEST_F(SofaLoader, AMatrixReplacesTheRest) {
  EXPECT_THAT(onlyBox(load("translation='7 7 7' transformation='1 0 0 100  0 1 0 0  0 0 1 0  0 0 0 1'")),
              IsBox(Corners{100, 0, 0, 105, 5, 5}));
}

TEST_F(SofaLoader, TheyCutQuadsAndDropLoosePointsOnRequest) {
  const auto counts = [&](const std::string& attributes) {
    std::vector<std::size_t> result;
    for (const auto& model : load(attributes, "<PointModel/><TriangleModel/><LineModel/>").models)
      result.push_back(model.elementCount());
    return result;
  };
  EXPECT_THAT(counts(""), ElementsAre(5, 2, 4));
  EXPECT_THAT(counts("triangulate='1'"), ElementsAre(5, 2, 5));
  EXPECT_THAT(counts("onlyAttachedPoints='1'"), ElementsAre(4, 2, 4));
  EXPECT_THAT(counts("handleSeams='1'"), ElementsAre(4, 2, 4));
}

TEST_F(SofaLoader, TheyGoByBothNames) {
  write("a.obj", kObj);
  for (const auto name : {"MeshObjLoader", "MeshOBJLoader"})
    EXPECT_THAT(onlyBox(readIn(std::string{"<"} + name +
                               " name='l' filename='a.obj'/><MechanicalObject position='@l.position'/><PointModel/>")),
                IsBox(Corners{0, 0, 0, 5, 5, 5}));
}

TEST_F(SofaLoader, TopologiesMayNameAFileThemselves) {
  write("a.obj", std::string{kObj} + "f 1 2 3 4\n");
  const auto scene = readIn("<MeshTopology filename='a.obj'/><MechanicalObject/><PointModel/><TriangleModel/>");
  ASSERT_THAT(scene.models, SizeIs(2));
  EXPECT_EQ(scene.models[0].elementCount(), 5U);
  EXPECT_EQ(scene.models[1].elementCount(), 2U);
}

TEST_F(SofaLoader, RigidMappingsMayNameAFile) {
  write("a.obj", kObj);
  EXPECT_THAT(onlyBox(readIn(R"(<MechanicalObject template="Rigid" dx="10"/>
    <Node><MechanicalObject/><RigidMapping filename="a.obj"/><PointModel/></Node>)")),
              IsBox(Corners{10, 0, 0, 15, 5, 5}));
}

TEST_F(SofaLoader, ANameOfAFileMayBeALinkToAnother) {
  write("sub/part.xml", "<Node name='P'><MeshObjLoader name='l' filename='b.obj'/></Node>");
  write("sub/b.obj", "v 7 0 0\nv 8 0 0\nv 7 1 0\nf 1 2 3\n");
  const auto named = [](const std::string& link) {
    return "<include href='sub/part.xml'/><MeshTopology name='t' filename='" + link +
           "'/><MechanicalObject/><TriangleModel/>";
  };
  EXPECT_THAT(onlyBox(readIn(named("@P/l.filename"))), IsBox(Corners{7, 0, 0, 8, 1, 0})) << "beside the other's scene";
  EXPECT_THAT(complaintIn(named("@P/x.filename")), HasSubstr("the file '@P/x.filename' is nowhere"));
  EXPECT_THAT(complaintIn("<MeshTopology name='t' filename='@t.filename'/><MechanicalObject/><TriangleModel/>"),
              HasSubstr("depends on itself"));
}

TEST_F(SofaLoader, MissingAndBrokenFilesAreNamedWithWhatNeedsThem) {
  EXPECT_THAT(
      complaintIn("<MeshObjLoader name='l' filename='gone.obj'/><MechanicalObject src='@l'/><PointModel name='p'/>"),
      AllOf(HasSubstr("scene.scn:2: MeshObjLoader 'l' (/l): the file 'gone.obj' is nowhere to be found"),
            HasSubstr("PointModel 'p' (/p) depends on it")));
  write("bad.obj", "v 0 0 0\nv 1\n");
  EXPECT_THAT(
      complaintIn("<MeshObjLoader name='l' filename='bad.obj'/><MechanicalObject src='@l'/><PointModel name='p'/>"),
      AllOf(HasSubstr("bad.obj:2: a number is missing"), HasSubstr("PointModel 'p' (/p) depends on it")));
  EXPECT_THAT(complaintIn("<MeshObjLoader name='l'/><MechanicalObject src='@l'/><PointModel/>"),
              HasSubstr("names no file"));
}

}  // namespace
}  // namespace allpairs::scene::sofa
