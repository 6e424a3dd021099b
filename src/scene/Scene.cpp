// SPDX-License-Identifier: MIT
#include "allpairs/scene/Scene.h"

#include <iterator>
#include <numeric>
#include <string>
#include <utility>

#include "allpairs/Error.h"
#include "allpairs/collision/DiscreteIntersection.h"
#include "input/ModelNames.h"
#include "input/SceneFrame.h"

namespace allpairs::scene {
namespace {

template <class T>
void moveBehind(std::vector<T>& target, std::vector<T>& more) {
  target.insert(target.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

/// Behind the sources that a scene has.
void moveSources(Scene& scene, Scene& more) {
  noteSources(scene, {});
  noteSources(more, {});
  for (ModelSource& source : more.sources) source.file += scene.files.size();
  moveBehind(scene.files, more.files);
  moveBehind(scene.inputs, more.inputs);
  moveBehind(scene.sources, more.sources);
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

SceneSearch searchOfAll(const Scene& scene) {
  SceneSearch search{.intersection = scene.intersection.get(), .region = scene.region};
  search.indices.resize(scene.models.size());
  std::iota(search.indices.begin(), search.indices.end(), std::size_t{0});
  return search;
}

/// The first input is the scene's own file.
void requireOneSearch(const Scene& scene) {
  if (scene.pipelines.empty()) return;
  const std::string file = scene.inputs.empty() ? "" : scene.inputs.front().string() + ": ";
  throw InvalidArgument(file + "a scene with several collision pipelines cannot be taken together with other inputs");
}

/// Leaves the models' names as they are.
void moveAll(Scene& scene, Scene& more) {
  if (more.frameFile.empty() && !more.files.empty()) more.frameFile = more.files.front();
  moveSources(scene, more);
  moveBehind(scene.remarks, more.remarks);
  moveBehind(scene.warnings, more.warnings);
  chooseMethod(scene, more);
  chooseRegion(scene, more);
  noteFrame(scene, more.frameFile, more.up, more.metresPerUnit);
  moveBehind(scene.models, more.models);
  moveBehind(scene.owners, more.owners);
}

}  // namespace

std::string textOf(const Remark& remark) {
  std::string place = remark.file.string();
  if (remark.line != 0) place += ':' + std::to_string(remark.line);
  if (!place.empty()) place += ": ";
  // A file that was left out as a whole is named already.
  const bool repeats = remark.subject.empty() || remark.subject == remark.file.filename();
  return place + (repeats ? "" : remark.subject + ": ") + remark.reason;
}

Scene emptyScene() {
  Scene scene;
  scene.intersection = std::make_unique<collision::DiscreteIntersection>();
  return scene;
}

std::vector<SceneSearch> searchesOf(const Scene& scene) {
  std::vector<SceneSearch> searches;
  for (const ScenePipeline& pipeline : scene.pipelines)
    searches.push_back(
        {.indices = pipeline.models, .intersection = pipeline.intersection.get(), .region = pipeline.region});
  if (searches.empty()) searches.push_back(searchOfAll(scene));
  for (SceneSearch& search : searches)
    for (const std::size_t index : search.indices) search.models.push_back(scene.models[index].get());
  return searches;
}

void append(Scene& scene, Scene more) {
  std::vector<Scene> one;
  one.push_back(std::move(more));
  append(scene, std::move(one));
}

void append(Scene& scene, std::vector<Scene> more) {
  if (more.empty()) return;
  requireOneSearch(scene);
  for (const Scene& one : more) requireOneSearch(one);
  for (Scene& one : more) moveAll(scene, one);
  nameModels(scene);
}

}  // namespace allpairs::scene
