// SPDX-License-Identifier: MIT
#include <allpairs/bullet/BulletBroadphase.h>
#include <btBulletDynamicsCommon.h>

#include <cstdlib>

/// Two balls that fall on a floor under Bullet's own world.
int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  allpairs::BulletBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btBoxShape floorShape(btVector3(10, 1, 10));
  btSphereShape ballShape(1);
  btRigidBody floor(0, nullptr, &floorShape);
  btRigidBody first(1, nullptr, &ballShape, btVector3(1, 1, 1));
  btRigidBody second(1, nullptr, &ballShape, btVector3(1, 1, 1));
  first.translate(btVector3(-4, 4, 0));
  second.translate(btVector3(4, 5, 0));
  for (btRigidBody* body : {&floor, &first, &second}) world.addRigidBody(body);
  for (int step = 0; step < 240; ++step) world.stepSimulation(btScalar(1) / 60, 0);
  const bool areOnFloor = first.getWorldTransform().getOrigin().y() > btScalar(1.9) &&
                          second.getWorldTransform().getOrigin().y() > btScalar(1.9);
  const int pairs = broadphase.getOverlappingPairCache()->getNumOverlappingPairs();
  for (btRigidBody* body : {&floor, &first, &second}) world.removeRigidBody(body);
  return areOnFloor && pairs == 2 ? EXIT_SUCCESS : EXIT_FAILURE;
}
