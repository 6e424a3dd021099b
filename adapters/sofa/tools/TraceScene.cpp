// SPDX-License-Identifier: MIT
// Runs a scene of SOFA, with its own broad phase or with another, and prints each step's pairs in order and the
// positions at the end, all digits of them, in lines that begin with "step", "pair" and "state". Two runs that print
// the same such lines have found the same. Lines that begin with "class" say first which broad phases they are.
#include <sofa/core/CollisionModel.h>

#include <cstdio>
#include <exception>

#include "SceneRun.h"

namespace {

using allpairs::tools::BroadPhase;
using allpairs::tools::SceneRun;

void printClasses(const SceneRun& run) {
  for (BroadPhase* phase : run.broadPhases()) {
    std::printf("class %s %s\n", phase->getClassName().c_str(), phase->getPathName().c_str());
  }
  std::fflush(stdout);  // said also where a step ends the program
}

void printPairs(int step, const SceneRun& run) {
  for (BroadPhase* phase : run.broadPhases()) {
    const auto& pairs = phase->getCollisionModelPairs();
    std::printf("step %d %s: %zu pairs\n", step, phase->getPathName().c_str(), pairs.size());
    for (const auto& [first, second] : pairs) {
      std::printf("pair %s %s\n", first->getLast()->getPathName().c_str(), second->getLast()->getPathName().c_str());
    }
  }
}

void printPositions(const SceneRun& run) {
  for (auto* state : run.states()) {
    const auto size = state->getMatrixSize() == 0 ? 0 : state->getSize() * state->getCoordDimension();
    std::vector<SReal> values(size);
    state->copyToBuffer(values.data(), sofa::core::vec_id::read_access::position, static_cast<unsigned>(size));
    std::printf("state %s:", state->getPathName().c_str());
    for (const SReal value : values) std::printf(" %a", static_cast<double>(value));
    std::printf("\n");
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto settings = allpairs::tools::readSettings(argc, argv);
    SceneRun run(settings, settings.broadPhases.empty() ? std::string() : settings.broadPhases.front());
    printClasses(run);
    for (int step = 0; step < settings.steps; ++step) {
      run.step();
      printPairs(step, run);
    }
    printPositions(run);
    std::printf("models %zu\n", run.countModels());
    return 0;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "trace-scene: %s\n", problem.what());
    return 2;
  }
}
