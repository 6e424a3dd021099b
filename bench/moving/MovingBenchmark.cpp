// SPDX-License-Identifier: MIT
// Moving boxes, frame after frame: the world beside our one-shot search and the peers that update, on the same frames,
// whose pairs are compared in each frame. Writes a line of CSV for each contender.
//   moving_benchmark [--boxes N] [--frames N] [--peer-frames N] [--scene NAME] [--setting NAME] [--output FILE]
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
#include "Samples.h"
#include "Stopwatch.h"
#include "allpairs/Error.h"
#include "allpairs/Overlaps.h"

namespace allpairs::bench {

namespace {

struct Request {
  std::size_t boxes = 100000;
  std::size_t frames = 200;
  std::size_t peerFrames = 20;
  std::string scene;
  std::string setting;
  std::string output;
};

/// A contender in a scene.
struct Entry {
  MovingContender contender;
  std::unique_ptr<MovingSearch> search;
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

void step(Entry& entry, const MovingScene& scene, const std::vector<Pair>& expected) {
  const measure::Stopwatch watch;
  entry.search->step(scene);
  const measure::Duration took = watch.elapsed();
  entry.cpuMs.push_back(took.cpuMs);
  entry.wallMs.push_back(took.wallMs);
  std::vector<Pair> pairs;
  entry.search->collect(scene, pairs);
  if (sorted(std::move(pairs)) != expected) ++entry.wrongFrames;
}

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

/// How many times longer an entry took than the first one: the median over the frames in which both took their turn, which
/// a burst of other work on the machine meets alike.
double ratioToFirst(const Entry& entry, const Entry& first) {
  std::vector<double> ratios;
  for (std::size_t frame = 0; frame < std::min(entry.cpuMs.size(), first.cpuMs.size()); ++frame) {
    ratios.push_back(entry.cpuMs[frame] / first.cpuMs[frame]);
  }
  return measure::median(ratios);
}

std::vector<Entry> run(const Motion& motion, const Request& request, std::size_t& pairs) {
  std::vector<Entry> entries;
  for (std::vector<MovingContender> part : {ownContenders(), peerContenders()}) {
    for (MovingContender& contender : part) {
      if (!request.setting.empty() && contender.setting != request.setting) continue;
      if (contender.own || request.peerFrames != 0) entries.push_back({contender, contender.make(), {}, {}, 0});
    }
  }
  MovingScene scene(motion, request.boxes, 1);
  for (Entry& entry : entries) entry.search->start(scene);
  // The first frames build up what the later ones keep.
  constexpr std::size_t kWarmUp = 3;
  for (std::size_t frame = 0; frame < kWarmUp + request.frames; ++frame) {
    scene.advance();
    const std::vector<Pair> expected = overlaps(BoxSet::fromRows(scene.rows()));
    pairs = expected.size();
    for (Entry& entry : entries) {
      if (!entry.contender.own && frame >= kWarmUp + request.peerFrames) continue;
      step(entry, scene, expected);
    }
    if (frame + 1 == kWarmUp) {
      for (Entry& entry : entries) entry.cpuMs.clear(), entry.wallMs.clear();
    }
  }
  return entries;
}

void report(const Motion& motion, const Request& request, const std::vector<Entry>& entries, std::size_t pairs,
            std::ofstream& csv) {
  std::printf("%s, %zu boxes, %zu pairs\n", motion.name.c_str(), request.boxes, pairs);
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
          << "\"," << entry.cpuMs.size() << ',' << median << ',' << late << ',' << worst << ','
          << measure::median(entry.wallMs) << ',' << ratio << ',' << entry.wrongFrames << '\n';
    }
  }
}

int runAll(const Request& request) {
  std::ofstream csv;
  if (!request.output.empty()) {
    csv.open(request.output);
    if (!csv) throw FileError(request.output, "can't be written");
    csv << "commit,compiler,processor,motion,boxes,pairs,contender,setting,frames,median_cpu_ms,p99_cpu_ms,"
           "worst_cpu_ms,median_wall_ms,median_ratio,wrong_frames\n";
  }
  bool right = true;
  for (const Motion& motion : motions()) {
    if (!request.scene.empty() && request.scene != motion.name) continue;
    std::size_t pairs = 0;
    const std::vector<Entry> entries = run(motion, request, pairs);
    report(motion, request, entries, pairs, csv);
    for (const Entry& entry : entries) right = right && entry.wrongFrames == 0;
  }
  return right ? 0 : 1;
}

}  // namespace

}  // namespace allpairs::bench

int main(int argc, char** argv) {
  allpairs::bench::Request request;
  CLI::App app{"Moving boxes, frame after frame, beside the peers that update"};
  app.add_option("--boxes", request.boxes, "How many boxes there are");
  app.add_option("--frames", request.frames, "How many frames ours are measured for");
  app.add_option("--peer-frames", request.peerFrames, "How many of them the peers are measured for");
  app.add_option("--scene", request.scene, "One scene only: straight, brownian, one-percent, slow");
  app.add_option("--setting", request.setting, "One setting only, such as world");
  app.add_option("-o,--output", request.output, "A file of CSV for the records");
  try {
    app.parse(argc, argv);
    return allpairs::bench::runAll(request);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "moving_benchmark: %s\n", error.what());
    return 2;
  }
}
