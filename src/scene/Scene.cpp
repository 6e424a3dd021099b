// SPDX-License-Identifier: MIT
#include "allpairs/scene/Scene.h"

#include <iterator>
#include <utility>

#include "allpairs/collision/DiscreteIntersection.h"
#include "input/UniqueNames.h"

namespace allpairs::scene {
namespace {

template <class T>
void moveBehind(std::vector<T>& target, std::vector<T>& more) {
  target.insert(target.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// Names that repeat within `more` stay as they are: that is how its file has them.
void renameTaken(const Scene& scene, Scene& more) {
  UniqueNames names;
  for (const auto& model : scene.models) names.add(model->getName());
  for (const auto& model : more.models) {
    if (names.contains(model->getName())) model->setName(names.unique(model->getName()));
  }
}

void chooseMethod(Scene& scene, Scene& more) {
  if (more.intersectionName.empty()) return;
  if (scene.intersectionName.empty()) {
    scene.intersection = std::move(more.intersection);
    scene.intersectionName = std::move(more.intersectionName);
    scene.timeStep = more.timeStep;
  } else if (scene.intersectionName != more.intersectionName ||
             scene.intersection->getAlarmDistance() != more.intersection->getAlarmDistance()) {
    scene.remarks.push_back(
        {.subject = more.intersectionName,
         .reason = "an input before it already says how models are tested: " + scene.intersectionName});
  }
}

void chooseRegion(Scene& scene, Scene& more) {
  if (!scene.region) {
    scene.region = more.region;
  } else if (more.region && more.region != scene.region) {
    scene.remarks.push_back({.subject = "region", .reason = "an input before it already gives one"});
  }
}

}  // namespace

Scene emptyScene() {
  Scene scene;
  scene.intersection = std::make_unique<collision::DiscreteIntersection>();
  return scene;
}

void append(Scene& scene, Scene more) {
  renameTaken(scene, more);
  moveBehind(scene.remarks, more.remarks);
  chooseMethod(scene, more);
  chooseRegion(scene, more);
  moveBehind(scene.models, more.models);
  moveBehind(scene.owners, more.owners);
}

}  // namespace allpairs::scene
