// SPDX-License-Identifier: MIT
#include "scene/sofa/SceneText.h"

namespace allpairs::scene::sofa {
namespace {

/// Which cell a point is bound to, seen by where it goes when the cells leave in different directions.
class SofaBarycentric : public SceneTest {
 protected:
  /// The point as it follows a topology of cells whose corners were at rest elsewhere.
  [[nodiscard]] Corners follow(const std::string& topology, const std::string& rest, const std::string& now,
                               const std::string& point) const {
    return onlyBox(readIn("<MechanicalObject rest_position='" + rest + "' position='" + now + "'/>" + topology +
                          "<Node><MechanicalObject position='" + point +
                          "'/><BarycentricMapping useRestPosition='1'/><PointModel/></Node>"));
  }
};

TEST_F(SofaBarycentric, PointsInAGridAwayFromZeroFollowIt) {
  const auto scene = readIn(
      "<RegularGridTopology n='3 3 3' min='1 1 1' max='3 3 3'/><MechanicalObject dx='10' scale='2'/>"
      "<Node><MechanicalObject position='1.5 2.5 2  3 3 3'/><BarycentricMapping/><PointModel/></Node>");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{13, 5, 4, 16, 6, 6}));
}

TEST_F(SofaBarycentric, TetrahedraEndAtTheirSlantingFace) {
  // A large one that rests, and beyond its slanting face a small one that leaves.
  const std::string large = "0 0 0 10 0 0 0 10 0 0 0 10 ";
  EXPECT_THAT(
      follow("<MeshTopology tetrahedra='0 1 2 3 4 5 6 7'/>", large + "3.8 3.8 3.8 4.8 3.8 3.8 3.8 4.8 3.8 3.8 3.8 4.8",
             large + "103.8 3.8 3.8 104.8 3.8 3.8 103.8 4.8 3.8 103.8 3.8 4.8", "4 4 4"),
      IsBox(Corners{104, 4, 4, 104, 4, 4}));
}

std::string textOfPoint(const Vec3& p) {
  return std::to_string(p[0]) + ' ' + std::to_string(p[1]) + ' ' + std::to_string(p[2]) + ' ';
}

/// SOFA looks the cells of a container up in a grid, here of cells as long as 10: the sides of three triangles are 90
/// long. The nearest triangle is in another cell than the point, and another one in the same cell is near enough.
TEST_F(SofaBarycentric, PointsAreBoundToWhatTouchesTheirOwnPlaceInTheGridIfItIsNearEnough) {
  constexpr auto kPlace = 5.0;
  struct Case {
    double point, near, nearest;
  };
  for (const std::size_t axis : {0U, 1U})
    for (const auto& [at, near, nearest] : {Case{9.9, 9.0, 10.1}, Case{10.1, 11.0, 9.5}}) {
      const auto triangle = [&](double where, double height) {
        Vec3 corner{kPlace, kPlace, height};
        corner[axis] = where;
        return textOfPoint(corner) + textOfPoint(corner + Vec3{0.3, 0, 0}) + textOfPoint(corner + Vec3{0, 0.4, 0});
      };
      const std::string far = "100 100 100  121.9 100 100  100 129.2 100";
      Vec3 point{kPlace, kPlace, kPlace};
      point[axis] = at;
      const auto box = follow("<TriangleSetTopologyContainer triangles='0 1 2 3 4 5 6 7 8'/>",
                              triangle(near, 5) + triangle(nearest, 5) + far,
                              triangle(near, 55) + triangle(nearest, -45) + far, textOfPoint(point));
      EXPECT_THAT(box, IsBox(Corners{point[0], point[1], 55, point[0], point[1], 55})) << axis << ' ' << at;
    }
}

/// Cells of the grid as long as 4. The large square touches the point's own cell and is far; of the two small ones, as
/// near as each other, the one in the lower cell comes first, though it is the later one of the mesh.
TEST_F(SofaBarycentric, OfWhatIsAsNearThatInTheLowerCellOfTheGridComesFirst) {
  const auto squares = [](const std::string& right, const std::string& left) {
    return "8.5 4.5 " + right + " 9.5 4.5 " + right + " 9.5 5.5 " + right + " 8.5 5.5 " + right + " 0.5 4.5 " + left +
           " 1.5 4.5 " + left + " 1.5 5.5 " + left + " 0.5 5.5 " + left +
           " 4.5 7.5 5 14.5 7.5 5 14.5 17.5 5 4.5 17.5 5";
  };
  EXPECT_THAT(follow("<QuadSetTopologyContainer quads='0 1 2 3 4 5 6 7 8 9 10 11'/>", squares("5", "5"),
                     squares("55", "-45"), "5 5 5"),
              IsBox(Corners{5, 5, -45, 5, 5, -45}));
}

TEST_F(SofaBarycentric, AGridHasAsManyPointsAsItsStateWhetherOrNotItListsCells) {
  const auto grid = [](const std::string& lists) {
    return "<RequiredPlugin name='Sofa.Component.X'/><RegularGridTopology n='9 9 9' min='0 0 0' max='1 1 1' " + lists +
           "/><MechanicalObject useTopology='0' position='0 0 0'/>"
           "<Node><MechanicalObject position='0.9 0.9 0.9'/><BarycentricMapping/><PointModel/></Node>";
  };
  for (const auto lists : {"", "computeHexaList='0' computeQuadList='0' computeTriangleList='0' computeEdgeList='0'"})
    EXPECT_THAT(complaintIn(grid(lists)), testing::HasSubstr("more points than its input's state")) << lists;
}

TEST_F(SofaBarycentric, APlaceInAGridThatIsNoNumberIsNamed) {
  EXPECT_THAT(
      complaintIn("<RegularGridTopology n='2 2 2' min='-1e308 0 0' max='1e308 1 1'/>"
                  "<MechanicalObject useTopology='0' position='0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0'/>"
                  "<Node><MechanicalObject position='1e308 0 0'/><BarycentricMapping/><PointModel/></Node>"),
      testing::HasSubstr("not finite"));
}

TEST_F(SofaBarycentric, NothingIsBoundToAContainerWithoutCells) {
  m_sofa = SofaVersion::Sofa2612;
  const auto boundTo = [this](const std::string& container) {
    return readIn("<" + container + "/><MechanicalObject/>" +
                  "<Node><MechanicalObject position='0.3 5 5'/><BarycentricMapping/><PointModel/></Node>")
        .models.at(0)
        .positions;
  };
  const std::string points = " position='0 0 0 1 0 0 0 1 0'";
  const std::string edges = points + " edges='0 1 1 2'";
  EXPECT_THAT(boundTo("PointSetTopologyContainer" + points), testing::IsEmpty());
  EXPECT_THAT(boundTo("TriangleSetTopologyContainer" + edges), testing::IsEmpty());
  EXPECT_THAT(boundTo("MeshTopology" + edges), testing::ElementsAre(Vec3{0.3, 0, 0}));
  m_sofa = SofaVersion::Sofa2006;
  EXPECT_THAT(boundTo("PointSetTopologyContainer" + points), testing::IsEmpty());
}

TEST_F(SofaBarycentric, MorePairsOfPointsAndCellsThanTheFilesAreWorthAreRefused) {
  EXPECT_THAT(complaintIn("<RegularGridTopology name='g' n='50 50 50'/><MeshTopology name='t' position='@g.position' "
                          "hexahedra='@g.hexahedra'/><MechanicalObject position='@g.position'/><Node>"
                          "<MechanicalObject position='@../g.position'/><BarycentricMapping input_topology='@../t'/>"
                          "<PointModel/></Node>"),
              testing::HasSubstr("comparing so many points, elements or components takes too long"));
}

TEST_F(SofaBarycentric, MorePairsOfPointsThanTheFilesAreWorthAreRefused) {
  EXPECT_THAT(complaintIn("<RegularGridTopology name='g' n='60 60 60'/><MechanicalObject position='@g.position'/><Node>"
                          "<MechanicalObject position='@../g.position'/><SubsetMapping radius='1000'/>"
                          "<PointModel/></Node>"),
              testing::HasSubstr("comparing so many points, elements or components takes too long"));
}

}  // namespace
}  // namespace allpairs::scene::sofa
