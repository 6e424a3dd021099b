// SPDX-License-Identifier: MIT
// Self-collision of many objects in FCL: our manager beside DynamicAABBTreeCollisionManager and its _Array sister, on
// the same objects in turns, step by step. What is timed is what a program does in a step, update() and collide(), with
// a callback that counts and that no compiler can see into; which pairs it gets is compared outside of the time.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/geometry/shape/box.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "ProcessorTime.h"
#include "allpairs/fcl/FclBroadPhaseManager.h"

namespace {

using Object = fcl::CollisionObjectd;
using Manager = fcl::BroadPhaseCollisionManagerd;

/// Boxes that drift through a cube; `room` is how much of it there is for each, in volumes of about one box.
class Swarm {
 public:
  Swarm(std::size_t count, double room) {
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
  std::mt19937 m_random{1};
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

Pairs pairsOf(const Manager& manager) {
  Pairs pairs;
  manager.collide(&pairs, [](Object* a, Object* b, void* data) {
    static_cast<Pairs*>(data)->emplace_back(std::minmax(a, b));
    return false;
  });
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

/// The step in the middle, by its whole time.
Step median(std::vector<Step> steps) {
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end(),
                   [](const Step& a, const Step& b) { return a.total() < b.total(); });
  return *middle;
}

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

void report(const std::string& name, const Steps& steps, bool isSame) {
  std::array<Step, kNames.size()> medians;
  for (std::size_t i = 0; i < medians.size(); ++i) {
    medians[i] = median(steps[i]);
    fmt::print("{:<20} {:<21} {:8.3f} ms a step ({:.3f} update, {:.3f} collide), {} pairs\n", name, kNames[i],
               medians[i].total() * 1e3, medians[i].update * 1e3, medians[i].collide * 1e3, steps[i].back().pairs);
  }
  fmt::print("{:<20} ratio {:.2f}, with the array {:.2f}{}\n", name, medians[0].total() / medians[2].total(),
             medians[1].total() / medians[2].total(), isSame ? "" : "; THE PAIRS DIFFER");
}

bool agree(const Managers& managers) {
  const Pairs pairs = pairsOf(*managers[0]);
  return pairs == pairsOf(*managers[1]) && pairs == pairsOf(*managers[2]);
}

/// Step by step: one object in `stride` moves, and each manager follows and finds the pairs.
void compare(const std::string& name, Swarm& swarm, std::size_t stride) {
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
  report(name, steps, isSame);
}

/// From objects without a manager to all pairs.
void compareFresh(const std::string& name, const Swarm& swarm) {
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
  report(name, steps, isSame);
}

}  // namespace

int main(int argumentCount, char** arguments) {
  const std::size_t count = argumentCount > 1 ? static_cast<std::size_t>(std::atoi(arguments[1])) : 10000;
  for (const auto& [density, room] : {std::pair("sparse", 20.0), std::pair("denser", 4.0), std::pair("dense", 1.0)}) {
    Swarm swarm(count, room);
    const std::string scene = density;
    compare(scene + ", all move", swarm, 1);
    compare(scene + ", a tenth", swarm, 10);
    compare(scene + ", 1 in 100", swarm, 100);
    compare(scene + ", none moves", swarm, 0);
    compareFresh(scene + ", afresh", swarm);
  }
}
