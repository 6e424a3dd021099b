// SPDX-License-Identifier: MIT
#include "scene/sofa/SceneText.h"

namespace allpairs::scene::sofa {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Pipelines : public SceneTest {};

std::string sphere(const std::string& node) {
  return "<Node name='" + node + "'><MechanicalObject position='0 0 0'/><SphereCollisionModel name='s'/></Node>\n";
}

const std::string kSubPipelineLinks =
    "intersectionMethod='@method' broadPhaseDetection='@broad' narrowPhaseDetection='@narrow' "
    "contactManager='@manager'";
const std::string kSubPipelineParts =
    "<NewProximityIntersection name='method' alarmDistance='3'/><BruteForceBroadPhase name='broad' box='0 0 0 1 1 1'/>"
    "<BVHNarrowPhase name='narrow'/><CollisionResponse name='manager'/>\n";

TEST_F(Pipelines, OfDifferentNodesTakeTheModelsBelowThem) {
  const auto scene = readIn("<Node name='A'><CollisionPipeline name='p'/><LocalMinDistance alarmDistance='2'/>" +
                            sphere("1") + sphere("2") + "</Node><Node name='B'><CollisionPipeline name='p'/>" +
                            sphere("1") + "</Node>" + sphere("C"));
  EXPECT_THAT(pathsOf(scene), ElementsAre("/A/1/s", "/A/2/s", "/B/1/s"));
  ASSERT_EQ(scene.pipelines.size(), 2U);
  EXPECT_EQ(scene.pipelines[0].path, "/A/p");
  EXPECT_THAT(scene.pipelines[0].models, ElementsAre(0, 1));
  EXPECT_EQ(scene.pipelines[0].method.alarmDistance, 2);
  EXPECT_THAT(scene.pipelines[1].models, ElementsAre(2));
  EXPECT_THAT(scene.pipelines[1].method.name, IsEmpty());
  ASSERT_EQ(scene.remarks.size(), 1U);
  EXPECT_EQ(scene.remarks[0].subject, "/C/s");
  EXPECT_FALSE(scene.remarks[0].isPartial);
}

TEST_F(Pipelines, OfANodeInsideAnotherShareModels) {
  const auto scene =
      readIn("<CollisionPipeline/>" + sphere("A") + "<Node name='B'><CollisionPipeline/>" + sphere("1") + "</Node>");
  EXPECT_THAT(pathsOf(scene), ElementsAre("/A/s", "/B/1/s"));
  ASSERT_EQ(scene.pipelines.size(), 2U);
  EXPECT_THAT(scene.pipelines[0].models, ElementsAre(0, 1));
  EXPECT_THAT(scene.pipelines[1].models, ElementsAre(1));
}

TEST_F(Pipelines, OfInactiveNodesAndAllButTheLastOfANodeDoNotRun) {
  const auto scene = readIn(
      "<CollisionPipeline name='first'/><DefaultPipeline name='last'/><Node activated='0'>"
      "<CollisionPipeline/>" +
      sphere("A") + "</Node>" + sphere("B"));
  ASSERT_EQ(scene.pipelines.size(), 1U);
  EXPECT_EQ(scene.pipelines[0].path, "/last");
  EXPECT_THAT(pathsOf(scene), ElementsAre("/B/s"));
  EXPECT_THAT(scene.remarks, IsEmpty());
}

TEST_F(Pipelines, OfACompositeTakeWhatTheyLink) {
  const auto scene = readIn(sphere("A") + sphere("B") + sphere("C") + kSubPipelineParts +
                            "<SubCollisionPipeline name='one' collisionModels='@/B/s @A/s @B/s' " + kSubPipelineLinks +
                            "/><SubCollisionPipeline name='two' collisionModels='@A/s' " + kSubPipelineLinks +
                            "/><SubCollisionPipeline name='unused' collisionModels='@C/s' " + kSubPipelineLinks +
                            "/><CompositeCollisionPipeline subCollisionPipelines='@two @one'/>");
  EXPECT_THAT(pathsOf(scene), ElementsAre("/A/s", "/B/s"));
  ASSERT_EQ(scene.pipelines.size(), 2U);
  EXPECT_EQ(scene.pipelines[0].path, "/two");
  EXPECT_THAT(scene.pipelines[0].models, ElementsAre(0));
  EXPECT_EQ(scene.pipelines[1].path, "/one");
  EXPECT_THAT(scene.pipelines[1].models, ElementsAre(1, 0));
  EXPECT_EQ(scene.pipelines[1].method.alarmDistance, 3);
  EXPECT_TRUE(scene.pipelines[1].region);
  ASSERT_EQ(scene.remarks.size(), 1U);
  EXPECT_EQ(scene.remarks[0].subject, "/C/s");
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST_F(Pipelines, ThatLackAPartAreWarnedOf) {
  const auto scene = readIn(sphere("A") + kSubPipelineParts +
                            "<SubCollisionPipeline name='p' collisionModels='@A/s' intersectionMethod='@method' "
                            "broadPhaseDetection='@broad' contactManager='@manager'/>"
                            "<CompositeCollisionPipeline subCollisionPipelines='@p'/>");
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_THAT(scene.warnings[0].reason, HasSubstr("lacks a narrow phase"));
  EXPECT_EQ(scene.warnings[0].subject, "/p");
}

std::vector<std::string> reasonsOf(const SceneDescription& scene) {
  std::vector<std::string> reasons;
  for (const Remark& warning : scene.warnings) reasons.push_back(warning.reason);
  return reasons;
}

TEST_F(Pipelines, OfANodeLackWhatIsNotInItOrBelow) {
  const std::vector<std::pair<std::string, std::string>> parts{
      {"a broad phase", "<BruteForceBroadPhase/>"},
      {"an intersection method", "<MinProximityIntersection/>"},
      {"a narrow phase", "<BVHNarrowPhase/>"},
      {"a contact manager", "<Node><CollisionResponse/></Node>"},
  };
  const auto without = [&](std::size_t part) {
    std::string text = "<CollisionPipeline/>" + sphere("A");
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (i != part) text += parts[i].second;
    return text;
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    m_sofa = SofaVersion::Sofa2612;
    EXPECT_THAT(reasonsOf(readIn(without(i))), ElementsAre(HasSubstr("the pipeline lacks " + parts[i].first)));
    const auto above = readIn(parts[i].second + "<Node name='N'>" + without(i) + "</Node>");
    EXPECT_THAT(reasonsOf(above), ElementsAre(HasSubstr("the pipeline lacks " + parts[i].first))) << "it is above";
    m_sofa = SofaVersion::Sofa2006;
    EXPECT_EQ(readIn(without(i)).warnings.size(), i == 0 ? 1U : 0U) << "older SOFA goes without " << parts[i].first;
  }
  m_sofa = SofaVersion::Sofa2612;
  EXPECT_THAT(readIn(without(parts.size())).warnings, IsEmpty());
  EXPECT_THAT(readIn("<CollisionPipeline/>").warnings, IsEmpty()) << "nothing to detect";
  for (const char* both : {"BruteForceDetection", "DirectSAP", "RayTraceDetection", "BulletCollisionDetection"})
    EXPECT_THAT(
        readIn("<CollisionPipeline/><CollisionResponse/><LocalMinDistance/><" + std::string(both) + "/>" + sphere("A"))
            .warnings,
        IsEmpty())
        << both;
}

TEST_F(Pipelines, NewerSofaLosesTheBoxOfOldDetections) {
  const auto regionOf = [&](const std::string& type, SofaVersion sofa) {
    m_sofa = sofa;
    const auto scene = readIn("<CollisionPipeline/><CollisionResponse/><LocalMinDistance/><BVHNarrowPhase/><" + type +
                              " box='0 0 0 1 1 1'/>" + sphere("A"));
    const bool isSaid = !scene.warnings.empty() && scene.warnings[0].reason.starts_with("its box is not read");
    EXPECT_NE(scene.pipelines[0].region.has_value(), isSaid) << type;
    return scene.pipelines[0].region.has_value();
  };
  for (const char* type : {"BruteForceDetection", "DirectSAP"}) {
    EXPECT_TRUE(regionOf(type, SofaVersion::Sofa2006)) << type;
    EXPECT_FALSE(regionOf(type, SofaVersion::Sofa2612)) << type;
  }
  EXPECT_TRUE(regionOf("BruteForceBroadPhase", SofaVersion::Sofa2612));
  EXPECT_FALSE(regionOf("RayTraceDetection", SofaVersion::Sofa2006));
}

TEST_F(Pipelines, SweepAndPruneHasRulesOfItsOwnAndThatIsSaid) {
  const auto scene = readIn("<CollisionPipeline/><IncrSAP box='0 0 0 1 1 1'/>" + sphere("A"));
  EXPECT_THAT(reasonsOf(scene), ElementsAre(HasSubstr("without groups across nodes")));
  EXPECT_THAT(reasonsOf(scene), ElementsAre(HasSubstr("whatever its box is")));
  EXPECT_TRUE(scene.pipelines[0].region);
}

TEST_F(Pipelines, OldDetectionsThatAreNotBruteForceHaveRulesOfTheirOwnAndThatIsSaid) {
  const auto reasonsFor = [&](const std::string& type, SofaVersion sofa, const std::string& flags = {}) {
    m_sofa = sofa;
    return reasonsOf(readIn("<CollisionPipeline/><CollisionResponse/><LocalMinDistance/><BVHNarrowPhase/><" + type +
                            "/><MechanicalObject/><SphereCollisionModel " + flags + "/>"));
  };
  EXPECT_THAT(reasonsFor("DirectSAP", SofaVersion::Sofa2006), ElementsAre(HasSubstr("without groups across nodes")));
  EXPECT_THAT(reasonsFor("DirectSAP", SofaVersion::Sofa2612), IsEmpty());
  const std::string itself = "selfCollision='1'";
  EXPECT_THAT(reasonsFor("RayTraceDetection", SofaVersion::Sofa2006, itself),
              ElementsAre(HasSubstr("SOFA pairs no model with itself")));
  EXPECT_THAT(reasonsFor("RayTraceDetection", SofaVersion::Sofa2006), IsEmpty());
  EXPECT_THAT(reasonsFor("RayTraceDetection", SofaVersion::Sofa2612, itself), IsEmpty());
  EXPECT_THAT(reasonsFor("BruteForceDetection", SofaVersion::Sofa2006, itself), IsEmpty());
}

TEST_F(Pipelines, WhereNothingTellsTheVersionContactDistancesAreSaidToCount) {
  const auto reasonsFor = [&](const std::string& method, const std::string& distance, SofaVersion sofa) {
    m_sofa = sofa;
    return reasonsOf(readIn("<CollisionPipeline/><CollisionResponse/><BruteForceDetection/><" + method +
                            "/><MechanicalObject/><SphereCollisionModel proximity='" + distance + "'/>"));
  };
  const std::string min = "MinProximityIntersection";
  EXPECT_THAT(reasonsFor(min, "0.1", SofaVersion::FromScene), ElementsAre(HasSubstr("as in SOFA since 21.06")));
  EXPECT_THAT(reasonsFor(min, "0", SofaVersion::FromScene), IsEmpty());
  EXPECT_THAT(reasonsFor("LocalMinDistance", "0.1", SofaVersion::FromScene), IsEmpty());
  EXPECT_THAT(reasonsFor(min, "0.1", SofaVersion::Sofa2006), IsEmpty());
}

TEST_F(Pipelines, NamesThatSofaDoesNotHaveAreSaidOnce) {
  const auto reasonsFor = [&](const std::string& text, SofaVersion sofa = SofaVersion::Sofa2612) {
    m_sofa = sofa;
    return reasonsOf(readIn("<BruteForceDetection/><CollisionResponse/><LocalMinDistance/>" + text));
  };
  const std::string old = "<DefaultPipeline/><Node><MechanicalObject/><PointModel/><PointModel/></Node>";
  EXPECT_THAT(reasonsFor(old), ElementsAre(HasSubstr("no component of the name 'DefaultPipeline' any more"),
                                           HasSubstr("no component of the name 'PointModel' any more")));
  EXPECT_THAT(reasonsFor(old, SofaVersion::Sofa2006), IsEmpty());
  const auto slip = [&](const std::string& name) { return reasonsFor("<CollisionPipeline/><" + name + "/>"); };
  EXPECT_THAT(slip("SphereCollisionModle"), ElementsAre(HasSubstr("is SphereCollisionModel meant?")));
  EXPECT_THAT(slip("Include"), ElementsAre(HasSubstr("is include meant?")));
  EXPECT_THAT(slip("node"), ElementsAre(HasSubstr("is Node meant?")));
  for (const char* other : {"CollisionNode", "OglModel", "SubsetTopologicalMapping", "BVHNarrowPhase", "VisualStyle"})
    EXPECT_THAT(slip(other), IsEmpty()) << other;
}

TEST_F(Pipelines, ThatLinkToNothingAreRefused) {
  EXPECT_THAT(complaintIn("<SubCollisionPipeline name='p' collisionModels='@A/s'/>"
                          "<CompositeCollisionPipeline subCollisionPipelines='@p'/>"),
              HasSubstr("collisionModels: '@A/s' leads to no such component"));
}

TEST_F(Pipelines, NoneAtAllIsWarnedOf) {
  const auto scene = readIn(sphere("A"));
  ASSERT_EQ(scene.pipelines.size(), 1U);
  EXPECT_THAT(scene.pipelines[0].models, ElementsAre(0));
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_THAT(scene.warnings[0].reason, HasSubstr("no collision pipeline"));
  EXPECT_THAT(readIn("").warnings, IsEmpty()) << "nor models";
}

}  // namespace
}  // namespace allpairs::scene::sofa
