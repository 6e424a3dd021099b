// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <memory>

namespace allpairs::test {

/// A body at rest; one without a mass never moves. The shape must outlive it.
inline std::unique_ptr<btRigidBody> makeBody(btCollisionShape& shape, btScalar mass, const btVector3& place) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape.calculateLocalInertia(mass, inertia);
  auto body = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(mass, nullptr, &shape, inertia));
  btTransform pose = btTransform::getIdentity();
  pose.setOrigin(place);
  body->setWorldTransform(pose);
  body->setInterpolationWorldTransform(pose);
  return body;
}

}  // namespace allpairs::test
