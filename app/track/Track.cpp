// SPDX-License-Identifier: MIT
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "Commands.h"
#include "allpairs/Overlaps.h"
#include "allpairs/World.h"
#include "allpairs/collision/BruteForceBroadPhase.h"
#include "cli/Arguments.h"
#include "cli/ExitStatus.h"
#include "cli/NpyOutput.h"
#include "cli/Options.h"
#include "cli/Output.h"
#include "cli/Progress.h"
#include "cli/Terminal.h"
#include "cli/Text.h"
#include "cli/Timer.h"
#include "detect/Detection.h"
#include "input/Inputs.h"
#include "track/FrameSource.h"
#include "track/TrackReport.h"

namespace allpairs::app {
namespace {

struct TrackSettings {
  InputSettings input;
  std::string distance = "0";
  std::string threads = "1";
  std::string format;
  std::string output;
  bool verify = false;
};

constexpr const char* kTrackExamples =
    R"(FRAMES is a NumPy array (t, n, 6), float32 or float64: t frames of n boxes, minx miny
minz maxx maxy maxz; or one mesh file per frame, whose boxes are those of the triangles.
A folder is one frame: all mesh files in it. Triangles that share a vertex are never
paired.

For each frame it counts the pairs, those that began and those that ended since the
previous frame, and measures the time to move all boxes and find the pairs.

Examples:
  allpairs generate brownian -n 10000 --frames 200 -o frames.npy
  allpairs track frames.npy
  allpairs track frames.npy --format csv -o frames.csv
  allpairs track cloth_*.ply --distance 0.001)";

/// Computes the changes of each frame by searching all boxes and comparing with the previous frame.
class Verification {
 public:
  Verification(double distance, PairPredicate accept) {
    OverlapOptions options;
    options.distance = distance;
    options.filter.accept = std::move(accept);
    m_search.setOptions(std::move(options));
  }

  void check(std::size_t frame, const BoxView& boxes, const StepResult& step) {
    const std::span<const Pair> found = m_search.find(boxes);
    std::vector<Pair> began;
    std::vector<Pair> ended;
    std::set_difference(found.begin(), found.end(), m_before.begin(), m_before.end(), std::back_inserter(began));
    std::set_difference(m_before.begin(), m_before.end(), found.begin(), found.end(), std::back_inserter(ended));
    const bool agree = std::ranges::equal(found, step.pairs) && std::ranges::equal(began, step.began) &&
                       std::ranges::equal(ended, step.ended);
    if (!agree) throw collision::VerificationError("verification failed: frame " + std::to_string(frame) + " differs");
    m_before.assign(found.begin(), found.end());
  }

 private:
  OverlapSearch m_search;
  std::vector<Pair> m_before;
};

/// Moves the boxes of a world frame by frame.
class Tracker {
 public:
  Tracker(const TrackSettings& settings, FrameSource& source) : m_settings(settings), m_source(source) {
    m_report.distance = parseDistance(settings.distance);
    m_report.boxes = source.boxCount();
  }

  TrackReport run() {
    const std::size_t count = m_source.frameCount();
    ProgressLine line;
    for (std::size_t frame = 0; frame < count; ++frame) {
      line.show(frame, count, "frame " + grouped(frame + 1) + " of " + grouped(count));
      const BoxView boxes = m_source.next();
      m_empty.look(boxes, frame * boxes.size());
      if (frame == 0) begin(boxes);
      const Timer timer;
      frame == 0 ? m_world->add(boxes, {}, m_ids) : m_world->move(m_ids, boxes);
      const StepResult step = m_world->step();
      const double milliseconds = 1e3 * timer.seconds();
      m_report.frames.push_back({step.pairs.size(), step.began.size(), step.ended.size(), milliseconds});
      if (m_verification) m_verification->check(frame, boxes, step);
    }
    if (m_world) m_report.rebuilds = m_world->statistics().rebuilds;
    line.clear();
    warnOfEmpty(m_settings.input, m_empty, m_report.boxes, "frame");
    return std::move(m_report);
  }

 private:
  void begin(const BoxView& boxes) {
    m_report.boxes = boxes.size();
    m_report.verified = m_settings.verify;
    m_executor = makeExecutor(parseThreads(m_settings.threads), boxes.size());
    if (m_executor) m_report.threads = m_executor->concurrency();
    WorldOptions options;
    options.distance = m_report.distance;
    options.accept = m_source.accept();
    options.executor = m_executor.get();
    m_world.emplace(options);
    m_ids.resize(boxes.size());
    if (m_settings.verify) m_verification.emplace(m_report.distance, m_source.accept());
  }

  const TrackSettings& m_settings;
  FrameSource& m_source;
  scene::EmptyBoxes m_empty;
  TrackReport m_report;
  std::unique_ptr<Executor> m_executor;
  std::optional<World> m_world;
  std::optional<Verification> m_verification;
  std::vector<BoxId> m_ids;
};

const std::vector<std::string> kTrackFormats = {"table", "csv", "json", "npy"};

void runTrack(const TrackSettings& settings) {
  static_cast<void>(parseThreads(settings.threads));
  const std::string format = formatOf(settings.format, settings.output, kTrackFormats);
  checkOutputs(settings.input);
  Output output(targetOf(settings.output));
  if (format == "npy") refuseTerminal(output);
  const std::unique_ptr<FrameSource> source = openFrames(settings.input);
  const TrackReport report = Tracker(settings, *source).run();
  writeTrack(report, format, output);
  output.commit();
  if (!settings.output.empty()) sayWritten(counted(report.frames.size(), "frame"), settings.output);
}

}  // namespace

void addTrack(CLI::App& program) {
  const auto settings = std::make_shared<TrackSettings>();
  CLI::App* command =
      program.add_subcommand("track", "Find the pairs that begin and end as boxes move, frame by frame");
  command->footer(kTrackExamples);
  command->add_option("FRAMES", settings->input.paths, "Boxes (t, n, 6) in a .npy file, or a mesh file for each frame")
      ->required()
      ->type_name("");
  addDistance(*command, settings->distance, "Report pairs up to D apart on every axis");
  addThreads(*command, settings->threads);
  command->add_flag("--verify", settings->verify, "Also search each frame from scratch; fail on any difference");
  addFormat(*command, settings->format, kTrackFormats);
  addReadLimits(*command, settings->input.limits);
  addOutput(*command, settings->output);
  command->callback([settings] {
    settings->input.outputs = {settings->output};
    withInputs(settings->input, [settings] { runTrack(*settings); });
  });
}

}  // namespace allpairs::app
