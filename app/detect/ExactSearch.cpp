// SPDX-License-Identifier: MIT
#include <string>

#include "allpairs/fcl/FclNarrowPhase.h"
#include "cli/Progress.h"
#include "cli/Timer.h"
#include "detect/Exact.h"

namespace allpairs::app {

void requireExact() {}

bool hasExact() { return true; }

ExactReport examine(const scene::Scene& scene, std::span<const Pair> candidates, const ExactRequest& request) {
  const Timer timer;
  ProgressLine line;
  FclNarrowPhase phase(
      {.clearance = request.clearance, .leastDepth = request.leastDepth, .lineLimit = request.lineLimit});
  phase.beginNarrowPhase();
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    line.show(i, candidates.size(),
              "examining pair " + std::to_string(i + 1) + " of " + std::to_string(candidates.size()));
    phase.addCollisionPair({scene.models[candidates[i].first].get(), scene.models[candidates[i].second].get()});
  }
  phase.endNarrowPhase();
  return {.pairs = {phase.pairs().begin(), phase.pairs().end()}, .seconds = timer.seconds()};
}

}  // namespace allpairs::app
