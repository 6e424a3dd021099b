// SPDX-License-Identifier: MIT
// Our broad phase under FCL's collision and distance functions.
#include <allpairs/fcl/FclBroadPhaseManager.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

namespace {

using Object = fcl::CollisionObjectd;

/// What the narrow phase is asked about each candidate.
bool countCollision(Object* a, Object* b, void* count) {
  fcl::CollisionResultd result;
  if (fcl::collide(a, b, fcl::CollisionRequestd(), result) != 0) ++*static_cast<int*>(count);
  return false;  // go on
}

bool keepLeast(Object* a, Object* b, void* data, double& least) {
  fcl::DistanceResultd result;
  fcl::distance(a, b, fcl::DistanceRequestd(), result);
  least = std::min(*static_cast<double*>(data), result.min_distance);
  *static_cast<double*>(data) = least;
  return least <= 0.0;
}

}  // namespace

int main() {
  const auto ball = std::make_shared<fcl::Sphered>(0.5);
  std::vector<Object> balls;
  for (const double x : {0.0, 0.75, 3.0, 5.0}) {
    balls.emplace_back(ball, fcl::Matrix3d::Identity(), fcl::Vector3d(x, 0.0, 0.0));
  }

  allpairs::FclBroadPhaseManagerd manager;  // was: fcl::DynamicAABBTreeCollisionManagerd manager;
  for (Object& object : balls) manager.registerObject(&object);
  manager.setup();
  int collisions = 0;
  manager.collide(&collisions, countCollision);
  std::printf("%d collision\n", collisions);

  balls[1].setTranslation({1.25, 0.0, 0.0});
  balls[1].computeAABB();
  manager.update(&balls[1]);
  double least = 1e9;
  manager.distance(&least, keepLeast);
  std::printf("now the nearest two are %.2f apart\n", least);
}
