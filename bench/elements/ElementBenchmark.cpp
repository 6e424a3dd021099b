// SPDX-License-Identifier: MIT
// Candidates of a deforming mesh, beside the packaged peers that are used for the same lists. A peer gets the boxes of
// the elements ready made, in float32, and searches them; then pairs with a common vertex are left out. Ours starts from
// positions, makes the boxes and compares in double, and its first line is the topology, which is made once.
//
//   element_benchmark START END        times are processor time in milliseconds, the least of several runs, one thread
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <functional>
#include <string>

#include "../Peer.h"
#include "ElementLists.h"
#include "Stopwatch.h"

namespace {

using namespace allpairs;
using bench::ElementStep;
using elements::CandidateKind;

constexpr int kRuns = 5;

constexpr std::array<CandidateKind, 3> kKinds{CandidateKind::VertexFace, CandidateKind::EdgeEdge,
                                              CandidateKind::FaceFace};
constexpr std::array<const char*, 3> kNames{"vertex-face", "edge-edge", "face-face"};

double leastMs(const std::function<void()>& run) {
  double least = 1e300;
  for (int i = 0; i < kRuns; ++i) {
    const measure::Stopwatch watch;
    run();
    least = std::min(least, watch.elapsed().cpuMs);
  }
  return least;
}

void show(const char* list, const std::string& who, std::size_t pairs, double ms) {
  std::printf("%-12s %-40s %10zu %10.2f\n", list, who.c_str(), pairs, ms);
  std::fflush(stdout);
}

/// One search from positions to the list, with nothing kept from before but the topology; and one that has run before.
void runOurs(const ElementStep& step, const elements::MeshTopology& topology, std::size_t i) {
  const auto search = [&](elements::ElementCandidates& candidates) {
    candidates.setPositions(0, std::span<const double>(step.start), step.end);
    return candidates.find(kKinds[i]).size();
  };
  std::size_t pairs = 0;
  const double once = leastMs([&] {
    elements::ElementCandidates candidates(topology, {.order = Order::Unordered});
    pairs = search(candidates);
  });
  show(kNames[i], "Allpairs", pairs, once);
  elements::ElementCandidates kept(topology, {.order = Order::Unordered});
  search(kept);
  show(kNames[i], "Allpairs, second step", pairs, leastMs([&] { search(kept); }));
}

void runPeers(const std::vector<float>& rows, const elements::MeshTopology& topology, std::size_t i) {
  for (const bench::Peer& peer : bench::packagedPeers()) {
    if (peer.name != "CGAL" && peer.name != "Embree" && peer.name != "FCL") continue;
    for (const bench::Setting& setting : peer.settings) {
      std::size_t pairs = 0;
      const double ms = leastMs([&] {
        const auto search = setting.make();
        pairs = bench::withoutShared(search->find(rows), kKinds[i], topology).size();
      });
      show(kNames[i], peer.name + ", " + setting.name, pairs, ms);
    }
  }
}

void runBetween([[maybe_unused]] const std::vector<float>& vertices, [[maybe_unused]] const std::vector<float>& faces,
                [[maybe_unused]] const elements::MeshTopology& topology) {
#ifdef ALLPAIRS_PEER_CGAL
  for (const std::ptrdiff_t cutoff : {10, 100, 1000}) {
    std::size_t pairs = 0;
    const double ms = leastMs(
        [&] { pairs = bench::withoutShared(bench::cgalBetween(vertices, faces, cutoff), kKinds[0], topology).size(); });
    show(kNames[0], "CGAL, boxes, cutoff " + std::to_string(cutoff), pairs, ms);
  }
#endif
}

void runAll(const ElementStep& step) {
  const elements::MeshView view{step.start.size() / 3, step.triangles};
  const elements::MeshTopology topology(view);
  show("topology", "Allpairs", topology.counts().edges, leastMs([&] { const elements::MeshTopology again(view); }));
  for (std::size_t i = 0; i < kKinds.size(); ++i) runOurs(step, topology, i);
  const std::vector<float> faces = faceRows(step, topology);
  runBetween(vertexRows(step), faces, topology);
  runPeers(edgeRows(step, topology), topology, 1);
  runPeers(faces, topology, 2);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: element_benchmark START END\n");
    return 2;
  }
  try {
    std::printf("%-12s %-40s %10s %10s\n", "list", "who", "pairs", "ms");
    runAll(bench::readStep(argv[1], argv[2]));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "element_benchmark: %s\n", error.what());
    return 3;
  }
}
