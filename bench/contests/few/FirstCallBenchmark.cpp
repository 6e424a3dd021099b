// SPDX-License-Identifier: MIT
// The first search of a process, which is all that many programs make: it finds cold caches, no memory, functions that
// are not bound yet and a processor that the library has not asked for its instruction sets. A process for each time,
// all contenders in turns; of a peer the fastest setting is printed.
//
//   first_call_benchmark [--rounds N]
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "RunMain.h"
#include "Samples.h"
#include "SetPeer.h"
#include "Stopwatch.h"
#include "allpairs/Overlaps.h"
#include "allpairs/generate/BoxScenes.h"

namespace {

using namespace allpairs;
using bench::SetPeer;
using bench::SetSetting;

constexpr int kNoContender = -1;

struct Arguments {
  int rounds = 15;
  int contender = kNoContender;  // Of a process that was started to measure it.
  std::size_t boxes = 100;
  std::uint64_t seed = 1;
};

class Overlaps final : public bench::SetSearch<float> {
 public:
  std::span<const Pair> find(const bench::Sets<float>& sets) override {
    m_pairs = overlaps(BoxView::fromRows(sets.first));
    return m_pairs;
  }
  void clear() override { m_pairs = {}; }

 private:
  std::vector<Pair> m_pairs;
};

/// overlaps(), and a contender for each setting of each peer.
std::vector<SetPeer<float>> makeContenders() {
  std::vector<SetPeer<float>> contenders{{"overlaps()", {{"", [] { return std::make_unique<Overlaps>(); }}}}};
  for (const SetPeer<float>& peer : bench::setPeers<float>(false)) {
    for (const SetSetting<float>& setting : peer.settings) contenders.push_back({peer.name, {setting}});
  }
  return contenders;
}

/// In a process of its own: prints the microseconds of one search.
int measureHere(const Arguments& a) {
  const auto search = makeContenders().at(static_cast<std::size_t>(a.contender)).settings.front().make();
  const std::vector<float> rows = generate::makeBoxes({.scene = "uniform", .count = a.boxes, .seed = a.seed});
  const measure::Stopwatch watch;
  const std::size_t pairs = search->find({rows, {}, false}).size();
  std::printf("%.3f %zu\n", 1e3 * watch.elapsed().cpuMs, pairs);
  return 0;
}

struct FirstCall {
  double microseconds = 0.0;
  std::size_t pairs = 0;
};

FirstCall measureInNewProcess(const Arguments& a) {
  const std::string command = "'" + std::filesystem::read_symlink("/proc/self/exe").string() + "' --contender " +
                              std::to_string(a.contender) + " --boxes " + std::to_string(a.boxes) + " --seed " +
                              std::to_string(a.seed);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> output(popen(command.c_str(), "r"), pclose);
  std::array<char, 80> line{};
  if (output == nullptr || std::fgets(line.data(), line.size(), output.get()) == nullptr) {
    throw std::runtime_error(command + " failed");
  }
  std::size_t end = 0;
  const std::string text(line.data());
  const double microseconds = std::stod(text, &end);
  return {microseconds, std::stoul(text.substr(end))};
}

/// The median of each contender, the least of those of one name.
std::map<std::string, double> compare(Arguments a) {
  const std::vector<SetPeer<float>> contenders = makeContenders();
  std::vector<std::vector<double>> times(contenders.size());
  for (int round = 0; round < a.rounds; ++round) {
    a.seed = static_cast<std::uint64_t>(round) + 1;
    std::size_t expected = 0;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      a.contender = static_cast<int>(i);
      const FirstCall call = measureInNewProcess(a);
      if (i == 0) expected = call.pairs;
      if (call.pairs != expected) throw std::runtime_error(contenders[i].name + " found another number of pairs");
      times[i].push_back(call.microseconds);
    }
  }
  std::map<std::string, double> medians;
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const auto [entry, isNew] = medians.try_emplace(contenders[i].name, std::numeric_limits<double>::infinity());
    entry->second = std::min(entry->second, measure::median(times[i]));
  }
  return medians;
}

int compareAll(Arguments a) {
  std::printf("Microseconds of processor time of the first search of a process, uniform boxes, medians.\n");
  for (const std::size_t boxes : {std::size_t{2}, std::size_t{100}, std::size_t{1000}, std::size_t{10000}}) {
    a.boxes = boxes;
    std::printf("\n%zu boxes\n", boxes);
    const std::map<std::string, double> medians = compare(a);
    const double ours = medians.at("overlaps()");
    for (const auto& [name, median] : medians)
      std::printf("  %-16s %10.1f %8.2f\n", name.c_str(), median, median / ours);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Compares the first search of a process.");
  app.add_option("--rounds", arguments.rounds, "Processes for each contender and number of boxes")
      ->capture_default_str();
  app.add_option("--contender", arguments.contender, "Measure this one here, by number")->group("");
  app.add_option("--boxes", arguments.boxes, "So many boxes")->group("");
  app.add_option("--seed", arguments.seed, "Of the boxes")->group("");
  return allpairs::bench::runMain(app, argc, argv, [&] {
    return arguments.contender == kNoContender ? compareAll(arguments) : measureHere(arguments);
  });
}
