// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "allpairs/Error.h"
#include "allpairs/collision/NarrowPhaseDetection.h"

namespace allpairs::collision {

void NarrowPhaseDetection::setTimeStep(double dt) {
  if (!std::isfinite(dt)) throw InvalidArgument("the length of the step is not a finite number");
  m_dt = dt;
}

void ElementNarrowPhase::beginNarrowPhase() { m_pairs.clear(); }

void ElementNarrowPhase::addCollisionPair(const CollisionModelPair& pair) {
  Intersection* method = getIntersectionMethod();
  if (method == nullptr) throw InvalidArgument("the narrow phase has no intersection method");
  if (pair.first == nullptr || pair.second == nullptr)
    throw InvalidArgument("a pair for the narrow phase has no model");
  CollisionModel* first = pair.first->getLast();
  CollisionModel* second = pair.second->getLast();
  bool swap = false;
  const ElementIntersector* intersector = method->findIntersector(first, second, swap);
  if (swap) std::swap(first, second);

  OverlapOptions options;
  options.distance = method->distanceBetween(*first, *second);
  options.executor = m_executor;
  m_search.setOptions(std::move(options));
  fillBoxes(*first, m_firstBoxes);
  if (first == second) {
    report(first, second, m_search.find(std::span<const Box>(m_firstBoxes)), intersector);
  } else {
    fillBoxes(*second, m_secondBoxes);
    report(first, second, m_search.find(std::span<const Box>(m_firstBoxes), std::span<const Box>(m_secondBoxes)),
           intersector);
  }
}

void ElementNarrowPhase::fillBoxes(const CollisionModel& model, std::vector<Box>& boxes) const {
  const bool swept = getIntersectionMethod()->isContinuous();
  boxes.resize(model.getSize());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes[i] = swept ? model.elementSweptBox(i, getTimeStep()) : model.elementBox(i);
    if (hasNan(boxes[i])) {
      throw InvalidBox(i, model.describe() + ", element " + std::to_string(i) + ": its box has a NaN");
    }
  }
}

void ElementNarrowPhase::report(CollisionModel* first, CollisionModel* second, Span<const Pair> found,
                                const ElementIntersector* intersector) {
  const auto before = static_cast<std::ptrdiff_t>(m_pairs.size());
  try {
    for (const Pair& pair : found) {
      const CollisionElementPair elements{{first, pair.first}, {second, pair.second}};
      if (intersector == nullptr ||
          intersector->canIntersect(elements.first, elements.second, *getIntersectionMethod())) {
        m_pairs.push_back(elements);
      }
    }
  } catch (...) {
    m_pairs.erase(m_pairs.begin() + before, m_pairs.end());
    throw;
  }
}

}  // namespace allpairs::collision
