// SPDX-License-Identifier: MIT
// The seed's cycle, step after step: begin, add all, end, on box models of which some move between the steps. A broad
// phase that keeps its search compared with one that runs a full search in each step; in each step both lists are
// compared, off the clock.
//
//   cycle_benchmark [--models N...] [--share S...] [--output FILE]
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "RecordFile.h"
#include "RunMain.h"
#include "Stopwatch.h"
#include "allpairs/collision/BoxModel.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "allpairs/collision/MinProximityIntersection.h"

namespace {

using namespace allpairs;
using collision::BoxModel;
using collision::BruteForceBroadPhase;
using collision::CollisionModel;

/// Cubes with centres in the unit cube, of this volume together: about five others touch each, whatever their number.
constexpr double kTotalVolume = 0.625;

/// How far a model moves in a step, in edges.
constexpr double kWay = 0.1;

/// The steps that are measured, and those before them.
constexpr double kSeconds = 1.0;
constexpr std::size_t kMostSteps = 300;
constexpr std::size_t kFewestSteps = 15;
constexpr std::size_t kFirstSteps = 6;

struct Request {
  std::vector<std::size_t> sizes{217, 1000, 10000, 100000};
  std::vector<double> shares{0.0, 0.01, 0.1, 1.0};
  std::string output;
};

/// Cubes that move straight on and turn round where they leave the room.
class Cubes {
 public:
  Cubes(std::size_t count, double share)
      : m_edge(std::cbrt(kTotalVolume / static_cast<double>(count))), m_random(count) {
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (std::size_t i = 0; i < count; ++i) {
      Vector centre;
      Vector velocity;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        centre[axis] = uniform(m_random);
        velocity[axis] = (uniform(m_random) - 0.5) * kWay * m_edge;
      }
      m_centres.push_back(centre);
      m_velocities.push_back(velocity);
      m_moves.push_back(uniform(m_random) < share);
    }
  }

  void advance() {
    for (std::size_t i = 0; i < m_centres.size(); ++i) {
      for (std::size_t axis = 0; m_moves[i] && axis < 3; ++axis) {
        double& velocity = m_velocities[i][axis];
        double& place = m_centres[i][axis];
        if ((place < 0.0 && velocity < 0.0) || (place > 1.0 && velocity > 0.0)) velocity = -velocity;
        place += velocity;
      }
    }
  }

  [[nodiscard]] std::size_t size() const { return m_centres.size(); }
  [[nodiscard]] bool moves(std::size_t i) const { return m_moves[i]; }
  [[nodiscard]] Box box(std::size_t i) const {
    Box box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = m_centres[i][axis] - 0.5 * m_edge;
      box.max[axis] = m_centres[i][axis] + 0.5 * m_edge;
    }
    return box;
  }

 private:
  using Vector = std::array<double, 3>;

  double m_edge;
  std::mt19937_64 m_random;
  std::vector<Vector> m_centres;
  std::vector<Vector> m_velocities;
  std::vector<bool> m_moves;
};

/// A broad phase with models of its own, so that none finds in the cache what another has just read.
class Contender {
 public:
  Contender(const Cubes& cubes, bool keeps) : m_keeps(keeps) {
    for (std::size_t i = 0; i < cubes.size(); ++i) {
      m_models.push_back(std::make_unique<BoxModel>("box " + std::to_string(i), cubes.box(i)));
      m_models.back()->setOwner(m_models.back().get());
      m_numbers[m_models.back().get()] = i;
    }
    m_method.setAlarmDistance(0.0);
    m_phase.setIntersectionMethod(&m_method);
    m_phase.setKeepsSearch(keeps);
  }

  void move(const Cubes& cubes) {
    for (std::size_t i = 0; i < m_models.size(); ++i) {
      if (!cubes.moves(i)) continue;
      m_models[i]->setBox(0, cubes.box(i));
      m_models[i]->computeBoundingTree(0);
    }
  }

  void step() {
    const measure::Stopwatch watch;
    m_phase.beginBroadPhase();
    for (const auto& model : m_models) m_phase.addCollisionModel(model.get());
    m_phase.endBroadPhase();
    m_cpuMs.push_back(watch.elapsed().cpuMs);
  }

  /// The pairs of the last step, by the numbers of models.
  [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> pairs() {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const auto& [first, second] : m_phase.getCollisionModelPairs()) {
      pairs.emplace_back(m_numbers.at(first), m_numbers.at(second));
    }
    return pairs;
  }

  void forgetTimes() { m_cpuMs.clear(); }
  [[nodiscard]] const std::vector<double>& times() const { return m_cpuMs; }
  [[nodiscard]] const char* setting() const { return m_keeps ? "kept" : "anew"; }

 private:
  bool m_keeps;
  collision::MinProximityIntersection m_method;
  BruteForceBroadPhase m_phase;
  std::vector<std::unique_ptr<BoxModel>> m_models;
  std::unordered_map<const CollisionModel*, std::size_t> m_numbers;
  std::vector<double> m_cpuMs;
};

bool runSteps(Cubes& cubes, Contender& kept, Contender& anew) {
  bool right = true;
  double cpuMs = 0.0;
  for (std::size_t i = 0; i < kFirstSteps + kMostSteps; ++i) {
    if (i >= kFirstSteps + kFewestSteps && cpuMs > 1e3 * kSeconds) break;
    const measure::Stopwatch watch;
    if (i == kFirstSteps) kept.forgetTimes(), anew.forgetTimes();
    cubes.advance();
    for (Contender* contender : {&kept, &anew}) {
      contender->move(cubes);
      contender->step();
    }
    cpuMs += watch.elapsed().cpuMs;
    right = right && kept.pairs() == anew.pairs();
  }
  return right;
}

bool run(std::size_t models, double share, bench::RecordFile& file) {
  Cubes cubes(models, share);
  Contender kept(cubes, true);
  Contender anew(cubes, false);
  const bool right = runSteps(cubes, kept, anew);
  const std::size_t pairs = kept.pairs().size();
  const std::string subject = std::to_string(static_cast<int>(std::lround(100.0 * share))) + " % move";
  for (const Contender* contender : {&kept, &anew}) {
    file.add({"cycle", subject, models, "Allpairs", contender->setting(), pairs, contender->times(), right});
  }
  const double keptMs = measure::median(kept.times());
  const double anewMs = measure::median(anew.times());
  std::printf("%8zu %12s %9zu %10.4f %10.4f %6.2f %6zu%s\n", models, subject.c_str(), pairs, keptMs, anewMs,
              anewMs / keptMs, kept.times().size(), right ? "" : "  the two lists differ");
  return right;
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app{"The component's cycle on a scene of which some models move"};
  app.add_option("--models", request.sizes, "How many models there are");
  app.add_option("--share", request.shares, "Which share of them moves in each step");
  app.add_option("-o,--output", request.output, "A file of CSV for the records");
  return allpairs::bench::runMain(app, argc, argv, [&] {
    bench::RecordFile file(request.output);
    std::printf("%8s %12s %9s %10s %10s %6s %6s\n", "models", "motion", "pairs", "kept ms", "anew ms", "times",
                "steps");
    bool right = true;
    for (const std::size_t size : request.sizes) {
      for (const double share : request.shares) right = run(size, share, file) && right;
    }
    return right ? 0 : 1;
  });
}
