// SPDX-License-Identifier: MIT
// Self-collision of many objects in FCL, and queries with objects among few and many: our manager beside
// DynamicAABBTreeCollisionManager and its _Array sister, on the same objects in turns, step by step. What is timed is
// what a program does in a step, update() and collide() or distance(), with a callback that counts or measures boxes
// and that no compiler can see into; which pairs it gets, and which least distances, is compared outside of the time.
// Ends with 1 if some differ.
//   fcl_benchmark [OBJECTS]
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/geometry/shape/box.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "Median.h"
#include "Number.h"
#include "ProcessorTime.h"
#include "allpairs/fcl/FclBroadPhaseManager.h"

namespace {

using Object = fcl::CollisionObjectd;
using Manager = fcl::BroadPhaseCollisionManagerd;

/// Boxes that drift through a cube; `room` is how much of it there is for each, in volumes of about one box.
class Swarm {
 public:
  Swarm(std::size_t count, double room, unsigned seed = 1) : m_random(seed) {
    const auto shape = std::make_shared<fcl::Boxd>(0.8, 1.0, 1.2);
    const double side = std::cbrt(static_cast<double>(count) * room);
    std::uniform_real_distribution<double> place(0.0, side);
    for (std::size_t i = 0; i < count; ++i) {
      m_owned.push_back(std::make_unique<Object>(shape));
      m_owned.back()->setTranslation({place(m_random), place(m_random), place(m_random)});
      m_owned.back()->setQuatRotation(fcl::Quaterniond(place(m_random), place(m_random), 1.0, 1.0).normalized());
      m_owned.back()->computeAABB();
      m_objects.push_back(m_owned.back().get());
    }
  }

  /// Moves one object in `stride` a little; with 0, none.
  void drift(std::size_t stride) {
    std::uniform_real_distribution<double> motion(-0.05, 0.05);
    for (std::size_t i = 0; stride != 0 && i < m_objects.size(); i += stride) {
      const fcl::Vector3d by(motion(m_random), motion(m_random), motion(m_random));
      m_objects[i]->setTranslation(m_objects[i]->getTranslation() + by);
      m_objects[i]->computeAABB();
    }
  }

  [[nodiscard]] const std::vector<Object*>& objects() const { return m_objects; }

 private:
  std::mt19937 m_random;
  std::vector<std::unique_ptr<Object>> m_owned;
  std::vector<Object*> m_objects;
};

bool countPair(Object*, Object*, void* count) {
  ++*static_cast<std::uint64_t*>(count);
  return false;
}

/// Read again for each query, so that no query is compiled for its callback.
fcl::CollisionCallBack<double> volatile callback = countPair;

using Pairs = std::vector<std::pair<Object*, Object*>>;

bool keepPair(Object* a, Object* b, void* data) {
  static_cast<Pairs*>(data)->emplace_back(std::minmax(a, b));
  return false;
}

Pairs pairsOf(const Manager& manager) {
  Pairs pairs;
  manager.collide(&pairs, keepPair);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Seconds of one step.
struct Step {
  double update = 0.0;
  double collide = 0.0;
  std::uint64_t pairs = 0;

  [[nodiscard]] double total() const { return update + collide; }
};

template <class Prepare>
Step timeStep(Manager& manager, const Prepare& prepare) {
  Step step;
  const double start = processorSeconds();
  prepare(manager);
  const double middle = processorSeconds();
  manager.collide(&step.pairs, callback);
  step.update = middle - start;
  step.collide = processorSeconds() - middle;
  return step;
}

constexpr std::array<const char*, 3> kNames{"DynamicAABBTree", "DynamicAABBTree_Array", "FclBroadPhaseManager"};
using Steps = std::array<std::vector<Step>, kNames.size()>;
using Managers = std::array<std::unique_ptr<Manager>, kNames.size()>;

Managers makeManagers() {
  return {std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>(),
          std::make_unique<fcl::DynamicAABBTreeCollisionManager_Arrayd>(),
          std::make_unique<allpairs::FclBroadPhaseManagerd>()};
}

/// Returns whether the pairs are the same.
bool report(const std::string& name, const Steps& steps, bool isSame) {
  std::array<Step, kNames.size()> medians;
  for (std::size_t i = 0; i < medians.size(); ++i) {
    medians[i] = median(steps[i]);
    fmt::print("{:<20} {:<21} {:8.3f} ms a step ({:.3f} update, {:.3f} collide), {} pairs\n", name, kNames[i],
               medians[i].total() * 1e3, medians[i].update * 1e3, medians[i].collide * 1e3, steps[i].back().pairs);
  }
  fmt::print("{:<20} ratio {:.2f}, with the array {:.2f}{}\n", name, medians[0].total() / medians[2].total(),
             medians[1].total() / medians[2].total(), isSame ? "" : "; THE PAIRS DIFFER");
  return isSame;
}

bool agree(const Managers& managers) {
  const Pairs pairs = pairsOf(*managers[0]);
  return pairs == pairsOf(*managers[1]) && pairs == pairsOf(*managers[2]);
}

/// Step by step: one object in `stride` moves, and each manager follows and finds the pairs.
bool compare(const std::string& name, Swarm& swarm, std::size_t stride) {
  constexpr int kSteps = 60;
  const Managers managers = makeManagers();
  for (const auto& manager : managers) {
    manager->registerObjects(swarm.objects());
    manager->setup();
  }
  Steps steps;
  bool isSame = true;
  for (int step = 0; step < kSteps; ++step) {
    swarm.drift(stride);
    for (std::size_t i = 0; i < managers.size(); ++i) {
      steps[i].push_back(timeStep(*managers[i], [&](Manager& manager) {
        if (stride != 0) manager.update();
      }));
    }
    if (step % 10 == 0) isSame = agree(managers) && isSame;
  }
  return report(name, steps, isSame);
}

/// From objects without a manager to all pairs.
bool compareFresh(const std::string& name, const Swarm& swarm) {
  constexpr int kRuns = 21;
  Steps steps;
  bool isSame = true;
  for (int run = 0; run < kRuns; ++run) {
    const Managers managers = makeManagers();
    for (std::size_t i = 0; i < managers.size(); ++i) {
      steps[i].push_back(timeStep(*managers[i], [&](Manager& manager) {
        manager.registerObjects(swarm.objects());
        manager.setup();
      }));
    }
    if (run == 0) isSame = agree(managers);
  }
  return report(name, steps, isSame);
}

bool measureBoxes(Object* a, Object* b, void* count, double& least) {
  ++*static_cast<std::uint64_t*>(count);
  least = std::min(least, a->getAABB().distance(b->getAABB()));
  return least <= 0.0;
}

fcl::DistanceCallBack<double> volatile distanceCallback = measureBoxes;

/// What one step of a program asks a manager.
struct Questions {
  std::string name;
  int collisions = 0;   ///< Queries with an object each.
  int distances = 0;    ///< The same.
  bool itself = false;  ///< Self-collision.
  bool moves = true;    ///< Whether all objects have moved before.
};

void askAll(Manager& manager, const Questions& questions, const std::vector<Object*>& probes, std::uint64_t& found) {
  if (questions.moves) manager.update();
  for (int i = 0; i < questions.collisions; ++i) {
    manager.collide(probes[static_cast<std::size_t>(i) % probes.size()], &found, callback);
  }
  for (int i = 0; i < questions.distances; ++i) {
    manager.distance(probes[static_cast<std::size_t>(i) % probes.size()], &found, distanceCallback);
  }
  if (questions.itself) manager.collide(&found, callback);
}

/// What a manager answers to some of the questions, each probe once.
struct Answers {
  Pairs pairs;
  std::vector<double> distances;

  bool operator==(const Answers& other) const { return pairs == other.pairs && distances == other.distances; }
};

Answers answersOf(Manager& manager, const Questions& questions, const std::vector<Object*>& probes) {
  Answers answers;
  if (questions.itself) answers.pairs = pairsOf(manager);
  for (std::size_t i = 0; i < probes.size(); ++i) {
    Pairs pairs;
    if (static_cast<int>(i) < questions.collisions) manager.collide(probes[i], &pairs, keepPair);
    std::sort(pairs.begin(), pairs.end());
    answers.pairs.insert(answers.pairs.end(), pairs.begin(), pairs.end());
    if (static_cast<int>(i) >= questions.distances) continue;
    answers.distances.push_back(std::numeric_limits<double>::infinity());
    manager.distance(probes[i], &answers.distances.back(), [](Object* a, Object* b, void* data, double& least) {
      least = std::min(least, a->getAABB().distance(b->getAABB()));
      *static_cast<double*>(data) = std::min(*static_cast<double*>(data), least);
      return least <= 0.0;
    });
  }
  return answers;
}

bool agree(const Managers& managers, const Questions& questions, const std::vector<Object*>& probes) {
  const Answers answers = answersOf(*managers[0], questions, probes);
  return answers == answersOf(*managers[1], questions, probes) && answers == answersOf(*managers[2], questions, probes);
}

/// Steps of a scene, which take so little time that many managers of a kind take them in turns.
bool compareQuestions(std::size_t count, double room, const Questions& questions) {
  constexpr int kSteps = 31;
  const std::size_t copies = 4000 / count + 1;
  Swarm swarm(count, room);
  const std::size_t probeCount = std::min<std::size_t>(count, 64);
  const Swarm probes(probeCount, room * static_cast<double>(count) / static_cast<double>(probeCount), 2);
  std::vector<Managers> managers;
  for (std::size_t i = 0; i < copies; ++i) {
    managers.push_back(makeManagers());
    for (const auto& manager : managers.back()) {
      manager->registerObjects(swarm.objects());
      manager->setup();
    }
  }
  std::array<std::vector<double>, kNames.size()> times;
  std::array<std::uint64_t, kNames.size()> found{};
  bool isSame = true;
  for (int step = 0; step < kSteps; ++step) {
    if (questions.moves) swarm.drift(1);
    for (std::size_t kind = 0; kind < kNames.size(); ++kind) {
      const double start = processorSeconds();
      for (const Managers& copy : managers) askAll(*copy[kind], questions, probes.objects(), found[kind]);
      times[kind].push_back((processorSeconds() - start) / static_cast<double>(copies));
    }
    if (step % 10 == 0) isSame = agree(managers.front(), questions, probes.objects()) && isSame;
  }
  const std::array<double, 3> medians{median(times[0]), median(times[1]), median(times[2])};
  // How many objects are measured until the nearest is known is each manager's own business.
  isSame = isSame && (questions.distances != 0 || (found[0] == found[1] && found[0] == found[2]));
  fmt::print(
      "{:>6} objects, {:<30} {:9.3f} us, array {:9.3f} us, ours {:9.3f} us; ratio {:.2f}, with the array {:.2f}{}\n",
      count, questions.name, medians[0] * 1e6, medians[1] * 1e6, medians[2] * 1e6, medians[0] / medians[2],
      medians[1] / medians[2], isSame ? "" : "; THE ANSWERS DIFFER");
  return isSame;
}

bool compareQuestions(double room) {
  bool isSame = true;
  for (const std::size_t count : {2U, 5U, 10U, 20U, 50U, 100U, 1000U, 10000U}) {
    isSame = compareQuestions(count, room, {.name = "update, one query", .collisions = 1}) && isSame;
    isSame = compareQuestions(count, room, {.name = "update, 20 queries", .collisions = 20}) && isSame;
    isSame = compareQuestions(count, room, {.name = "update, 200 queries", .collisions = 200}) && isSame;
    isSame =
        compareQuestions(count, room, {.name = "20 queries, none moves", .collisions = 20, .moves = false}) && isSame;
    isSame = compareQuestions(count, room, {.name = "update, self-collision", .itself = true}) && isSame;
    isSame = compareQuestions(count, room, {.name = "update, one distance", .distances = 1}) && isSame;
    isSame =
        compareQuestions(count, room, {.name = "20 distances, none moves", .distances = 20, .moves = false}) && isSame;
  }
  return isSame;
}

}  // namespace

int main(int argumentCount, char** arguments) {
  const auto count = static_cast<std::size_t>(numberAt(1, argumentCount, arguments, 10000));
  bool isSame = true;
  for (const auto& [density, room] : {std::pair("dense", 8.0), std::pair("sparse", 200.0)}) {
    fmt::print("{}\n", density);
    isSame = compareQuestions(room) && isSame;
  }
  for (const auto& [density, room] : {std::pair("sparse", 20.0), std::pair("denser", 4.0), std::pair("dense", 1.0)}) {
    Swarm swarm(count, room);
    const std::string scene = density;
    isSame = compare(scene + ", all move", swarm, 1) && isSame;
    isSame = compare(scene + ", a tenth", swarm, 10) && isSame;
    isSame = compare(scene + ", 1 in 100", swarm, 100) && isSame;
    isSame = compare(scene + ", none moves", swarm, 0) && isSame;
    isSame = compareFresh(scene + ", afresh", swarm) && isSame;
  }
  return isSame ? EXIT_SUCCESS : EXIT_FAILURE;
}
