// SPDX-License-Identifier: MIT
// The time of the component, not of the raw engine: a step of BruteForceBroadPhase (begin, add all, end) on box models
// in nodes of their own, beside the plain double loop with virtual calls (Strategy::Exhaustive) on the same models: a
// step with a full rebuild, and one after which nothing has moved, which keeps the last search. All lists are compared
// before anything is timed.
//
//   component_benchmark [MODELS...]        the default is 217 1000 10000
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "allpairs/Overlaps.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/MinProximityIntersection.h"

namespace {

using allpairs::Box;
using allpairs::Strategy;
using allpairs::collision::BoxModel;
using allpairs::collision::BruteForceBroadPhase;
using allpairs::collision::CollisionModel;
using allpairs::collision::CollisionModelPair;

/// Cubes with centres in the unit cube, of this volume together: about five others touch each, whatever their number.
constexpr double kTotalVolume = 0.625;

/// A median of few repetitions jumps about; one of many takes long. Half a second of them, and at least three.
constexpr double kSecondsPerCase = 0.5;
constexpr std::size_t kMinRepetitions = 3;
constexpr std::size_t kMaxRepetitions = 2000;

struct World {
  std::vector<std::unique_ptr<BoxModel>> owned;
  std::vector<CollisionModel*> models;
};

World makeWorld(std::size_t n) {
  std::mt19937_64 random(n);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double edge = std::cbrt(kTotalVolume / static_cast<double>(n));
  World world;
  for (std::size_t i = 0; i < n; ++i) {
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double centre = uniform(random);
      box.min[axis] = centre - edge / 2.0;
      box.max[axis] = centre + edge / 2.0;
    }
    world.owned.push_back(std::make_unique<BoxModel>("box " + std::to_string(i), box));
    world.owned.back()->setOwner(world.owned.back().get());
    world.models.push_back(world.owned.back().get());
  }
  return world;
}

void step(BruteForceBroadPhase& phase, const World& world) {
  phase.beginBroadPhase();
  for (CollisionModel* model : world.models) phase.addCollisionModel(model);
  phase.endBroadPhase();
}

double processorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Timing {
  double median = 0.0;  // seconds
  double low = 0.0;     // the 10th percentile
  double high = 0.0;    // the 90th
  std::size_t repetitions = 0;
};

template <class Step>
Timing timeOf(const Step& step) {
  std::vector<double> seconds;
  double total = 0.0;
  while (seconds.size() < kMinRepetitions || (total < kSecondsPerCase && seconds.size() < kMaxRepetitions)) {
    const double start = processorSeconds();
    step();
    seconds.push_back(processorSeconds() - start);
    total += seconds.back();
  }
  std::sort(seconds.begin(), seconds.end());
  const std::size_t n = seconds.size();
  return {seconds[n / 2], seconds[n / 10], seconds[n - 1 - n / 10], n};
}

/// The raw engine on the same boxes, in the order in which the component needs its pairs.
Timing timeEngine(const World& world) {
  std::vector<Box> boxes;
  for (const auto& model : world.owned) boxes.push_back(model->boxes().front());
  allpairs::OverlapOptions options;
  options.order = allpairs::Order::BySecond;
  allpairs::OverlapSearch search(options);
  return timeOf([&] { static_cast<void>(search.find(std::span<const Box>(boxes))); });
}

/// FNV-1a over the list, by the models' places: the same for every run and machine.
std::uint64_t hashOf(const std::vector<CollisionModelPair>& pairs, const World& world) {
  std::vector<std::pair<const CollisionModel*, std::uint64_t>> places;
  for (std::size_t i = 0; i < world.models.size(); ++i) places.emplace_back(world.models[i], i);
  std::sort(places.begin(), places.end());
  const auto placeOf = [&](const CollisionModel* model) {
    return std::lower_bound(places.begin(), places.end(), std::pair{model, std::uint64_t{0}})->second;
  };
  std::uint64_t hash = 14695981039346656037ULL;
  for (const auto& [first, second] : pairs) {
    for (const std::uint64_t value : {placeOf(first), placeOf(second)}) hash = (hash ^ value) * 1099511628211ULL;
  }
  return hash;
}

bool runCase(std::size_t n) {
  const World world = makeWorld(n);
  allpairs::collision::MinProximityIntersection method;
  method.setAlarmDistance(0.0);
  BruteForceBroadPhase fast;
  BruteForceBroadPhase rebuilding;
  rebuilding.setKeepsSearch(false);
  BruteForceBroadPhase plain;
  plain.setStrategy(Strategy::Exhaustive);
  for (BruteForceBroadPhase* phase : {&fast, &rebuilding, &plain}) {
    phase->setIntersectionMethod(&method);
    phase->init();
    step(*phase, world);
  }
  if (fast.getCollisionModelPairs() != plain.getCollisionModelPairs() ||
      rebuilding.getCollisionModelPairs() != plain.getCollisionModelPairs()) {
    std::fprintf(stderr, "%zu models: the lists differ\n", n);
    return false;
  }
  const std::uint64_t hash = hashOf(fast.getCollisionModelPairs(), world);
  const Timing kept = timeOf([&] { step(fast, world); });
  const Timing ours = timeOf([&] { step(rebuilding, world); });
  const Timing loop = timeOf([&] { step(plain, world); });
  std::printf("%8zu %9zu %016llx %10.4f %9.4f %9.4f %6zu %10.4f %10.4f %11.3f %6zu %7.0f\n", n,
              fast.getCollisionModelPairs().size(), static_cast<unsigned long long>(hash), 1e3 * ours.median,
              1e3 * ours.low, 1e3 * ours.high, ours.repetitions, 1e3 * kept.median, 1e3 * timeEngine(world).median,
              1e3 * loop.median, loop.repetitions, loop.median / ours.median);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::size_t> sizes;
  for (int i = 1; i < argc; ++i) {
    std::size_t n = 0;
    const char* end = argv[i] + std::strlen(argv[i]);
    if (std::from_chars(argv[i], end, n).ptr != end || n == 0) {
      std::fprintf(stderr, "usage: component_benchmark [MODELS...]; '%s' is no number of models\n", argv[i]);
      return 2;
    }
    sizes.push_back(n);
  }
  if (sizes.empty()) sizes = {217, 1000, 10000};
  std::printf(
      "BruteForceBroadPhase, box models with an owner each, MinProximityIntersection, alarm 0, one thread, %s\n",
      std::string(allpairs::instructionSets().front()).c_str());
  std::printf("%8s %9s %16s %10s %9s %9s %6s %10s %10s %11s %6s %7s\n", "models", "pairs", "hash", "rebuild ms", "p10",
              "p90", "steps", "kept ms", "engine ms", "loop ms", "steps", "times");
  bool equal = true;
  for (const std::size_t n : sizes) equal = runCase(n) && equal;
  return equal ? 0 : 1;
}
