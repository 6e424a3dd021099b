// SPDX-License-Identifier: MIT
#include "elements/ElementReport.h"

#include <fmt/format.h>

#include "JsonText.h"
#include "cli/Text.h"

namespace allpairs::app {
namespace {

using view::JsonText;

std::string countsText(const elements::ElementCounts& counts) {
  return fmt::format("{}, {}, {}", counted(counts.vertices, "vertex", "vertices"), counted(counts.edges, "edge"),
                     counted(counts.triangles, "triangle"));
}

void addMesh(const ElementReport::Mesh& mesh, JsonText& json) {
  json.beginObject();
  json.add("name", mesh.name);
  json.add("vertices", mesh.counts.vertices);
  json.add("edges", mesh.counts.edges);
  json.add("faces", mesh.counts.triangles);
  json.endObject();
}

void addStatistics(const ElementReport& report, JsonText& json) {
  json.beginObject("statistics");
  json.addReal("distance", report.distance);
  json.add("between", report.betweenOnly);
  json.add("threads", report.threads);
  json.add("readSeconds", report.readSeconds);
  json.add("findSeconds", report.findSeconds);
  json.endObject();
}

}  // namespace

std::string tableOf(const ElementReport& report) {
  std::string text;
  if (report.meshes.size() > 1) {
    for (const ElementReport::Mesh& mesh : report.meshes) {
      text += fmt::format("mesh         {}: {}\n", printable(mesh.name), countsText(mesh.counts));
    }
    if (report.betweenOnly) text += "wanted       candidates between different meshes\n";
  }
  text += fmt::format("elements     {}\ndistance     {}\n", countsText(report.counts), report.distance);
  for (std::size_t i = 0; i < kKindNames.size(); ++i) {
    text += fmt::format("{:<13}{}\n", kKindNames[i].title, grouped(report.candidates[i]));
  }
  for (const ElementReport::File& file : report.files) text += fmt::format("file         {}\n", printable(file.path));
  text += fmt::format("time         {:.1f} ms to read, {:.1f} ms to find on {}\n", 1e3 * report.readSeconds,
                      1e3 * report.findSeconds, counted(report.threads, "thread"));
  return text;
}

std::string jsonOf(const ElementReport& report) {
  JsonText json(JsonText::Layout::Indented);
  json.beginObject();
  for (std::size_t i = 0; i < kKindNames.size(); ++i) json.add(kKindNames[i].key, report.candidates[i]);
  json.add("vertices", report.counts.vertices);
  json.add("edges", report.counts.edges);
  json.add("faces", report.counts.triangles);
  json.beginList("meshes");
  for (const ElementReport::Mesh& mesh : report.meshes) addMesh(mesh, json);
  json.endList();
  json.beginObject("files");
  for (const ElementReport::File& file : report.files) json.add(file.key, file.path);
  json.endObject();
  addStatistics(report, json);
  json.endObject();
  return json.text() + '\n';
}

}  // namespace allpairs::app
