// SPDX-License-Identifier: MIT
// Moving boxes, frame after frame: the world beside our one-shot search and the peers that update, on the same frames,
// whose pairs are compared in each frame. Writes a line of CSV for each contender.
//   moving_benchmark [--boxes N] [--frames N] [--peer-frames N] [--scene NAME] [--setting NAME]... [--turn N]
//     [--output FILE]
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "MovingScene.h"
#include "MovingSearch.h"
#include "Provenance.h"
#include "RunMain.h"
#include "Samples.h"
#include "Stopwatch.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"
#include "allpairs/scene/FileError.h"

namespace allpairs::bench {

namespace {

struct Request {
  std::size_t boxes = 100000;
  std::size_t frames = 200;
  std::size_t peerFrames = 20;
  std::string scene;
  std::vector<std::string> settings;
  std::string output;
  std::size_t stretch = 1;
};

/// A contender in a scene.
struct Entry {
  MovingContender contender;
  std::unique_ptr<MovingSearch> search;
  MovingScene scene;
  std::size_t frames = 0;
  std::vector<double> cpuMs;
  std::vector<double> wallMs;
  std::size_t wrongFrames = 0;
};

std::vector<Pair> sorted(std::vector<Pair> pairs) {
  for (Pair& pair : pairs) {
    if (pair.first > pair.second) std::swap(pair.first, pair.second);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// The next frame of a contender.
void step(Entry& entry) {
  entry.scene.advance();
  const std::vector<Pair> expected = overlaps(BoxView::fromRows(entry.scene.rows()));
  const measure::Stopwatch watch;
  entry.search->step(entry.scene);
  const measure::Duration took = watch.elapsed();
  entry.cpuMs.push_back(took.cpuMs);
  entry.wallMs.push_back(took.wallMs);
  std::vector<Pair> pairs;
  entry.search->collect(entry.scene, pairs);
  if (sorted(std::move(pairs)) != expected) ++entry.wrongFrames;
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

/// How many times longer an entry took than the first one: the median over the frames in which both took their turn,
/// which a burst of other work on the machine meets alike.
double ratioToFirst(const Entry& entry, const Entry& first) {
  std::vector<double> ratios;
  for (std::size_t frame = 0; frame < std::min(entry.cpuMs.size(), first.cpuMs.size()); ++frame) {
    ratios.push_back(entry.cpuMs[frame] / first.cpuMs[frame]);
  }
  return measure::median(ratios);
}

bool isWanted(const Request& request, const MovingContender& contender) {
  const std::vector<std::string>& wanted = request.settings;
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), contender.setting) != wanted.end();
}

std::vector<Entry> entriesFor(const Motion& motion, const Request& request) {
  std::vector<Entry> entries;
  for (const std::vector<MovingContender>& part : {ownContenders(), peerContenders()}) {
    for (const MovingContender& contender : part) {
      if (!isWanted(request, contender)) continue;
      const std::size_t frames = contender.own ? request.frames : std::min(request.frames, request.peerFrames);
      if (frames == 0) continue;
      entries.push_back({contender, contender.make(), MovingScene(motion, request.boxes, 1), frames, {}, {}, 0});
    }
  }
  return entries;
}

/// Runs all frames; contenders take turns of some frames each.
void run(std::vector<Entry>& entries, std::size_t stretch) {
  // The first frames build up what the later ones keep.
  constexpr std::size_t kWarmUp = 3;
  for (Entry& entry : entries) {
    entry.search->start(entry.scene);
    for (std::size_t frame = 0; frame < kWarmUp; ++frame) step(entry);
    entry.cpuMs.clear();
    entry.wallMs.clear();
  }
  for (bool goesOn = true; goesOn;) {
    goesOn = false;
    for (Entry& entry : entries) {
      for (std::size_t i = 0; i < stretch && entry.cpuMs.size() < entry.frames; ++i) step(entry);
      goesOn = goesOn || entry.cpuMs.size() < entry.frames;
    }
  }
}

void report(const Motion& motion, const Request& request, const std::vector<Entry>& entries, std::ofstream& csv) {
  const std::size_t pairs = overlaps(BoxView::fromRows(entries.front().scene.rows())).size();
  std::printf("%s, %zu boxes, %zu pairs, turns of %zu\n", motion.name.c_str(), request.boxes, pairs, request.stretch);
  const measure::Provenance provenance = measure::provenance();
  for (const Entry& entry : entries) {
    const double median = measure::median(entry.cpuMs);
    const double late = percentile(entry.cpuMs, 0.99);
    const double worst = percentile(entry.cpuMs, 1.0);
    const double ratio = ratioToFirst(entry, entries.front());
    std::printf("  %-10s %-32s median %8.3f ms  99%% %8.3f  worst %8.3f  of %zu frames  ratio %5.2f%s\n",
                entry.contender.name.c_str(), entry.contender.setting.c_str(), median, late, worst, entry.cpuMs.size(),
                ratio, entry.wrongFrames == 0 ? "" : "  WRONG PAIRS");
    if (csv.is_open()) {
      csv << provenance.commit << ',' << provenance.compiler << ',' << provenance.processor << ',' << motion.name << ','
          << request.boxes << ',' << pairs << ",\"" << entry.contender.name << "\",\"" << entry.contender.setting
          << "\"," << request.stretch << ',' << entry.cpuMs.size() << ',' << median << ',' << late << ',' << worst
          << ',' << measure::median(entry.wallMs) << ',' << ratio << ',' << entry.wrongFrames << '\n';
    }
  }
}

int runAll(const Request& request) {
  std::ofstream csv;
  if (!request.output.empty()) {
    csv.open(request.output);
    if (!csv) throw FileError(request.output, "can't be written");
    csv << "commit,compiler,processor,motion,boxes,pairs,contender,setting,turn_frames,frames,median_cpu_ms,p99_cpu_ms,"
           "worst_cpu_ms,median_wall_ms,median_ratio,wrong_frames\n";
  }
  bool right = true;
  bool isEmpty = true;
  for (const Motion& motion : motions()) {
    if (!request.scene.empty() && request.scene != motion.name) continue;
    std::vector<Entry> entries = entriesFor(motion, request);
    if (entries.empty()) continue;
    isEmpty = false;
    run(entries, request.stretch);
    report(motion, request, entries, csv);
    if (csv.is_open() && !csv.flush()) throw FileError(request.output, "can't be written");
    for (const Entry& entry : entries) right = right && entry.wrongFrames == 0;
  }
  if (isEmpty) throw InvalidArgument("there are no frames to measure");
  return right ? 0 : 1;
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const Motion& motion : motions()) names.push_back(motion.name);
  return names;
}

std::vector<std::string> settingNames() {
  std::vector<std::string> names;
  for (const std::vector<MovingContender>& part : {ownContenders(), peerContenders()}) {
    for (const MovingContender& contender : part) names.push_back(contender.setting);
  }
  return names;
}

}  // namespace

}  // namespace allpairs::bench

int main(int argc, char** argv) {
  allpairs::bench::Request request;
  CLI::App app{"Moving boxes, frame after frame, beside the peers that update"};
  app.add_option("--boxes", request.boxes, "How many boxes there are");
  app.add_option("--frames", request.frames, "How many frames ours are measured for");
  app.add_option("--peer-frames", request.peerFrames, "How many of them the peers are measured for");
  app.add_option("--scene", request.scene, "One scene only")->check(CLI::IsMember(allpairs::bench::sceneNames()));
  app.add_option("--setting", request.settings, "Only these settings (repeatable)")
      ->check(CLI::IsMember(allpairs::bench::settingNames()));
  app.add_option("--turn", request.stretch, "Frames of a contender's turn: from the second on the caches are its own")
      ->check(CLI::PositiveNumber);
  app.add_option("-o,--output", request.output, "A file of CSV for the records");
  return allpairs::bench::runMain(app, argc, argv, [&] { return allpairs::bench::runAll(request); });
}
