// SPDX-License-Identifier: MIT
#include "allpairs/scene/ReadSofaScene.h"

#include <nlohmann/json.hpp>

#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/TriangleModel.h"
#include "allpairs/scene/FileError.h"
#include "scene/sofa/DataScenes.h"
#include "scene/sofa/SceneText.h"

namespace allpairs::scene {
namespace {

using sofa::Corners;
using sofa::IsBox;
using testing::ElementsAre;
using testing::HasSubstr;

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// The broad phase's pairs, as indices into the scene's models.
Pairs pairsOf(const Scene& scene) {
  collision::BruteForceBroadPhase broadPhase;
  broadPhase.setIntersectionMethod(scene.intersection.get());
  if (scene.region) broadPhase.setBox(*scene.region);
  broadPhase.init();
  broadPhase.beginBroadPhase();
  std::map<const collision::CollisionModel*, std::size_t> indices;
  for (const auto& model : scene.models) {
    model->computeBoundingTree();
    indices[model.get()] = indices.size();
    broadPhase.addCollisionModel(model->getFirst());
  }
  broadPhase.endBroadPhase();
  Pairs pairs;
  for (const auto& [first, second] : broadPhase.getCollisionModelPairs())
    pairs.emplace_back(indices.at(first->getLast()), indices.at(second->getLast()));
  return pairs;
}

Corners rootOf(collision::CollisionModel& model) {
  model.computeBoundingTree();
  const auto box = model.getFirst()->elementBox(0);
  return {box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]};
}

class ReadSofaScene : public testing::Test {
 protected:
  [[nodiscard]] Scene read(const std::string& text, bool partial = false) const {
    ReadOptions options;
    options.partial = partial;
    return readSofaScene(m_folder.write("scene.scn", "<Node name='root'>\n" + text + "\n</Node>"), options);
  }

  sofa::Folder m_folder;
};

constexpr auto kEverything = R"(
  <MechanicalObject position="0 0 0  1 0 0  0 1 0  0 0 1"/>
  <MeshTopology tetrahedra="0 1 2 3"/>
  <PointModel/><LineModel/><TriangleModel/><TetrahedronModel/><SphereModel/><CapsuleModel/>
  <Node><MechanicalObject template="Rigid" position="5 5 5 0 0 0 1"/><OBBModel/><CapsuleModel/><CylinderModel/></Node>)";

TEST_F(ReadSofaScene, MakesModelsOfEveryTypeWithSofasNamesAndBoxes) {
  const auto scene = read(kEverything);
  std::vector<std::string> types;
  std::vector<std::size_t> sizes;
  for (const auto& model : scene.models) {
    types.emplace_back(model->typeName());
    sizes.push_back(model->getSize());
  }
  EXPECT_THAT(types, ElementsAre("TPointModel", "TLineModel", "TTriangleModel", "TetrahedronModel", "TSphereModel",
                                 "TCapsuleModel", "TOBBModel", "TCapsuleModel", "TCylinderModel"));
  EXPECT_THAT(sizes, ElementsAre(4, 6, 4, 1, 4, 6, 1, 1, 1));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_THAT(rootOf(*scene.models[i]), IsBox(Corners{0, 0, 0, 1, 1, 1}));
  EXPECT_THAT(rootOf(*scene.models[4]), IsBox(Corners{-1, -1, -1, 2, 2, 2}));
  EXPECT_THAT(rootOf(*scene.models[5]), IsBox(Corners{-0.5, -0.5, -0.5, 1.5, 1.5, 1.5}));
  EXPECT_THAT(rootOf(*scene.models[6]), IsBox(Corners{4, 4, 4, 6, 6, 6}));
  EXPECT_THAT(rootOf(*scene.models[7]), IsBox(Corners{4.5, 3.5, 4.5, 5.5, 6.5, 5.5}));
  EXPECT_THAT(rootOf(*scene.models[8]), IsBox(Corners{4.5, 3.5, 4.5, 5.5, 6.5, 5.5}));
}

TEST_F(ReadSofaScene, CarriesFlagsGroupsDistancesAndOwnersOver) {
  const auto scene = read(R"(<MechanicalObject/>
    <PointModel simulated="0" moving="0" selfCollision="1" group="2 1" proximity="0.5"/><PointModel active="0"/>
    <Node name="N"><MechanicalObject/><MeshTopology/><TriangleModel useCurvature="1"/></Node>)");
  ASSERT_EQ(scene.models.size(), 3U);
  const auto& first = *scene.models[0];
  EXPECT_FALSE(first.isSimulated() || first.isMoving());
  EXPECT_TRUE(first.isActive() && first.getSelfCollision());
  EXPECT_THAT(first.getGroups(), ElementsAre(1, 2));
  EXPECT_EQ(first.getContactDistance(), 0.5);
  EXPECT_FALSE(scene.models[1]->isActive());
  EXPECT_EQ(first.getOwner(), scene.models[1]->getOwner());
  EXPECT_NE(first.getOwner(), scene.models[2]->getOwner());
  EXPECT_EQ(static_cast<const Owner*>(scene.models[2]->getOwner())->path, "/N");
  EXPECT_TRUE(dynamic_cast<const collision::TriangleModel&>(*scene.models[2]).getUseCurvature());
}

TEST_F(ReadSofaScene, MakesTheMethodThatTheSceneNames) {
  for (const auto name : {"MinProximityIntersection", "NewProximityIntersection", "LocalMinDistance"}) {
    const auto scene = read(std::string{"<"} + name + " alarmDistance='0.75' contactDistance='0.25'/>");
    EXPECT_EQ(scene.intersection->typeName(), name);
    EXPECT_EQ(scene.intersectionName, name);
    EXPECT_EQ(scene.intersection->getAlarmDistance(), 0.75);
    EXPECT_EQ(scene.intersection->getContactDistance(), 0.25);
  }
  EXPECT_EQ(read("<DiscreteIntersection/>").intersectionName, "DiscreteIntersection");
  EXPECT_EQ(read("").intersection->typeName(), "DiscreteIntersection");
}

TEST_F(ReadSofaScene, BulletsDetectionIsReadAsItsModelsBoxesAndThatIsSaid) {
  const auto scene = read(R"(<BulletCollisionDetection/><CollisionPipeline/><BulletIntersection contactDistance="5"/>
    <MechanicalObject position="0 0 0 1 0 0 0 1 0"/><MeshTopology triangles="0 1 2"/>
    <TBulletTriangleModel name="t" contactDistance="0" margin="5"/>)");
  ASSERT_EQ(scene.models.size(), 1U);
  EXPECT_EQ(scene.models[0]->typeName(), "TBulletTriangleModel");
  EXPECT_THAT(rootOf(*scene.models[0]), IsBox(Corners{0, 0, 0, 1, 1, 0}));
  EXPECT_EQ(scene.intersectionName, "BulletIntersection");
  EXPECT_EQ(scene.intersection->getContactDistance(), 0);
  ASSERT_EQ(scene.warnings.size(), 1U);
  EXPECT_THAT(scene.warnings[0].reason, HasSubstr("Bullet detects in this scene"));
}

TEST_F(ReadSofaScene, DistanceGridsAreTheBoxOfTheirSurfaceOrTheCellsThatBendIt) {
  m_folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 3\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n");
  const auto scene = read(R"(
    <Node><MechanicalObject template="Rigid3" position="10 0 0 0 0 0.70710678118654752 0.70710678118654752  9 9 9 0 0 0 1"/>
      <RigidDistanceGridCollisionModel filename="a.obj" scale="2" contactDistance="5" translation="1 0 0"/></Node>
    <Node><MechanicalObject dx="1"/><SparseGridTopology name="grid" n="2 2 3" filename="a.obj" min="0 0 -1" max="2 4 4"/>
      <FFDDistanceGridCollisionModel filename="a.obj" topology="@grid"/></Node>)");
  ASSERT_EQ(scene.models.size(), 2U);
  EXPECT_EQ(scene.models[0]->typeName(), "RigidDistanceGridCollisionModel");
  EXPECT_EQ(scene.models[0]->getSize(), 1U);
  EXPECT_THAT(rootOf(*scene.models[0]), IsBox(Corners{6, 1, 0, 10, 3, 6}));
  EXPECT_EQ(scene.models[1]->typeName(), "FFDDistanceGridCollisionModel");
  EXPECT_EQ(scene.models[1]->getSize(), 2U);
  EXPECT_THAT(rootOf(*scene.models[1]), IsBox(Corners{1, 0, -1, 3, 4, 4}));
  // The grid may be elsewhere, and need not be named.
  const std::string grid = "<SparseGridTopology name='grid' n='2 2 3' filename='a.obj' min='0 0 -1' max='2 4 4'/>";
  const std::string surface = "<FFDDistanceGridCollisionModel filename='a.obj' ";
  const auto others =
      read("<Node name='a'>" + grid + "</Node><Node><MechanicalObject position='@../a/grid.position'/>" + surface +
           "topology='@../a/grid'/></Node><Node><MechanicalObject/>" + grid + surface + "/></Node>");
  ASSERT_EQ(others.models.size(), 2U);
  for (const auto& model : others.models) {
    EXPECT_EQ(model->getSize(), 2U);
    EXPECT_THAT(rootOf(*model), IsBox(Corners{0, 0, -1, 2, 4, 4}));
  }
  EXPECT_THAT(
      [&] { (void)read("<MeshTopology position='0 0 0 1 1 1' edges='0 1'/><MechanicalObject/>" + surface + "/>"); },
      testing::ThrowsMessage<FileError>(HasSubstr("its topology is no grid")));
  const auto refuses = [&](const std::string& data, const std::string& why) {
    const auto text = "<MechanicalObject template='Rigid3'/><DistanceGridCollisionModel " + data + "/>";
    EXPECT_THAT([&] { (void)read(text); }, testing::ThrowsMessage<FileError>(HasSubstr(why)));
  };
  refuses("filename='a.obj' sampling='1'", "sampled, turned or inside out");
  refuses("filename='a.obj' flipNormals='1'", "sampled, turned or inside out");
  refuses("filename='a.obj' rotation='0 0 90'", "sampled, turned or inside out");
  refuses("", "its surface is no Wavefront file");
}

TEST_F(ReadSofaScene, MakesTheRegionThatTheBroadPhaseNames) {
  const auto scene = read("<BruteForceDetection box='0 1 2 3 4 5'/>");
  EXPECT_EQ(scene.region, (Box{{0, 1, 2}, {3, 4, 5}}));
}

TEST_F(ReadSofaScene, WhatAModelRefusesIsNamedWithItsLineOrLeftOut) {
  const std::string text = "<MechanicalObject/>\n<SphereModel name='s' radius='-1'/><PointModel name='p'/>";
  EXPECT_THAT([&] { (void)read(text); }, testing::ThrowsMessage<FileError>(HasSubstr("scene.scn:3:")));
  const auto scene = read(text, true);
  ASSERT_EQ(scene.models.size(), 1U);
  ASSERT_EQ(scene.remarks.size(), 1U);
  EXPECT_EQ(scene.remarks[0].subject, "/s");
  EXPECT_EQ(scene.remarks[0].line, 3U);
  EXPECT_TRUE(scene.remarks[0].isPartial);
}

TEST_F(ReadSofaScene, ContactDistancesCountBetweenBoxesExceptWhereOldSofaIsAskedFor) {
  // Boxes of 1.1 with 0.8 between them.
  const auto spheres = [](const std::string& method) {
    const auto sphere = [](const std::string& x) {
      return "<Node><MechanicalObject position='" + x + " 0 0'/><SphereModel radius='1' proximity='0.1'/></Node>";
    };
    return "<DefaultPipeline/><BruteForceDetection/><" + method + " alarmDistance='0.75'/>" + sphere("0") + sphere("3");
  };
  const auto pairs = [&](const std::string& method, SofaVersion sofa) {
    const auto path = m_folder.write("scene.scn", "<Node>" + spheres(method) + "</Node>");
    return pairsOf(readSofaScene(path, {.sofa = sofa}));
  };
  for (const char* method : {"MinProximityIntersection", "NewProximityIntersection"}) {
    EXPECT_EQ(pairs(method, SofaVersion::FromScene), (Pairs{{1, 0}})) << method;
    EXPECT_EQ(pairs(method, SofaVersion::Sofa2612), (Pairs{{1, 0}})) << method;
    EXPECT_EQ(pairs(method, SofaVersion::Sofa2006), Pairs{}) << method;
  }
  EXPECT_EQ(pairs("LocalMinDistance", SofaVersion::Sofa2006), (Pairs{{1, 0}}));
}

TEST(ReadSofaDataScenes, GiveThePairsThatSofaPrintedInItsOrder) {
  ALLPAIRS_NEED_SCENES(scenes);
  std::size_t total = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes / "expected")) {
    SCOPED_TRACE(entry.path().filename());
    const auto known = nlohmann::json::parse(std::ifstream(entry.path()));
    ReadOptions options;
    options.searchRoots = {scenes, scenes / "examples"};
    const auto scene = readSofaScene(scenes / known.at("scene").get<std::string>(), options);
    const auto pairs = pairsOf(scene);
    EXPECT_EQ(pairs, known.at("pairs").get<Pairs>());
    total += pairs.size();
  }
  EXPECT_EQ(total, 530U);
}

TEST(ReadSofaDataScenes, TheWorkedExamplesGiveTheWorkedPairs) {
  ALLPAIRS_NEED_SCENES(scenes);
  const auto pairs = [&](const char* name) { return pairsOf(readSofaScene(scenes / "worked" / name)); };
  EXPECT_EQ(pairs("ex1_alarm_proximity.scn"), (Pairs{{1, 0}}));
  EXPECT_EQ(pairs("ex1b_alarm_proximity_075.scn"), (Pairs{{1, 0}}));
  EXPECT_EQ(pairs("ex2_euler_rigid.scn"), Pairs{});
  EXPECT_EQ(pairs("ex3_groups_self.scn"), (Pairs{{1, 1}, {2, 1}, {3, 0}, {4, 0}, {4, 2}}));
}

}  // namespace
}  // namespace allpairs::scene
