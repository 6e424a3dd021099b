// SPDX-License-Identifier: MIT
// Bullet's character controller moves its ghost object and asks for the ghost's pairs between two steps of the world.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>
#include <btBulletDynamicsCommon.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "BulletPairs.h"
#include "allpairs/bullet/BulletBroadphase.h"

namespace allpairs::test {
namespace {

/// A character between two walls on a floor, moved by its controller after each step.
class Room {
 public:
  explicit Room(btBroadphaseInterface& broadphase)
      : m_dispatcher(&m_configuration),
        m_world(&m_dispatcher, &broadphase, &m_solver, &m_configuration),
        m_controller(&m_ghost, &m_capsule, btScalar(0.35), {0, 1, 0}) {
    broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&m_ghostPairs);
    add(m_floor, {0, -1, 0});
    add(m_wall, {6, 3, 0});
    add(m_wall, {-6, 3, 0});
    m_ghost.setCollisionShape(&m_capsule);
    m_ghost.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
    m_controller.warp({0, 3, 0});
    m_world.addCollisionObject(&m_ghost, btBroadphaseProxy::CharacterFilter,
                               btBroadphaseProxy::StaticFilter | btBroadphaseProxy::DefaultFilter);
  }

  ~Room() {
    m_world.removeCollisionObject(&m_ghost);
    for (auto& body : m_bodies) m_world.removeRigidBody(body.get());
  }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  /// Lands, walks to a wall and along it, back, into both walls and out again. The controller moves up to six times a
  /// step.
  btVector3 step(int frame, btScalar speed) {
    if (frame == 60) m_controller.setWalkDirection({speed, 0, speed / 4});
    if (frame == 140) m_controller.setWalkDirection({-speed, 0, 0});
    if (frame == 200) m_controller.warp({btScalar(5.3), 2, 0});
    if (frame == 202) m_controller.setWalkDirection({speed, 0, 0});
    if (frame == 260) m_controller.warp({btScalar(-5.3), btScalar(0.3), 1});
    m_world.stepSimulation(kTime, 0);
    for (int i = frame % 20 == 19 ? 6 : 1; i > 0; --i) m_controller.updateAction(&m_world, kTime);
    return m_ghost.getWorldTransform().getOrigin();
  }

  btKinematicCharacterController& controller() { return m_controller; }

 private:
  static constexpr btScalar kTime = btScalar(1) / 60;

  void add(btCollisionShape& shape, const btVector3& place) {
    m_bodies.push_back(std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0, nullptr, &shape)));
    btTransform pose = btTransform::getIdentity();
    pose.setOrigin(place);
    m_bodies.back()->setWorldTransform(pose);
    m_world.addRigidBody(m_bodies.back().get());
  }

  btDefaultCollisionConfiguration m_configuration;
  btCollisionDispatcher m_dispatcher;
  btSequentialImpulseConstraintSolver m_solver;
  btDiscreteDynamicsWorld m_world;
  btGhostPairCallback m_ghostPairs;
  btBoxShape m_floor{btVector3(20, 1, 20)};
  btBoxShape m_wall{btVector3(btScalar(0.5), 3, 10)};
  btCapsuleShape m_capsule{btScalar(0.5), btScalar(1)};
  btPairCachingGhostObject m_ghost;
  btKinematicCharacterController m_controller;
  std::vector<std::unique_ptr<btRigidBody>> m_bodies;
};

TEST(BulletCharacter, IsAtEachFrameWhereItIsWithTheDynamicTree) {
  for (const bool asksItsGhost : {true, false}) {
    for (const btScalar speed : {btScalar(0.03), btScalar(0.1)}) {
      BulletBroadphase ours;
      btDbvtBroadphase theirs;
      Room room(ours);
      Room expected(theirs);
      room.controller().setUseGhostSweepTest(asksItsGhost);
      expected.controller().setUseGhostSweepTest(asksItsGhost);
      for (int frame = 0; frame < 320; ++frame) {
        const btVector3 place = room.step(frame, speed);
        ASSERT_LT((place - expected.step(frame, speed)).length(), btScalar(1e-4))
            << "frame " << frame << ", speed " << speed << ", asks its ghost: " << asksItsGhost;
      }
    }
  }
}

/// A ghost among bodies, in a world that is never stepped.
class GhostTest : public ::testing::Test {
 protected:
  void open(btBroadphaseInterface& broadphase) {
    broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&m_ghostPairs);
    m_world = std::make_unique<btCollisionWorld>(&m_dispatcher, &broadphase, &m_configuration);
    m_body.setCollisionShape(&m_cube);
    m_world->addCollisionObject(&m_body);
    m_ghost.setCollisionShape(&m_cube);
  }

  void add(btScalar x) {
    place(x);
    m_world->addCollisionObject(&m_ghost);
  }

  void move(btScalar x) {
    place(x);
    m_world->updateSingleAabb(&m_ghost);
  }

  void TearDown() override {
    m_world->removeCollisionObject(&m_ghost);
    m_world->removeCollisionObject(&m_body);
  }

  [[nodiscard]] int found() const { return m_ghost.getNumOverlappingObjects(); }
  btCollisionWorld& world() { return *m_world; }
  btPairCachingGhostObject& ghost() { return m_ghost; }

  BulletBroadphase& standard() { return m_standard; }
  BulletBroadphase& late() { return m_late; }

 private:
  void place(btScalar x) {
    btTransform pose = btTransform::getIdentity();
    pose.setOrigin({x, 0, 0});
    m_ghost.setWorldTransform(pose);
  }

  BulletBroadphase m_standard;
  BulletBroadphase m_late{{.immediatePairs = ImmediatePairs::None}};
  btDefaultCollisionConfiguration m_configuration;
  btCollisionDispatcher m_dispatcher{&m_configuration};
  btGhostPairCallback m_ghostPairs;
  btBoxShape m_cube{btVector3(1, 1, 1)};
  btCollisionObject m_body;
  btPairCachingGhostObject m_ghost;
  std::unique_ptr<btCollisionWorld> m_world;
};

TEST_F(GhostTest, KnowsItsPairsAsSoonAsItIsAdded) {
  open(standard());
  add(1);
  EXPECT_EQ(found(), 1);
}

TEST_F(GhostTest, KnowsItsPairsAsSoonAsItIsMovedAndLosesThemInTheNextStep) {
  open(standard());
  add(9);
  EXPECT_EQ(found(), 0);
  move(1);
  EXPECT_EQ(found(), 1);
  move(9);
  world().performDiscreteCollisionDetection();
  EXPECT_EQ(found(), 0);
  EXPECT_EQ(standard().getOverlappingPairCache()->getNumOverlappingPairs(), 0);
}

TEST_F(GhostTest, WithoutImmediatePairsKnowsThemAfterTheStep) {
  open(late());
  add(1);
  EXPECT_EQ(found(), 0);
  world().performDiscreteCollisionDetection();
  EXPECT_EQ(found(), 1);
}

TEST_F(GhostTest, ThatIsACharacterHasAMarginAndAnyOtherHasNone) {
  open(standard());
  const btScalar justApart = btScalar(2.07);  // Bullet adds 0.02 to each side of a box that it updates
  add(justApart);
  world().performDiscreteCollisionDetection();
  EXPECT_EQ(found(), 0);
  ghost().setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
  world().performDiscreteCollisionDetection();
  EXPECT_EQ(found(), 1);
  for (const btScalar x : {-justApart, justApart}) {
    move(x);
    world().performDiscreteCollisionDetection();
    EXPECT_EQ(found(), 1) << x;
  }
  struct Tally : btBroadphaseAabbCallback {
    int count = 0;
    bool process(const btBroadphaseProxy*) override { return ++count > 0; }
  } tally;
  const btVector3& corner = ghost().getBroadphaseHandle()->m_aabbMax;
  const btVector3 by(btScalar(0.03), 0, 0);
  standard().aabbTest(corner + by, corner + by, tally);
  EXPECT_EQ(tally.count, 0) << "a box meets the ghost's own box only";
}

/// What a ray hits, in the order in which it is told.
struct RayHits : btBroadphaseRayCallback {
  std::vector<const btBroadphaseProxy*> found;
  bool process(const btBroadphaseProxy* proxy) override {
    found.push_back(proxy);
    return true;
  }
};

TEST_F(GhostTest, ThatIsACharacterIsHitByRaysInItsOwnBoxOnly) {
  open(standard());
  ghost().setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
  add(btScalar(0.02));
  const btBroadphaseProxy* const character = ghost().getBroadphaseHandle();
  const btBroadphaseProxy* const body = standard().proxyOf(0);
  ASSERT_NE(body, character);
  const auto hits = [this](const btVector3& from, const btVector3& to, btScalar radius = 0) {
    RayHits ray;
    const btVector3 half(radius, radius, radius);
    standard().rayTest(from, to, ray, -half, half);
    return ray.found;
  };
  using ::testing::ElementsAre;
  EXPECT_THAT(hits({-9, 0, 0}, {9, 0, 0}), ElementsAre(body, character)) << "its margin comes first, its box does not";
  EXPECT_THAT(hits({9, 0, 0}, {-9, 0, 0}), ElementsAre(character, body));
  const btScalar above = character->m_aabbMax.y() + btScalar(0.03);
  EXPECT_THAT(hits({-9, above, 0}, {9, above, 0}), ::testing::IsEmpty()) << "passes through its margin";
  EXPECT_THAT(hits({9, 0, 0}, {character->m_aabbMax.x() + btScalar(0.03), 0, 0}), ::testing::IsEmpty());
  EXPECT_THAT(hits({-9, above, 0}, {9, above, 0}, btScalar(0.04)), ElementsAre(body, character));
  ghost().setCollisionFlags(0);
  EXPECT_THAT(hits({-9, above, 0}, {9, above, 0}), ::testing::IsEmpty()) << "its box in the world is still enlarged";
}

TEST(BulletCharacter, WithAnEmptyBoxHasNoPairsAlsoWithinTheMargin) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btGhostObject character;
  character.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
  btCollisionObject body;
  BulletBroadphase broadphase({.characterMargin = 1});
  auto* const around = broadphase.createProxy({-9, -9, -9}, {9, 9, 9}, 0, &body, 1, -1, &dispatcher);
  auto* const empty = broadphase.createProxy({btScalar(0.5), 0, 0}, {0, 1, 1}, 0, &character, 1, -1, &dispatcher);
  const auto pairs = [&] {
    broadphase.calculateOverlappingPairs(&dispatcher);
    return pairsOf(*broadphase.getOverlappingPairCache());
  };
  EXPECT_THAT(pairs(), ::testing::IsEmpty());
  broadphase.setAabb(empty, {0, 0, 0}, {1, 1, 1}, &dispatcher);
  EXPECT_THAT(pairs(), ::testing::SizeIs(1));
  broadphase.setAabb(empty, {0, 0, 0}, {1, -1, 1}, &dispatcher);
  EXPECT_THAT(pairs(), ::testing::IsEmpty());
  for (auto* proxy : {around, empty}) broadphase.destroyProxy(proxy, &dispatcher);
}

}  // namespace
}  // namespace allpairs::test
