// SPDX-License-Identifier: MIT
// Broad and narrow phase on several threads, step after step: each list is that of one thread.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "Fixture.h"
#include "allpairs/collision/NarrowPhaseDetection.h"
#include "allpairs/parallel/TbbExecutor.h"
#include "support/Sanitizers.h"

namespace allpairs::test {
namespace {

using collision::BoxModel;
using collision::BruteForceBroadPhase;
using collision::CollisionElementPair;
using collision::CollisionModelPair;
using collision::ElementNarrowPhase;
using parallel::TbbExecutor;

/// Four threads, and how often they were asked for.
class CountedThreads final : public Executor {
 public:
  [[nodiscard]] std::size_t concurrency() const noexcept override { return m_threads.concurrency(); }
  void run(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    ++m_runs;
    m_threads.run(count, task);
  }
  [[nodiscard]] std::size_t runs() const { return m_runs; }

 private:
  TbbExecutor m_threads{4};
  std::size_t m_runs = 0;
};

/// Enough boxes for a search to be divided among threads; each touches a few others.
constexpr std::size_t kBoxes = kIsSanitized ? 6000 : 20000;

class Threads : public BroadPhaseTest {
 protected:
  Box anyBox() {
    std::uniform_real_distribution<double> place(0.0, std::cbrt(static_cast<double>(kBoxes)));
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = place(m_random);
      box.max[axis] = box.min[axis] + 1.0;
    }
    return box;
  }

  /// Gives each `stride`th model another place.
  void moveEach(std::size_t stride) {
    for (std::size_t i = 0; i < m_models.size(); i += stride) dynamic_cast<BoxModel&>(*m_models[i]).setBox(0, anyBox());
  }

  std::vector<CollisionModelPair> step(BruteForceBroadPhase& phase) {
    phase.setIntersectionMethod(&m_method);
    phase.beginBroadPhase();
    phase.addCollisionModels(m_models);
    phase.endBroadPhase();
    return phase.getCollisionModelPairs();
  }

  std::mt19937_64 m_random{1};
  CountedThreads m_threads;
};

TEST_F(Threads, StepsOfABroadPhaseGiveTheListsOfOneThread) {
  for (std::size_t i = 0; i < kBoxes; ++i) add(anyBox());
  BruteForceBroadPhase alone;
  BruteForceBroadPhase divided;
  divided.setExecutor(&m_threads);
  // All at first, then few, none, many and few again: boxes and pairs are kept between some of these steps.
  for (const std::size_t stride : {1U, 100U, 100U, 100U, 200000U, 2U, 1U, 50U}) {
    moveEach(stride);
    const std::vector<CollisionModelPair> expected = step(alone);
    ASSERT_FALSE(expected.empty());
    ASSERT_TRUE(step(divided) == expected) << "one model in " << stride << " has moved";
  }
  EXPECT_GT(m_threads.runs(), 0U);
}

TEST_F(Threads, ElementsOfAPairOfModelsAreThoseOfOneThread) {
  std::vector<Box> boxes(kBoxes);
  for (Box& box : boxes) box = anyBox();
  const auto half = boxes.begin() + static_cast<std::ptrdiff_t>(kBoxes / 2);
  BoxModel first("first", std::vector<Box>(boxes.begin(), half));
  BoxModel second("second", std::vector<Box>(half, boxes.end()));
  first.setSelfCollision(true);
  const auto elementsOn = [&](Executor* executor) {
    ElementNarrowPhase phase;
    phase.setIntersectionMethod(&m_method);
    phase.setExecutor(executor);
    phase.beginNarrowPhase();
    phase.addCollisionPair({&first, &second});
    phase.addCollisionPair({&first, &first});
    std::vector<std::pair<std::size_t, std::size_t>> numbersOfPairs;
    for (const CollisionElementPair& pair : phase.getElementPairs())
      numbersOfPairs.emplace_back(pair.first.index, pair.second.index);
    return numbersOfPairs;
  };
  const auto expected = elementsOn(nullptr);
  EXPECT_GT(expected.size(), kBoxes / 4);
  EXPECT_TRUE(elementsOn(&m_threads) == expected);
  EXPECT_GT(m_threads.runs(), 0U);
}

}  // namespace
}  // namespace allpairs::test
