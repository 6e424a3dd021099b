// SPDX-License-Identifier: MIT
// Looks for losing regimes: random scenes, each measured with the calls that users make and with all peers of
// bench/peers, a plain double loop and a plain sweep along one axis. Scenes differ from repetition to repetition,
// contenders take turns, and their pairs are compared. Times are processor time, medians, one thread.
//
//   hunt_benchmark [--seconds S] [--seed N] [--least-boxes N] [--most-boxes N] [--peer NAME] [--output FILE]
//   hunt_benchmark --scene-seed N [--seconds S]
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <set>
#include <string>

#include "Match.h"
#include "Random.h"
#include "Report.h"
#include "RunMain.h"
#include "SceneFamily.h"
#include "SetPeer.h"
#include "allpairs/Error.h"

namespace {

using namespace allpairs;

struct Arguments {
  double seconds = 60.0;
  std::uint64_t seed = 1;
  std::optional<std::uint64_t> sceneSeed;
  std::size_t leastBoxes = 0;
  std::size_t mostBoxes = bench::kMostBoxes;
  std::string output;
  bench::MatchOptions match;
};

template <class T>
void addPeerNames(std::set<std::string>& names) {
  for (const bool areTwo : {false, true}) {
    for (const bench::SetPeer<T>& peer : bench::setPeers<T>(areTwo)) names.insert(peer.name);
  }
}

std::set<std::string> peerNames() {
  std::set<std::string> names{"none"};
  addPeerNames<float>(names);
  addPeerNames<double>(names);
  return names;
}

void declare(CLI::App& app, Arguments& a) {
  app.add_option("--seconds", a.seconds, "For the whole hunt, or for the one scene")->capture_default_str();
  app.add_option("--seed", a.seed, "Of the hunt: which scenes, and in which order")->capture_default_str();
  app.add_option("--scene-seed", a.sceneSeed, "Only the scene of this seed, with the times of all contenders");
  app.add_option("--least-boxes", a.leastBoxes, "Leave out scenes of fewer boxes");
  app.add_option("--most-boxes", a.mostBoxes, "Leave out scenes of more boxes");
  app.add_option("--peer", a.match.peers, "Only these contenders besides ours, by name (repeatable); 'none' for none")
      ->check(CLI::IsMember(peerNames()));
  app.add_option("-o,--output", a.output, "Where all times go, as CSV");
}

/// On a terminal: how far the hunt is.
class Progress {
 public:
  void show(const bench::Report& report, double seconds) const {
    if (m_isTerminal) {
      std::fprintf(stderr, "\r%zu scenes, %.0f s, least ratio %.2f ", report.scenes(), seconds, report.worstRatio());
    }
  }
  void end() const {
    if (m_isTerminal) std::fprintf(stderr, "\n");
  }

 private:
  bool m_isTerminal = ::isatty(STDERR_FILENO) == 1;
};

int hunt(const Arguments& a) {
  if (a.leastBoxes > std::min(a.mostBoxes, bench::kMostBoxes)) throw InvalidArgument("no scene has so many boxes");
  bench::Report report(a.output);
  const Progress progress;
  const auto begin = std::chrono::steady_clock::now();
  generate::Random seeds(a.seed, 0);
  for (double elapsed = 0.0; elapsed < a.seconds;) {
    const bench::SceneFamily family = bench::familyOf(seeds.bits() >> 32U);
    if (family.boxes() >= a.leastBoxes && family.boxes() <= a.mostBoxes) {
      report.add(bench::holdMatch(family, a.match));
      progress.show(report, elapsed);
    }
    elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  progress.end();
  if (report.scenes() == 0) throw InvalidArgument("no scene of so many boxes was drawn in that time");
  report.print();
  return report.mistakes() == 0 ? 0 : 1;
}

int measureOne(const Arguments& a) {
  bench::MatchOptions options = a.match;
  options.all = true;
  options.seconds = options.carefulSeconds = a.seconds;
  const bench::MatchResult result = bench::holdMatch(bench::familyOf(*a.sceneSeed), options);
  bench::printInDetail(result);
  bench::Report report(a.output);
  report.add(result);
  return report.mistakes() == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Looks for scenes on which somebody is faster than Allpairs.");
  declare(app, arguments);
  return allpairs::bench::runMain(app, argc, argv,
                                  [&] { return arguments.sceneSeed ? measureOne(arguments) : hunt(arguments); });
}
