// SPDX-License-Identifier: MIT
// A world of Bullet's on our broad phase: the second line of main() is the only one that differs from what you have.
#include <allpairs/bullet/BulletBroadphase.h>
#include <btBulletDynamicsCommon.h>

#include <cstdio>

namespace {

btRigidBody bodyOf(btScalar mass, btCollisionShape& shape, const btVector3& place) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape.calculateLocalInertia(mass, inertia);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
  info.m_startWorldTransform.setOrigin(place);
  return btRigidBody(info);
}

}  // namespace

int main() {
  btDefaultCollisionConfiguration configuration;
  allpairs::BulletBroadphase broadphase;  // was: btDbvtBroadphase broadphase;
  btCollisionDispatcher dispatcher(&configuration);
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);

  btBoxShape floor(btVector3(10, 1, 10));
  btBoxShape crate(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)));
  btRigidBody ground = bodyOf(0, floor, {0, -1, 0});
  btRigidBody lower = bodyOf(1, crate, {0, 2, 0});
  btRigidBody upper = bodyOf(1, crate, {0, 4, 0});
  for (btRigidBody* body : {&ground, &lower, &upper}) world.addRigidBody(body);

  constexpr int kSteps = 300;
  for (int step = 0; step < kSteps; ++step) world.stepSimulation(btScalar(1) / 60, 0);

  std::printf("lower crate at %.1f, upper crate at %.1f\n",
              static_cast<double>(lower.getWorldTransform().getOrigin().y()),
              static_cast<double>(upper.getWorldTransform().getOrigin().y()));
  std::printf("%d pairs of boxes\n", broadphase.getOverlappingPairCache()->getNumOverlappingPairs());
  for (btRigidBody* body : {&ground, &lower, &upper}) world.removeRigidBody(body);
}
