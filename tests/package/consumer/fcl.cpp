// SPDX-License-Identifier: MIT
#include <allpairs/collision/SphereModel.h>
#include <allpairs/fcl/FclBroadPhaseManager.h>
#include <allpairs/fcl/FclNarrowPhase.h>

#include <cstdlib>

int main() {
  allpairs::collision::SphereModel first("first", {{0, 0, 0}});
  allpairs::collision::SphereModel second("second", {{0, 0, 1.5}});
  allpairs::FclNarrowPhase phase;
  phase.beginNarrowPhase();
  phase.addCollisionPair({&first, &second});
  const bool isDeep = phase.pairs().front().depth == 0.5;
  const allpairs::FclBroadPhaseManagerd manager;
  return isDeep && manager.empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
