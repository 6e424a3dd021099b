// SPDX-License-Identifier: MIT
#include "elements/ElementReport.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/Text.h"

namespace allpairs::app {
namespace {

std::string countsText(const elements::ElementCounts& counts) {
  return fmt::format("{}, {}, {}", counted(counts.vertices, "vertex", "vertices"), counted(counts.edges, "edge"),
                     counted(counts.triangles, "triangle"));
}

nlohmann::ordered_json meshesJson(const ElementReport& report) {
  nlohmann::ordered_json meshes = nlohmann::ordered_json::array();
  for (const ElementReport::Mesh& mesh : report.meshes) {
    meshes.push_back({{"name", mesh.name},
                      {"vertices", mesh.counts.vertices},
                      {"edges", mesh.counts.edges},
                      {"faces", mesh.counts.triangles}});
  }
  return meshes;
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
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < kKindNames.size(); ++i) json[std::string(kKindNames[i].key)] = report.candidates[i];
  json["vertices"] = report.counts.vertices;
  json["edges"] = report.counts.edges;
  json["faces"] = report.counts.triangles;
  json["meshes"] = meshesJson(report);
  json["files"] = nlohmann::ordered_json::object();
  for (const ElementReport::File& file : report.files) json["files"][file.key] = file.path;
  json["statistics"] = {{"distance", report.distance},
                        {"between", report.betweenOnly},
                        {"threads", report.threads},
                        {"readSeconds", report.readSeconds},
                        {"findSeconds", report.findSeconds}};
  return json.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace allpairs::app
