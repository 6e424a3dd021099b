// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "SceneText.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/scene/FileError.h"
#include "allpairs/scene/ReadSofaScene.h"
#include "support/TempFolder.h"

namespace allpairs::test {

inline constexpr scene::SofaVersion kBoth[] = {scene::SofaVersion::Sofa2006, scene::SofaVersion::Sofa2612};

/// All that a scene says.
struct SofaAnswer {
  std::vector<std::string> models;    ///< "/A/S 1 [0 0 0] [1 1 1]": name, number of elements, and box if it has any.
  std::vector<std::string> pairs;     ///< Of the broad phase: "/B/S - /A/S".
  std::vector<std::string> warnings;  ///< "/A/S: why".

  /// A line each.
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const auto* lines : {&models, &pairs, &warnings}) {
      for (const std::string& line : *lines) text += line + '\n';
    }
    return text;
  }
};

/// Minus zero is written as zero.
inline std::string textOf(collision::CollisionModel& model) {
  std::ostringstream text;
  text << model.getName() << ' ' << model.getSize();
  if (model.getSize() == 0) return text.str();
  const auto [min, max] = boxOf(model);
  text << " [" << min[0] + 0.0 << ' ' << min[1] + 0.0 << ' ' << min[2] + 0.0 << "] [" << max[0] + 0.0 << ' '
       << max[1] + 0.0 << ' ' << max[2] + 0.0 << ']';
  return text.str();
}

inline SofaAnswer answerOf(const scene::Scene& scene) {
  SofaAnswer answer;
  collision::BruteForceBroadPhase broadPhase;
  broadPhase.setIntersectionMethod(scene.intersection.get());
  broadPhase.init();
  broadPhase.beginBroadPhase();
  for (const auto& model : scene.models) {
    answer.models.push_back(textOf(*model));
    broadPhase.addCollisionModel(model->getFirst());
  }
  broadPhase.endBroadPhase();
  for (const auto& [first, second] : broadPhase.getCollisionModelPairs())
    answer.pairs.push_back(first->getLast()->getName() + " - " + second->getLast()->getName());
  for (const scene::Remark& warning : scene.warnings)
    answer.warnings.push_back(warning.subject + ": " + warning.reason);
  return answer;
}

/// Scenes as texts, read by either generation of SOFA.
class SofaAnswers : public testing::Test {
 protected:
  [[nodiscard]] SofaAnswer partsOfAnswer(const std::string& body,
                                         scene::SofaVersion sofa = scene::SofaVersion::Sofa2612) const {
    scene::ReadOptions options;
    options.sofa = sofa;
    const auto path = m_folder.write("scene.scn",
                                     "<Node name='root'><CollisionPipeline/><BruteForceBroadPhase/>"
                                     "<BVHNarrowPhase/><CollisionResponse/>" +
                                         m_method + "\n" + body + "\n</Node>");
    return answerOf(scene::readSofaScene(path, options));
  }

  [[nodiscard]] std::string answer(const std::string& body,
                                   scene::SofaVersion sofa = scene::SofaVersion::Sofa2612) const {
    return partsOfAnswer(body, sofa).text();
  }

  TempFolder m_folder;
  std::string m_method = "<DiscreteIntersection/>";
};

}  // namespace allpairs::test
