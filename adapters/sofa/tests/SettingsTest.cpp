// SPDX-License-Identifier: MIT
// The data of the plugin's component, what it says of bad ones, and how SOFA finds it.
#include <sofa/core/ObjectFactory.h>

#include <limits>

#include "World.h"

extern "C" {
void initExternalModule();
const char* getModuleName();
const char* getModuleVersion();
const char* getModuleLicense();
const char* getModuleDescription();
void registerObjects(sofa::core::ObjectFactory* factory);
}

namespace allpairs::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class SofaSettings : public ::testing::Test {
 protected:
  SofaSettings() {
    messages() = {};
    m_method.setAlarmDistance(0.0);
    for (const double x : {0.0, 0.5, 3.0, 3.5}) m_world.addAt(x);
  }

  static sofa::helper::Messages& messages() { return sofa::helper::Messages::all(); }

  Numbers runWithBox(const Vec3& min, const Vec3& max) {
    plugin::AllpairsBroadPhase::Region box;
    box[0] = min;
    box[1] = max;
    m_world.ours().d_box.setValue(box);
    m_world.ours().init();
    return m_world.runBoth(m_method);
  }

  World m_world;
  intersection::MinProximityIntersection m_method;
};

TEST_F(SofaSettings, ModelsOutsideOfTheBoxAreLeftOut) {
  EXPECT_EQ(runWithBox({2.0, 0.0, 0.0}, {5.0, 1.0, 1.0}), (Numbers{{3, 2}}));
  EXPECT_THAT(messages().warnings, IsEmpty());
}

TEST_F(SofaSettings, TheBoxIsWidenedByTheAlarmDistance) {
  EXPECT_EQ(runWithBox({2.4, 0.0, 0.0}, {2.6, 1.0, 1.0}), Numbers{});
  m_method.setAlarmDistance(1.0);
  EXPECT_EQ(runWithBox({2.4, 0.0, 0.0}, {2.6, 1.0, 1.0}), (Numbers{{3, 2}}));
}

TEST_F(SofaSettings, ABoxThatIsReversedInXIsNotInForceAndSaysSo) {
  EXPECT_EQ(runWithBox({5.0, 0.0, 0.0}, {2.0, 1.0, 1.0}), (Numbers{{1, 0}, {3, 2}}));
  EXPECT_THAT(messages().warnings, ElementsAre(HasSubstr("not in force")));
}

TEST_F(SofaSettings, ABoxThatIsReversedInYIsInForceAsInSofaAndSaysSo) {
  EXPECT_EQ(runWithBox({2.0, 5.0, 0.0}, {5.0, -5.0, 1.0}), Numbers{});
  EXPECT_THAT(messages().warnings, ElementsAre(HasSubstr("is in force")));
}

TEST_F(SofaSettings, ABoxWithANaNInXIsInForceAsInSofaAndSaysSo) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(runWithBox({nan, 10.0, 10.0}, {nan, 11.0, 11.0}), Numbers{});
  EXPECT_THAT(messages().warnings, ElementsAre(HasSubstr("is in force")));
}

TEST_F(SofaSettings, EveryStrategyGivesTheSameList) {
  for (const char* name : {"automatic", "exhaustive", "bvh"}) {
    auto strategy = m_world.ours().d_strategy.getValue();
    m_world.ours().d_strategy.setValue(strategy.setSelectedItem(name));
    EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}, {3, 2}})) << name;
  }
}

TEST_F(SofaSettings, AWordThatIsNoStrategyIsAnErrorAndTheDefaultIsUsed) {
  for (const std::string word : {"exhaustve", "BVH", "2x", "3", ""}) {
    messages() = {};
    m_world.ours().parseField("strategy", "bvh");
    m_world.ours().parseField("strategy", word);
    EXPECT_EQ(m_world.ours().d_strategy.getValue().getSelectedId(), 0U) << word;
    EXPECT_THAT(messages().errors, ElementsAre(HasSubstr("'strategy' is '" + word + "', not")));
  }
  messages() = {};
  for (const std::string word : {"automatic", "1", "bvh", "@/other.strategy"})
    m_world.ours().parseField("strategy", word);
  EXPECT_THAT(messages().errors, IsEmpty());
}

TEST_F(SofaSettings, AStrategyThatIsLinkedToOneOfMoreChoicesIsAnErrorAndTheDefaultIsUsed) {
  using sofa::helper::OptionsGroup;
  const sofa::core::objectmodel::DataDefault<OptionsGroup> choices{OptionsGroup{"a", "b", "c", "d"}};
  sofa::core::objectmodel::Data<OptionsGroup> other(choices);
  other.read("d");
  m_world.ours().d_strategy.setParent(&other);
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}, {3, 2}}));
  EXPECT_THAT(messages().errors, ElementsAre(HasSubstr("choice 3 of 'strategy'")));
}

TEST_F(SofaSettings, ThreadsThatMakeNoSenseAreAnErrorAndOneIsUsed) {
  for (const int threads : {-1, 10000, 70000}) {
    messages() = {};
    m_world.ours().d_threads.setValue(threads);
    EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}, {3, 2}}));
    EXPECT_THAT(messages().errors, ElementsAre(HasSubstr("'threads' is " + std::to_string(threads))));
  }
}

TEST_F(SofaSettings, SeveralThreadsGiveTheSameList) {
  m_world.ours().d_threads.setValue(3);
  for (int i = 0; i < 3000; ++i) m_world.addAt(0.25 * i);
  EXPECT_GT(m_world.run(m_world.ours(), m_method).size(), 3000U);
  EXPECT_EQ(m_world.run(m_world.ours(), m_method), m_world.runStock(m_method));
  EXPECT_THAT(messages().errors, IsEmpty());
}

TEST_F(SofaSettings, VerifySaysNothingWhereTheListsAreTheSame) {
  m_world.ours().d_verify.setValue(true);
  m_world.runBoth(m_method);
  runWithBox({2.0, 0.0, 0.0}, {5.0, 1.0, 1.0});
  EXPECT_THAT(messages().errors, IsEmpty());
}

TEST_F(SofaSettings, VerifyTakesTheBoxThatWasReadLastAndNotTheOneThatIsYetToBeRead) {
  runWithBox({2.0, 0.0, 0.0}, {5.0, 1.0, 1.0});
  m_world.ours().d_box.setValue({});
  m_world.ours().d_verify.setValue(true);
  EXPECT_EQ(m_world.run(m_world.ours(), m_method), (Numbers{{3, 2}}));
  m_world.ours().reinit();
  EXPECT_EQ(m_world.runBoth(m_method), (Numbers{{1, 0}, {3, 2}}));
  EXPECT_THAT(messages().errors, IsEmpty());
}

TEST_F(SofaSettings, VerifyNamesTheFirstPairThatDiffersOnceAStep) {
  m_world.ours().d_verify.setValue(true);
  BruteForceBroadPhase::isBroken() = true;
  m_world.run(m_world.ours(), m_method, true);
  BruteForceBroadPhase::isBroken() = false;
  EXPECT_THAT(messages().errors, ElementsAre("pair 0 is (/1, /0), but BruteForceBroadPhase gives no pair"));
  m_world.run(m_world.ours(), m_method);
  EXPECT_EQ(messages().errors.size(), 1U);
}

TEST_F(SofaSettings, WithoutAnIntersectionMethodItSaysSoAndFindsNothing) {
  m_world.ours().beginBroadPhase();
  m_world.ours().addCollisionModel(m_world.bodies().front().root.get());
  EXPECT_THAT(messages().errors, ElementsAre(HasSubstr("no intersection method")));
}

TEST_F(SofaSettings, DeepBoundingTreesAreNotNeeded) { EXPECT_FALSE(m_world.ours().needsDeepBoundingTree()); }

TEST(SofaPlugin, RegistersOneComponentUnderItsOwnName) {
  sofa::core::ObjectFactory factory;
  initExternalModule();
  registerObjects(&factory);
  ASSERT_EQ(factory.registered.size(), 1U);
  ASSERT_EQ(factory.registered[0].makers.size(), 1U);
  const auto made = factory.registered[0].makers[0]();
  EXPECT_NE(dynamic_cast<plugin::AllpairsBroadPhase*>(made.get()), nullptr);
  EXPECT_STREQ(getModuleName(), "Allpairs");
  EXPECT_STREQ(getModuleLicense(), "MIT");
  EXPECT_STRNE(getModuleVersion(), "");
  EXPECT_STRNE(getModuleDescription(), "");
}

}  // namespace
}  // namespace allpairs::test
