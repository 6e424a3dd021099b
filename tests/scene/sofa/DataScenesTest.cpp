// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "allpairs/scene/FileError.h"
#include "scene/sofa/DataScenes.h"
#include "scene/sofa/SceneText.h"

namespace allpairs::scene::sofa {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Known {
  std::string path;
  std::string type;
  std::size_t elements = 0;
  Corners box{};
  bool simulated = true;
  bool moving = true;
};

Known toKnown(const nlohmann::json& model) {
  Known known{model.at("path"), model.at("type"), model.at("elements"), {}, model.at("simulated"), model.at("moving")};
  for (std::size_t corner = 0; corner < 2; ++corner)
    for (std::size_t axis = 0; axis < 3; ++axis) known.box[3 * corner + axis] = model.at("box")[corner][axis];
  return known;
}

void compare(const std::filesystem::path& scenes, const std::filesystem::path& file) {
  SCOPED_TRACE(file.filename());
  const auto known = nlohmann::json::parse(std::ifstream(file));
  const auto scene = describeScene(scenes / known.at("scene").get<std::string>(),
                                   {.searchRoots = {scenes, scenes / "examples"}, .partial = false});
  EXPECT_DOUBLE_EQ(scene.pipelines[0].method.alarmDistance, known.at("alarmDistance"));
  ASSERT_EQ(scene.models.size(), known.at("models").size());
  for (std::size_t i = 0; i < scene.models.size(); ++i) {
    const auto expected = toKnown(known.at("models")[i]);
    const auto& model = scene.models[i];
    SCOPED_TRACE(expected.path);
    EXPECT_EQ(model.path, expected.path);
    EXPECT_EQ(model.type, expected.type);
    EXPECT_EQ(model.elementCount(), expected.elements);
    EXPECT_EQ(model.simulated, expected.simulated);
    EXPECT_EQ(model.moving, expected.moving);
    EXPECT_THAT(boxOf(model), IsBox(expected.box));
  }
}

TEST(SofaDataScenes, HaveTheModelsThatSofaPrinted) {
  ALLPAIRS_NEED_SCENES(scenes);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes / "expected")) {
    compare(scenes, entry.path());
    ++files;
  }
  EXPECT_EQ(files, 12U);
}

TEST(SofaDataScenes, TheWorkedExamplesHaveTheWorkedNumbers) {
  ALLPAIRS_NEED_SCENES(scenes);
  const auto spheres = describeScene(scenes / "worked/ex1_alarm_proximity.scn", {});
  ASSERT_EQ(spheres.models.size(), 2U);
  EXPECT_THAT(boxOf(spheres.models[0]), IsBox(Corners{-1.1, -1.1, -1.1, 1.1, 1.1, 1.1}));
  EXPECT_THAT(boxOf(spheres.models[1]), IsBox(Corners{1.9, -1.1, -1.1, 4.1, 1.1, 1.1}));
  EXPECT_EQ(spheres.pipelines[0].method.alarmDistance, 0.85);
  const auto euler = describeScene(scenes / "worked/ex2_euler_rigid.scn", {});
  ASSERT_EQ(euler.models.size(), 3U);
  EXPECT_THAT(boxOf(euler.models[0]), IsBox(Corners{5, 0, 1, 5, 1, 2}));
  EXPECT_THAT(boxOf(euler.models[1]), IsBox(Corners{8, 2, 3, 8, 4, 3}));
  const auto groups = describeScene(scenes / "worked/ex3_groups_self.scn", {});
  ASSERT_EQ(groups.models.size(), 5U);
  EXPECT_THAT(groups.models[0].groups, ElementsAre(1, 2));
  EXPECT_TRUE(groups.models[1].selfCollision);
  EXPECT_FALSE(groups.models[3].simulated || groups.models[4].simulated);
}

TEST(SofaDataScenes, NeedTheirSearchRoots) {
  ALLPAIRS_NEED_SCENES(scenes);
  EXPECT_THAT([&] { (void)describeScene(scenes / "examples/Demos/chainHybrid.scn", {}); },
              testing::ThrowsMessage<FileError>(HasSubstr("nowhere to be found")));
}

}  // namespace
}  // namespace allpairs::scene::sofa
