// SPDX-License-Identifier: MIT
#include "allpairs/collision/CollisionPipeline.h"

#include "allpairs/Error.h"

namespace allpairs::collision {

void CollisionPipeline::setIntersectionMethod(Intersection* method) {
  m_method = method;
  m_initialised = false;
}

void CollisionPipeline::setBroadPhase(BroadPhaseDetection* broadPhase) {
  m_broadPhase = broadPhase;
  m_initialised = false;
}

void CollisionPipeline::setNarrowPhase(NarrowPhaseDetection* narrowPhase) {
  m_narrowPhase = narrowPhase;
  m_initialised = false;
}

void CollisionPipeline::setDepth(int depth) {
  if (depth < 0) throw InvalidArgument("bounding trees of negative depth");
  m_depth = depth;
}

void CollisionPipeline::init() {
  if (m_method == nullptr) throw InvalidArgument("the collision pipeline has no intersection method");
  if (m_broadPhase == nullptr) throw InvalidArgument("the collision pipeline has no broad phase");
  m_broadPhase->setIntersectionMethod(m_method);
  if (m_narrowPhase != nullptr) m_narrowPhase->setIntersectionMethod(m_method);
  m_broadPhase->init();
  m_initialised = true;
}

void CollisionPipeline::initOnce() {
  if (!m_initialised || m_broadPhase->getIntersectionMethod() != m_method) return init();
  if (m_narrowPhase == nullptr || m_narrowPhase->getIntersectionMethod() == m_method) return;
  m_narrowPhase->setIntersectionMethod(m_method);  // another pipeline uses it too, with a method of its own
}

void CollisionPipeline::reset() {
  m_active.clear();
  if (m_broadPhase != nullptr) m_broadPhase->beginBroadPhase();
  if (m_narrowPhase != nullptr) m_narrowPhase->beginNarrowPhase();
}

bool CollisionPipeline::takes(const CollisionModel* model) {
  return model != nullptr && !model->getLast()->empty() && model->isActive();
}

void CollisionPipeline::computeBoundingTrees(Span<CollisionModel* const> models, double dt) {
  initOnce();
  m_active.clear();
  if (m_narrowPhase != nullptr) m_narrowPhase->setTimeStep(dt);
  const bool deep =
      m_broadPhase->needsDeepBoundingTree() || (m_narrowPhase != nullptr && m_narrowPhase->needsDeepBoundingTree());
  for (CollisionModel* model : models) {
    if (!takes(model)) continue;
    CollisionModel* const last = model->getLast();  // a level above it may be gone with its old bounding tree
    if (last->isMoving() || !last->hasBoundingTree()) computeBoundingTree(*last, dt, deep ? m_depth : 0);
    m_active.push_back(last);
  }
}

void CollisionPipeline::computeBoundingTree(CollisionModel& model, double dt, int depth) const {
  if (m_method->isContinuous()) {
    model.computeContinuousBoundingTree(dt, depth);
  } else {
    model.computeBoundingTree(depth);
  }
}

void CollisionPipeline::detect() {
  initOnce();
  m_broadPhase->beginBroadPhase();
  m_broadPhase->addCollisionModels(m_active);
  m_broadPhase->endBroadPhase();
  if (m_narrowPhase == nullptr) return;
  m_narrowPhase->beginNarrowPhase();
  m_narrowPhase->addCollisionPairs(m_broadPhase->getCollisionModelPairs());
  m_narrowPhase->endNarrowPhase();
}

const std::vector<CollisionModelPair>& CollisionPipeline::step(Span<CollisionModel* const> models, double dt) {
  initOnce();
  reset();
  computeBoundingTrees(models, dt);
  detect();
  return m_broadPhase->getCollisionModelPairs();
}

}  // namespace allpairs::collision
