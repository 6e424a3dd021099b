// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

#include "SceneText.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadSofaScene.h"
#include "support/TempFolder.h"

namespace allpairs::test {

/// All that a scene says, a line each: its models with their boxes, the pairs of the broad phase, and the warnings.
inline std::string answerOf(const scene::Scene& scene) {
  std::ostringstream text;
  collision::BruteForceBroadPhase broadPhase;
  broadPhase.setIntersectionMethod(scene.intersection.get());
  broadPhase.init();
  broadPhase.beginBroadPhase();
  std::map<const collision::CollisionModel*, std::string> names;
  for (const auto& model : scene.models) {
    names[model.get()] = model->getName();
    text << model->getName() << ' ' << model->getSize();
    if (model->getSize() != 0) {
      const Box box = boxOf(*model);
      text << " [" << box.min[0] << ' ' << box.min[1] << ' ' << box.min[2] << "] [" << box.max[0] << ' ' << box.max[1]
           << ' ' << box.max[2] << ']';
    }
    text << '\n';
    broadPhase.addCollisionModel(model->getFirst());
  }
  broadPhase.endBroadPhase();
  for (const auto& [first, second] : broadPhase.getCollisionModelPairs())
    text << names.at(first->getLast()) << " - " << names.at(second->getLast()) << '\n';
  for (const scene::Remark& warning : scene.warnings) text << warning.subject << ": " << warning.reason << '\n';
  return text.str();
}

/// Scenes as texts, read by either generation of SOFA.
class SofaAnswers : public testing::Test {
 protected:
  [[nodiscard]] std::string answer(const std::string& body,
                                   scene::SofaVersion sofa = scene::SofaVersion::Sofa2612) const {
    scene::ReadOptions options;
    options.sofa = sofa;
    const auto path = m_folder.write("scene.scn",
                                     "<Node name='root'><CollisionPipeline/><BruteForceBroadPhase/>"
                                     "<DiscreteIntersection/>\n" +
                                         body + "\n</Node>");
    return answerOf(scene::readSofaScene(path, options));
  }

  TempFolder m_folder;
};

}  // namespace allpairs::test
