// SPDX-License-Identifier: MIT
// Queries against boxes that rest: a world beside the peers that answer the same, which take turns; what they give is
// compared, ids exactly, times and distances to a few roundings in float32, of rays all but a thousandth. Trees are made
// before the clock starts.
//
//   query_benchmark [--boxes N] [--queries N] [--output FILE]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include "QueryContest.h"
#include "RecordFile.h"
#include "RunMain.h"
#include "Stopwatch.h"

namespace {

using namespace allpairs;
using bench::Answers;
using bench::QueryContender;
using bench::QueryKind;
using bench::QueryScene;

constexpr std::size_t kRounds = 7;

/// Peers compute times and distances in float32; so near must they be to ours, in a room of side 1.
constexpr double kTolerance = 1e-5;

/// Of float32's rays some graze a box that exact ones miss: one ray in this many may differ.
constexpr std::size_t kOneInSoMany = 1000;

struct Request {
  std::size_t boxes = 100000;
  std::size_t queries = 100000;
  std::string output;
};

/// Cubes whose centres are spread evenly over the unit cube, of this volume together.
constexpr double kTotalVolume = 0.625;

QueryScene makeScene(const Request& request) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double edge = std::cbrt(kTotalVolume / static_cast<double>(request.boxes));
  QueryScene scene;
  const auto addCube = [&](std::vector<float>& rows, double side) {
    std::array<float, 6> row{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = uniform(random);
      row[axis] = static_cast<float>(low);
      row[axis + 3] = static_cast<float>(low + side);
    }
    rows.insert(rows.end(), row.begin(), row.end());
  };
  const auto anyPoint = [&] {
    std::array<double, 3> point{};
    for (double& x : point) {
      const volatile float stored = static_cast<float>(uniform(random));  // GCC 12 leaves out what is not stored
      x = static_cast<double>(stored);
    }
    return point;
  };
  for (std::size_t i = 0; i < request.boxes; ++i) addCube(scene.rows, edge);
  for (std::size_t i = 0; i < request.queries; ++i) {
    addCube(scene.boxes, edge);
    Ray ray{anyPoint(), anyPoint(), 1.0};
    for (double& x : ray.direction) x -= 0.5;
    scene.rays.push_back(ray);
    scene.points.push_back(anyPoint());
  }
  return scene;
}

/// The numbers of each query in ascending order.
Answers sorted(Answers answers) {
  std::size_t begin = 0;
  for (const std::size_t end : answers.ends) {
    std::sort(answers.numbers.begin() + static_cast<std::ptrdiff_t>(begin),
              answers.numbers.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
  return answers;
}

bool areSame(std::span<const double> a, std::span<const double> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](double x, double y) { return x == y || std::abs(x - y) <= kTolerance; });
}

bool agree(QueryKind kind, const Answers& a, const Answers& b) {
  if (a.ends.size() != b.ends.size()) return false;
  std::size_t different = 0;
  std::size_t beginA = 0;
  std::size_t beginB = 0;
  for (std::size_t i = 0; i < a.ends.size(); ++i) {
    const std::span<const double> ofA(a.numbers.data() + beginA, a.ends[i] - beginA);
    const std::span<const double> ofB(b.numbers.data() + beginB, b.ends[i] - beginB);
    different += areSame(ofA, ofB) ? 0U : 1U;
    beginA = a.ends[i];
    beginB = b.ends[i];
  }
  const bool ofRays = kind == QueryKind::FirstHit || kind == QueryKind::AllHits;
  return ofRays ? different * kOneInSoMany <= a.ends.size() : different == 0;
}

std::vector<QueryContender> contendersFor(const QueryScene& scene) {
  std::vector<QueryContender> contenders;
  bench::addOwnIndices(scene, contenders);
#ifdef ALLPAIRS_PEER_EMBREE
  bench::addEmbreeIndex(scene, contenders);
#endif
#ifdef ALLPAIRS_PEER_BOOST_GEOMETRY
  bench::addBoostIndex(scene, contenders);
#endif
  return contenders;
}

/// One kind of query, by all that answer it, the first being ours; whether they agree.
bool run(std::size_t kind, const QueryScene& scene, std::vector<QueryContender>& contenders, bench::RecordFile& file) {
  std::vector<std::vector<double>> cpuMs(contenders.size());
  for (std::size_t round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      if (!contenders[i].index->answers(bench::kQueryKinds[kind])) continue;
      const measure::Stopwatch watch;
      contenders[i].index->run(bench::kQueryKinds[kind], scene);
      cpuMs[i].push_back(watch.elapsed().cpuMs);
    }
  }
  Answers expected;
  bool right = true;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    if (cpuMs[i].empty()) continue;
    Answers answers;
    contenders[i].index->collect(answers);
    answers = sorted(std::move(answers));
    const bool same = i == 0 || agree(bench::kQueryKinds[kind], expected, answers);
    right = right && same;
    std::printf("%-18s %-16s %-20s %10zu %10.2f %8.0f%s\n", bench::kQueryNames[kind], contenders[i].name.c_str(),
                contenders[i].setting.c_str(), answers.numbers.size(), measure::median(cpuMs[i]),
                1e6 * measure::median(cpuMs[i]) / static_cast<double>(scene.rays.size()), same ? "" : "  DIFFERS");
    file.add({bench::kQueryNames[kind], std::to_string(scene.rows.size() / 6) + " boxes", scene.rays.size(),
              contenders[i].name, contenders[i].setting, answers.numbers.size(), cpuMs[i], same});
    if (i == 0) expected = std::move(answers);
  }
  return right;
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app{"Queries against boxes, beside the peers that answer the same"};
  app.add_option("--boxes", request.boxes, "How many boxes there are");
  app.add_option("--queries", request.queries, "How many queries of each kind there are");
  app.add_option("-o,--output", request.output, "A file of CSV for the records");
  return allpairs::bench::runMain(app, argc, argv, [&] {
    bench::RecordFile file(request.output);
    const QueryScene scene = makeScene(request);
    std::vector<QueryContender> contenders = contendersFor(scene);
    std::printf("%-18s %-16s %-20s %10s %10s %8s\n", "query", "who", "how", "results", "ms", "ns each");
    bool right = true;
    for (std::size_t kind = 0; kind < bench::kQueryKinds.size(); ++kind)
      right = run(kind, scene, contenders, file) && right;
    return right ? 0 : 1;
  });
}
