// SPDX-License-Identifier: MIT
// Candidates of a deforming mesh, beside the packaged peers that are used for the same lists. A peer gets the boxes of
// the elements ready made, in float32, and searches them; then pairs with a common vertex are left out. Ours starts from
// positions, makes the boxes and compares in double, and its first line is the topology, which is made once.
//
//   element_benchmark [--output FILE] START END [START END ...]
//
// Times are processor time in milliseconds, the median of several runs, one thread.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>

#include "../Peer.h"
#include "../records/RecordFile.h"
#include "ElementLists.h"
#include "Stopwatch.h"

namespace {

using namespace allpairs;
using bench::ElementStep;
using elements::CandidateKind;

constexpr int kRuns = 3;

constexpr std::array<CandidateKind, 3> kKinds{CandidateKind::VertexFace, CandidateKind::EdgeEdge,
                                              CandidateKind::FaceFace};
constexpr std::array<const char*, 3> kNames{"vertex-face", "edge-edge", "face-face"};

std::vector<double> timesOf(const std::function<void()>& run) {
  std::vector<double> cpuMs;
  for (int i = 0; i < kRuns; ++i) {
    const measure::Stopwatch watch;
    run();
    cpuMs.push_back(watch.elapsed().cpuMs);
  }
  return cpuMs;
}

/// Prints what a contender took, and writes it down.
class Show {
 public:
  Show(std::string step, bench::RecordFile& file) : m_step(std::move(step)), m_file(file) {}

  void operator()(const char* list, const std::string& who, const std::string& how, std::size_t pairs,
                  const std::vector<double>& cpuMs) {
    std::printf("%-20s %-12s %-10s %-32s %10zu %10.2f\n", m_step.c_str(), list, who.c_str(), how.c_str(), pairs,
                measure::median(cpuMs));
    std::fflush(stdout);
    m_file.add({list, m_step, pairs, who, how, pairs, cpuMs, true});
  }

 private:
  std::string m_step;
  bench::RecordFile& m_file;
};

/// One search from positions to the list, with nothing kept from before but the topology; and one that has run before.
void runOurs(const ElementStep& step, const elements::MeshTopology& topology, std::size_t i, Show& show) {
  const auto search = [&](elements::ElementCandidates& candidates) {
    candidates.setPositions(0, std::span<const double>(step.start), step.end);
    return candidates.find(kKinds[i]).size();
  };
  std::size_t pairs = 0;
  const std::vector<double> once = timesOf([&] {
    elements::ElementCandidates candidates(topology, {.order = Order::Unordered});
    pairs = search(candidates);
  });
  show(kNames[i], "Allpairs", "once", pairs, once);
  elements::ElementCandidates kept(topology, {.order = Order::Unordered});
  search(kept);
  show(kNames[i], "Allpairs", "second step", pairs, timesOf([&] { search(kept); }));
}

void runPeers(const std::vector<float>& rows, const elements::MeshTopology& topology, std::size_t i, Show& show) {
  for (const bench::Peer& peer : bench::packagedPeers()) {
    if (peer.name != "CGAL" && peer.name != "Embree" && peer.name != "FCL") continue;
    for (const bench::Setting& setting : peer.settings) {
      std::size_t pairs = 0;
      const std::vector<double> cpuMs = timesOf([&] {
        const auto search = setting.make();
        pairs = bench::withoutShared(search->find(rows), kKinds[i], topology).size();
      });
      show(kNames[i], peer.name, setting.name, pairs, cpuMs);
    }
  }
}

void runBetween([[maybe_unused]] const std::vector<float>& vertices, [[maybe_unused]] const std::vector<float>& faces,
                [[maybe_unused]] const elements::MeshTopology& topology, [[maybe_unused]] Show& show) {
#ifdef ALLPAIRS_PEER_CGAL
  for (const std::ptrdiff_t cutoff : {10, 100, 1000}) {
    std::size_t pairs = 0;
    const std::vector<double> cpuMs = timesOf(
        [&] { pairs = bench::withoutShared(bench::cgalBetween(vertices, faces, cutoff), kKinds[0], topology).size(); });
    show(kNames[0], "CGAL", "boxes, cutoff " + std::to_string(cutoff), pairs, cpuMs);
  }
#endif
}

void runAll(const ElementStep& step, Show show) {
  const elements::MeshView view{step.start.size() / 3, step.triangles};
  const elements::MeshTopology topology(view);
  show("topology", "Allpairs", "made once", topology.counts().edges,
       timesOf([&] { const elements::MeshTopology again(view); }));
  for (std::size_t i = 0; i < kKinds.size(); ++i) runOurs(step, topology, i, show);
  const std::vector<float> faces = faceRows(step, topology);
  runBetween(vertexRows(step), faces, topology, show);
  runPeers(edgeRows(step, topology), topology, 1, show);
  runPeers(faces, topology, 2, show);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  std::string output;
  CLI::App app{"Candidates of deforming meshes, beside the packaged peers that are used for the same lists"};
  app.add_option("FILES", files, "Meshes at the start and at the end of a step, by turns")->required();
  app.add_option("-o,--output", output, "A file of CSV for the records");
  try {
    app.parse(argc, argv);
    if (files.size() % 2 != 0) throw InvalidArgument("a step has a START and an END");
    bench::RecordFile file(output);
    std::printf("%-20s %-12s %-10s %-32s %10s %10s\n", "step", "list", "who", "how", "pairs", "ms");
    for (std::size_t i = 0; i < files.size(); i += 2) {
      const std::string step = std::filesystem::path(files[i]).parent_path().filename().string();
      runAll(bench::readStep(files[i], files[i + 1]), Show(step, file));
    }
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "element_benchmark: %s\n", error.what());
    return 3;
  }
}
