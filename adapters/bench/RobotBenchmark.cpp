// SPDX-License-Identifier: MIT
// A robot of 50 links among obstacles, as motion planners ask FCL: does it collide with itself, and with the world? Our
// manager beside DynamicAABBTreeCollisionManager, in turns, on the same poses, each of which is another one. A manager
// is made for each pose, or kept and updated; several threads check poses against one world. What is timed is managers
// and their queries, with a callback that counts. Off the clock, the same is done with one that sums hashes of the
// pairs, which are compared too. Ends with 1 if some differ.
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "Median.h"
#include "ProcessorTime.h"
#include "allpairs/fcl/FclBroadPhaseManager.h"

namespace {

using Object = fcl::CollisionObjectd;
using Manager = fcl::BroadPhaseCollisionManagerd;

constexpr std::uint32_t kLinks = 50;
constexpr std::size_t kPoses = 16;  ///< So many are checked in one timing.
constexpr int kRounds = 41;

/// Of a link, or of an obstacle, each from a beginning of its own.
std::uint32_t numberOf(const Object& object) { return *static_cast<const std::uint32_t*>(object.getUserData()); }

bool countPair(Object*, Object*, void* count) {
  ++*static_cast<std::uint64_t*>(count);
  return false;
}

/// Sums hashes of pairs by the numbers of their bodies, which copies of a robot have in common.
bool hashPair(Object* a, Object* b, void* sum) {
  const auto [first, second] = std::minmax({numberOf(*a), numberOf(*b)});
  std::uint64_t mixed = (std::uint64_t{first} << 32U | second) * 0x9E3779B97F4A7C15U;
  mixed = (mixed ^ (mixed >> 29U)) * 0xBF58476D1CE4E5B9U;
  *static_cast<std::uint64_t*>(sum) += mixed ^ (mixed >> 32U);
  return false;
}

/// Read again for each query, so that no query is compiled for its callback.
fcl::CollisionCallBack<double> volatile callback = countPair;

/// Boxes that are owned, and FCL's pointers to them.
struct Bodies {
  std::vector<std::unique_ptr<Object>> owned;
  std::vector<Object*> objects;
  std::vector<std::unique_ptr<std::uint32_t>> numbers;
  std::uint32_t firstNumber = 0;

  void add(const std::shared_ptr<fcl::Boxd>& shape, const fcl::Vector3d& place, const fcl::Quaterniond& turn) {
    owned.push_back(std::make_unique<Object>(shape));
    owned.back()->setTranslation(place);
    owned.back()->setQuatRotation(turn);
    owned.back()->computeAABB();
    objects.push_back(owned.back().get());
    numbers.push_back(std::make_unique<std::uint32_t>(firstNumber + static_cast<std::uint32_t>(numbers.size())));
    owned.back()->setUserData(numbers.back().get());
  }
};

fcl::Quaterniond randomTurn(std::mt19937& random) {
  std::normal_distribution<double> part;
  return fcl::Quaterniond(part(random), part(random), part(random), part(random)).normalized();
}

/// The obstacles, with the robot's base in the middle: in a room of 2 m in which it moves, or a greater one where they
/// would be denser.
Bodies makeWorld(std::size_t count) {
  constexpr double kRoom = 0.03;  // cubic metres for each
  std::mt19937 random(1);
  const double half = std::max(1.0, std::cbrt(static_cast<double>(count) * kRoom) / 2.0);
  std::uniform_real_distribution<double> place(-half, half);
  const auto shape = std::make_shared<fcl::Boxd>(0.12, 0.08, 0.1);
  Bodies world;
  world.firstNumber = kLinks;
  for (std::size_t i = 0; i < count; ++i) {
    world.add(shape, {place(random), place(random), place(random)}, randomTurn(random));
  }
  return world;
}

/// A chain of links, each at the end of the one before. A pose is a body of its own, so that no timing moves anything.
Bodies makePose(std::mt19937& random) {
  const auto shape = std::make_shared<fcl::Boxd>(0.06, 0.06, 0.1);
  std::uniform_real_distribution<double> bend(-0.6, 0.6);
  Bodies robot;
  fcl::Vector3d place(0, 0, 0);
  fcl::Vector3d way(0, 0, 1);
  for (std::size_t link = 0; link < kLinks; ++link) {
    robot.add(shape, place, fcl::Quaterniond::FromTwoVectors(fcl::Vector3d(0, 0, 1), way));
    way = (way + fcl::Vector3d(bend(random), bend(random), bend(random))).normalized();
    place += way * 0.1;
  }
  return robot;
}

/// The robot of a program that keeps its objects and moves them: takes the boxes of a pose.
void assume(Bodies& robot, const Bodies& pose) {
  for (std::size_t i = 0; i < kLinks; ++i) {
    robot.objects[i]->setTransform(pose.objects[i]->getTransform());
    robot.objects[i]->computeAABB();
  }
}

using Make = std::function<std::unique_ptr<Manager>()>;

const std::array<Make, 2> kMakes{[] { return std::make_unique<fcl::DynamicAABBTreeCollisionManagerd>(); },
                                 [] { return std::make_unique<allpairs::FclBroadPhaseManagerd>(); }};

std::unique_ptr<Manager> makeOf(const Make& make, const Bodies& bodies) {
  std::unique_ptr<Manager> manager = make();
  manager->registerObjects(bodies.objects);
  manager->setup();
  return manager;
}

/// What one kind of manager needs: its world, and a robot that it keeps.
struct Contender {
  Make make;
  std::unique_ptr<Manager> world;
  Bodies robot;
  std::unique_ptr<Manager> robotManager;
};

struct Scene {
  Bodies obstacles;
  std::array<Contender, kMakes.size()> contenders;

  explicit Scene(std::size_t count) : obstacles(makeWorld(count)) {
    for (std::size_t i = 0; i < kMakes.size(); ++i) {
      std::mt19937 random(7);
      contenders[i].make = kMakes[i];
      contenders[i].world = makeOf(kMakes[i], obstacles);
      contenders[i].robot = makePose(random);
      contenders[i].robotManager = makeOf(kMakes[i], contenders[i].robot);
    }
  }
};

/// One way to check a pose; returns how many pairs there are.
struct Check {
  const char* name;
  std::function<std::uint64_t(const Scene&, Contender&, Bodies&)> run;
};

std::uint64_t checkItself(const Make& make, const Bodies& pose) {
  std::uint64_t found = 0;
  makeOf(make, pose)->collide(&found, callback);
  return found;
}

std::uint64_t checkWorld(const Manager& world, const Bodies& pose) {
  std::uint64_t found = 0;
  for (Object* link : pose.objects) world.collide(link, &found, callback);
  return found;
}

std::uint64_t checkKept(Contender& own, const Bodies& pose, bool isWithWorld) {
  std::uint64_t found = 0;
  assume(own.robot, pose);
  own.robotManager->update();
  own.robotManager->collide(&found, callback);
  if (isWithWorld) own.robotManager->collide(own.world.get(), &found, callback);
  return found;
}

const std::array<Check, 5> kChecks{{
    {"self, fresh manager", [](const Scene&, Contender& own, Bodies& pose) { return checkItself(own.make, pose); }},
    {"self, kept and updated", [](const Scene&, Contender& own, Bodies& pose) { return checkKept(own, pose, false); }},
    {"world by link, kept", [](const Scene&, Contender& own, Bodies& pose) { return checkWorld(*own.world, pose); }},
    {"world by link, fresh", [](const Scene& scene, Contender& own,
                                Bodies& pose) { return checkWorld(*makeOf(own.make, scene.obstacles), pose); }},
    {"self and world, two managers",
     [](const Scene&, Contender& own, Bodies& pose) { return checkKept(own, pose, true); }},
}};

std::vector<Bodies> makePoses(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Bodies> poses;
  for (std::size_t i = 0; i < count; ++i) poses.push_back(makePose(random));
  return poses;
}

struct Times {
  std::array<std::vector<double>, kMakes.size()> seconds;
  std::array<std::uint64_t, kMakes.size()> found{};
  std::array<std::uint64_t, kMakes.size()> hashes{};

  /// Returns whether the pairs are the same.
  bool print(std::size_t obstacles, const std::string& name) const {
    const bool isSame = found[0] == found[1] && hashes[0] == hashes[1];
    const double theirs = median(seconds[0]);
    const double ours = median(seconds[1]);
    fmt::print("{:>5} obstacles, {:<30} tree {:9.2f} us, ours {:9.2f} us, ratio {:.2f}{}\n", obstacles, name,
               theirs * 1e6, ours * 1e6, theirs / ours, isSame ? "" : "; THE PAIRS DIFFER");
    return isSame;
  }
};

/// Each round has poses of its own; who begins changes from round to round.
bool compare(std::size_t obstacles, const Check& check) {
  Scene scene(obstacles);
  Times times;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Bodies> poses = makePoses(kPoses, 100 + static_cast<unsigned>(round));
    for (std::size_t turn = 0; turn < kMakes.size(); ++turn) {
      const std::size_t who = (turn + static_cast<std::size_t>(round)) % kMakes.size();
      const double start = processorSeconds();
      for (Bodies& pose : poses) times.found[who] += check.run(scene, scene.contenders[who], pose);
      times.seconds[who].push_back((processorSeconds() - start) / static_cast<double>(kPoses));
      callback = hashPair;
      for (Bodies& pose : poses) times.hashes[who] += check.run(scene, scene.contenders[who], pose);
      callback = countPair;
    }
  }
  return times.print(obstacles, check.name);
}

/// Threads that check poses of their own, each against itself with a fresh manager and against one world. Processor
/// time of all threads, per pose.
bool compareThreads(std::size_t obstacles, std::size_t threadCount) {
  constexpr int kThreadRounds = 15;
  constexpr std::size_t kPosesOfThread = 64;
  Scene scene(obstacles);
  Times times;
  std::vector<std::vector<Bodies>> poses;
  for (unsigned i = 0; i < threadCount; ++i) poses.push_back(makePoses(kPosesOfThread, 1000 + i));
  for (int round = 0; round < kThreadRounds; ++round) {
    for (std::size_t turn = 0; turn < kMakes.size(); ++turn) {
      const std::size_t who = (turn + static_cast<std::size_t>(round)) % kMakes.size();
      const Contender& own = scene.contenders[who];
      std::vector<std::uint64_t> found(threadCount * 8);  // a cache line for each
      const double start = processorSeconds();
      std::vector<std::thread> threads;
      for (std::size_t i = 0; i < threadCount; ++i) {
        threads.emplace_back([&, i] {
          for (const Bodies& pose : poses[i])
            found[8 * i] += checkItself(own.make, pose) + checkWorld(*own.world, pose);
        });
      }
      for (std::thread& thread : threads) thread.join();
      times.seconds[who].push_back((processorSeconds() - start) / static_cast<double>(threadCount * kPosesOfThread));
      for (const std::uint64_t count : found) times.found[who] += count;
      callback = hashPair;
      for (std::size_t i = 0; round == 0 && i < threadCount; ++i) {
        for (const Bodies& pose : poses[i])
          times.hashes[who] += checkItself(own.make, pose) + checkWorld(*own.world, pose);
      }
      callback = countPair;
    }
  }
  return times.print(obstacles, fmt::format("{} threads, self and world", threadCount));
}

}  // namespace

int main() {
  bool isSame = true;
  for (const std::size_t obstacles : {20U, 50U, 200U, 1000U, 5000U}) {
    for (const Check& check : kChecks) isSame = compare(obstacles, check) && isSame;
    for (const std::size_t threads : {1U, 2U, 4U, 8U}) isSame = compareThreads(obstacles, threads) && isSame;
  }
  return isSame ? EXIT_SUCCESS : EXIT_FAILURE;
}
