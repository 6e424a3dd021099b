// SPDX-License-Identifier: MIT
// Candidates of a deforming mesh, beside the packaged peers that are used for the same lists. A peer gets the boxes of
// the elements ready made, in float32, and searches them; then pairs with a common vertex are left out. Ours starts
// from positions, makes the boxes and compares in double, and its first line is the topology, which is made once.
//
//   element_benchmark [--output FILE] START END [START END ...]
//
// Times are processor time in milliseconds, the median of several rounds in which all take turns, one thread.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ElementLists.h"
#include "Peer.h"
#include "RecordFile.h"
#include "RunMain.h"
#include "Stopwatch.h"

namespace {

using namespace allpairs;
using bench::ElementStep;
using elements::CandidateKind;

constexpr int kRounds = 5;

constexpr std::array<CandidateKind, 3> kKinds{CandidateKind::VertexFace, CandidateKind::EdgeEdge,
                                              CandidateKind::FaceFace};
constexpr std::array<const char*, 3> kNames{"vertex-face", "edge-edge", "face-face"};

/// A way to make a list; run() returns how many pairs it has.
struct Contender {
  std::string who;
  std::string how;
  std::function<std::size_t()> run;
  std::size_t pairs = 0;
  std::vector<double> cpuMs{};
};

/// All contenders take turns, some rounds; then what they took is printed and written down.
void contest(const std::string& step, const char* list, std::vector<Contender> contenders, bench::RecordFile& file) {
  for (int round = 0; round < kRounds; ++round) {
    for (Contender& contender : contenders) {
      const measure::Stopwatch watch;
      contender.pairs = contender.run();
      contender.cpuMs.push_back(watch.elapsed().cpuMs);
    }
  }
  for (const Contender& c : contenders) {
    std::printf("%-20s %-12s %-10s %-32s %10zu %10.2f\n", step.c_str(), list, c.who.c_str(), c.how.c_str(), c.pairs,
                measure::median(c.cpuMs));
    // Boxes that are rounded outward have some more pairs, never fewer.
    const std::size_t ours = contenders.front().pairs;
    const bool right = c.who == contenders.front().who ? c.pairs == ours : c.pairs >= ours;
    file.add({list, step, c.pairs, c.who, c.how, c.pairs, c.cpuMs, right});
  }
  std::fflush(stdout);
}

/// One search from positions to the list, with nothing kept from before but the topology; and one that has run before.
void addOurs(const ElementStep& step, const elements::MeshTopology& topology, CandidateKind kind,
             std::vector<Contender>& contenders) {
  const auto search = [&step, kind](elements::ElementCandidates& candidates) {
    candidates.setPositions(0, std::span<const double>(step.start), step.end);
    return candidates.find(kind).size();
  };
  contenders.push_back({"Allpairs", "once", [&topology, search] {
                          elements::ElementCandidates candidates(topology, {.order = Order::Unordered});
                          return search(candidates);
                        }});
  const auto kept =
      std::make_shared<elements::ElementCandidates>(topology, elements::CandidateOptions{.order = Order::Unordered});
  search(*kept);
  contenders.push_back({"Allpairs", "second step", [kept, search] { return search(*kept); }});
}

void addPeers(const std::vector<float>& rows, const elements::MeshTopology& topology, CandidateKind kind,
              std::vector<Contender>& contenders) {
  for (const bench::Peer& peer : bench::packagedPeers()) {
    if (peer.name != "CGAL" && peer.name != "Embree" && peer.name != "FCL") continue;
    for (const bench::Setting& setting : peer.settings) {
      contenders.push_back({peer.name, setting.name, [&rows, &topology, kind, make = setting.make] {
                              const auto search = make();
                              return bench::withoutShared(search->find(rows), kind, topology).size();
                            }});
    }
  }
}

void addBetween([[maybe_unused]] const std::vector<float>& vertices, [[maybe_unused]] const std::vector<float>& faces,
                [[maybe_unused]] const elements::MeshTopology& topology,
                [[maybe_unused]] std::vector<Contender>& contenders) {
#ifdef ALLPAIRS_PEER_CGAL
  for (const std::ptrdiff_t cutoff : {10, 100, 1000}) {
    contenders.push_back({"CGAL", "boxes, cutoff " + std::to_string(cutoff), [&vertices, &faces, &topology, cutoff] {
                            return bench::withoutShared(bench::cgalBetween(vertices, faces, cutoff),
                                                        CandidateKind::VertexFace, topology)
                                .size();
                          }});
  }
#endif
}

void runAll(const ElementStep& step, const std::string& name, bench::RecordFile& file) {
  const elements::MeshView view{step.start.size() / 3, step.triangles};
  const elements::MeshTopology topology(view);
  contest(name, "topology",
          {{"Allpairs", "made once", [&view] { return elements::MeshTopology(view).counts().edges; }}}, file);
  const std::vector<float> vertices = vertexRows(step);
  const std::vector<float> edges = edgeRows(step, topology);
  const std::vector<float> faces = faceRows(step, topology);
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    std::vector<Contender> contenders;
    addOurs(step, topology, kKinds[i], contenders);
    if (kKinds[i] == CandidateKind::VertexFace) {
      addBetween(vertices, faces, topology, contenders);
    } else {
      addPeers(kKinds[i] == CandidateKind::EdgeEdge ? edges : faces, topology, kKinds[i], contenders);
    }
    contest(name, kNames[i], std::move(contenders), file);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  std::string output;
  CLI::App app{"Candidates of deforming meshes, beside the packaged peers that are used for the same lists"};
  app.add_option("FILES", files, "Meshes at the start and at the end of a step, by turns")->required();
  app.add_option("-o,--output", output, "A file of CSV for the records");
  return allpairs::bench::runMain(app, argc, argv, [&] {
    if (files.size() % 2 != 0) throw InvalidArgument("a step has a START and an END");
    bench::RecordFile file(output);
    std::printf("%-20s %-12s %-10s %-32s %10s %10s\n", "step", "list", "who", "how", "pairs", "ms");
    for (std::size_t i = 0; i < files.size(); i += 2) {
      const std::string step = std::filesystem::path(files[i]).parent_path().filename().string();
      runAll(bench::readStep(files[i], files[i + 1]), step, file);
    }
    return 0;
  });
}
