// SPDX-License-Identifier: MIT
// Objects in Coal: our manager beside DynamicAABBTreeCollisionManager, on the same objects in turns, step by step. What
// is timed is what a program does in a step: update(), and then self-collision or queries with objects; the callback
// counts. Which pairs it gets is compared outside of the time.
#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>
#include <coal/shape/geometric_shapes.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "Median.h"
#include "ProcessorTime.h"
#include "allpairs/coal/CoalBroadPhaseManager.h"

namespace {

using Object = coal::CollisionObject;
using Manager = coal::BroadPhaseCollisionManager;
using Objects = std::vector<std::unique_ptr<Object>>;

constexpr int kSteps = 41;

/// Boxes in a cube that has the volume of twenty boxes for each of so many.
class Swarm {
 public:
  Swarm(std::size_t count, std::size_t room) : m_place(0.0, std::cbrt(20.0 * static_cast<double>(room))) {
    const auto shape = std::make_shared<coal::Box>(0.8, 1.0, 1.2);
    for (std::size_t i = 0; i < count; ++i) objects.push_back(std::make_unique<Object>(shape));
    scatter();
  }

  void scatter() {
    for (const auto& object : objects) place(*object);
  }

  void drift() {
    std::uniform_real_distribution<double> motion(-0.05, 0.05);
    for (const auto& object : objects) {
      object->setTranslation(object->getTranslation() +
                             coal::Vec3s(motion(m_random), motion(m_random), motion(m_random)));
      object->computeAABB();
    }
  }

  void place(Object& object) {
    object.setTranslation(coal::Vec3s(m_place(m_random), m_place(m_random), m_place(m_random)));
    object.computeAABB();
  }

  Objects objects;

 private:
  std::mt19937 m_random{1};
  std::uniform_real_distribution<double> m_place;
};

struct Count : coal::CollisionCallBackBase {
  bool collide(Object* /*first*/, Object* /*second*/) override {
    ++pairs;
    return false;
  }

  std::uint64_t pairs = 0;
};

struct Collect : coal::CollisionCallBackBase {
  bool collide(Object* first, Object* second) override {
    pairs.insert(std::minmax(first, second));
    return false;
  }

  std::set<std::pair<Object*, Object*>> pairs;
};

bool agree(const Manager& one, const Manager& other) {
  Collect a;
  Collect b;
  one.collide(&a);
  other.collide(&b);
  return a.pairs == b.pairs;
}

/// Seconds that a step takes a manager: it follows the objects, and is asked for all pairs or with some objects.
double timeStep(Manager& manager, const Objects* probes, std::uint64_t& pairs) {
  Count count;
  const double start = processorSeconds();
  manager.update();
  if (probes == nullptr) manager.collide(&count);
  if (probes != nullptr) {
    for (const auto& probe : *probes) manager.collide(probe.get(), &count);
  }
  pairs += count.pairs;
  return processorSeconds() - start;
}

/// Compares both managers, and says whether they found the same.
bool compare(const char* name, std::size_t count, std::size_t queries) {
  Swarm swarm(count, count);
  Swarm probes(queries, count);
  coal::DynamicAABBTreeCollisionManager tree;
  allpairs::CoalBroadPhaseManager ours;
  const std::array<Manager*, 2> managers{&tree, &ours};
  for (Manager* manager : managers) {
    for (const auto& object : swarm.objects) manager->registerObject(object.get());
    manager->setup();
  }
  std::array<std::vector<double>, 2> seconds;
  std::array<std::uint64_t, 2> pairs{};
  for (int step = 0; step < kSteps; ++step) {
    swarm.drift();
    for (const auto& probe : probes.objects) swarm.place(*probe);
    for (std::size_t i = 0; i < managers.size(); ++i) {
      seconds[i].push_back(timeStep(*managers[i], queries == 0 ? nullptr : &probes.objects, pairs[i]));
    }
  }
  const bool isSame = pairs[0] == pairs[1] && agree(tree, ours);
  const double before = median(seconds[0]);
  const double now = median(seconds[1]);
  fmt::print("{:>6} objects, {:<24} {:9.1f} us by the tree, {:9.1f} by ours: {:.1f}{}\n", count, name, before * 1e6,
             now * 1e6, before / now, isSame ? "" : "; THE PAIRS DIFFER");
  return isSame;
}

}  // namespace

int main() {
  bool isSame = true;
  for (const std::size_t count : {std::size_t{20}, std::size_t{100}, std::size_t{1000}, std::size_t{10000}}) {
    isSame = compare("update, self-collision", count, 0) && isSame;
    isSame = compare("update, 20 queries", count, 20) && isSame;
  }
  return isSame ? EXIT_SUCCESS : EXIT_FAILURE;
}
