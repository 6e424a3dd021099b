// SPDX-License-Identifier: MIT
// Scenes in which a few models change from step to step, each in one way: what the plugin keeps of a model between
// steps is never out of date.
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "Dice.h"
#include "World.h"

namespace allpairs::test {
namespace {

using sofa::core::CollisionModel;

CollisionModel::SPtr newBox(Dice& dice) {
  const auto box = sofa::core::objectmodel::New<CubeCollisionModel>();
  box->resize(1);
  const Vec3 min{dice.quarter(20), dice.quarter(20), dice.quarter(20)};
  box->setParentOf(0, min, {min[0] + dice.quarter(16), min[1] + dice.quarter(16), min[2] + dice.quarter(16)});
  return box;
}

class ChangingScene {
 public:
  explicit ChangingScene(unsigned seed) : m_dice(seed) {
    for (int i = 0; i < 12; ++i) m_world.addBody(newBox(m_dice), newElements());
    addAll();
  }

  /// Changes up to three bodies; returns in which ways.
  std::string change() {
    std::string ways;
    for (int i = m_dice.upTo(3); i > 0; --i) {
      const int way = m_dice.upTo(static_cast<int>(std::size(kWays)) - 1);
      (this->*kWays[way])();
      ways += " " + std::to_string(way);
    }
    return ways;
  }

  void run() {
    m_world.runBoth(m_proximity);
    m_world.runBoth(m_discrete);
  }

 private:
  using Way = void (ChangingScene::*)();

  CollisionModel::SPtr newElements() {
    if (m_dice.oneIn(6)) return new OddGroups;
    return new Triangles;
  }

  Body& any() {
    return m_world.bodies()[static_cast<std::size_t>(m_dice.upTo(static_cast<int>(m_world.bodies().size()) - 1))];
  }

  void addAll() {
    std::vector<CollisionModel*> models;
    for (const Body& body : m_world.bodies()) models.push_back(body.root.get());
    m_world.setModels(std::move(models));
  }

  void removeOne() {
    if (m_world.bodies().size() > 2) m_world.remove(static_cast<std::size_t>(m_dice.upTo(1)));
    addAll();
  }
  void addOne() {
    m_world.addBody(newBox(m_dice), newElements());
    addAll();
  }
  /// The new one has the memory of the old one, if nobody holds it.
  void replaceOne() {
    removeOne();
    addOne();
  }
  void leaveSomeOut() {
    std::vector<CollisionModel*> models;
    for (const Body& body : m_world.bodies()) {
      for (int times = m_dice.oneIn(4) ? m_dice.upTo(2) : 1; times > 0; --times) models.push_back(body.root.get());
    }
    m_world.setModels(std::move(models));
  }
  void shuffle() {
    std::vector<CollisionModel*> models;
    for (const Body& body : m_world.bodies()) models.push_back(body.root.get());
    std::shuffle(models.begin(), models.end(), m_dice.engine());
    m_world.setModels(std::move(models));
  }
  void regroup() {
    if (m_dice.oneIn(2)) return any().elements->addGroup(m_dice.upTo(2));
    any().elements->setGroups({});
  }
  void moveToAnotherNode() {
    const auto* node = m_dice.oneIn(3) ? &m_world.newNode() : any().elements->getContext();
    any().elements->setContext(node);
  }
  void setSimulated() { any().root->setSimulated(m_dice.oneIn(2)); }
  void setSelfCollision() { any().elements->setSelfCollision(m_dice.oneIn(2)); }
  void setContactDistance() { any().root->setContactDistance(m_dice.quarter(4)); }
  void moveBox() {
    Body& body = any();
    const Vec3 min{m_dice.quarter(20), m_dice.quarter(20), m_dice.quarter(20)};
    body.box().setParentOf(0, min, {min[0] + 2.0, min[1] + 2.0, min[2] + (m_dice.oneIn(8) ? -1.0 : 2.0)});
  }
  /// One level more.
  void putLevelBelowRoot() {
    Body& body = any();
    const CollisionModel::SPtr below = body.root->getNext();
    const auto level = sofa::core::objectmodel::New<CubeCollisionModel>();
    level->resize(1);
    level->setPrevious(body.root);
    below->setPrevious(level);
  }
  /// Two levels, however many there were.
  void removeLevels() {
    Body& body = any();
    const CollisionModel::SPtr above = body.elements->getPrevious();
    body.elements->setPrevious(body.root);
  }
  /// The elements become a level between; what is below them is the last.
  void putElementsBelow() {
    Body& body = any();
    CollisionModel::SPtr elements = newElements();
    elements->resize(1);
    elements->setContext(body.elements->getContext());
    elements->setPrevious(body.elements);
    body.elements = elements;
  }
  /// Of three levels the one between stays.
  void replaceElementsOfLevelBetween() {
    Body& body = any();
    const CollisionModel::SPtr above = body.elements->getPrevious();
    CollisionModel::SPtr elements = newElements();
    elements->resize(1);
    elements->setContext(&m_world.newNode());
    elements->setPrevious(above);
    body.elements = elements;
  }
  void replaceRoot() {
    Body& body = any();
    body.root = newBox(m_dice);
    body.elements->setPrevious(body.root);
    addAll();
  }
  void replaceElements() {
    Body& body = any();
    const auto* node = body.elements->getContext();
    CollisionModel::SPtr elements = newElements();
    elements->resize(1);
    elements->setContext(node);
    elements->setPrevious(body.root);
    body.elements = elements;
  }

  static constexpr Way kWays[] = {&ChangingScene::removeOne,
                                  &ChangingScene::addOne,
                                  &ChangingScene::replaceOne,
                                  &ChangingScene::leaveSomeOut,
                                  &ChangingScene::shuffle,
                                  &ChangingScene::regroup,
                                  &ChangingScene::moveToAnotherNode,
                                  &ChangingScene::setSimulated,
                                  &ChangingScene::setSelfCollision,
                                  &ChangingScene::setContactDistance,
                                  &ChangingScene::moveBox,
                                  &ChangingScene::putLevelBelowRoot,
                                  &ChangingScene::removeLevels,
                                  &ChangingScene::replaceRoot,
                                  &ChangingScene::replaceElements,
                                  &ChangingScene::putElementsBelow,
                                  &ChangingScene::replaceElementsOfLevelBetween};

  Dice m_dice;
  World m_world;
  intersection::MinProximityIntersection m_proximity;
  intersection::DiscreteIntersection m_discrete;
};

TEST(SofaChangingScenes, GiveTheListOfTheDoubleLoopInEveryStep) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    ChangingScene scene(seed);
    std::string ways;
    for (int step = 0; step < 40; ++step) {
      scene.run();
      if (HasFailure()) FAIL() << "seed " << seed << ", step " << step << ", after" << ways;
      ways = scene.change();
    }
  }
}

TEST(SofaChangingScenes, AnEditThatEndsAfterAStepIsSeenInTheNext) {
  World world;
  intersection::MinProximityIntersection method;
  world.addAt(0.0).elements->setGroups({1});
  Body& body = world.addAt(0.5);
  auto& groups = *static_cast<sofa::core::objectmodel::Data<std::set<int>>*>(body.elements->findData("group"));
  std::set<int>& edited = *groups.beginEdit();
  EXPECT_EQ(world.runBoth(method), (Numbers{{1, 0}}));
  edited.insert(1);
  groups.endEdit();
  EXPECT_EQ(world.runBoth(method), Numbers{});
}

TEST(SofaChangingScenes, DataOfTheRootThatFollowThoseOfTheElementsAreSeen) {
  World world;
  intersection::MinProximityIntersection method;
  method.setAlarmDistance(0.0);
  world.addAt(0.0);
  Body& body = world.addAt(1.5);
  body.root->findData("contactDistance")->setParent(body.elements->findData("contactDistance"));
  EXPECT_EQ(world.runBoth(method), Numbers{});
  for (const double distance : {0.5, 0.25, 0.75}) {
    body.elements->setContactDistance(distance);
    EXPECT_EQ(world.runBoth(method), distance < 0.5 ? Numbers{} : (Numbers{{1, 0}})) << distance;
  }
}

/// A method of the user's own to which all models are near.
class EverythingIsNear : public sofa::core::collision::Intersection {
 public:
  sofa::core::collision::ElementIntersector* findIntersector(CollisionModel* /*first*/, CollisionModel* /*second*/,
                                                             bool& /*swap*/) override {
    return &m_near;
  }

 private:
  class Near : public sofa::core::collision::ElementIntersector {
   public:
    bool canIntersect(sofa::core::CollisionElementIterator /*first*/, sofa::core::CollisionElementIterator /*second*/,
                      const sofa::core::collision::Intersection* /*method*/) override {
      return true;
    }
  };
  Near m_near;
};

TEST(SofaChangingScenes, ARootOfTheUsersOwnIsAskedInEachStepWhetherItIsSimulated) {
  class Root : public CollisionModel {
   public:
    [[nodiscard]] bool isSimulated() const override { return isOn; }
    bool isOn = false;
  };
  World world;
  EverythingIsNear method;
  Root* const root = new Root;  // held by its body
  world.addBody(root, new Triangles).root->resize(1);
  world.addAt(0.0).root->setSimulated(false);
  EXPECT_EQ(world.runBoth(method), Numbers{});
  root->isOn = true;
  EXPECT_EQ(world.runBoth(method), (Numbers{{1, 0}}));
}

TEST(SofaChangingScenes, AModelThatHasLeftIsHeldUntilTheNextStepOnly) {
  World world;
  intersection::MinProximityIntersection method;
  world.addAt(0.0);
  static int alive = 0;
  class Counted : public sofa::core::CollisionModel {
   public:
    Counted() { ++alive; }
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
    Counted(Counted&&) = delete;
    Counted& operator=(Counted&&) = delete;
    ~Counted() override { --alive; }
  };
  Body& body = world.add<Counted>({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  world.run(world.ours(), method);
  const CollisionModel::SPtr other = world.bodies().front().root;
  world.setModels({other.get()});
  body.elements.reset();
  EXPECT_EQ(alive, 1);
  world.run(world.ours(), method);
  EXPECT_EQ(alive, 0);
}

TEST(SofaChangingScenes, NoModelIsHeldAfterCleanup) {
  World world;
  intersection::MinProximityIntersection method;
  Body& body = world.addAt(0.0);
  world.run(world.ours(), method);
  EXPECT_GT(body.elements->holders(), 1);
  world.ours().cleanup();
  EXPECT_EQ(body.elements->holders(), 1);
}

}  // namespace
}  // namespace allpairs::test
