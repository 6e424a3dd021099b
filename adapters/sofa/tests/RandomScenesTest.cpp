// SPDX-License-Identifier: MIT
// Random scenes through many steps: the plugin's list is the double loop's, whatever is in them.
#include "Dice.h"
#include "World.h"

namespace allpairs::test {
namespace {

void place(Body& body, Dice& dice, bool withOddBoxes) {
  Vec3 min{};
  Vec3 max{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    min[axis] = dice.quarter(30);
    max[axis] = min[axis] + dice.quarter(8) - (withOddBoxes && dice.oneIn(20) ? 3.0 : 0.0);
    if (withOddBoxes && dice.oneIn(100)) min[axis] = std::numeric_limits<double>::quiet_NaN();
  }
  body.box().setParentOf(0, min, max);
}

void setFlags(Body& body, const Body& neighbour, Dice& dice) {
  body.root->setSimulated(!dice.oneIn(3));
  body.root->setContactDistance(dice.oneIn(3) ? dice.quarter(2) : 0.0);
  body.box().setConeAngle(dice.oneIn(2) ? 1.0 : 2.0);
  body.elements->setSelfCollision(dice.oneIn(3));
  std::set<int> groups;
  while (dice.oneIn(2)) groups.insert(dice.upTo(3) - 1);
  body.elements->setGroups(groups);
  if (dice.oneIn(4)) body.elements->setContext(neighbour.elements->getContext());
}

struct Kind {
  bool withOddBoxes = false;
  bool withOwnRules = false;
  bool withDuplicates = false;
};

void fill(World& world, Dice& dice, const Kind& kind) {
  const int count = dice.upTo(60);
  for (int i = 0; i <= count; ++i) {
    const bool ownRules = kind.withOwnRules && dice.oneIn(4);
    Body& body = ownRules ? world.add<OddGroups>({}, {}) : world.add({}, {});
    if (kind.withDuplicates && dice.oneIn(10)) world.addAgain(body);
  }
}

class SofaRandomScenes : public ::testing::TestWithParam<Kind> {};

TEST_P(SofaRandomScenes, GiveTheListOfTheDoubleLoopInEveryStep) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Dice dice(seed);
    World world;
    fill(world, dice, GetParam());
    intersection::MinProximityIntersection proximity;
    intersection::DiscreteIntersection discrete;
    SlabMethod slab;
    for (int step = 0; step < 4; ++step) {
      for (Body& body : world.bodies()) {
        place(body, dice, GetParam().withOddBoxes);
        setFlags(body, world.bodies()[static_cast<std::size_t>(dice.upTo(5)) % world.bodies().size()], dice);
      }
      proximity.setAlarmDistance(dice.quarter(4) - 0.25);
      world.runBoth(proximity);
      world.runBoth(discrete);
      world.runBoth(slab);
      if (HasFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllKinds, SofaRandomScenes,
                         ::testing::Values(Kind{}, Kind{.withOddBoxes = true}, Kind{.withOwnRules = true},
                                           Kind{.withDuplicates = true}, Kind{true, true, true}));

}  // namespace
}  // namespace allpairs::test
