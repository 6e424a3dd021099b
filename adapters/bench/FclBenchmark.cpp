// SPDX-License-Identifier: MIT
// Self-collision of many objects in FCL: our manager beside DynamicAABBTreeCollisionManager, on the same objects in the
// same run, with a callback that only counts. Objects that move every step, some that move, and none.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/geometry/shape/box.h>
#include <fmt/format.h>

#include <cmath>
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

/// Boxes that drift through a cube so large that each meets about five others.
class Swarm {
 public:
  explicit Swarm(std::size_t count) {
    const auto shape = std::make_shared<fcl::Boxd>(0.8, 1.0, 1.2);
    const double side = std::cbrt(static_cast<double>(count) * 4.0);
    std::uniform_real_distribution<double> place(0.0, side);
    for (std::size_t i = 0; i < count; ++i) {
      m_owned.push_back(std::make_unique<Object>(shape));
      m_owned.back()->setTranslation({place(m_random), place(m_random), place(m_random)});
      m_owned.back()->setQuatRotation(fcl::Quaterniond(place(m_random), place(m_random), 1.0, 1.0).normalized());
      m_owned.back()->computeAABB();
      m_objects.push_back(m_owned.back().get());
    }
  }

  /// Moves one object in `stride` a little.
  void drift(std::size_t stride) {
    std::uniform_real_distribution<double> motion(-0.05, 0.05);
    for (std::size_t i = 0; i < m_objects.size(); i += stride) {
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

struct Timing {
  double update = 0.0;
  double collide = 0.0;
  std::uint64_t pairs = 0;
};

bool countPair(Object*, Object*, void* count) {
  ++*static_cast<std::uint64_t*>(count);
  return false;
}

/// The least times of a step; stride 0 moves nothing.
template <class Manager>
Timing measure(std::size_t count, std::size_t stride) {
  Swarm swarm(count);
  Manager manager;
  manager.registerObjects(swarm.objects());
  manager.setup();
  Timing best;
  constexpr int kSteps = 60;
  double total = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    if (stride != 0) swarm.drift(stride);
    std::uint64_t pairs = 0;
    const double start = processorSeconds();
    if (stride != 0) manager.update();
    const double middle = processorSeconds();
    manager.collide(&pairs, countPair);
    const double end = processorSeconds();
    if (step == 0 || end - start < total) {
      total = end - start;
      best = {middle - start, end - middle, pairs};
    }
    best.pairs = pairs;
  }
  return best;
}

/// The least time from objects without a manager to all pairs.
template <class Manager>
Timing measureFresh(std::size_t count) {
  const Swarm swarm(count);
  Timing best;
  constexpr int kRuns = 20;
  for (int run = 0; run < kRuns; ++run) {
    std::uint64_t pairs = 0;
    const double start = processorSeconds();
    Manager manager;
    manager.registerObjects(swarm.objects());
    manager.setup();
    const double middle = processorSeconds();
    manager.collide(&pairs, countPair);
    const double end = processorSeconds();
    if (run == 0 || end - start < best.update + best.collide) best = {middle - start, end - middle, pairs};
  }
  return best;
}

void report(const std::string& name, const Timing& tree, const Timing& array, const Timing& ours) {
  const auto total = [](const Timing& timing) { return (timing.update + timing.collide) * 1e3; };
  for (const auto& [who, t] : {std::pair("DynamicAABBTree", tree), std::pair("DynamicAABBTree_Array", array),
                               std::pair("FclBroadPhaseManager", ours)}) {
    fmt::print("{:<11} {:<21} {:8.3f} ms a step ({:.3f} update, {:.3f} collide), {} pairs\n", name, who, total(t),
               t.update * 1e3, t.collide * 1e3, t.pairs);
  }
  fmt::print("{:<11} ratio {:.2f}, with the array {:.2f}{}\n", name, total(tree) / total(ours),
             total(array) / total(ours),
             tree.pairs == ours.pairs && array.pairs == ours.pairs ? "" : "; THE PAIRS DIFFER");
}

using Tree = fcl::DynamicAABBTreeCollisionManagerd;
using ArrayTree = fcl::DynamicAABBTreeCollisionManager_Arrayd;
using Ours = allpairs::FclBroadPhaseManagerd;

void compare(const std::string& name, std::size_t count, std::size_t stride) {
  report(name, measure<Tree>(count, stride), measure<ArrayTree>(count, stride), measure<Ours>(count, stride));
}

void compareFresh(std::size_t count) {
  report("fresh", measureFresh<Tree>(count), measureFresh<ArrayTree>(count), measureFresh<Ours>(count));
}

}  // namespace

int main(int argumentCount, char** arguments) {
  const std::size_t count = argumentCount > 1 ? static_cast<std::size_t>(std::atoi(arguments[1])) : 10000;
  compareFresh(count);
  compare("all move", count, 1);
  compare("a tenth", count, 10);
  compare("none moves", count, 0);
}
