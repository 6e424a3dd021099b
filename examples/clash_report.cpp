// SPDX-License-Identifier: MIT
// Which parts of a folder of meshes clash, where and how deep, and how far apart the others are that are near.
#include <allpairs/Error.h>
#include <allpairs/collision/BruteForceBroadPhase.h>
#include <allpairs/collision/CollisionPipeline.h>
#include <allpairs/fcl/FclNarrowPhase.h>
#include <allpairs/scene/ReadInput.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

void report(const allpairs::ExactPair& pair) {
  const char* first = pair.first->getName().c_str();
  const char* second = pair.second->getName().c_str();
  if (!isContact(pair.state)) {
    std::printf("%s and %s are %.2f apart\n", first, second, pair.distance);
  } else if (pair.depth.value_or(0.0) > 0.0) {
    const auto& [x, y, z] = pair.pointOnFirst;
    std::printf("%s and %s clash, %.2f deep at (%.2f, %.2f, %.2f)\n", first, second, *pair.depth, x, y, z);
  } else {
    std::printf("%s and %s touch\n", first, second);
  }
}

}  // namespace

int main(int count, char** arguments) {
  try {
    const auto scene = allpairs::scene::readMeshFolder(count > 1 ? arguments[1] : "examples/parts");
    scene.intersection->setAlarmDistance(1.0);  // parts that are further apart on some axis are of no interest

    allpairs::collision::BruteForceBroadPhase broadPhase;
    allpairs::FclNarrowPhase narrowPhase;
    allpairs::collision::CollisionPipeline pipeline;
    pipeline.setIntersectionMethod(scene.intersection.get());
    pipeline.setBroadPhase(&broadPhase);
    pipeline.setNarrowPhase(&narrowPhase);

    std::vector<allpairs::collision::CollisionModel*> models;
    for (const auto& model : scene.models) models.push_back(model.get());
    pipeline.step(models);
    for (const allpairs::ExactPair& pair : narrowPhase.pairs()) report(pair);
    return EXIT_SUCCESS;
  } catch (const allpairs::Error& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    return EXIT_FAILURE;
  }
}
