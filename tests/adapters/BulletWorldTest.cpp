// SPDX-License-Identifier: MIT
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <btBulletDynamicsCommon.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "BulletBody.h"
#include "BulletPairs.h"
#include "allpairs/bullet/BulletBroadphase.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

/// A world of Bullet's with a floor and columns of boxes and balls above it.
class FallingBodies {
 public:
  FallingBodies(btBroadphaseInterface& broadphase, int columns, int height)
      : m_dispatcher(&m_configuration), m_world(&m_dispatcher, &broadphase, &m_solver, &m_configuration) {
    m_world.setGravity({0, btScalar(-9.81), 0});
    add(m_floor, 0, {0, -1, 0});
    for (const btScalar side : {btScalar(-1), btScalar(1)}) {
      add(m_wall, 0, {side * 12 + 4, 5, 4});
      add(m_wallAcross, 0, {4, 5, side * 12 + 4});
    }
    for (int i = 0; i < columns * columns * height; ++i) {
      const int column = i / height;
      // A little askew, so that columns topple.
      const btScalar shift = btScalar(0.13) * static_cast<btScalar>(i % 5);
      add(i % 2 == 0 ? static_cast<btCollisionShape&>(m_box) : m_ball, 1,
          {static_cast<btScalar>(column % columns) * btScalar(1.6) + shift,
           btScalar(1) + static_cast<btScalar>(i % height) * btScalar(1.25),
           static_cast<btScalar>(column / columns) * btScalar(1.6) - shift});
    }
  }

  ~FallingBodies() {
    for (auto& body : m_bodies) m_world.removeRigidBody(body.get());
  }

  FallingBodies(const FallingBodies&) = delete;
  FallingBodies& operator=(const FallingBodies&) = delete;

  void step() { m_world.stepSimulation(btScalar(1) / 60, 0); }

  btDiscreteDynamicsWorld& world() { return m_world; }
  std::vector<std::unique_ptr<btRigidBody>>& bodies() { return m_bodies; }

  [[nodiscard]] bool isFinite() const {
    for (const auto& body : m_bodies) {
      const btVector3& place = body->getWorldTransform().getOrigin();
      if (!std::isfinite(place.x()) || !std::isfinite(place.y()) || !std::isfinite(place.z())) return false;
    }
    return true;
  }

  [[nodiscard]] double kineticEnergy() const {
    double energy = 0.0;
    for (const auto& body : m_bodies) energy += static_cast<double>(body->getLinearVelocity().length2()) / 2.0;
    return energy;
  }

  [[nodiscard]] double lowest() const {
    double y = 1e9;
    for (std::size_t i = kFixed; i < m_bodies.size(); ++i) {
      y = std::min(y, static_cast<double>(m_bodies[i]->getWorldTransform().getOrigin().y()));
    }
    return y;
  }

  [[nodiscard]] double highest() const {
    double y = -1e9;
    for (std::size_t i = kFixed; i < m_bodies.size(); ++i) {
      y = std::max(y, static_cast<double>(m_bodies[i]->getWorldTransform().getOrigin().y()));
    }
    return y;
  }

  static constexpr std::size_t kFixed = 5;  ///< So many bodies come first that don't move.

 private:
  void add(btCollisionShape& shape, btScalar mass, const btVector3& place) {
    m_bodies.push_back(makeBody(shape, mass, place));
    m_bodies.back()->setDamping(btScalar(0.1), btScalar(0.5));  // balls on a smooth floor would roll for ever
    m_world.addRigidBody(m_bodies.back().get());
  }

  btDefaultCollisionConfiguration m_configuration;
  btCollisionDispatcher m_dispatcher;
  btSequentialImpulseConstraintSolver m_solver;
  btDiscreteDynamicsWorld m_world;
  btBoxShape m_floor{btVector3(60, 1, 60)};
  btBoxShape m_wall{btVector3(1, 6, 13)};
  btBoxShape m_wallAcross{btVector3(13, 6, 1)};
  btBoxShape m_box{btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5))};
  btSphereShape m_ball{btScalar(0.5)};
  std::vector<std::unique_ptr<btRigidBody>> m_bodies;
};

TEST(BulletWorld, ThousandsOfStepsHaveThePairsThatTheBoxesDemandAndEndAtRest) {
  BulletBroadphase broadphase;
  FallingBodies scene(broadphase, 6, 10);
  for (int step = 0; step < 2000; ++step) {
    scene.step();
    if (kIsSanitized && step % 4 != 0) continue;  // to look at all pairs of boxes takes longer than the step
    // A step of Bullet's ends with the motion; the pairs are those of the boxes before it, which the proxies still
    // have.
    ASSERT_EQ(pairsOf(*broadphase.getOverlappingPairCache()), demandedPairs(scene.world())) << "step " << step;
    ASSERT_TRUE(scene.isFinite()) << "step " << step;
  }
  EXPECT_GT(scene.lowest(), 0.4);
  EXPECT_LT(scene.highest(), 13.0);
  EXPECT_LT(scene.kineticEnergy(), 1.0);
}

TEST(BulletWorld, EndsAsHealthyAsWithTheDynamicTree) {
  BulletBroadphase ours;
  btDbvtBroadphase theirs;
  FallingBodies first(ours, 4, 12);
  FallingBodies second(theirs, 4, 12);
  for (int step = 0; step < 1000; ++step) {
    first.step();
    second.step();
    if (step % 50 == 0) {
      ASSERT_EQ(pairsOf(*ours.getOverlappingPairCache()), demandedPairs(first.world()));
      const auto dbvt = pairsOf(*theirs.getOverlappingPairCache());
      for (const auto& pair : demandedPairs(second.world())) {
        ASSERT_TRUE(std::binary_search(dbvt.begin(), dbvt.end(), pair)) << "the oracle asks for more than Bullet";
      }
    }
  }
  EXPECT_TRUE(first.isFinite());
  EXPECT_LT(first.kineticEnergy(), 1.0);
  EXPECT_LT(second.kineticEnergy(), 1.0);
  EXPECT_NEAR(first.lowest(), second.lowest(), 0.05);
}

TEST(BulletWorld, ASimulationRunTwiceIsTheSameToTheLastBit) {
  std::vector<btScalar> ends;
  for (int run = 0; run < 2; ++run) {
    BulletBroadphase broadphase;
    FallingBodies scene(broadphase, 4, 8);
    for (int step = 0; step < 300; ++step) scene.step();
    for (const auto& body : scene.bodies()) ends.push_back(body->getWorldTransform().getOrigin().x());
  }
  const auto middle = ends.begin() + static_cast<std::ptrdiff_t>(ends.size() / 2);
  EXPECT_TRUE(std::equal(ends.begin(), middle, middle, ends.end()));
}

TEST(BulletWorld, RayTestsOfTheWorldHitTheNearestBody) {
  BulletBroadphase broadphase;
  FallingBodies scene(broadphase, 3, 2);
  scene.step();
  const btVector3 from(0, 50, 0);
  const btVector3 to(0, -50, 0);
  btCollisionWorld::ClosestRayResultCallback hit(from, to);
  scene.world().rayTest(from, to, hit);
  ASSERT_TRUE(hit.hasHit());
  EXPECT_EQ(hit.m_collisionObject, scene.bodies()[FallingBodies::kFixed + 1].get());
  EXPECT_NEAR(hit.m_hitPointWorld.y(), 2.75, 0.1);

  btBoxShape probe(btVector3(btScalar(0.2), btScalar(0.2), btScalar(0.2)));
  btTransform start = btTransform::getIdentity();
  start.setOrigin(from);
  btTransform end = btTransform::getIdentity();
  end.setOrigin(to);
  btCollisionWorld::ClosestConvexResultCallback sweep(from, to);
  scene.world().convexSweepTest(&probe, start, end, sweep);
  EXPECT_TRUE(sweep.hasHit());
}

TEST(BulletWorld, ACacheThatDefersRemovalServesASimulation) {
  btSortedOverlappingPairCache cache;
  ASSERT_TRUE(cache.hasDeferredRemoval());
  BulletBroadphase broadphase({.pairCache = &cache});
  FallingBodies scene(broadphase, 4, 6);
  for (int step = 0; step < 600; ++step) {
    scene.step();
    ASSERT_EQ(pairsOf(cache), demandedPairs(scene.world())) << "step " << step;
    ASSERT_TRUE(scene.isFinite()) << "step " << step;
  }
  EXPECT_GT(scene.lowest(), 0.4);
}

TEST(BulletWorld, GroupsAndMasksOfBodiesDecideWhatTheyRestOn) {
  BulletBroadphase broadphase;
  FallingBodies scene(broadphase, 3, 1);
  btRigidBody* const falling = scene.bodies()[FallingBodies::kFixed].get();
  scene.world().removeRigidBody(falling);
  scene.world().addRigidBody(falling, 64, 64);  // the floor's mask has that group, this mask not the floor's
  for (int step = 0; step < 240; ++step) {
    scene.step();
    ASSERT_EQ(pairsOf(*broadphase.getOverlappingPairCache()), demandedPairs(scene.world())) << "step " << step;
  }
  EXPECT_LT(falling->getWorldTransform().getOrigin().y(), -10);
  EXPECT_GT(scene.bodies().back()->getWorldTransform().getOrigin().y(), 0.4);
}

TEST(BulletWorld, AGhostKnowsTheBodiesThatFallThroughIt) {
  BulletBroadphase broadphase;
  btGhostPairCallback callback;
  broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&callback);
  FallingBodies scene(broadphase, 4, 4);
  btBoxShape gate(btVector3(20, btScalar(0.5), 20));
  btPairCachingGhostObject ghost;
  btTransform pose = btTransform::getIdentity();
  pose.setOrigin({0, 3, 0});
  ghost.setWorldTransform(pose);
  ghost.setCollisionShape(&gate);
  ghost.setCollisionFlags(btCollisionObject::CF_NO_CONTACT_RESPONSE);
  scene.world().addCollisionObject(&ghost);
  int most = 0;
  for (int step = 0; step < 300; ++step) {
    scene.step();
    int demanded = 0;
    for (const auto& body : scene.bodies()) {
      demanded += isDemanded(*body->getBroadphaseHandle(), *ghost.getBroadphaseHandle()) ? 1 : 0;
    }
    ASSERT_EQ(ghost.getNumOverlappingObjects(), demanded) << "step " << step;
    most = std::max(most, demanded);
  }
  EXPECT_GT(most, 4 + 8);  // the walls, and some of those that fall
  scene.world().removeCollisionObject(&ghost);
  EXPECT_EQ(ghost.getNumOverlappingObjects(), 0);
}

TEST(BulletWorld, BodiesMayLeaveAndComeBackBetweenSteps) {
  BulletBroadphase broadphase;
  FallingBodies scene(broadphase, 4, 4);
  for (int step = 0; step < 400; ++step) {
    scene.step();
    ASSERT_EQ(pairsOf(*broadphase.getOverlappingPairCache()), demandedPairs(scene.world())) << "step " << step;
    btRigidBody* const body = scene.bodies()[FallingBodies::kFixed + static_cast<std::size_t>(step % 60)].get();
    if (step % 3 == 0) scene.world().removeRigidBody(body);
    if (step % 3 == 0) scene.world().addRigidBody(body);
  }
}

}  // namespace
}  // namespace allpairs::test
