// SPDX-License-Identifier: MIT
#include "scene/sofa/SceneText.h"

namespace allpairs::scene::sofa {
namespace {

using testing::HasSubstr;

struct Counts {
  std::size_t points, lines, triangles;

  friend bool operator==(const Counts&, const Counts&) = default;
  friend std::ostream& operator<<(std::ostream& out, const Counts& c) {
    return out << c.points << " points, " << c.lines << " lines, " << c.triangles << " triangles";
  }
};

class SofaTopology : public SceneTest {
 protected:
  /// The elements that models of points, lines and triangles find on a topology.
  [[nodiscard]] Counts counts(const std::string& text) const {
    const auto scene = readIn(text + "<PointModel/><LineModel/><TriangleModel/>");
    EXPECT_EQ(scene.models.size(), 3U);
    return {scene.models.at(0).elementCount(), scene.models.at(1).elementCount(), scene.models.at(2).elementCount()};
  }
};

constexpr auto kCorners = "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1";

std::string onCorners(const std::string& topology) {
  return "<MechanicalObject position='" + std::string{kCorners} + "'/>" + topology;
}

TEST_F(SofaTopology, MeshesDeriveEdgesAndFacesFromCells) {
  EXPECT_EQ(counts(onCorners("<MeshTopology tetrahedra='0 1 2 4'/>")), (Counts{8, 6, 4}));
  EXPECT_EQ(counts(onCorners("<MeshTopology tetrahedra='0 1 2 4 0 2 1 6'/>")), (Counts{8, 9, 7}));
  // A face that two tetrahedra have the same way round is there twice in a mesh, and once in a container.
  EXPECT_EQ(counts(onCorners("<MeshTopology tetrahedra='0 1 2 4 0 1 2 6'/>")), (Counts{8, 9, 8}));
  EXPECT_EQ(counts(onCorners("<TetrahedronSetTopologyContainer tetrahedra='0 1 2 4 0 1 2 6'/>")), (Counts{8, 9, 7}));
  EXPECT_EQ(counts(onCorners("<MeshTopology hexahedra='0 1 2 3 4 5 6 7'/>")), (Counts{8, 12, 12}));
  EXPECT_EQ(counts(onCorners("<MeshTopology triangles='0 1 2 0 2 3'/>")), (Counts{8, 5, 2}));
  EXPECT_EQ(counts(onCorners("<MeshTopology quads='0 1 2 3'/>")), (Counts{8, 4, 2}));
}

TEST_F(SofaTopology, MeshesDeriveNothingThatIsGiven) {
  EXPECT_EQ(counts(onCorners("<MeshTopology tetrahedra='0 1 2 4' triangles='5 6 7' edges='0 7'/>")), (Counts{8, 1, 1}));
}

TEST_F(SofaTopology, ListsGoByTheirOldNamesToo) {
  EXPECT_EQ(counts(onCorners("<Mesh lines='0 1 1 2'/>")), (Counts{8, 2, 0}));
  EXPECT_EQ(counts(onCorners("<Mesh tetras='0 1 2 4'/>")), (Counts{8, 6, 4}));
  EXPECT_EQ(counts(onCorners("<Mesh hexas='0 1 2 3 4 5 6 7'/>")), (Counts{8, 12, 12}));
}

TEST_F(SofaTopology, ContainersDeriveFromTheirOwnElements) {
  const std::string points = "position='" + std::string{kCorners} + "'";
  EXPECT_EQ(counts("<EdgeSetTopologyContainer " + points + " edges='0 1'/><MechanicalObject/>"), (Counts{8, 1, 0}));
  EXPECT_EQ(counts("<TriangleSetTopologyContainer " + points + " triangles='0 1 2'/><MechanicalObject/>"),
            (Counts{8, 3, 1}));
  EXPECT_EQ(counts("<QuadSetTopologyContainer " + points + " quads='0 1 2 3'/><MechanicalObject/>"), (Counts{8, 4, 2}));
  EXPECT_EQ(counts("<TetrahedronSetTopologyContainer " + points + " tetrahedra='0 1 2 4'/><MechanicalObject/>"),
            (Counts{8, 6, 4}));
  EXPECT_EQ(counts("<HexahedronSetTopologyContainer " + points + " hexahedra='0 1 2 3 4 5 6 7'/><MechanicalObject/>"),
            (Counts{8, 12, 12}));
}

TEST_F(SofaTopology, ContainersIgnoreElementsThatTheyCannotHold) {
  EXPECT_EQ(counts(onCorners("<EdgeSetTopologyContainer edges='0 1' triangles='0 1 2'/>")), (Counts{8, 1, 0}));
  EXPECT_EQ(counts(onCorners("<TetrahedronSetTopologyContainer tetrahedra='0 1 2 4' quads='0 1 2 3'/>")),
            (Counts{8, 6, 4}));
  EXPECT_EQ(counts(onCorners("<HexahedronSetTopologyContainer hexahedra='0 1 2 3 4 5 6 7' triangles='0 1 2'/>")),
            (Counts{8, 12, 12}));
  EXPECT_EQ(counts(onCorners("<HexahedronSetTopologyContainer hexahedra='0 1 2 3 4 5 6 7' quads='0 1 2 3'/>")),
            (Counts{8, 12, 2}))
      << "quads, which these hold, are not derived where they are given";
}

TEST_F(SofaTopology, ContainersWithoutPointsDeriveEdges) {
  EXPECT_EQ(counts(onCorners("<TriangleSetTopologyContainer triangles='0 1 2'/>")), (Counts{8, 3, 1}));
}

TEST_F(SofaTopology, PointsThatOnlyElementsNameAreAtTheOriginAndThatIsSaid) {
  const std::string begin =
      "<CollisionPipeline/><BruteForceBroadPhase/><BVHNarrowPhase/><CollisionResponse/>\n"
      "<DiscreteIntersection/><MeshTopology name='t' position='5 5 5  6 5 5  5 6 5' ";
  const std::string end = "/><MechanicalObject/><TriangleCollisionModel/>";
  const auto good = readIn(begin + "triangles='0 1 2'" + end);
  EXPECT_THAT(good.warnings, testing::IsEmpty());
  const auto bad = readIn(begin + "triangles='0 1 2  0 1 4'" + end);
  EXPECT_THAT(onlyBox(bad), IsBox(Corners{0, 0, 0, 6, 6, 5}));
  ASSERT_EQ(bad.warnings.size(), 1U);
  EXPECT_EQ(bad.warnings[0].subject, "/t");
  EXPECT_THAT(bad.warnings[0].reason, HasSubstr("it has positions of 3 points, and elements or a count that need 5"));
}

TEST_F(SofaTopology, BadIndicesAreNamed) {
  for (const auto bad : {"0 -1", "0 1.5", "0 5e9"})
    EXPECT_THAT(complaintIn(onCorners("<MeshTopology name='t' edges='" + std::string{bad} + "'/><LineModel/>")),
                testing::AllOf(HasSubstr("MeshTopology 't'"), HasSubstr("edges")));
  EXPECT_THAT(complaintIn(onCorners("<MeshTopology edges='0 -1'/><LineModel/>")), HasSubstr("has the index -1, which"));
}

// Grids.

class SofaGrid : public SofaTopology {
 protected:
  [[nodiscard]] Corners box(const std::string& attributes) const {
    return onlyBox(readIn("<RegularGridTopology " + attributes + "/><MechanicalObject/><PointModel/>"));
  }
};

TEST_F(SofaGrid, FillsTheSpaceBetweenItsCorners) {
  EXPECT_THAT(box("n='3 4 5' min='-1 -2 -3' max='1 2 3'"), IsBox(Corners{-1, -2, -3, 1, 2, 3}));
  EXPECT_THAT(box("nx='3' ny='4' nz='5' xmin='-1' ymin='-2' zmin='-3' xmax='1' ymax='2' zmax='3'"),
              IsBox(Corners{-1, -2, -3, 1, 2, 3}));
  EXPECT_THAT(box(""), IsBox(Corners{0, 0, 0, 1, 1, 1}));
}

TEST_F(SofaGrid, OnePointOnAnAxisLiesInTheMiddleOfXAndYAndAtTheBottomOfZ) {
  EXPECT_THAT(box("n='1 1 1' min='0 0 0' max='2 4 6'"), IsBox(Corners{1, 2, 0, 1, 2, 0}));
}

TEST_F(SofaGrid, ItsFirstPointMayBeMoved) {
  EXPECT_THAT(box("n='2 2 2' min='0 0 0' max='1 2 3' p0='10 0 0'"), IsBox(Corners{10, 0, 0, 11, 2, 3}));
}

TEST_F(SofaGrid, ScaleAppliesToTheSixSingleNumbersOnly) {
  EXPECT_THAT(box("scale='2' xmin='0' ymin='0' zmin='0' xmax='1' ymax='1' zmax='1'"), IsBox(Corners{0, 0, 0, 2, 2, 2}));
  EXPECT_THAT(box("scale='2' min='0 0 0' max='1 1 1'"), IsBox(Corners{0, 0, 0, 1, 1, 1}));
}

TEST_F(SofaGrid, HasEdgesQuadsAndTheirTriangles) {
  // 12 edges; six quads, each as itself and as two triangles.
  EXPECT_EQ(counts("<RegularGrid n='2 2 2'/><MechanicalObject/>"), (Counts{8, 12, 24}));
  EXPECT_EQ(counts("<RegularGrid n='3 3 1'/><MechanicalObject/>"), (Counts{9, 12, 16}));
}

TEST_F(SofaGrid, HasTheEdgesOfItsTrianglesInNewerSofa) {
  m_sofa = SofaVersion::Sofa2612;
  EXPECT_EQ(counts("<RegularGrid n='2 2 2'/><MechanicalObject/>"), (Counts{8, 18, 24}));
  EXPECT_EQ(counts("<RegularGrid n='3 3 1'/><MechanicalObject/>"), (Counts{9, 16, 16}));
  EXPECT_EQ(counts("<RegularGrid n='3 1 1'/><MechanicalObject/>"), (Counts{3, 2, 0})) << "no triangles";
  EXPECT_EQ(counts("<RegularGrid n='2 2 2' computeTriangleList='0'/><MechanicalObject/>"), (Counts{8, 12, 12}));
  EXPECT_EQ(counts("<RegularGrid n='2 2 2' computeTriangleList='0' computeQuadList='0'/><MechanicalObject/>"),
            (Counts{8, 12, 12}))
      << "derived from the cubes";
  const auto scene = readIn("<RegularGrid n='2 2 1'/><MechanicalObject/><LineModel/>");
  EXPECT_EQ(scene.models[0].lines, (Elements<2>{{1, 3}, {3, 0}, {0, 1}, {3, 2}, {2, 0}}));
}

TEST_F(SofaGrid, IsEmptyInNewerSofaIfItNamesAFileThatIsNotThere) {
  m_sofa = SofaVersion::Sofa2612;
  const auto text = "<RegularGridTopology fileTopology='none.trian' n='1 2 1'/><MechanicalObject/><LineModel/>";
  const auto scene = readIn(text);
  EXPECT_EQ(scene.models.at(0).lines.size(), 0U);
  EXPECT_EQ(scene.models.at(0).positions.size(), 0U);
  std::vector<std::string> reasons;
  for (const Remark& warning : scene.warnings) reasons.push_back(warning.reason);
  EXPECT_THAT(reasons, testing::Contains(testing::HasSubstr("it names a file that is not there")));
  EXPECT_THAT(reasons, testing::Contains("it has no elements, and is in no pair"));
  write("there.obj", "v 0 0 0\n");
  EXPECT_THAT(complaintIn("<RegularGridTopology filename='there.obj'/><MechanicalObject/><LineModel/>"),
              testing::HasSubstr("a regular grid that is read from a file"));
  m_sofa = SofaVersion::Sofa2006;
  EXPECT_EQ(readIn(text).models.at(0).lines.size(), 1U);
}

TEST_F(SofaGrid, TakesItsShapeFromAnotherThatIsItsSource) {
  const auto scene = readIn(
      "<Node name='a'><RegularGrid name='g' nx='4' ny='3' nz='1' xmin='0' xmax='3' ymin='0' ymax='2' zmin='0' "
      "zmax='1'/></Node><Node name='b'><RegularGrid src='@/a/g'/><MechanicalObject/><TriangleModel/></Node>"
      "<Node name='c'><RegularGrid src='@/a/g' n='2 2 2' p0='0 0 5'/><MechanicalObject/><PointModel/></Node>");
  ASSERT_EQ(scene.models.size(), 2U);
  EXPECT_EQ(scene.models[0].triangles.size(), 24U);
  EXPECT_THAT(boxOf(scene.models[0]), IsBox(Corners{0, 0, 0, 3, 2, 0}));
  EXPECT_THAT(boxOf(scene.models[1]), IsBox(Corners{0, 0, 5, 3, 2, 6}));
}

TEST_F(SofaGrid, AResolutionBelowOneBecomesTwo) {
  EXPECT_EQ(counts("<RegularGrid n='0 5 5' max='3 3 3'/><MechanicalObject/>").points, 8U);
}

TEST_F(SofaGrid, CellsOfAWidthAreCountedAndKeepTheSpacingThatWasWritten) {
  EXPECT_EQ(counts("<RegularGrid cellWidth='0.4'/><MechanicalObject/>").points, 64U) << "ceil(1 / 0.4) + 1 = 4";
  EXPECT_THAT(box("cellWidth='0.4'"), IsBox(Corners{0, 0, 0, 3, 3, 3}));
}

TEST_F(SofaGrid, ResolutionsOutOfAllReasonDoNotEatTheMemory) {
  for (const auto n : {"1000000000 1 1", "100000 100000 100000", "1e300 1 1"})
    EXPECT_THAT(complaintIn("<RegularGridTopology n='" + std::string{n} + "'/><MechanicalObject/><PointModel/>"),
                testing::AnyOf(HasSubstr("more than this reader makes"), HasSubstr("points it takes more than")));
  EXPECT_THAT(complaintIn("<RegularGridTopology cellWidth='1e-9'/><MechanicalObject/><PointModel/>"),
              testing::AnyOf(HasSubstr("more than this reader makes"), HasSubstr("points it takes more than")));
}

// Mappings between topologies.

constexpr auto kCube = "<RegularGridTopology name='grid' n='2 2 2'/><MechanicalObject/>";

TEST_F(SofaTopology, TetrahedraShowTheTrianglesOfTheirBorder) {
  const auto scene = readIn(R"(<TetrahedronSetTopologyContainer name="t" position="0 0 0 1 0 0 0 1 0 0 0 1 1 1 1"
      tetrahedra="0 1 2 3 1 2 3 4"/><MechanicalObject/>
    <Node><TriangleSetTopologyContainer name="c"/><TriangleSetTopologyModifier/>
    <Tetra2TriangleTopologicalMapping input="@../t" output="@c"/>
    <LineModel/><TriangleModel/></Node>)");
  ASSERT_EQ(scene.models.size(), 2U);
  EXPECT_EQ(scene.models[0].elementCount(), 9U);
  EXPECT_EQ(scene.models[1].elementCount(), 6U);
}

TEST_F(SofaTopology, MappingsGoFromTheParentsTopologyToTheirOwnNodesUnlessTold) {
  const auto scene = readIn(std::string{kCube} + R"(<Node>
    <TetrahedronSetTopologyContainer/><TetrahedronSetTopologyModifier/><Hexa2TetraTopologicalMapping/><TetrahedronModel/></Node>)");
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.models[0].elementCount(), 6U);
}

TEST_F(SofaTopology, NeighbouringCubesAreCutAsMirrorImagesIfTheyAreToldTo) {
  const auto cut = [&](const std::string& grid, const std::string& data) {
    return readIn("<RegularGridTopology " + grid + "/><MechanicalObject/><Node><TetrahedronSetTopologyContainer/>" +
                  "<TetrahedronSetTopologyModifier/><Hexa2TetraTopologicalMapping " + data +
                  "/><TetrahedronModel/></Node>")
        .models.at(0)
        .tetrahedra;
  };
  EXPECT_EQ(cut("n='2 2 2'", ""),
            (Elements<4>{{0, 5, 1, 7}, {0, 1, 2, 7}, {1, 2, 7, 3}, {7, 2, 0, 6}, {7, 6, 0, 5}, {6, 5, 4, 0}}));
  EXPECT_EQ(cut("n='2 2 2'", "swapping='1'"),
            (Elements<4>{{1, 4, 6, 0}, {1, 0, 6, 3}, {0, 3, 2, 6}, {6, 3, 7, 1}, {6, 7, 4, 1}, {7, 4, 1, 5}}));
  // Two cubes along y and two along z: the third is mirrored in x and in z.
  EXPECT_EQ(cut("n='2 3 3'", "swapping='1'").at(12), (std::array<Index, 4>{13, 6, 12, 8}));
}

TEST_F(SofaTopology, HexahedraShowTheQuadsOfTheirBorderAndQuadsTwoTrianglesEach) {
  const auto scene = readIn(R"(<RegularGridTopology name="grid" n="3 2 2"/><MechanicalObject/>
    <Node name="Q"><QuadSetTopologyContainer name="q"/><QuadSetTopologyModifier/>
      <Hexa2QuadTopologicalMapping input="@../grid" output="@q"/>
      <TriangleModel/>
      <Node name="T"><TriangleSetTopologyContainer name="t"/><TriangleSetTopologyModifier/>
        <Quad2TriangleTopologicalMapping input="@../q" output="@t"/><TriangleModel/>
        <Node name="E"><EdgeSetTopologyContainer name="e"/>
          <Triangle2EdgeTopologicalMapping input="@../t" output="@e"/><LineModel/></Node></Node></Node>)");
  ASSERT_EQ(scene.models.size(), 3U);
  EXPECT_EQ(scene.models[0].elementCount(), 20U);
  EXPECT_EQ(scene.models[1].elementCount(), 20U);
  EXPECT_EQ(scene.models[2].elementCount(), 0U);  // A closed surface has no border.
}

TEST_F(SofaTopology, TheBorderOfASheetOfTrianglesIsItsEdges) {
  const auto scene = readIn(R"(<TriangleSetTopologyContainer name="t" position="0 0 0 1 0 0 1 1 0 0 1 0"
      triangles="0 1 2 0 2 3"/><MechanicalObject/>
    <Node><EdgeSetTopologyContainer/><EdgeSetTopologyModifier/><Triangle2EdgeTopologicalMapping/><LineModel/></Node>)");
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.models[0].elementCount(), 4U);
}

TEST_F(SofaTopology, PointsAreMadeOnPointsEdgesFacesAndCells) {
  const auto made = [&](const std::string& from, const std::string& data) {
    return readIn(from +
                  "<MechanicalObject/><Node><MeshTopology name='c'/><Mesh2PointTopologicalMapping "
                  "input='@../from' output='@c' " +
                  data + "/><MechanicalObject/><PointModel/><LineModel/></Node>");
  };
  const std::string square =
      "<MeshTopology name='from' position='0 0 0 2 0 0 2 2 0 0 2 0' triangles='0 1 2' quads='0 1 2 3' edges='0 1'/>";
  const auto points = [](const SceneDescription& scene) { return scene.models.at(0).positions; };
  EXPECT_EQ(
      points(made(square, "pointBaryCoords='0 0 1 0 0 2'")),
      (std::vector<Vec3>{{0, 0, 1}, {0, 0, 2}, {2, 0, 1}, {2, 0, 2}, {2, 2, 1}, {2, 2, 2}, {0, 2, 1}, {0, 2, 2}}));
  EXPECT_EQ(points(made(square, "edgeBaryCoords='0.25 0 0'")), (std::vector<Vec3>{{0.5, 0, 0}}));
  EXPECT_EQ(points(made(square, "triangleBaryCoords='0.5 0.25 0'")), (std::vector<Vec3>{{1.5, 0.5, 0}}));
  EXPECT_EQ(points(made(square, "quadBaryCoords='0 1 0'")), (std::vector<Vec3>{{2, 2, 0}}))
      << "of a quad SOFA takes the third corner for the fourth";
  EXPECT_EQ(points(made("<MeshTopology name='from' position='0 0 0 1 0 0 0 1 0 0 0 1' tetrahedra='0 1 2 3'/>",
                        "tetraBaryCoords='0.5 0.25 0.125'")),
            (std::vector<Vec3>{{0.5, 0.25, 0.125}}));
  EXPECT_EQ(points(made("<RegularGridTopology name='from' n='2 2 2'/>", "hexaBaryCoords='0.5 0.25 0.125'")),
            (std::vector<Vec3>{{0.5, 0.25, 0.125}}));
  // The first corner counts too: here it is not at zero.
  const std::string away =
      "<MeshTopology name='from' position='1 1 1 3 1 1 3 3 1 1 3 1' triangles='0 1 2' quads='0 1 2 3' edges='0 1'/>";
  EXPECT_EQ(points(made(away, "edgeBaryCoords='0.25 0 0'")), (std::vector<Vec3>{{1.5, 1, 1}}));
  EXPECT_EQ(points(made(away, "triangleBaryCoords='0.5 0.25 0'")), (std::vector<Vec3>{{2.5, 1.5, 1}}));
  EXPECT_EQ(points(made(away, "quadBaryCoords='0.25 0.5 0'")), (std::vector<Vec3>{{2, 2, 1}}));
  EXPECT_EQ(points(made("<MeshTopology name='from' position='1 1 1 2 1 1 1 2 1 1 1 2' tetrahedra='0 1 2 3'/>",
                        "tetraBaryCoords='0.5 0.25 0.125'")),
            (std::vector<Vec3>{{1.5, 1.25, 1.125}}));
  EXPECT_EQ(points(made("<RegularGridTopology name='from' n='2 2 2' min='1 1 1' max='2 2 2'/>",
                        "hexaBaryCoords='0.5 0.25 0.125'")),
            (std::vector<Vec3>{{1.5, 1.25, 1.125}}));
  const auto both = made(square, "pointBaryCoords='0 0 0 0 0 9' edgeBaryCoords='0.5 0 0' copyEdges='1'");
  EXPECT_EQ(points(both).size(), 9U);
  EXPECT_EQ(both.models.at(1).lines, (Elements<2>{{0, 2}}));
}

TEST_F(SofaTopology, ASubsetOfATopologyIsWhatItSaysItself) {
  const auto scene = readIn(R"(<MeshTopology name="from" position="0 0 0 2 0 0 2 2 0 0 2 0" triangles="0 1 2 0 2 3"/>
    <MechanicalObject/><Node><TriangleSetTopologyContainer name="c" position="@../from.position" triangles="0 2 3"/>
    <SubsetTopologicalMapping input="@../from" output="@c" samePoints="1"/><TriangleModel/></Node>)");
  EXPECT_EQ(scene.models.at(0).triangles, (Elements<3>{{0, 2, 3}}));
}

TEST_F(SofaTopology, UnknownTopologiesAndMappingsOfThemAreNamed) {
  EXPECT_THAT(complaintIn("<MagicTopology name='t'/><MechanicalObject/><LineModel/>"),
              HasSubstr("MagicTopology 't' (/t): this kind of topology is not known"));
  EXPECT_THAT(complaintIn(std::string{kCube} +
                          "<Node><EdgeSetTopologyContainer/><MagicTopologicalMapping name='m'/><LineModel/></Node>"),
              HasSubstr("MagicTopologicalMapping 'm' (/1/m): this kind of topological mapping is not known"));
}

using SofaCube = SofaGrid;

TEST_F(SofaCube, IsTheSurfaceOfABox) {
  const std::string cube = "<CubeTopology nx='3' ny='4' nz='3' min='0 -1 -1' max='4 2 1' ";
  EXPECT_EQ(counts(cube + "/><MechanicalObject/>"), (Counts{34, 64, 64}));
  EXPECT_EQ(counts(cube + "internalPoints='1'/><MechanicalObject/>"), (Counts{36, 64, 64}));
  EXPECT_EQ(counts("<CubeTopology nx='3' ny='2' nz='1'/><MechanicalObject/>"), (Counts{6, 7, 4}));
  const auto scene = readIn(cube + "/><MechanicalObject/><PointModel/><TriangleModel/>");
  EXPECT_THAT(boxOf(scene.models[0]), IsBox(Corners{0, -1, -1, 4, 2, 1}));
  EXPECT_THAT(boxOf(scene.models[1]), IsBox(Corners{0, -1, -1, 4, 2, 1}));
  // The last points are those of the sides half way up: along x in front and behind, then along y left and right.
  const auto& points = scene.models[0].positions;
  EXPECT_EQ(points[24], (Vec3{0, -1, 0}));
  EXPECT_EQ(points[27], (Vec3{0, 2, 0}));
  EXPECT_EQ(points[30], (Vec3{0, 0, 0}));
  EXPECT_EQ(points[33], (Vec3{4, 1, 0}));
  EXPECT_THAT(complaintIn("<CubeTopology name='c' splitNormals='1'/><MechanicalObject/><PointModel/>"),
              HasSubstr("corners are split"));
}

TEST_F(SofaCube, ASquareMadeByACreatorIsCutByItsPattern) {
  const auto square = [](const std::string& data) {
    return "<GridMeshCreator name='l' resolution='3 2' " + data +
           "/><MeshTopology src='@l'/><MechanicalObject src='@l'/>";
  };
  EXPECT_EQ(counts(square("")), (Counts{6, 9, 4}));
  EXPECT_EQ(counts(square("trianglePattern='0'")), (Counts{6, 7, 4})) << "two quads, of two triangles each";
  EXPECT_EQ(counts(square("trianglePattern='4'")), (Counts{6, 0, 0})) << "SOFA has no such pattern";
  EXPECT_EQ(counts("<GridMeshCreator name='l' resolution='2 3'/><MeshTopology src='@l'/><MechanicalObject src='@l'/>"),
            (Counts{6, 9, 4}));
  const auto scene = readIn(square("trianglePattern='1' scale3d='2 3 1' translation='1 0 0'") + "<TriangleModel/>");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{1, 0, 0, 3, 3, 0}));
  EXPECT_EQ(scene.models[0].triangles, (Elements<3>{{0, 1, 4}, {0, 4, 3}, {1, 2, 4}, {2, 5, 4}}));
  EXPECT_EQ(readIn(square("trianglePattern='3'") + "<TriangleModel/>").models[0].triangles[0],
            (std::array<Index, 3>{0, 1, 3}));
  EXPECT_THAT(complaintIn("<GridMeshCreator name='l' resolution='1 2'/><MechanicalObject src='@l'/><PointModel/>"),
              HasSubstr("two points in each direction"));
}

TEST_F(SofaTopology, ASubsetOfTetrahedraThatAreGivenIsOfTheseAlone) {
  const auto scene = readIn(R"(<MeshTopology name="m" position="0 0 0 1 0 0 0 1 0 0 0 1 5 5 5" tetrahedra="0 1 2 3"/>
    <Node><SubsetTopology name="s" rest_position="@../m.position" tetrahedra="1 2 3 4" box="-1 -1 -1 9 9 9"/>
    <Node><MechanicalObject position="@../../m.position"/><TetrahedronSetTopologyContainer
    tetrahedra="@../s.tetrahedraInROI"/><TetrahedronModel/></Node></Node>)");
  EXPECT_EQ(scene.models.at(0).tetrahedra, (Elements<4>{{1, 2, 3, 4}}));
}

TEST_F(SofaTopology, ASubsetIsWhatLiesInBoxesOrSpheres) {
  // Three squares in a row along x, each of two triangles: points 0 to 3 below, 4 to 7 above.
  const auto subset = [](const std::string& data, const std::string& part) {
    return "<MeshTopology name='m' position='0 0 0 1 0 0 2 0 0 3 0 0 0 1 0 1 1 0 2 1 0 3 1 0' triangles='0 1 5 0 5 4 1 "
           "2 "
           "6 1 6 5 2 3 7 2 7 6'/><Node><SubsetTopology name='s' rest_position='@../m.position' "
           "triangles='@../m.triangles' " +
           data + "/><Node><MechanicalObject position='" +
           (data.find("local") == std::string::npos ? "@../../m.position" : "@../s.points" + part) +
           "'/><MeshTopology triangles='@../s.triangles" + part + "'/><PointModel/><TriangleModel/></Node></Node>";
  };
  const auto trianglesOf = [&](const std::string& data, const std::string& part) {
    return readIn(subset(data, part)).models.at(1).triangles;
  };
  const std::string box = "box='2.5 2 1 0.5 -1 -1'";
  EXPECT_EQ(trianglesOf(box, "InROI"), (Elements<3>{{1, 2, 6}, {1, 6, 5}}));
  EXPECT_EQ(trianglesOf(box, "OutROI"), (Elements<3>{{0, 1, 5}, {0, 5, 4}, {2, 3, 7}, {2, 7, 6}}));
  EXPECT_EQ(trianglesOf("centers='0.5 0.5 0 2.5 0.5 0' radii='0.8 0.6'", "InROI"), (Elements<3>{{0, 1, 5}, {0, 5, 4}}));
  // All four points inside belong to triangles that are partly outside, and come first in both parts.
  const auto in = readIn(subset(box + " localIndices='1'", "InROI"));
  EXPECT_EQ(in.models[0].positions, (std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 1, 0}}));
  EXPECT_EQ(in.models[1].triangles, (Elements<3>{{0, 1, 3}, {0, 3, 2}}));
  const auto out = readIn(subset(box + " localIndices='1'", "OutROI"));
  EXPECT_EQ(out.models[0].positions.size(), 8U);
  EXPECT_THAT(boxOf(out.models[1]), IsBox(Corners{0, 0, 0, 3, 1, 0}));
  EXPECT_EQ(out.models[1].triangles[0], (std::array<Index, 3>{4, 0, 2}));
  // Of the points inside, only 1 and 5 belong to triangles that are partly outside; 0 and 4 come behind them.
  const auto first = readIn(subset("box='-1 -1 -1 1.5 2 1' localIndices='1'", "InROI"));
  EXPECT_EQ(first.models[0].positions, (std::vector<Vec3>{{1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(first.models[1].triangles, (Elements<3>{{2, 0, 1}, {2, 1, 3}}));
  EXPECT_THAT(complaintIn(subset("centers='0 0 0'", "InROI")), HasSubstr("not one radius for each centre"));
  EXPECT_THAT(complaintIn(subset("centers='0 0 0 1 0 0' radii='1'", "InROI")),
              HasSubstr("not one radius for each centre"));
  EXPECT_THAT(complaintIn(subset(box + " tetrahedraInput='0'", "InROI")), HasSubstr("cannot compute"));
}

TEST_F(SofaTopology, ASparseGridOfCellsOfNegativeWidthIsNamed) {
  write("cube.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n");
  EXPECT_THAT(complaintIn("<SparseGridTopology n='4 4 4' fileTopology='cube.obj' cellWidth='-0.25'/>"
                          "<MechanicalObject/><PointModel/>"),
              HasSubstr("points along an axis is none"));
}

}  // namespace
}  // namespace allpairs::scene::sofa
