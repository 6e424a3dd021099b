// SPDX-License-Identifier: MIT
#include "Contest.h"

#include <sofa/core/ObjectFactory.h>
#include <sofa/core/collision/Intersection.h>

#include <ctime>

namespace allpairs::tools {
namespace {

double now(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) * 1e6 + static_cast<double>(time.tv_nsec) * 1e-3;
}

void detect(BroadPhase& phase, const sofa::type::vector<sofa::core::CollisionModel*>& models) {
  phase.beginBroadPhase();
  phase.addCollisionModels(models);
  phase.endBroadPhase();
}

}  // namespace

void Contest::enterInFactory() {
  sofa::core::ObjectFactory::getInstance()->registerObjects(
      sofa::core::ObjectRegistrationData("Times several broad phases in the place of one.").add<Contest>());
}

void Contest::enter(const std::string& name, BroadPhase& phase) {
  m_contestants.push_back({name, &phase, {}, {}, true});
}

void Contest::addCollisionModel(sofa::core::CollisionModel* cm) { addCollisionModels({cm}); }

void Contest::addCollisionModels(const sofa::type::vector<sofa::core::CollisionModel*>& models) {
  if (m_contestants.empty()) return;
  for (Contestant& contestant : m_contestants) contestant.phase->setIntersectionMethod(intersectionMethod);
  Contestant& first = m_contestants[m_turn++ % m_contestants.size()];
  const double processorBefore = now(CLOCK_THREAD_CPUTIME_ID);
  const double before = now(CLOCK_MONOTONIC);
  detect(*first.phase, models);
  first.elapsed.push_back(now(CLOCK_MONOTONIC) - before);
  first.processor.push_back(now(CLOCK_THREAD_CPUTIME_ID) - processorBefore);
  for (Contestant& contestant : m_contestants) {
    if (&contestant != &first) detect(*contestant.phase, models);
  }
  m_models = models.size();
  cmPairs = m_contestants.front().phase->getCollisionModelPairs();
  for (Contestant& contestant : m_contestants) {
    contestant.sameLists = contestant.sameLists && contestant.phase->getCollisionModelPairs() == cmPairs;
  }
}

}  // namespace allpairs::tools
