// SPDX-License-Identifier: MIT
// Candidates of a deforming mesh, beside the packaged peers that are used for the same lists. A peer gets the boxes of
// the elements ready made, in float32, and searches them; then pairs with a common vertex are left out. Ours starts
// from positions, makes the boxes and compares in double, and its first line is the topology, which is made once. Of a
// peer's list, those whose boxes overlap in double have to be ours.
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

/// A way to make a list; run() returns how many pairs it has, and gives them where it is asked for them, untimed.
struct Contender {
  std::string who;
  std::string how;
  std::function<std::size_t(std::vector<Pair>*)> run;
  std::size_t pairs = 0;
  std::vector<double> cpuMs{};
};

/// What a list is made of.
struct Task {
  const ElementStep& step;
  const elements::MeshTopology& topology;
  CandidateKind kind;
};

/// All contenders take turns, some rounds; then what they took is printed and written down. Returns whether all agree.
bool contest(const std::string& step, const char* list, std::vector<Contender> contenders, bench::RecordFile& file) {
  for (int round = 0; round < kRounds; ++round) {
    for (Contender& contender : contenders) {
      const measure::Stopwatch watch;
      contender.pairs = contender.run(nullptr);
      contender.cpuMs.push_back(watch.elapsed().cpuMs);
    }
  }
  std::vector<Pair> ours;
  contenders.front().run(&ours);
  bool allRight = true;
  for (const Contender& c : contenders) {
    std::vector<Pair> pairs;
    c.run(&pairs);
    const bool right = pairs == ours;
    allRight = allRight && right;
    std::printf("%-20s %-12s %-10s %-32s %10zu %10.2f%s\n", step.c_str(), list, c.who.c_str(), c.how.c_str(), c.pairs,
                measure::median(c.cpuMs), right ? "" : "  DIFFERS");
    file.add({list, step, c.pairs, c.who, c.how, c.pairs, c.cpuMs, right});
  }
  std::fflush(stdout);
  return allRight;
}

/// One search from positions to the list, with nothing kept from before but the topology; and one that has run before.
void addOurs(const Task& task, std::vector<Contender>& contenders) {
  const auto search = [task](elements::ElementCandidates& candidates, std::vector<Pair>* list) {
    candidates.setPositions(0, std::span<const double>(task.step.start), task.step.end);
    const auto found = candidates.find(task.kind);
    if (list != nullptr) {
      list->assign(found.begin(), found.end());
      std::sort(list->begin(), list->end());
    }
    return found.size();
  };
  contenders.push_back({"Allpairs", "once", [task, search](std::vector<Pair>* list) {
                          elements::ElementCandidates candidates(task.topology, {.order = Order::Unordered});
                          return search(candidates, list);
                        }});
  const auto kept = std::make_shared<elements::ElementCandidates>(
      task.topology, elements::CandidateOptions{.order = Order::Unordered});
  search(*kept, nullptr);
  contenders.push_back({"Allpairs", "second step", [kept, search](auto* list) { return search(*kept, list); }});
}

/// What a peer has found, as run() of a contender gives it.
std::size_t give(const Task& task, std::span<const Pair> found, std::vector<Pair>* list) {
  const std::vector<Pair> pairs = bench::withoutShared(found, task.kind, task.topology);
  if (list != nullptr) *list = bench::overlapping(pairs, task.kind, task.step, task.topology);
  return pairs.size();
}

void addPeers(const Task& task, const std::vector<float>& rows, std::vector<Contender>& contenders) {
  for (const bench::Peer& peer : bench::packagedPeers()) {
    if (peer.name != "CGAL" && peer.name != "Embree" && peer.name != "FCL") continue;
    for (const bench::Setting& setting : peer.settings) {
      contenders.push_back({peer.name, setting.name, [task, &rows, make = setting.make](std::vector<Pair>* list) {
                              const auto search = make();
                              return give(task, search->find(rows), list);
                            }});
    }
  }
}

void addBetween([[maybe_unused]] const Task& task, [[maybe_unused]] const std::vector<float>& vertices,
                [[maybe_unused]] const std::vector<float>& faces, [[maybe_unused]] std::vector<Contender>& contenders) {
#ifdef ALLPAIRS_PEER_CGAL
  for (const std::ptrdiff_t cutoff : {10, 100, 1000}) {
    contenders.push_back(
        {"CGAL", "boxes, cutoff " + std::to_string(cutoff), [task, &vertices, &faces, cutoff](std::vector<Pair>* list) {
           return give(task, bench::cgalBetween(vertices, faces, cutoff), list);
         }});
  }
#endif
}

bool runAll(const ElementStep& step, const std::string& name, bench::RecordFile& file) {
  const elements::MeshView view{step.start.size() / 3, step.triangles};
  const elements::MeshTopology topology(view);
  contest(name, "topology",
          {{"Allpairs", "made once", [&view](auto*) { return elements::MeshTopology(view).counts().edges; }}}, file);
  const std::vector<float> vertices = vertexRows(step);
  const std::vector<float> edges = edgeRows(step, topology);
  const std::vector<float> faces = faceRows(step, topology);
  bool right = true;
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    const Task task{step, topology, kKinds[i]};
    std::vector<Contender> contenders;
    addOurs(task, contenders);
    if (kKinds[i] == CandidateKind::VertexFace) {
      addBetween(task, vertices, faces, contenders);
    } else {
      addPeers(task, kKinds[i] == CandidateKind::EdgeEdge ? edges : faces, contenders);
    }
    right = contest(name, kNames[i], std::move(contenders), file) && right;
  }
  return right;
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
    bool right = true;
    for (std::size_t i = 0; i < files.size(); i += 2) {
      const std::string step = std::filesystem::path(files[i]).parent_path().filename().string();
      right = runAll(bench::readStep(files[i], files[i + 1]), step, file) && right;
    }
    return right ? 0 : 1;
  });
}
