// SPDX-License-Identifier: MIT
// Attributes that are not read, and whose names are near to one that is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "SceneText.h"

namespace allpairs::scene::sofa {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// What is said of a scene of a model, of its state, topology and pipeline, with these attributes besides.
class AttributeSlip : public SceneTest {
 protected:
  struct Extra {
    std::string state{};
    std::string topology{};
    std::string model{};
    std::string method{};
  };

  [[nodiscard]] std::vector<std::string> warningsOf(const Extra& extra) const {
    const auto scene = readIn(
        "<CollisionPipeline/><BruteForceBroadPhase/><BVHNarrowPhase/><CollisionResponse/>\n"
        "<MinProximityIntersection name='m' " +
        extra.method +
        "/>\n"
        "<MeshTopology name='t' position='0 0 0  1 0 0  0 1 0' triangles='0 1 2' " +
        extra.topology + "/>\n<MechanicalObject name='o' " + extra.state + "/>\n<TriangleCollisionModel name='c' " +
        extra.model + "/>");
    std::vector<std::string> warnings;
    for (const auto& warning : scene.warnings)
      warnings.push_back(std::to_string(warning.line) + ' ' + warning.subject + ": " + warning.reason);
    return warnings;
  }
};

TEST_F(AttributeSlip, IsNamedWithItsLineAndWhatIsMeant) {
  EXPECT_THAT(warningsOf({}), IsEmpty());
  EXPECT_THAT(warningsOf({.model = "selfColision='1'"}),
              ElementsAre("6 /c: its attribute 'selfColision' is not read; is 'selfCollision' meant?"));
  EXPECT_THAT(warningsOf({.method = "alarmDistanec='3'"}),
              ElementsAre("3 /m: its attribute 'alarmDistanec' is not read; is 'alarmDistance' meant?"));
  EXPECT_THAT(warningsOf({.state = "translaton='3 0 0'"}),
              ElementsAre("5 /o: its attribute 'translaton' is not read; is 'translation' meant?"));
}

TEST_F(AttributeSlip, IsNoOtherNameOfSofas) {
  EXPECT_THAT(warningsOf({.state = "rotation2='0 0 1' reset_position='0 0 0' showObject='1' translation2='1 0 0'"}),
              IsEmpty());
  EXPECT_THAT(warningsOf({.topology = "edge='0 1'", .model = "color='1 0 0 1' bothSide='1' grup='1'"}), IsEmpty())
      << "too short to tell";
  EXPECT_THAT(warningsOf({.model = "selfCollision='1' selfColision='1'"}), IsEmpty()) << "it is there too";
}

}  // namespace
}  // namespace allpairs::scene::sofa
