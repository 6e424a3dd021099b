// SPDX-License-Identifier: MIT
// Loads a scene of SOFA, lets its collision pipelines detect once where everything stands at the start, and prints its
// collision models and the pairs of each broad phase as JSON, with the keys that `allpairs detect --format json` has.
#include <sofa/component/collision/geometry/CubeCollisionModel.h>
#include <sofa/core/CollisionModel.h>
#include <sofa/core/collision/Pipeline.h>

#include <cstdio>
#include <exception>
#include <map>
#include <string>

#include "Json.h"
#include "SceneRun.h"

namespace {

using allpairs::tools::BroadPhase;
using allpairs::tools::jsonNumber;
using allpairs::tools::quoted;
using allpairs::tools::SceneRun;
using sofa::component::collision::geometry::Cube;
using sofa::component::collision::geometry::CubeCollisionModel;
using sofa::core::CollisionModel;

using Numbers = std::map<const CollisionModel*, std::size_t>;

const char* yesOrNo(bool value) { return value ? "true" : "false"; }

template <class Corner>
std::string jsonCorner(const Corner& corner) {
  std::string result = "[";
  for (sofa::Size axis = 0; axis < 3; ++axis) {
    if (axis > 0) result += ", ";
    result += jsonNumber(static_cast<double>(corner[axis]));
  }
  return result + "]";
}

/// The root box, or null where there are no elements or no pipeline and nobody else has made one.
void printBox(CollisionModel& model) {
  auto* root = dynamic_cast<CubeCollisionModel*>(model.getFirst());
  if (root == nullptr || root->getSize() == 0) {
    std::printf("null");
    return;
  }
  const Cube cube(root, 0);
  std::printf("[%s, %s]", jsonCorner(cube.minVect()).c_str(), jsonCorner(cube.maxVect()).c_str());
}

void printGroups(const CollisionModel& model) {
  const char* before = "";
  for (const int group : model.getGroups()) {
    std::printf("%s%d", before, group);
    before = ", ";
  }
}

void print(CollisionModel& model) {
  const bool isBounded = model.getPrevious() != nullptr;  // By a pipeline, that is.
  if (!isBounded && model.isActive()) model.computeBoundingTree(0);
  std::printf("{\"name\": %s, \"type\": %s, \"elements\": %zu, \"bounded\": %s, ", quoted(model.getPathName()).c_str(),
              quoted(model.getClassName()).c_str(), static_cast<std::size_t>(model.getSize()), yesOrNo(isBounded));
  std::printf("\"active\": %s, \"moving\": %s, \"simulated\": %s, \"selfCollision\": %s, \"groups\": [",
              yesOrNo(model.isActive()), yesOrNo(model.isMoving()), yesOrNo(model.isSimulated()),
              yesOrNo(model.getSelfCollision()));
  printGroups(model);
  std::printf("], \"contactDistance\": %s, \"box\": ",
              jsonNumber(static_cast<double>(model.getContactDistance())).c_str());
  printBox(model);
  std::printf("}");
}

Numbers printModels(const SceneRun& run) {
  Numbers numbers;
  std::printf("{\"models\": [");
  for (CollisionModel* model : run.models()) {
    std::printf(numbers.empty() ? "\n  " : ",\n  ");
    numbers.emplace(model, numbers.size());
    print(*model);
  }
  std::printf("],\n");
  return numbers;
}

void printPairs(BroadPhase& phase, const Numbers& numbers) {
  std::printf("{\"name\": %s, \"pairs\": [", quoted(phase.getPathName()).c_str());
  const char* before = "";
  for (const auto& [first, second] : phase.getCollisionModelPairs()) {
    std::printf("%s[%zu, %zu]", before, numbers.at(first->getLast()), numbers.at(second->getLast()));
    before = ", ";
  }
  std::printf("]}");
}

void printBroadPhases(const SceneRun& run, const Numbers& numbers) {
  std::printf(" \"pipelines\": %zu,\n \"broadPhases\": [", run.pipelines().size());
  const char* before = "\n  ";
  for (BroadPhase* phase : run.broadPhases()) {
    std::printf("%s", before);
    printPairs(*phase, numbers);
    before = ",\n  ";
  }
  std::printf("]}\n");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto settings = allpairs::tools::readSettings(argc, argv);
    SceneRun run(settings);
    for (sofa::core::collision::Pipeline* pipeline : run.pipelines()) {
      pipeline->computeCollisionReset();
      pipeline->computeCollisionDetection();
    }
    printBroadPhases(run, printModels(run));
    return 0;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "list-models: %s\n", problem.what());
    return 2;
  }
}
