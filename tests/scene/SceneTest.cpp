// SPDX-License-Identifier: MIT
#include "allpairs/scene/Scene.h"

#include <gtest/gtest.h>

#include <set>

#include "SceneText.h"
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
}

}  // namespace
}  // namespace allpairs::test
