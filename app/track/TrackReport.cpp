// SPDX-License-Identifier: MIT
#include "track/TrackReport.h"

#include <fmt/format.h>

#include <algorithm>

#include "JsonText.h"
#include "cli/NpyOutput.h"
#include "cli/Text.h"

namespace allpairs::app {
namespace {

using view::JsonText;

struct Totals {
  std::uint64_t fewest = 0;
  std::uint64_t most = 0;
  std::uint64_t began = 0;
  std::uint64_t ended = 0;
};

Totals totalsOf(const std::vector<TrackedFrame>& frames) {
  Totals totals;
  if (!frames.empty()) totals.fewest = frames.front().pairs;
  for (const TrackedFrame& frame : frames) {
    totals.fewest = std::min(totals.fewest, frame.pairs);
    totals.most = std::max(totals.most, frame.pairs);
    totals.began += frame.began;
    totals.ended += frame.ended;
  }
  return totals;
}

std::string tableOf(const TrackReport& report) {
  const Totals totals = totalsOf(report.frames);
  const FrameTimes times = timesOf(report.frames);
  const double first = report.frames.empty() ? 0.0 : report.frames.front().milliseconds;
  std::string text =
      fmt::format("frames   {} of {}\n", grouped(report.frames.size()), counted(report.boxes, "box", "boxes"));
  text += fmt::format("distance {}\n", report.distance);
  text += fmt::format("pairs    {} to {} a frame\n", grouped(totals.fewest), grouped(totals.most));
  text += fmt::format("began    {}\nended    {}\n", grouped(totals.began), grouped(totals.ended));
  if (report.verified) text += "verify   searching each frame from scratch gives the same pairs and changes\n";
  text += fmt::format("time     {:.4f} ms median, {:.4f} ms 99th percentile, {:.4f} ms worst (frame {})\n",
                      times.medianMs, times.percentile99Ms, times.worstMs, times.worstFrame);
  text += fmt::format("first    {:.4f} ms; {} of the order since, on {}\n", first, counted(report.rebuilds, "rebuild"),
                      counted(report.threads, "thread"));
  return text;
}

std::string csvOf(const TrackReport& report) {
  std::string text = "frame,pairs,began,ended,milliseconds\n";
  for (std::size_t i = 0; i < report.frames.size(); ++i) {
    const TrackedFrame& frame = report.frames[i];
    text += fmt::format("{},{},{},{},{:.6g}\n", i, frame.pairs, frame.began, frame.ended, frame.milliseconds);
  }
  return text;
}

template <class Value>
void addColumn(const char* key, const std::vector<TrackedFrame>& frames, Value TrackedFrame::*member, JsonText& json) {
  json.beginList(key);
  for (const TrackedFrame& frame : frames) json.add({}, frame.*member);
  json.endList();
}

void addStatistics(const TrackReport& report, JsonText& json) {
  const FrameTimes times = timesOf(report.frames);
  const Totals totals = totalsOf(report.frames);
  json.beginObject("statistics");
  json.addReal("distance", report.distance);
  json.add("began", totals.began);
  json.add("ended", totals.ended);
  json.add("medianMs", times.medianMs);
  json.add("percentile99Ms", times.percentile99Ms);
  json.add("worstMs", times.worstMs);
  json.add("worstFrame", times.worstFrame);
  json.add("rebuilds", report.rebuilds);
  json.add("threads", report.threads);
  json.add("verified", report.verified);
  json.endObject();
}

std::string jsonOf(const TrackReport& report) {
  JsonText json(JsonText::Layout::Compact);
  json.beginObject();
  json.add("frames", report.frames.size());
  json.add("boxes", report.boxes);
  addColumn("pairs", report.frames, &TrackedFrame::pairs, json);
  addColumn("began", report.frames, &TrackedFrame::began, json);
  addColumn("ended", report.frames, &TrackedFrame::ended, json);
  addColumn("milliseconds", report.frames, &TrackedFrame::milliseconds, json);
  addStatistics(report, json);
  json.endObject();
  return json.text() + '\n';
}

void writeNpyTo(Output& output, const TrackReport& report) {
  NpyOutput file(output, "<f8", {report.frames.size(), 4});
  for (const TrackedFrame& frame : report.frames) {
    const std::array<double, 4> row{static_cast<double>(frame.pairs), static_cast<double>(frame.began),
                                    static_cast<double>(frame.ended), frame.milliseconds};
    file.add(row);
  }
}

}  // namespace

FrameTimes timesOf(const std::vector<TrackedFrame>& frames) {
  if (frames.empty()) return {};
  const std::size_t begin = frames.size() > 1 ? 1 : 0;
  std::vector<double> times;
  std::size_t worst = begin;
  for (std::size_t i = begin; i < frames.size(); ++i) {
    times.push_back(frames[i].milliseconds);
    if (frames[i].milliseconds > frames[worst].milliseconds) worst = i;
  }
  std::sort(times.begin(), times.end());
  const std::size_t rank99 = (99 * times.size() + 99) / 100;  // rounded up
  return {times[(times.size() - 1) / 2], times[rank99 - 1], frames[worst].milliseconds, worst};
}

void writeTrack(const TrackReport& report, const std::string& format, Output& output) {
  if (format == "npy") {
    writeNpyTo(output, report);
  } else if (format == "csv") {
    output.write(csvOf(report));
  } else {
    output.write(format == "json" ? jsonOf(report) : tableOf(report));
  }
}

}  // namespace allpairs::app
