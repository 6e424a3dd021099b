// SPDX-License-Identifier: MIT
#include "bench/BenchReport.h"

#include <fmt/format.h>

#include <string_view>

#include "cli/Text.h"

namespace allpairs::app {
namespace {

/// A text in JSON's quotes. Ours hold no control characters but those that a file's name may bring.
std::string jsonQuoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string timesJson(std::string_view prefix, const measure::Summary& times) {
  return fmt::format(
      "  \"{0}median_ms\": {1:.6g},\n  \"{0}median_cpu_ms\": {2:.6g},\n  \"{0}min_ms\": {3:.6g},\n"
      "  \"{0}max_ms\": {4:.6g},\n  \"{0}repetitions\": {5},\n",
      prefix, times.medianMs, times.medianCpuMs, times.minMs, times.maxMs, times.repetitions);
}

std::string timesLine(std::string_view name, const measure::Summary& times) {
  return fmt::format("{:<12}{:.4f} ms median, {:.4f} ms processor time, {:.4f} to {:.4f} ms in {}\n", name,
                     times.medianMs, times.medianCpuMs, times.minMs, times.maxMs,
                     counted(times.repetitions, "repetition"));
}

std::string provenanceJson(const measure::Provenance& p) {
  return fmt::format("  \"commit\": {},\n  \"compiler\": {},\n  \"build\": {},\n  \"processor\": {},\n  \"date\": {}\n",
                     jsonQuoted(p.commit), jsonQuoted(p.compiler), jsonQuoted(p.buildType), jsonQuoted(p.processor),
                     jsonQuoted(p.date));
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
  std::string text =
      fmt::format("{{\n  \"input\": {},\n  \"n\": {},\n  \"pairs\": {},\n", jsonQuoted(r.input), r.boxes, r.pairs);
  if (!r.hash.empty()) text += fmt::format("  \"hash\": {},\n", jsonQuoted(r.hash));
  text += fmt::format("  \"box_tests\": {},\n  \"group_tests\": {},\n", r.work.boxTests, r.work.groupTests);
  text += timesJson("", r.oneShot) + timesJson("warm_", r.warm);
  text += fmt::format("  \"order\": {},\n  \"strategy\": {},\n  \"threads\": {},\n  \"instruction_set\": {},\n",
                      jsonQuoted(r.order), jsonQuoted(r.strategy), r.threads, jsonQuoted(r.instructionSet));
  return text + provenanceJson(r.provenance) + "}\n";
}

}  // namespace allpairs::app
