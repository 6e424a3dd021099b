// SPDX-License-Identifier: MIT
// dump_verdicts INPUT... [--sequence] [--data DIR]...: prints, for each frame, each model of the inputs, and each
// before it and itself, the verdict of the rules, the widest gap and its axis, one a line: what the page's own rules
// are compared with.

#include <cstdio>
#include <exception>
#include <string>

#include "Explain.h"
#include "app/view/MakeViewScene.h"
#include "app/view/ViewFrames.h"

namespace {

void dump(const allpairs::view::ViewScene& scene, const allpairs::view::ViewFrame& frame) {
  for (std::uint32_t newer = 0; newer < scene.modelCount; ++newer) {
    for (std::uint32_t older = 0; older <= newer; ++older) {
      const auto said = allpairs::view::explain(scene, frame, newer, older);
      std::printf("%u %u %s %d %.17g %d\n", newer, older, std::string(verdictName(said.verdict)).c_str(), said.axis,
                  said.gap, said.group);
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  try {
    allpairs::app::InputSettings input;
    bool isSequence = false;
    for (int i = 1; i < count; ++i) {
      const std::string word = arguments[i];
      if (word == "--sequence") {
        isSequence = true;
      } else if (word == "--data" && i + 1 < count) {
        input.searchRoots.emplace_back(arguments[++i]);
      } else {
        input.paths.push_back(word);
      }
    }
    const auto scene = isSequence ? allpairs::app::makeViewFrames(input, {}) : allpairs::app::makeViewScene(input, {});
    for (const auto& frame : scene.frames) dump(scene, frame);
    return 0;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    return 1;
  }
}
