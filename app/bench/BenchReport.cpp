// SPDX-License-Identifier: MIT
#include "bench/BenchReport.h"

#include <fmt/format.h>

#include <string_view>

#include "JsonText.h"
#include "cli/Text.h"

namespace allpairs::app {
namespace {

using view::JsonText;

void addTimes(const std::string& prefix, const measure::Summary& times, JsonText& json) {
  json.add(prefix + "median_ms", times.medianMs);
  json.add(prefix + "median_cpu_ms", times.medianCpuMs);
  json.add(prefix + "min_ms", times.minMs);
  json.add(prefix + "max_ms", times.maxMs);
  json.add(prefix + "repetitions", times.repetitions);
}

std::string timesLine(std::string_view name, const measure::Summary& times) {
  return fmt::format("{:<12}{:.4f} ms median, {:.4f} ms processor time, {:.4f} to {:.4f} ms in {}\n", name,
                     times.medianMs, times.medianCpuMs, times.minMs, times.maxMs,
                     counted(times.repetitions, "repetition"));
}

void addProvenance(const measure::Provenance& provenance, JsonText& json) {
  json.add("commit", provenance.commit);
  json.add("compiler", provenance.compiler);
  json.add("build", provenance.buildType);
  json.add("processor", provenance.processor);
  json.add("date", provenance.date);
}

}  // namespace

std::string benchTable(const BenchRecord& r) {
  std::string text = fmt::format("{:<12}{}\n{:<12}{}\n{:<12}{}\n", "input", r.input, "n", r.boxes, "pairs", r.pairs);
  if (!r.hash.empty()) text += fmt::format("{:<12}{}\n", "hash", r.hash);
  text += timesLine("one-shot", r.oneShot) + timesLine("warm", r.warm);
  text += fmt::format("{:<12}{}, strategy {}, {}, {}\n", "search", r.order, r.strategy, counted(r.threads, "thread"),
                      r.instructionSet);
  text += fmt::format("{:<12}{} of boxes, {} of groups\n", "tests", r.work.boxTests, r.work.groupTests);
  return text + fmt::format("{:<12}{}, {}, {}, commit {}, {}\n", "machine", r.provenance.processor,
                            r.provenance.compiler, r.provenance.buildType, r.provenance.commit, r.provenance.date);
}

std::string benchJson(const BenchRecord& r) {
  JsonText json(JsonText::Layout::Indented);
  json.beginObject();
  json.add("input", r.input);
  json.add("n", r.boxes);
  json.add("pairs", r.pairs);
  if (!r.hash.empty()) json.add("hash", r.hash);
  json.add("box_tests", r.work.boxTests);
  json.add("group_tests", r.work.groupTests);
  addTimes("", r.oneShot, json);
  addTimes("warm_", r.warm, json);
  json.add("order", r.order);
  json.add("strategy", r.strategy);
  json.add("threads", r.threads);
  json.add("instruction_set", r.instructionSet);
  addProvenance(r.provenance, json);
  json.endObject();
  return json.text() + '\n';
}

}  // namespace allpairs::app
