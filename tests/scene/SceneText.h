// SPDX-License-Identifier: MIT
#pragma once

#include <sstream>
#include <string>

#include "allpairs/scene/Scene.h"
#include "support/Boxes.h"

namespace allpairs::test {

/// A scene in a form that is easy to compare: for each model its name, type and number of elements.
inline std::string namesOf(const scene::Scene& scene) {
  std::string text;
  for (const auto& model : scene.models) {
    text += model->getName() + ' ' + std::string(model->typeName()) + ' ' + std::to_string(model->getSize()) + '\n';
  }
  return text;
}

/// The root box of a model.
inline Box boxOf(collision::CollisionModel& model) {
  model.computeBoundingTree();
  return model.getFirst()->elementBox(0);
}

}  // namespace allpairs::test
