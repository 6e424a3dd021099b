// SPDX-License-Identifier: MIT
#include "SofaAnswer.h"

namespace allpairs::test {
namespace {

using SofaAttributeElements = SofaAnswers;

TEST_F(SofaAttributeElements, HaveTheValueOfTheLastDataInThem) {
  const std::string states =
      "<Node name='A'><MechanicalObject><Attribute type='name'><Data value='m'/></Attribute>"
      "<Attribute type='position'><Data value='0 0 0 1 0 0'/></Attribute></MechanicalObject>";
  const auto radius = [&](const std::string& data) {
    return states + "<Object type='SphereCollisionModel' name='s'><Attribute type='radius'" + data +
           "</Attribute></Object></Node><Node name='B'><MechanicalObject position='@../A/m.position'/>"
           "<SphereCollisionModel name='s' radius='0.25'/></Node>";
  };
  const std::string second = "/B/s 2 [-0.25 -0.25 -0.25] [1.25 0.25 0.25]\n/B/s - /A/s\n";
  for (const auto sofa : {scene::SofaVersion::Sofa2006, scene::SofaVersion::Sofa2612}) {
    EXPECT_EQ(answer(radius("><Data value='3'/>"), sofa), "/A/s 2 [-3 -3 -3] [4 3 3]\n" + second);
    EXPECT_EQ(answer(radius("><Data value='3'/><Data value='2'/>"), sofa), "/A/s 2 [-2 -2 -2] [3 2 2]\n" + second);
    EXPECT_EQ(answer(radius(" value='3'>"), sofa), "/A/s 2 [-1 -1 -1] [2 1 1]\n" + second);
  }
}

}  // namespace
}  // namespace allpairs::test
