// SPDX-License-Identifier: MIT
#include "scene/sofa/SceneText.h"

namespace allpairs::scene::sofa {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using SofaModel = SceneTest;

constexpr auto kMesh = R"(<MechanicalObject position="0 0 0  1 0 0  0 1 0  0 0 1"/>
  <MeshTopology tetrahedra="0 1 2 3" triangles="0 1 2" edges="0 3"/>)";
constexpr auto kFrame = R"(<MechanicalObject template="Rigid3d" position="1 2 3 0 0 0 1"/>)";

struct NamedClass {
  const char* written;
  const char* type;
  std::size_t elements;
};

TEST_F(SofaModel, ClassNamesOfBothGenerationsAreKnown) {
  constexpr NamedClass kClasses[] = {{"TriangleModel", "TTriangleModel", 1},
                                     {"TriangleCollisionModel", "TTriangleModel", 1},
                                     {"TTriangleModel", "TTriangleModel", 1},
                                     {"TriangleMesh", "TTriangleModel", 1},
                                     {"TriangleSet", "TTriangleModel", 1},
                                     {"Triangle", "TTriangleModel", 1},
                                     {"LineModel", "TLineModel", 1},
                                     {"LineCollisionModel", "TLineModel", 1},
                                     {"TLineModel", "TLineModel", 1},
                                     {"Line", "TLineModel", 1},
                                     {"LineMesh", "TLineModel", 1},
                                     {"LineSet", "TLineModel", 1},
                                     {"PointModel", "TPointModel", 4},
                                     {"PointCollisionModel", "TPointModel", 4},
                                     {"TPointModel", "TPointModel", 4},
                                     {"Point", "TPointModel", 4},
                                     {"SphereModel", "TSphereModel", 4},
                                     {"SphereCollisionModel", "TSphereModel", 4},
                                     {"TSphereModel", "TSphereModel", 4},
                                     {"Sphere", "TSphereModel", 4},
                                     {"CapsuleModel", "TCapsuleModel", 1},
                                     {"CapsuleCollisionModel", "TCapsuleModel", 1},
                                     {"TCapsuleModel", "TCapsuleModel", 1},
                                     {"Capsule", "TCapsuleModel", 1},
                                     {"TetrahedronModel", "TetrahedronModel", 1},
                                     {"Tetrahedron", "TetrahedronModel", 1}};
  for (const auto& [written, type, elements] : kClasses) {
    const auto scene = readIn(std::string{kMesh} + '<' + written + "/>");
    ASSERT_EQ(scene.models.size(), 1U) << written;
    EXPECT_EQ(scene.models[0].type, type) << written;
    EXPECT_EQ(scene.models[0].elementCount(), elements) << written;
  }
}

TEST_F(SofaModel, ClassNamesForRigidStatesAreKnown) {
  constexpr NamedClass kClasses[] = {{"OBB", "TOBBModel", 1},
                                     {"OBBModel", "TOBBModel", 1},
                                     {"TOBBModel", "TOBBModel", 1},
                                     {"RigidCapsuleModel", "TCapsuleModel", 1},
                                     {"CapsuleModel", "TCapsuleModel", 1},
                                     {"CylinderModel", "TCylinderModel", 1},
                                     {"SphereModel", "TSphereModel", 1}};
  for (const auto& [written, type, elements] : kClasses) {
    const auto scene = readIn(std::string{kFrame} + '<' + written + "/>");
    ASSERT_EQ(scene.models.size(), 1U) << written;
    EXPECT_EQ(scene.models[0].type, type) << written;
    EXPECT_EQ(scene.models[0].elementCount(), elements) << written;
  }
}

TEST_F(SofaModel, RigidStatesGoByFourNames) {
  for (const auto name : {"Rigid", "Rigid3", "Rigid3d", "Rigid3f"})
    EXPECT_THAT(onlyBox(readIn(std::string{"<MechanicalObject template='"} + name + "'/><OBB/>")),
                IsBox(Corners{-1, -1, -1, 1, 1, 1}))
        << name;
}

TEST_F(SofaModel, DefaultsAreThoseOfTheContract) {
  const auto scene = readIn(std::string{kMesh} + "<PointModel/>");
  ASSERT_EQ(scene.models.size(), 1U);
  const auto& model = scene.models[0];
  EXPECT_TRUE(model.active && model.simulated && model.moving);
  EXPECT_FALSE(model.selfCollision || model.useCurvature);
  EXPECT_THAT(model.groups, IsEmpty());
  EXPECT_EQ(model.contactDistance, 0);
}

TEST_F(SofaModel, FlagsAreReadInEverySpelling) {
  const auto scene = readIn(std::string{kMesh} + R"(
    <PointModel simulated="0" moving="false" selfCollision="1" proximity="0.25" group="3 1 -2 9"/>
    <TriangleModel simulated="False" moving="f" selfCollision="true" contactDistance="0.5" useCurvature="1"/>
    <LineModel simulated="00" moving="F" selfCollision="-1"/>)");
  ASSERT_EQ(scene.models.size(), 3U);
  for (const auto& model : scene.models) {
    EXPECT_FALSE(model.simulated || model.moving);
    EXPECT_TRUE(model.selfCollision);
  }
  EXPECT_THAT(scene.models[0].groups, ElementsAre(-2, 1, 3, 9));
  EXPECT_EQ(scene.models[0].contactDistance, 0.25);
  EXPECT_EQ(scene.models[1].contactDistance, 0.5);
  EXPECT_TRUE(scene.models[1].useCurvature);
}

TEST_F(SofaModel, HasWhatOldSofaKnowsOfItWhereThatIsAskedFor) {
  const std::string text =
      std::string{kMesh} + "<TriangleModel useCurvature='1' proximity='0.25' contactDistance='0.125'/>";
  m_sofa = SofaVersion::Sofa2612;
  const auto today = readIn(text);
  EXPECT_TRUE(today.models.at(0).useCurvature);
  EXPECT_EQ(today.models[0].contactDistance, 0.25);
  m_sofa = SofaVersion::Sofa2006;
  const auto old = readIn(text + "<PointModel contactDistance='0.125'/>");
  EXPECT_FALSE(old.models.at(0).useCurvature);
  EXPECT_EQ(old.models[0].contactDistance, 0.25);
  EXPECT_EQ(old.models.at(1).contactDistance, 0);
  std::vector<std::string> reasons;
  for (const auto& warning : old.warnings) reasons.push_back(warning.subject + ": " + warning.reason);
  EXPECT_THAT(reasons, testing::IsSupersetOf(
                           {HasSubstr("/tTriangleModel1: its useCurvature is not read, as in SOFA before 20.12"),
                            HasSubstr("/tPointModel1: its contactDistance is not read, as in SOFA before 25.12")}));
}

TEST_F(SofaModel, WhatOldSofaDoesNotReadIsSaidOnceAndOnlyWhereItCounts) {
  m_sofa = SofaVersion::Sofa2006;
  const auto reasonsFor = [&](const std::string& models) {
    std::vector<std::string> reasons;
    for (const auto& warning :
         readIn("<CollisionPipeline/><BruteForceDetection/>" + std::string{kMesh} + models).warnings)
      reasons.push_back(warning.subject + ": " + warning.reason);
    return reasons;
  };
  const std::string given = "<PointModel contactDistance='0.125'/>";
  const std::string flat = "<TriangleModel useCurvature='1'/>";
  EXPECT_THAT(reasonsFor("<PointModel contactDistance='0.0'/><TriangleModel useCurvature='false'/>"
                         "<PointModel contactDistance='0.125' proximity='0.25'/>"),
              IsEmpty());
  EXPECT_THAT(reasonsFor(given),
              ElementsAre("/tPointModel1: its contactDistance is not read, as in SOFA before 25.12, which calls it "
                          "proximity"));
  EXPECT_THAT(reasonsFor(flat + given + flat + given + given),
              ElementsAre("/tTriangleModel1: its useCurvature is not read, as in SOFA before 20.12; nor is that of 1 "
                          "other model",
                          "/tPointModel1: its contactDistance is not read, as in SOFA before 25.12, which calls it "
                          "proximity; nor is that of 2 other models"));
}

TEST_F(SofaModel, AGroupThatIsComputedAndNoNumberIsAnError) {
  EXPECT_THAT(complaintIn("<TransformEngine name='t' input_position='1e300 1e300 1e300' scale='1e300 1e300 1e300' "
                          "rotation='0 0 45'/><MechanicalObject/><PointModel group='@t.output_position'/>"),
              HasSubstr("a group beyond all integers"));
}

TEST_F(SofaModel, AFlagThatIsNeitherTrueNorFalseIsNamed) {
  const auto scene = readIn("<MechanicalObject/><PointModel simulated='no'/>");
  EXPECT_TRUE(scene.models.at(0).simulated);
  EXPECT_THAT(scene.warnings.back().reason, HasSubstr("simulated: 'no' is neither true nor false"));
}

TEST_F(SofaModel, InactiveModelsAreMarkedAndNeedNoPlace) {
  const auto scene = readIn("<PointModel active='0'/>");
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_FALSE(scene.models[0].active);
  EXPECT_EQ(scene.models[0].elementCount(), 0U);
}

TEST_F(SofaModel, SphereRadiiComeFromTheListAndThenFromTheSingleRadius) {
  const auto scene =
      readIn("<MechanicalObject position='0 0 0 10 0 0 20 0 0'/><SphereModel radius='2' listRadius='0.5'/>");
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_THAT(scene.models[0].radii, ElementsAre(0.5, 2, 2));
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{-0.5, -2, -2, 22, 2, 2}));
}

TEST_F(SofaModel, SphereRadiiMayComeFromALoader) {
  write("s.sph", "sph 1.0\nnums 2\nsphe 0 1 2 3 0.5\n# a comment\nsphe 1 4 5 6 2\n");
  for (const auto radii : {"listRadius='@loader.listRadius'", "src='@loader'"}) {
    const auto scene = readIn(std::string{R"(<SphereLoader name="loader" filename="s.sph"/>
      <MechanicalObject position="@[-1].position"/><SphereModel )"} +
                              radii + "/>");
    EXPECT_THAT(onlyBox(scene), IsBox(Corners{0.5, 1.5, 2.5, 6, 7, 8})) << radii;
  }
}

TEST_F(SofaModel, OrientedBoxesTurnWithTheirFrames) {
  const auto scene = readIn(R"(<MechanicalObject template="Rigid" position="1 0 0 0 0 0 1"/>
    <MechanicalObject template="Rigid" position="10 0 0 0 0 0.7071067811865476 0.7071067811865476"/>
    <OBBModel extents="1 2 3"/>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{8, -1, -3, 12, 1, 3}));
}

/// As a quaternion with the vector u and the scalar w turns a vector v: v + 2 w (u x v) + 2 u x (u x v).
Vec3 turned(const Vec3& u, double w, const Vec3& v) {
  const auto across = [&u](const Vec3& a) {
    return Vec3{u[1] * a[2] - u[2] * a[1], u[2] * a[0] - u[0] * a[2], u[0] * a[1] - u[1] * a[0]};
  };
  const auto once = across(v), twice = across(once);
  return v + once * (2 * w) + twice * 2;
}

TEST_F(SofaModel, OrientedBoxesTurnWithFramesThatAreTurnedThemselves) {
  const auto scene = readIn(R"(<MechanicalObject template="Rigid" position="1 2 3 0.1 0.5 -0.5 0.7"/>
                            <Node><MechanicalObject template="Rigid" position="4 5 6 -0.7 0.1 0.5 0.5"/>
                            <RigidRigidMapping/><OBBModel extents="3 2 1"/></Node>)");
  Corners expected{1e9, 1e9, 1e9, -1e9, -1e9, -1e9};
  for (const double x : {-3.0, 3.0})
    for (const double y : {-2.0, 2.0})
      for (const double z : {-1.0, 1.0}) {
        const auto inChild = turned({-0.7, 0.1, 0.5}, 0.5, {x, y, z});
        const auto corner = turned({0.1, 0.5, -0.5}, 0.7, {4 + inChild[0], 5 + inChild[1], 6 + inChild[2]});
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double at = corner[axis] + 1.0 + static_cast<double>(axis);
          expected[axis] = std::min(expected[axis], at);
          expected[axis + 3] = std::max(expected[axis + 3], at);
        }
      }
  EXPECT_THAT(onlyBox(scene), IsBox(expected));
}

TEST_F(SofaModel, CapsulesJoinEdgesOrLieAlongTheYAxisOfFrames) {
  const auto edges = readIn(R"(<MechanicalObject position="0 0 0 4 0 0"/><MeshTopology edges="0 1"/>
    <CapsuleModel defaultRadius="0.25" proximity="9"/>)");
  EXPECT_THAT(onlyBox(edges), IsBox(Corners{-0.25, -0.25, -0.25, 4.25, 0.25, 0.25}));
  const auto frames = readIn(std::string{kFrame} + "<CapsuleModel radii='1' heights='4'/>");
  EXPECT_THAT(onlyBox(frames), IsBox(Corners{0, -1, 2, 2, 5, 4}));
  const auto standard = readIn(std::string{kFrame} + "<CapsuleModel/>");
  EXPECT_THAT(onlyBox(standard), IsBox(Corners{0.5, 0.5, 2.5, 1.5, 3.5, 3.5}));
}

TEST_F(SofaModel, QuadsAreTwoTrianglesEach) {
  const auto scene = readIn(R"(<MechanicalObject position="0 0 0 1 0 0 1 1 0 0 1 0 5 5 5"/>
    <MeshTopology triangles="0 1 4" quads="0 1 2 3"/><TriangleModel/>)");
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.models[0].elementCount(), 3U);
}

TEST_F(SofaModel, StateAndTopologyMayStandInAnAncestor) {
  const auto scene = readIn(std::string{kMesh} + "<Node><Node><TriangleModel/></Node></Node>");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{0, 0, 0, 1, 1, 0}));
}

TEST_F(SofaModel, OfSeveralTopologiesInItsNodeAModelSeesTheLast) {
  const auto scene = readIn(R"(<MechanicalObject position="0 0 0 1 0 0 2 0 0 3 0 0"/>
    <MeshTopology edges="0 1"/><MeshTopology edges="2 3"/><LineModel/>)");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{2, 0, 0, 3, 0, 0}));
}

TEST_F(SofaModel, WhatAModelLacksIsNamed) {
  EXPECT_THAT(complaintIn("<PointModel name='p'/>"),
              testing::AllOf(HasSubstr("scene.scn:2: PointModel 'p' (/p)"), HasSubstr("no MechanicalObject")));
  EXPECT_THAT(complaintIn("<MechanicalObject/><TriangleModel/>"), HasSubstr("no topology"));
  EXPECT_THAT(complaintIn(std::string{kFrame} + "<PointModel/>"), HasSubstr("state is rigid"));
  EXPECT_THAT(complaintIn("<MechanicalObject/><OBBModel/>"), HasSubstr("needs a rigid state"));
}

TEST_F(SofaModel, IndicesBeyondThePointsAreNamed) {
  EXPECT_THAT(complaintIn("<MechanicalObject position='0 0 0 1 1 1'/><MeshTopology edges='0 7'/><LineModel/>"),
              HasSubstr("names point 7, its state has 2"));
  EXPECT_THAT(complaintIn("<MechanicalObject position='0 0 0 1 1 1'/><MeshTopology edges='0 2'/><LineModel/>"),
              HasSubstr("names point 2, its state has 2"));
}

TEST_F(SofaModel, PartialReadingLeavesOutWhatCannotBePlacedAndSaysWhy) {
  const auto scene = readIn(R"(<MechanicalObject position="1 1 1"/><PointModel name="good"/>
    <Node name="N"><MechanicalObject/><MagicMapping name="m"/><PointModel name="bad"/><SphereModel name="too"/></Node>)",
                            true);
  EXPECT_THAT(pathsOf(scene), ElementsAre("/good"));
  ASSERT_EQ(scene.remarks.size(), 2U);
  EXPECT_EQ(scene.remarks[0].subject, "/N/bad");
  EXPECT_EQ(scene.remarks[1].subject, "/N/too");
  EXPECT_EQ(scene.remarks[0].line, 3U);
  EXPECT_TRUE(scene.remarks[0].isPartial);
  EXPECT_THAT(scene.remarks[0].reason, HasSubstr("MagicMapping 'm' (/N/m): this kind of mapping is not known"));
}

TEST_F(SofaModel, WhatNobodyDependsOnIsSkippedWithoutAWord) {
  const auto scene = readIn(R"(<RequiredPlugin name="Nothing"/><EulerImplicit/><UniformMass mass="x y"/><OglModel/>
    <MagicMapping output="@nobody"/><MagicTopology/>
    <MeshObjLoader filename="missing.obj"/>
    <MechanicalObject position="1 1 1 2 2 2"/><PointModel/>)");
  EXPECT_EQ(scene.models.size(), 1U);
  EXPECT_THAT(scene.remarks, IsEmpty());
}

TEST_F(SofaModel, UnknownCollisionModelsAreNamed) {
  EXPECT_THAT(complaintIn("<ImplicitSurfaceCollisionModel name='d'/>"),
              HasSubstr("ImplicitSurfaceCollisionModel 'd' (/d): this kind of collision model is not known"));
}

// Methods and region.

TEST_F(SofaModel, MethodsHaveTheirDefaults) {
  for (const auto name : {"MinProximityIntersection", "NewProximityIntersection", "LocalMinDistance"}) {
    const auto method = readIn(std::string{"<"} + name + "/>").pipelines[0].method;
    EXPECT_EQ(method.name, name);
    EXPECT_EQ(method.alarmDistance, 1.0);
    EXPECT_EQ(method.contactDistance, 0.5);
  }
  const auto discrete = readIn("<DiscreteIntersection/>").pipelines[0].method;
  EXPECT_EQ(discrete.alarmDistance, 0);
  EXPECT_EQ(discrete.contactDistance, 0);
  EXPECT_THAT(readIn("").pipelines[0].method.name, IsEmpty());
}

TEST_F(SofaModel, TheFirstMethodBelowThePipelineCounts) {
  const auto method = readIn(R"(<DiscreteIntersection/><Node><CollisionPipeline/>
    <Node><LocalMinDistance alarmDistance="0.3" contactDistance="0.1"/></Node></Node>)")
                          .pipelines[0]
                          .method;
  EXPECT_EQ(method.name, "LocalMinDistance");
  EXPECT_EQ(method.alarmDistance, 0.3);
  EXPECT_EQ(method.contactDistance, 0.1);
}

TEST_F(SofaModel, AnUnknownMethodIsNamed) {
  EXPECT_THAT(complaintIn("<MagicIntersection/>"), HasSubstr("intersection method is not known"));
}

TEST_F(SofaModel, TheBroadPhaseMayHaveARegion) {
  for (const auto name : {"BruteForceDetection", "BruteForceBroadPhase", "ParallelBruteForceBroadPhase"}) {
    const auto region = readIn(std::string{"<"} + name + " box='-1 -2 -3 4 5 6'/>").pipelines[0].region;
    ASSERT_TRUE(region) << name;
    EXPECT_EQ(region->min, (Vec3{-1, -2, -3}));
    EXPECT_EQ(region->max, (Vec3{4, 5, 6}));
  }
  EXPECT_FALSE(readIn("<BruteForceDetection/>").pipelines[0].region);
  EXPECT_FALSE(readIn("<BruteForceDetection box=''/>").pipelines[0].region);
  EXPECT_THAT(complaintIn("<BruteForceDetection box='1 2 3'/>"), HasSubstr("two corners"));
}

TEST_F(SofaModel, ARegionThatIsNoBoxIsNamedWithItsLine) {
  EXPECT_FALSE(readIn("<BruteForceDetection box='0 0 0 0 0 0'/>").pipelines[0].region) << "what SOFA writes for none";
  const auto complaint = complaintIn("<BruteForceDetection box='0 0 1e-9 1 1 1e-10'/>");
  EXPECT_THAT(complaint, HasSubstr("in z they are 1e-09 and 1e-10"));
  EXPECT_THAT(complaint, HasSubstr(".scn:"));
  EXPECT_THAT(complaintIn("<BruteForceDetection box='0 2 0 1 2 1'/>"), HasSubstr("in y they are 2 and 2"));
}

TEST_F(SofaModel, AListOfRadiiThatLinksToNothingIsTheDefaultAndThatIsSaid) {
  const auto scene = readIn(
      "<CollisionPipeline/><BruteForceDetection/><MechanicalObject position='0 0 0'/><SphereModel name='s' radius='2' "
      "listRadius='@loader.listRadius'/>");
  EXPECT_THAT(onlyBox(scene), IsBox(Corners{-2, -2, -2, 2, 2, 2}));
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_THAT(scene.warnings[0].reason, HasSubstr("listRadius links to nothing"));
}

TEST_F(SofaModel, MethodsOfTheSameBoxesAreProximityMethods) {
  for (const auto name : {"CCDTightInclusionIntersection", "CudaProximityIntersection"}) {
    const auto scene = readIn(std::string{"<"} + name + " alarmDistance='0.5'/>");
    EXPECT_EQ(scene.pipelines[0].method.contactDistance, 0.5) << name;
    EXPECT_EQ(scene.pipelines[0].method.alarmDistance, 0.5) << name;
    EXPECT_THAT(scene.warnings, testing::IsEmpty()) << name;
  }
  const auto scene = readIn("<CCDTightInclusionIntersection continuousCollisionType='Inertia'/>");
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_THAT(scene.warnings[0].reason, HasSubstr("continuous"));
  EXPECT_THAT(readIn("<CCDTightInclusionIntersection continuousCollisionType='0'/>").warnings, IsEmpty())
      << "the number of None";
}

TEST_F(SofaModel, ModelsOfPluginsAreNotOverlooked) {
  for (const auto name :
       {"TBulletSphereModel", "BulletOBBModel", "TBulletCylinderModel", "TBulletConvexHullModel", "CudaPointModel"})
    EXPECT_THAT(complaintIn(std::string{"<MechanicalObject/><"} + name + "/>"),
                HasSubstr("this kind of collision model is not known"))
        << name;
  for (const auto name : {"OglModel", "OglCylinderModel", "CudaVisualModel", "PointSplatModel", "CylinderVisualModel"})
    EXPECT_THAT(readIn(std::string{"<MechanicalObject/><"} + name + "/>").models, testing::IsEmpty()) << name;
  EXPECT_THAT(onlyBox(readIn("<MechanicalObject template='CudaVec3f' position='1 0 0'/><CudaSphereModel radius='2'/>")),
              IsBox(Corners{-1, -2, -2, 3, 2, 2}));
}

TEST_F(SofaModel, AFlagMayBeALinkToOneInWords) {
  const auto tests = [this](const std::string& first, const std::string& link) {
    return readIn("<Node name='a'><MechanicalObject/><SphereModel name='s' selfCollision='" + first +
                  "'/></Node><Node name='b'><MechanicalObject/><SphereModel name='s' selfCollision='" + link +
                  "'/></Node>")
        .models.at(1)
        .selfCollision;
  };
  for (const auto* yes : {"true", "1", "T"}) EXPECT_TRUE(tests(yes, "@../a/s.selfCollision")) << yes;
  for (const auto* no : {"false", "0"}) EXPECT_FALSE(tests(no, "@../a/s.selfCollision")) << no;
  EXPECT_THAT(complaintIn("<MechanicalObject/><SphereModel name='s' selfCollision='@s.selfCollision'/>"),
              HasSubstr("depends on itself"));
}

}  // namespace
}  // namespace allpairs::scene::sofa
