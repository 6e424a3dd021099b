// SPDX-License-Identifier: MIT
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "allpairs/scene/WriteResult.h"
#include "write/TextBuffer.h"

namespace allpairs::scene {
namespace {

/// Quoted and escaped; bytes that are no UTF-8 become U+FFFD, since JSON has no way to say them.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string number(double value) {
  if (std::isinf(value)) return value > 0 ? "\"inf\"" : "\"-inf\"";
  return fmt::format("{}", value);
}

std::string corner(const std::array<double, 3>& point) {
  return '[' + number(point[0]) + ", " + number(point[1]) + ", " + number(point[2]) + ']';
}

std::string boxValue(const Box& box) { return '[' + corner(box.min) + ", " + corner(box.max) + ']'; }

void writeModel(const ModelRecord& model, TextBuffer& out) {
  out.format(R"({{"name": {}, )", quoted(model.name));
  if (!model.file.empty()) out.format(R"("file": {}, )", quoted(model.file));
  if (!model.path.empty()) out.format(R"("path": {}, )", quoted(model.path));
  if (!model.kind.empty()) out.format(R"("ifcType": {}, "globalId": {}, )", quoted(model.kind), quoted(model.id));
  out.format(R"("type": {}, "elements": {}, )", quoted(model.type), model.elements);
  out.format(R"("box": {}, )", boxValue(model.box));
  out.format(R"("active": {}, "simulated": {}, "moving": {}, "selfCollision": {}, )", model.active, model.simulated,
             model.moving, model.selfCollision);
  if (model.outside) out.format(R"("outside": {}, )", *model.outside);
  out.format(R"("groups": [{}], "contactDistance": {}}})", fmt::join(model.groups, ", "),
             number(model.contactDistance));
}

/// `view` is a ResultView or an InputView.
template <class View>
void writeModels(const View& view, TextBuffer& out) {
  out.append("{\"models\": [");
  for (std::size_t i = 0; i < view.modelCount; ++i) {
    out.append(i == 0 ? "\n  " : ",\n  ");
    writeModel(view.model(i), out);
  }
  out.append("],\n");
}

void writePairs(const ResultView& result, TextBuffer& out) {
  constexpr std::size_t kPairsPerLine = 8;  // so that no line has megabytes
  out.append("\"pairs\": [");
  for (std::size_t i = 0; i < result.pairs.size(); ++i) {
    const Pair pair = result.pairs[i];
    if (i != 0) out.append(i % kPairsPerLine == 0 ? ",\n  " : ", ");
    out.format("[{}, {}]", result.swapped ? pair.second : pair.first, result.swapped ? pair.first : pair.second);
  }
  out.append("],\n");
}

void writeRemarks(std::string_view name, std::span<const Remark> remarks, TextBuffer& out) {
  out.format("\"{}\": [", name);
  for (std::size_t i = 0; i < remarks.size(); ++i) {
    const Remark& remark = remarks[i];
    out.append(i == 0 ? "\n  " : ",\n  ");
    out.format(R"({{"file": {}, "line": {}, )", quoted(remark.file.string()), remark.line);
    out.format(R"("subject": {}, "reason": {}}})", quoted(remark.subject), quoted(remark.reason));
  }
  out.append("],\n");
}

/// `detected`: how many pairs each has is known.
void writePipelines(std::span<const PipelineRecord> pipelines, bool detected, TextBuffer& out) {
  if (pipelines.empty()) return;
  out.append("\"pipelines\": [");
  for (std::size_t i = 0; i < pipelines.size(); ++i) {
    const PipelineRecord& pipeline = pipelines[i];
    out.append(i == 0 ? "\n  " : ",\n  ");
    out.format(R"({{"name": {}, "method": {}, "distance": {}, )", quoted(pipeline.name), quoted(pipeline.method),
               number(pipeline.distance));
    if (pipeline.region) out.format(R"("region": {}, )", boxValue(*pipeline.region));
    out.format(R"("models": [{}])", fmt::join(pipeline.models, ", "));
    if (detected) out.format(R"(, "pairs": {})", pipeline.pairs);
    out.append("}");
  }
  out.append("],\n");
}

void writeStatistics(const ResultView& result, TextBuffer& out) {
  const DetectionStatistics& statistics = result.statistics;
  out.format(R"("statistics": {{"models": {}, "pairs": {}, "distance": {}, )", result.modelCount, result.pairs.size(),
             number(statistics.distance));
  out.format(R"("strategy": {}, "threads": {}, "verified": {}, )", quoted(statistics.strategy), statistics.threads,
             statistics.verified);
  out.format(R"("testsOfAllPairs": {}, "testsMade": {}, "candidates": {}, )", statistics.testsOfAllPairs,
             statistics.testsMade, statistics.candidates);
  out.format(R"("readSeconds": {}, "detectSeconds": {}}}}})", statistics.readSeconds, statistics.detectSeconds);
  out.append("\n");
}

void writeSummary(const InputView& input, TextBuffer& out) {
  out.format(R"("statistics": {{"models": {}, "elements": {}, "box": {}, )", input.modelCount, input.elements,
             boxValue(input.box));
  if (input.region) out.format(R"("region": {}, )", boxValue(*input.region));
  out.format(R"("method": {}, "distance": {}}}}})", quoted(input.method), number(input.distance));
  out.append("\n");
}

}  // namespace

void writeJson(const ResultView& result, ByteSink sink) {
  TextBuffer out(sink);
  writeModels(result, out);
  writePairs(result, out);
  writeRemarks("ignored", result.ignored, out);
  writeRemarks("warnings", result.warnings, out);
  writePipelines(result.pipelines, true, out);
  writeStatistics(result, out);
  out.flush();
}

void writeInputJson(const InputView& input, ByteSink sink) {
  TextBuffer out(sink);
  writeModels(input, out);
  writeRemarks("ignored", input.ignored, out);
  writeRemarks("warnings", input.warnings, out);
  writePipelines(input.pipelines, false, out);
  writeSummary(input, out);
  out.flush();
}

}  // namespace allpairs::scene
