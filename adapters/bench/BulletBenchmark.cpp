// SPDX-License-Identifier: MIT
// The broad phase of a Bullet world, step by step: ours beside btDbvtBroadphase, on the same boxes in the same run. The
// boxes are those of real bodies that fall into a pile, and of a gas, moving and at rest; what is timed is what Bullet
// asks of a broad phase in a step, setAabb() of every body and calculateOverlappingPairs(). The pairs of each step that
// are exact are compared, off the clock. Ends with 1 if some differ.
//   bullet_benchmark [BODIES [STEPS]]
#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "Median.h"
#include "Number.h"
#include "ProcessorTime.h"
#include "allpairs/bullet/BulletBroadphase.h"

namespace {

struct Bounds {
  btVector3 min;
  btVector3 max;
};

using Frame = btAlignedObjectArray<Bounds>;
using Film = std::vector<Frame>;

/// The boxes that Bullet gave a broad phase in one step.
Frame frameOf(btCollisionWorld& world) {
  Frame frame;
  for (int i = 0; i < world.getNumCollisionObjects(); ++i) {
    const btBroadphaseProxy* proxy = world.getCollisionObjectArray()[i]->getBroadphaseHandle();
    frame.push_back({proxy->m_aabbMin, proxy->m_aabbMax});
  }
  return frame;
}

/// Balls and boxes that fall on a floor and each other.
Film pileOf(int count, int steps) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btBoxShape floor(btVector3(500, 1, 500));
  btBoxShape box(btVector3(btScalar(0.5), btScalar(0.4), btScalar(0.6)));
  btSphereShape ball(btScalar(0.5));
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  const int side = static_cast<int>(std::cbrt(static_cast<double>(count)) + 1.0);
  for (int i = 0; i <= count; ++i) {
    btCollisionShape& shape = i == 0       ? static_cast<btCollisionShape&>(floor)
                              : i % 2 == 0 ? static_cast<btCollisionShape&>(box)
                                           : ball;
    btVector3 inertia(0, 0, 0);
    if (i != 0) shape.calculateLocalInertia(1, inertia);
    bodies.push_back(std::make_unique<btRigidBody>(btScalar(i == 0 ? 0 : 1), nullptr, &shape, inertia));
    btTransform pose = btTransform::getIdentity();
    const btVector3 place(btScalar(i % side), btScalar(i / side % side), btScalar(i / side / side));
    pose.setOrigin(i == 0 ? btVector3(0, -2, 0) : place * btScalar(1.15) + btVector3(0, 1, btScalar(i % 7) / 20));
    bodies.back()->setWorldTransform(pose);
    bodies.back()->setActivationState(DISABLE_DEACTIVATION);
    world.addRigidBody(bodies.back().get());
  }
  Film film;
  for (int step = 0; step < steps; ++step) {
    world.stepSimulation(btScalar(1) / 60, 0);
    film.push_back(frameOf(world));
  }
  for (auto& body : bodies) world.removeRigidBody(body.get());
  return film;
}

/// Cubes that fly straight on in a box so large that each meets about five others.
Film gasOf(int count, int steps) {
  std::mt19937 random(1);
  const btScalar side = static_cast<btScalar>(std::cbrt(static_cast<double>(count) * 8.0 / 5.0));
  std::uniform_real_distribution<btScalar> place(0, side);
  std::uniform_real_distribution<btScalar> motion(btScalar(-0.05), btScalar(0.05));
  std::vector<btVector3> places;
  std::vector<btVector3> motions;
  for (int i = 0; i < count; ++i) {
    places.emplace_back(place(random), place(random), place(random));
    motions.emplace_back(motion(random), motion(random), motion(random));
  }
  Film film;
  for (int step = 0; step < steps; ++step) {
    Frame frame;
    for (std::size_t i = 0; i < places.size(); ++i) {
      places[i] += motions[i];
      frame.push_back({places[i], places[i] + btVector3(1, 1, 1)});
    }
    film.push_back(frame);
  }
  return film;
}

/// The gas at rest: one of its boxes is elsewhere in each step.
Film restOf(const Film& gas) {
  Film film;
  for (std::size_t step = 0; step < gas.size(); ++step) {
    film.push_back(gas.front());
    const int moved = static_cast<int>(step) * 37 % gas.front().size();
    film.back()[moved] = gas[step][moved];
  }
  return film;
}

struct Timing {
  double moving = 0.0;
  double pairing = 0.0;
  int pairs = 0;
  std::size_t exactPairs = 0;

  [[nodiscard]] double total() const { return moving + pairing; }
};

using Pairs = std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>>;
using Numbers = std::unordered_map<const btBroadphaseProxy*, std::ptrdiff_t>;

/// The pairs of a cache that overlap by the boxes themselves, by the numbers of their bodies.
Pairs exactPairs(btOverlappingPairCache& cache, const Numbers& numbers) {
  Pairs exact;
  const btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) {
    const btBroadphaseProxy& a = *pairs[i].m_pProxy0;
    const btBroadphaseProxy& b = *pairs[i].m_pProxy1;
    bool isPair = true;
    for (int axis = 0; axis < 3; ++axis) {
      isPair = isPair && a.m_aabbMin[axis] <= b.m_aabbMax[axis] && b.m_aabbMin[axis] <= a.m_aabbMax[axis];
    }
    if (isPair) exact.emplace_back(std::minmax({numbers.at(&a), numbers.at(&b)}));
  }
  std::sort(exact.begin(), exact.end());
  return exact;
}

/// What a contender is shown, and the pairs of each step: the first to be asked writes them, the others compare.
struct Showing {
  const Film& film;
  std::vector<Pairs> expected{};
  bool isSame = true;

  void compare(std::size_t step, Pairs pairs) {
    if (step == expected.size())
      expected.push_back(std::move(pairs));
    else
      isSame = isSame && pairs == expected[step];
  }
};

/// Shows a film to a broad phase; the times are of a step, without the first ones.
Timing show(Showing& showing, btBroadphaseInterface& broadphase, bool compares) {
  const Film& film = showing.film;
  std::vector<btBroadphaseProxy*> proxies;
  Numbers numbers;
  for (int i = 0; i < film[0].size(); ++i) {
    proxies.push_back(broadphase.createProxy(film[0][i].min, film[0][i].max, 0, nullptr, 1, -1, nullptr));
    numbers[proxies.back()] = i;
  }
  Timing timing;
  const std::size_t first = film.size() / 4;
  for (std::size_t step = 0; step < film.size(); ++step) {
    const double start = processorSeconds();
    for (std::size_t i = 0; i < proxies.size(); ++i) {
      const Bounds& bounds = film[step][static_cast<int>(i)];
      broadphase.setAabb(proxies[i], bounds.min, bounds.max, nullptr);
    }
    const double middle = processorSeconds();
    broadphase.calculateOverlappingPairs(nullptr);
    const double end = processorSeconds();
    if (compares) showing.compare(step, exactPairs(*broadphase.getOverlappingPairCache(), numbers));
    if (step < first) continue;
    timing.moving += (middle - start) / static_cast<double>(film.size() - first);
    timing.pairing += (end - middle) / static_cast<double>(film.size() - first);
  }
  timing.pairs = broadphase.getOverlappingPairCache()->getNumOverlappingPairs();
  timing.exactPairs = exactPairs(*broadphase.getOverlappingPairCache(), numbers).size();
  for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
  return timing;
}

struct Contender {
  const char* name;
  std::function<std::unique_ptr<btBroadphaseInterface>()> make;
};

std::unique_ptr<btBroadphaseInterface> makeNumbered() {
  allpairs::BulletBroadphaseOptions options;
  options.number = [next = 0](const btBroadphaseProxy&) mutable { return next++; };
  return std::make_unique<allpairs::BulletBroadphase>(options);
}

/// Each is shown the film in turns; the first time the pairs are compared. Returns whether they are the same.
bool compare(const std::string& name, const Film& film) {
  constexpr int kRepetitions = 9;
  const std::array<Contender, 3> contenders{{
      {"btDbvtBroadphase", [] { return std::make_unique<btDbvtBroadphase>(); }},
      {"BulletBroadphase", [] { return std::make_unique<allpairs::BulletBroadphase>(); }},
      {"with numbers", makeNumbered},
  }};
  Showing showing{film};
  std::array<bool, contenders.size()> areSame{};
  std::array<std::vector<Timing>, contenders.size()> timings;
  for (int run = 0; run < kRepetitions; ++run) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      if (run == 0) showing.isSame = true;
      timings[i].push_back(show(showing, *contenders[i].make(), run == 0));
      if (run == 0) areSame[i] = showing.isSame;
    }
  }
  const Timing theirs = median(timings[0]);
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const Timing timing = median(timings[i]);
    fmt::print(
        "{:<12} {:<17} {:8.3f} ms a step ({:.3f} setAabb, {:.3f} pairs), {} pairs, {} of them exact, ratio {:.2f}{}\n",
        name, contenders[i].name, timing.total() * 1e3, timing.moving * 1e3, timing.pairing * 1e3, timing.pairs,
        timing.exactPairs, theirs.total() / timing.total(), areSame[i] ? "" : "; THE PAIRS DIFFER");
  }
  return std::all_of(areSame.begin(), areSame.end(), [](bool isSame) { return isSame; });
}

}  // namespace

int main(int count, char** arguments) {
  const int bodies = numberAt(1, count, arguments, 10000);
  const int steps = numberAt(2, count, arguments, 120);
  const Film gas = gasOf(bodies, steps);
  bool isSame = compare("gas", gas);
  isSame = compare("at rest", restOf(gas)) && isSame;
  isSame = compare("pile", pileOf(bodies, steps)) && isSame;
  return isSame ? EXIT_SUCCESS : EXIT_FAILURE;
}
