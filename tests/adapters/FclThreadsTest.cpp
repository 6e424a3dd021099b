// SPDX-License-Identifier: MIT
// Queries of one manager from several threads between updates, which FCL's own trees allow.
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/geometry/shape/sphere.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <latch>
#include <limits>
#include <memory>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "allpairs/fcl/FclBroadPhaseManager.h"

namespace allpairs::test {
namespace {

using ObjectD = ::fcl::CollisionObjectd;
using AnyManager = ::fcl::BroadPhaseCollisionManagerd;
using ObjectPairs = std::vector<std::pair<ObjectD*, ObjectD*>>;

/// The naive manager gives all pairs.
bool collect(ObjectD* a, ObjectD* b, void* pairs) {
  if (a->getAABB().overlap(b->getAABB())) static_cast<ObjectPairs*>(pairs)->push_back(std::minmax(a, b));
  return false;
}

bool measure(ObjectD* a, ObjectD* b, void* known, double& least) {
  auto& distance = *static_cast<double*>(known);
  distance = std::min(distance, a->getAABB().distance(b->getAABB()));
  least = distance;
  return false;
}

/// All answers of a manager that a thread may ask it for.
struct Answers {
  std::vector<ObjectPairs> ofProbes;
  std::vector<double> distances;
  ObjectPairs ofItself;
  ObjectPairs ofOther;
  double least = std::numeric_limits<double>::max();
  std::size_t size = 0;
  std::size_t listed = 0;

  friend bool operator==(const Answers&, const Answers&) = default;
};

ObjectPairs sorted(ObjectPairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Asks a manager everything, beginning with another question for each `turn`.
Answers ask(const AnyManager& manager, AnyManager& other, const std::vector<ObjectD*>& probes, std::size_t turn) {
  Answers answers;
  answers.ofProbes.resize(probes.size());
  answers.distances.assign(probes.size(), std::numeric_limits<double>::max());
  for (std::size_t i = 0; i < 5; ++i) {
    switch ((turn + i) % 5) {
      case 0:
        for (std::size_t p = 0; p < probes.size(); ++p) {
          manager.collide(probes[p], &answers.ofProbes[p], collect);
          answers.ofProbes[p] = sorted(answers.ofProbes[p]);
        }
        break;
      case 1:
        for (std::size_t p = 0; p < probes.size(); ++p) manager.distance(probes[p], &answers.distances[p], measure);
        break;
      case 2:
        manager.collide(&answers.ofItself, collect);
        answers.ofItself = sorted(answers.ofItself);
        break;
      case 3:
        manager.collide(&other, &answers.ofOther, collect);
        answers.ofOther = sorted(answers.ofOther);
        break;
      default:
        manager.distance(&answers.least, measure);
        answers.size = manager.empty() ? 0 : manager.size();
        std::vector<ObjectD*> objects;
        manager.getObjects(objects);
        answers.listed = objects.size();
    }
  }
  return answers;
}

/// Spheres at random places.
class Spheres {
 public:
  explicit Spheres(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      m_owned.push_back(std::make_unique<ObjectD>(m_sphere));
      m_objects.push_back(m_owned.back().get());
    }
    move(1);
  }

  /// Moves every n-th object to a random place.
  void move(std::size_t stride) {
    std::uniform_real_distribution<double> place(0.0, 12.0);
    for (std::size_t i = 0; i < m_objects.size(); i += stride) {
      m_objects[i]->setTranslation({place(m_random), place(m_random), place(m_random)});
      m_objects[i]->computeAABB();
    }
  }

  [[nodiscard]] const std::vector<ObjectD*>& objects() const { return m_objects; }

 private:
  std::mt19937 m_random{3};
  std::shared_ptr<::fcl::Sphered> m_sphere = std::make_shared<::fcl::Sphered>(0.5);
  std::vector<std::unique_ptr<ObjectD>> m_owned;
  std::vector<ObjectD*> m_objects;
};

class FclThreads : public ::testing::TestWithParam<std::size_t> {};

TEST_P(FclThreads, GetTheAnswersOfTheNaiveManagerAllAtOnce) {
  constexpr std::size_t kThreads = 8;
  Spheres spheres(GetParam());
  Spheres others(60);
  Spheres probes(40);
  FclBroadPhaseManagerd manager;
  FclBroadPhaseManagerd other;
  manager.registerObjects(spheres.objects());
  other.registerObjects(others.objects());
  for (const std::size_t stride : {1U, 100U, 100U, 100U, 100U, 1U, 7U, 150U, 150U, 150U}) {
    spheres.move(stride);
    others.move(stride);
    manager.update();
    manager.setup();
    other.update();
    ::fcl::NaiveCollisionManagerd naive;
    ::fcl::NaiveCollisionManagerd naiveOther;
    naive.registerObjects(spheres.objects());
    naiveOther.registerObjects(others.objects());
    const Answers expected = ask(naive, naiveOther, probes.objects(), 0);
    std::atomic<int> wrong = 0;
    std::latch start(kThreads);
    std::vector<std::thread> threads;
    for (std::size_t turn = 0; turn < kThreads; ++turn) {
      threads.emplace_back([&, turn] {
        start.arrive_and_wait();
        for (std::size_t round = 0; round < 3; ++round) {
          wrong += ask(manager, other, probes.objects(), turn + round) == expected ? 0 : 1;
        }
      });
    }
    for (std::thread& thread : threads) thread.join();
    ASSERT_EQ(wrong, 0) << "one in " << stride << " moved";
  }
}

INSTANTIATE_TEST_SUITE_P(FewAndMany, FclThreads, ::testing::Values(20, 400));

}  // namespace
}  // namespace allpairs::test
