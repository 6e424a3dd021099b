// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/MinProximityIntersection.h"
#include "support/Boxes.h"

namespace allpairs::test {

using Numbers = std::vector<std::pair<int, int>>;

/// A unit box that begins at x, between 0 and 1 on the other axes.
inline Box unitBoxAt(double x) { return {{x, 0.0, 0.0}, {x + 1.0, 1.0, 1.0}}; }

/// Models by number, a proximity method of alarm distance 0, and the lists of every strategy, which must be the same.
class BroadPhaseTest : public ::testing::Test {
 protected:
  BroadPhaseTest() { m_method.setAlarmDistance(0.0); }

  /// Adds a box model of an owner of its own.
  collision::BoxModel& add(const Box& box) {
    m_owned.push_back(std::make_unique<collision::BoxModel>("model " + std::to_string(m_models.size()), box));
    m_owned.back()->setOwner(m_owned.back().get());
    m_models.push_back(m_owned.back().get());
    return *m_owned.back();
  }

  void addTouching(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) add(unitBoxAt(0.0));
  }

  void addAgain(collision::CollisionModel& model) { m_models.push_back(&model); }

  [[nodiscard]] Numbers numbers(const std::vector<collision::CollisionModelPair>& pairs) const {
    const auto numberOf = [this](const collision::CollisionModel* model) {
      return static_cast<int>(std::find(m_models.begin(), m_models.end(), model) - m_models.begin());
    };
    Numbers result;
    for (const auto& [first, second] : pairs) result.emplace_back(numberOf(first), numberOf(second));
    return result;
  }

  Numbers detectWith(Strategy strategy, collision::Intersection& method) {
    collision::BruteForceBroadPhase phase;
    phase.setIntersectionMethod(&method);
    if (m_region) phase.setBox(*m_region);
    phase.init();
    phase.setStrategy(strategy);
    phase.beginBroadPhase();
    phase.addCollisionModels(m_models);
    phase.endBroadPhase();
    return numbers(phase.getCollisionModelPairs());
  }

  Numbers detect(collision::Intersection& method) {
    Numbers result = detectWith(Strategy::Automatic, method);
    EXPECT_EQ(detectWith(Strategy::Exhaustive, method), result);
    EXPECT_EQ(detectWith(Strategy::Bvh, method), result);
    return result;
  }

  Numbers detect() { return detect(m_method); }

  collision::MinProximityIntersection m_method;
  std::optional<Box> m_region;
  std::vector<std::unique_ptr<collision::CollisionModel>> m_others;
  std::vector<std::unique_ptr<collision::BoxModel>> m_owned;
  std::vector<collision::CollisionModel*> m_models;
};

}  // namespace allpairs::test
