// SPDX-License-Identifier: MIT
#include "allpairs/scene/Scene.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "SceneText.h"
#include "allpairs/Error.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/MinProximityIntersection.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadInput.h"
#include "support/TempFolder.h"

namespace allpairs::test {
namespace {

scene::Scene sceneOf(const std::string& name, double alarmDistance) {
  scene::Scene scene = scene::emptyScene();
  scene.intersection = std::make_unique<collision::MinProximityIntersection>();
  scene.intersection->setAlarmDistance(alarmDistance);
  scene.intersectionName = "MinProximityIntersection";
  scene.models.push_back(std::make_unique<collision::BoxModel>(name, cube(0, 0, 0)));
  return scene;
}

TEST(Scene, BoxesBecomeBodiesOfTheirOwn) {
  const TempFolder folder;
  const auto path = folder.write("boxes.csv", "a,0,0,0,1,1,1\nb,1,1,1,2,2,2\n");
  const scene::Scene scene = scene::readInput(path);
  EXPECT_EQ(namesOf(scene), "a BoxModel 1\nb BoxModel 1\n");
  EXPECT_EQ(boxOf(*scene.models[1]), cube(1, 1, 1));
  EXPECT_NE(scene.models[0]->getOwner(), scene.models[1]->getOwner());
  EXPECT_NE(scene.models[0]->getOwner(), nullptr);
}

TEST(Scene, AScriptOfSofaIsNamedAsSuch) {
  const TempFolder folder;
  for (const char* name : {"scene.py", "scene.pyscn"}) {
    const auto path = folder.write(name, "def createScene(root): pass\n");
    try {
      (void)scene::readInput(path);
      ADD_FAILURE() << name;
    } catch (const FileError& problem) {
      EXPECT_NE(problem.problem().find("a SOFA scene in Python"), std::string::npos) << problem.what();
    }
  }
}

TEST(Scene, AppendingKeepsTheOrderAndTellsNamesApart) {
  scene::Scene scene = sceneOf("wheel", 1);
  scene::append(scene, sceneOf("wheel", 1));
  scene::append(scene, sceneOf("axle", 1));
  scene::append(scene, sceneOf("wheel", 1));
  EXPECT_EQ(namesOf(scene), "wheel BoxModel 1\nwheel#2 BoxModel 1\naxle BoxModel 1\nwheel#3 BoxModel 1\n");
  EXPECT_TRUE(scene.remarks.empty());
}

TEST(Scene, SeveralAppendedTogetherAreAsOneAfterTheOther) {
  const std::vector<std::string> names{"wheel", "axle", "wheel", "bolt", "wheel", "axle"};
  scene::Scene expected = sceneOf("axle", 1);
  scene::Scene scene = sceneOf("axle", 1);
  std::vector<scene::Scene> more;
  for (const std::string& name : names) {
    scene::append(expected, sceneOf(name, 2));
    more.push_back(sceneOf(name, 2));
  }
  scene::append(scene, std::move(more));
  EXPECT_EQ(namesOf(scene), namesOf(expected));
  EXPECT_EQ(scene.remarks.size(), names.size());
  EXPECT_EQ(scene.files.size(), expected.files.size());
}

TEST(Scene, OfSeveralWithOneThatCannotBeAppendedNoneIs) {
  scene::Scene scene = sceneOf("axle", 1);
  std::vector<scene::Scene> more;
  more.push_back(sceneOf("wheel", 1));
  more.push_back(sceneOf("bolt", 1));
  more.back().pipelines.emplace_back();
  EXPECT_THROW(scene::append(scene, std::move(more)), InvalidArgument);
  EXPECT_EQ(namesOf(scene), "axle BoxModel 1\n");
}

std::string triangle(const std::string& name) { return "o " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n"; }

TEST(SceneNames, OfSeveralFilesAreByFileAndObjectWhereTheyWouldNotTellModelsApart) {
  const TempFolder folder;
  folder.write("a.obj", triangle("wheel") + triangle("axle") + triangle("wheel"));
  folder.write("b.obj", triangle("wheel") + triangle("Cylinder.002"));
  folder.write("c.obj", triangle("default"));
  folder.write("d.obj", triangle("Bolt 12"));
  const scene::Scene scene = scene::readInput(folder.path());
  EXPECT_EQ(namesOf(scene),
            "a.obj › wheel TTriangleModel 1\naxle TTriangleModel 1\na.obj › wheel#2 TTriangleModel 1\n"
            "b.obj › wheel TTriangleModel 1\nb.obj › Cylinder.002 TTriangleModel 1\nc.obj TTriangleModel 1\n"
            "Bolt 12 TTriangleModel 1\n");
  ASSERT_EQ(scene.sources.size(), 7U);
  EXPECT_EQ(scene.files.at(scene.sources[4].file), folder.path() / "b.obj");
  EXPECT_EQ(scene.sources[4].name, "Cylinder.002");
}

TEST(SceneNames, OfOneFileStayAsTheyAre) {
  const TempFolder folder;
  const auto path = folder.write("a.obj", triangle("default") + triangle("Cube.001"));
  EXPECT_EQ(namesOf(scene::readInput(path)), "default TTriangleModel 1\nCube.001 TTriangleModel 1\n");
}

/// "wheel#9" is the ninth wheel of a file; "bolt#" has no number, and is no bolt.
TEST(SceneNames, NumbersOfAFileAreNoPartOfANameThatIsShared) {
  const TempFolder folder;
  std::string wheels;
  for (int i = 0; i < 10; ++i) wheels += triangle("wheel");
  scene::Scene scene = scene::readInput(folder.write("a.obj", wheels + triangle("bolt#")));
  scene::append(scene, scene::readInput(folder.write("b.obj", triangle("wheel") + triangle("bolt"))));
  std::string expected = "a.obj › wheel TTriangleModel 1\n";
  for (int i = 2; i <= 10; ++i) expected += "a.obj › wheel#" + std::to_string(i) + " TTriangleModel 1\n";
  EXPECT_EQ(namesOf(scene),
            expected + "bolt# TTriangleModel 1\nb.obj › wheel TTriangleModel 1\nbolt TTriangleModel 1\n");
}

TEST(SceneNames, OfFilesThatAreCalledAlikeHaveTheirFolders) {
  const TempFolder folder;
  const auto left = folder.write("left/wheel.obj", triangle("wheel"));
  const auto right = folder.write("right/wheel.obj", triangle("wheel"));
  const auto axle = folder.write("axle.obj", triangle("axle"));
  scene::Scene scene = scene::readInput(left);
  scene::append(scene, scene::readInput(axle));
  scene::append(scene, scene::readInput(right));
  EXPECT_EQ(
      namesOf(scene),
      "left/wheel.obj › wheel TTriangleModel 1\naxle TTriangleModel 1\nright/wheel.obj › wheel TTriangleModel 1\n");
  scene::append(scene, scene::readInput(right));
  EXPECT_EQ(scene.models.back()->getName(), "right/wheel.obj › wheel#2") << "the same file again";
}

TEST(SceneNames, OfACallerStay) {
  const TempFolder folder;
  const auto a = folder.write("a.obj", triangle("wheel") + triangle("axle") + triangle("bolt"));
  const auto b = folder.write("b.obj", triangle("wheel") + triangle("axle") + triangle("mine"));
  scene::Scene scene = scene::readInput(a);
  scene.models[0]->setName("mine");
  scene::Scene more = scene::readInput(b);
  more.models[0]->setName("yours");
  scene::append(scene, std::move(more));
  EXPECT_EQ(namesOf(scene),
            "mine TTriangleModel 1\na.obj › axle TTriangleModel 1\nbolt TTriangleModel 1\n"
            "yours TTriangleModel 1\nb.obj › axle TTriangleModel 1\nmine#2 TTriangleModel 1\n")
      << "and no other model takes one";
  scene.models[1]->setName("axle");
  scene::append(scene, scene::readInput(folder.write("c.obj", triangle("bolt"))));
  EXPECT_EQ(namesOf(scene),
            "mine TTriangleModel 1\naxle TTriangleModel 1\na.obj › bolt TTriangleModel 1\n"
            "yours TTriangleModel 1\nb.obj › axle TTriangleModel 1\nmine#2 TTriangleModel 1\n"
            "c.obj › bolt TTriangleModel 1\n")
      << "the file's own name too, where the model had another";
}

TEST(SceneNames, OfScenesThatHaveTheSameNodesAreByScene) {
  const TempFolder folder;
  const std::string text =
      "<Node><CollisionPipeline/><Node name=\"A\"><MechanicalObject position=\"0 0 0\"/>"
      "<SphereCollisionModel name=\"s\" radius=\"1\"/></Node></Node>";
  scene::Scene scene = scene::readInput(folder.write("one.scn", text));
  scene::append(scene, scene::readInput(folder.write("two.scn", text)));
  EXPECT_EQ(scene.models[0]->getName(), "one.scn › /A/s");
  EXPECT_EQ(scene.models[1]->getName(), "two.scn › /A/s");
}

TEST(Scene, TheFirstMethodThatAFileNamesCounts) {
  scene::Scene scene = scene::emptyScene();
  scene::append(scene, sceneOf("a", 0.25));
  scene::append(scene, sceneOf("b", 0.5));
  scene::append(scene, scene::emptyScene());
  EXPECT_EQ(scene.intersectionName, "MinProximityIntersection");
  EXPECT_EQ(scene.intersection->getAlarmDistance(), 0.25);
  EXPECT_EQ(scene.remarks.size(), 1U) << "the second one is not used, and that is said";
}

TEST(Scene, TheFirstRegionCounts) {
  scene::Scene scene = scene::emptyScene();
  scene::Scene more = scene::emptyScene();
  more.region = cube(0, 0, 0);
  scene::append(scene, std::move(more));
  EXPECT_EQ(scene.region, cube(0, 0, 0));
  scene::Scene other = scene::emptyScene();
  other.region = cube(1, 0, 0);
  scene::append(scene, std::move(other));
  EXPECT_EQ(scene.region, cube(0, 0, 0));
  EXPECT_EQ(scene.remarks.size(), 1U);
  scene::Scene same = scene::emptyScene();
  same.region = cube(0, 0, 0);
  scene::append(scene, std::move(same));
  EXPECT_EQ(scene.remarks.size(), 1U) << "of the same one there is nothing to say";
}

}  // namespace
}  // namespace allpairs::test
